// SPDX-License-Identifier: GPL-3.0-or-later
//
// meshoptimizer's simplifier with the tolerance as its target error.
#include "peers.h"

#include "stopwatch.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <meshoptimizer.h>

#include <array>
#include <vector>

namespace surety::benchmark {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

using Indices = std::vector<unsigned int>;

Indices corner_indices(const Mesh& mesh)
{
  Indices indices;
  for (const auto f : mesh.faces()) {
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) indices.push_back(v.idx());
  }
  return indices;
}

/// It knows single precision only.
std::vector<float> coordinates(const Mesh& mesh)
{
  std::vector<float> result;
  for (const auto v : mesh.vertices()) {
    for (int i = 0; i < 3; ++i) result.push_back(static_cast<float>(mesh.point(v)[i]));
  }
  return result;
}

/// The result need not be manifold: what hangs together at single edges or vertices is separated,
/// which does not change the surface. Its vertices are the input's, in double precision.
Mesh to_mesh(const Mesh& input, const Indices& indices)
{
  std::vector<Point> points;
  for (const auto v : input.vertices()) points.push_back(input.point(v));
  std::vector<std::array<std::size_t, 3>> triangles;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  PMP::remove_isolated_points_in_polygon_soup(points, triangles);
  PMP::orient_polygon_soup(points, triangles);
  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  return mesh;
}

double simplify(Mesh& mesh, const Goal& goal)
{
  const Indices indices = corner_indices(mesh);
  const std::vector<float> points = coordinates(mesh);
  const std::size_t vertices = points.size() / 3, stride = 3 * sizeof(float);

  const Stopwatch stopwatch;
  const float scale = meshopt_simplifyScale(points.data(), vertices, stride);
  Indices result(indices.size());
  result.resize(meshopt_simplify(
      result.data(), indices.data(), indices.size(), points.data(), vertices, stride, 0,
      static_cast<float>(goal.tolerance) / scale, 0, nullptr));
  const double seconds = stopwatch.seconds();
  mesh = to_mesh(mesh, result);
  return seconds;
}

} // namespace

Peer meshoptimizer_target_error() { return {"meshoptimizer", true, false, simplify}; }

} // namespace surety::benchmark
