// SPDX-License-Identifier: GPL-3.0-or-later
//
// Puts a smooth surface through the vertices of a mesh, within a tolerance of it, and asks it for
// closest points: how far are points beside the faces from the surface, and how is it curved there?
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/features_by_need.h>
#include <surety/geometric_support.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <algorithm>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

int main(int argc, char* argv[])
{
  Mesh mesh;
  if (argc != 3 || !CGAL::IO::read_polygon_mesh(argv[1], mesh) || mesh.is_empty()) {
    std::cerr << "usage: ask_support input.off tolerance\n";
    return EXIT_FAILURE;
  }
  const double tolerance = std::stod(argv[2]);
  const auto features = surety::find_features_by_need(mesh, tolerance);
  const auto support = surety::make_geometric_support(mesh, tolerance, features);
  std::cout << features.ridges << " ridges; smooth on " << 100 * support.report().tangent_share
            << " % of the area; proven within " << support.report().deviation << '\n';

  double farthest = 0, largest_curvature = 0;
  for (const auto f : mesh.faces()) {
    const auto [a, b, c] = support.corners(f);
    const auto centre = CGAL::centroid(
        mesh.point(Mesh::Vertex_index(a)), mesh.point(Mesh::Vertex_index(b)),
        mesh.point(Mesh::Vertex_index(c)));
    const auto found = support.closest_point({centre.x(), centre.y(), centre.z()});
    const auto curvature = support.curvature(found.location);
    farthest = std::max(farthest, std::sqrt(found.squared_distance));
    largest_curvature
        = std::max({largest_curvature, -curvature.min_curvature, curvature.max_curvature});
  }
  std::cout << "centres of faces are within " << farthest << " of it; it bends with radii down to "
            << 1 / largest_curvature << '\n';
  return farthest <= tolerance / 2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
