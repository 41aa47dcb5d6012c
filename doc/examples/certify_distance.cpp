// SPDX-License-Identifier: GPL-3.0-or-later
//
// Proves that two meshes lie within a distance of each other, or shows a point where they do not.
// The meshes may come from anywhere.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/distance.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

int main(int argc, char* argv[])
{
  Mesh a, b;
  if (argc != 4 || !CGAL::IO::read_polygon_mesh(argv[1], a)
      || !CGAL::IO::read_polygon_mesh(argv[2], b)) {
    std::cerr << "usage: certify_distance a.off b.off bound\n";
    return EXIT_FAILURE;
  }
  const auto proof = surety::certify_distance(a, b, std::stod(argv[3]));
  if (proof.holds()) {
    std::cout << "proven: within " << proof.upper_bound() << " of each other\n";
  } else if (const auto witness = proof.witness()) {
    std::cout << "refuted: the point (" << witness->point[0] << ", " << witness->point[1] << ", "
              << witness->point[2] << ") is at least " << witness->distance_lower_bound
              << " away from the other mesh\n";
  } else {
    std::cout << "undecided\n";
  }
  return proof.holds() ? EXIT_SUCCESS : EXIT_FAILURE;
}
