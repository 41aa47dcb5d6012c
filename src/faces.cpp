// SPDX-License-Identifier: GPL-3.0-or-later
#include "faces.h"

#include <surety/statistics.h>

#include <cmath>

namespace surety::tool {

std::vector<double> face_qualities(const Mesh& mesh)
{
  std::vector<double> values;
  for (const auto face : mesh.faces()) {
    const auto [a, b, c] = corners(mesh, face);
    values.push_back(quality(mesh.point(a), mesh.point(b), mesh.point(c)));
  }
  return values;
}

std::vector<double> face_sizes(const Mesh& mesh)
{
  const auto length = [&](Mesh::Vertex_index a, Mesh::Vertex_index b) {
    return std::sqrt(CGAL::squared_distance(mesh.point(a), mesh.point(b)));
  };
  std::vector<double> values;
  for (const auto face : mesh.faces()) {
    const auto [a, b, c] = corners(mesh, face);
    values.push_back((length(a, b) + length(b, c) + length(c, a)) / 3);
  }
  return values;
}

} // namespace surety::tool
