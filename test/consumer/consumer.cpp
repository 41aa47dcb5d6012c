// SPDX-License-Identifier: GPL-3.0-or-later
//
// Uses the library as a stranger would, in two translation units, and exits with 0 if a simplified
// sphere is certified, and the second unit says so, too.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/geometric_mesh.h>
#include <surety/version.h>

#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>
#include <cmath>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

bool lie_within(const Mesh& a, const Mesh& b, double tolerance);

namespace {

/// The unit sphere: an icosahedron, subdivided, its vertices pushed out.
Mesh unit_sphere(unsigned subdivisions)
{
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Kernel::Point_3(0, 0, 0), 1.);
  CGAL::Subdivision_method_3::Loop_subdivision(
      mesh, CGAL::parameters::number_of_iterations(subdivisions));
  for (const auto v : mesh.vertices()) {
    const Kernel::Vector_3 radius(CGAL::ORIGIN, mesh.point(v));
    mesh.point(v) = CGAL::ORIGIN + radius / std::sqrt(radius.squared_length());
  }
  return mesh;
}

} // namespace

int main()
{
  const Mesh sphere = unit_sphere(3);
  Mesh simplified = sphere;
  const auto certificate = surety::make_geometric_mesh(simplified, 0.01);
  std::cout << "surety " SURETY_VERSION_STRING ": " << sphere.number_of_faces() << " -> "
            << simplified.number_of_faces() << " faces within " << certificate.bound() << '\n';
  return certificate.holds() && simplified.number_of_faces() < sphere.number_of_faces()
          && lie_within(sphere, simplified, 0.01)
      ? EXIT_SUCCESS
      : EXIT_FAILURE;
}
