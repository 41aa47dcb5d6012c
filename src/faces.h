// SPDX-License-Identifier: GPL-3.0-or-later
//
// What several files ask of the faces of a mesh.
#ifndef SURETY_TOOL_FACES_H
#define SURETY_TOOL_FACES_H

#include "mesh.h"

#include <array>
#include <vector>

namespace surety::tool {

/// The vertices of a face, in the order of files.
inline std::array<Mesh::Vertex_index, 3> corners(const Mesh& mesh, Mesh::Face_index face)
{
  const auto h = mesh.halfedge(face);
  return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
}

/// By face: the quality Q.
std::vector<double> face_qualities(const Mesh& mesh);

/// By face: the mean length of its edges.
std::vector<double> face_sizes(const Mesh& mesh);

} // namespace surety::tool

#endif // SURETY_TOOL_FACES_H
