// SPDX-License-Identifier: GPL-3.0-or-later
//
// Four levels of detail, and a mesh between two of them.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/hierarchy.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

int main(int argc, char* argv[])
{
  Mesh mesh;
  if (argc != 3 || !CGAL::IO::read_polygon_mesh(argv[1], mesh) || mesh.is_empty()) {
    std::cerr << "usage: make_levels input.off finest_tolerance\n";
    return EXIT_FAILURE;
  }
  const double finest = std::stod(argv[2]);
  const auto hierarchy
      = surety::make_hierarchy(mesh, {finest, 4 * finest, 16 * finest, 64 * finest});

  bool all_hold = true;
  for (const auto& level : hierarchy.levels()) {
    std::cout << level.mesh.number_of_faces() << " faces within " << level.certificate.bound()
              << '\n';
    all_hold = all_hold && level.certificate.holds();
  }
  const auto between = hierarchy.extract_faces(mesh.number_of_faces() / 4);
  std::cout << "a quarter of the faces: " << between.mesh.number_of_faces() << " within "
            << between.tolerance << '\n';
  return all_hold ? EXIT_SUCCESS : EXIT_FAILURE;
}
