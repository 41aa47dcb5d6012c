// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a surface to tetrahedra: remeshes a closed part, hands both the input and the result with
// their features to CGAL's volume mesher, with the same criteria, and prints the quality of both
// volumes.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <surety/remesh.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_polyhedron_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Volume = CGAL::Mesh_complex_3_in_triangulation_3<
    Triangulation, Domain::Corner_index, Domain::Curve_index>;

/// The least and the largest dihedral angle, and the mean of radius of the circumscribed sphere
/// over shortest edge, .612 for the regular tetrahedron.
void print_quality(const std::string& name, std::size_t faces, const Volume& volume)
{
  double least = 180, largest = 0, sum = 0;
  std::size_t small = 0;
  for (auto cell = volume.cells_in_complex_begin(); cell != volume.cells_in_complex_end(); ++cell) {
    const auto t = volume.triangulation().tetrahedron(cell);
    double shortest = CGAL::squared_distance(t[0], t[1]), least_here = 180;
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        const int k = (i == 0 ? (j == 1 ? 2 : 1) : 0), l = 6 - i - j - k;
        const double angle = std::abs(CGAL::approximate_dihedral_angle(t[i], t[j], t[k], t[l]));
        least_here = std::min(least_here, angle);
        largest = std::max(largest, angle);
        shortest = std::min(shortest, CGAL::squared_distance(t[i], t[j]));
      }
    }
    least = std::min(least, least_here);
    small += least_here < 10;
    const auto center = CGAL::circumcenter(t);
    sum += std::sqrt(CGAL::squared_distance(center, t[0]) / shortest);
  }
  const std::size_t cells = volume.number_of_cells_in_complex();
  std::cout << name << ": " << faces << " faces, " << cells << " tetrahedra, dihedral angles from "
            << least << " to " << largest << " degrees, " << small
            << " tetrahedra below 10, mean radius-edge ratio " << sum / double(cells) << '\n';
}

/// A volume whose surface has edges of about a size, with its features kept.
Volume mesh_volume(const Mesh& mesh, double size, double distance, double feature_angle)
{
  Polyhedron polyhedron;
  CGAL::copy_face_graph(mesh, polyhedron);
  Domain domain(polyhedron);
  domain.detect_features(feature_angle);
  using namespace CGAL::parameters;
  const CGAL::Mesh_criteria_3<Triangulation> criteria(
      edge_size = size, facet_angle = 25, facet_size = size, facet_distance = distance,
      cell_radius_edge_ratio = 2, cell_size = size);
  return CGAL::make_mesh_3<Volume>(domain, criteria);
}

int main(int argc, char* argv[])
{
  Mesh input;
  if (argc != 4 || !CGAL::IO::read_polygon_mesh(argv[1], input) || !CGAL::is_closed(input)) {
    std::cerr << "usage: volume_mesh closed_mesh.off tolerance size\n";
    return EXIT_FAILURE;
  }
  const double tolerance = std::stod(argv[2]), size = std::stod(argv[3]);
  constexpr double feature_angle = 40;

  Mesh surface = input;
  const auto result = surety::remesh(
      surface, tolerance, surety::parameters::feature_angle(feature_angle).maximum_size(size));
  if (!result.unit_mesh.certificate.holds()) return EXIT_FAILURE;

  const Volume raw = mesh_volume(input, size, tolerance, feature_angle);
  const Volume made = mesh_volume(surface, size, tolerance, feature_angle);
  print_quality("input", input.number_of_faces(), raw);
  print_quality("remeshed", surface.number_of_faces(), made);
  return made.number_of_cells_in_complex() > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
