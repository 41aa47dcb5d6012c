// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a mesh, features and normals, which the user may have mixed up, to what supports are made
// of.
#ifndef SURETY_INTERNAL_SUPPORT_INPUT_H
#define SURETY_INTERNAL_SUPPORT_INPUT_H

#include <surety/curvature_field.h>
#include <surety/features.h>
#include <surety/internal/support/flat_mesh.h>
#include <surety/internal/support/max_normals.h>
#include <surety/internal/validation.h>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace surety::internal {

/// The mesh of a support, its features, and normals by side: Max's where none are given.
struct Support_input {
  Flat_mesh mesh;
  std::vector<Vector> normals;
};

inline void require_size(
    std::size_t size, std::size_t expected, const char* function, const char* argument)
{
  if (size == expected) return;
  throw Invalid_input(
      function, argument,
      "it has " + std::to_string(size) + " entries, and the mesh asks for "
          + std::to_string(expected),
      "make it of the same mesh and the same features");
}

template <class Mesh, class NamedParameters>
Support_input support_input(
    const Mesh& mesh, const Features& features, const std::vector<Eigen::Vector3d>* normals,
    const char* function, const NamedParameters& np)
{
  require_valid_mesh(mesh, function, "mesh", np);
  require_size(features.edge.size(), num_edges(mesh), function, "features");
  require_size(features.corner.size(), num_vertices(mesh), function, "features");
  const Sides sides = find_sides(mesh, features);
  Support_input input{flatten(mesh, vertex_points(mesh, np)), {}};
  add_features(mesh, features, sides, input.mesh);
  if (normals == nullptr) {
    input.normals = max_normals(input.mesh);
    return input;
  }
  require_size(normals->size(), sides.size(), function, "normals");
  for (const Eigen::Vector3d& n : *normals) {
    if (n.allFinite())
      input.normals.push_back(unit(n));
    else
      throw Invalid_input(function, "normals", "a coordinate is not finite");
  }
  return input;
}

inline std::vector<Eigen::Vector3d> normals_of(const Curvature_field& curvature)
{
  std::vector<Eigen::Vector3d> normals;
  for (const Side_curvature& side : curvature.side) normals.push_back(side.normal);
  return normals;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_INPUT_H
