// SPDX-License-Identifier: GPL-3.0-or-later
//
// Uses the installed library as a stranger would, in two translation units' worth of headers, and
// exits with 0 if a simplified grid is certified.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/surety.h>

#include <CGAL/boost/graph/generators.h>
#include <iostream>

int main()
{
  CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> mesh;
  using Point = CGAL::Epick::Point_3;
  CGAL::make_grid(
      10, 10, mesh, [](std::size_t i, std::size_t j) { return Point(i, j, 0); }, true);
  const auto faces = mesh.number_of_faces();
  const auto certificate = surety::make_geometric_mesh(mesh, 0.01);
  std::cout << "surety " SURETY_VERSION_STRING ": " << faces << " -> " << mesh.number_of_faces()
            << " faces\n";
  return certificate.holds() && mesh.number_of_faces() < faces ? EXIT_SUCCESS : EXIT_FAILURE;
}
