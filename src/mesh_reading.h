// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading of meshes from files.
#ifndef SURETY_TOOL_MESH_READING_H
#define SURETY_TOOL_MESH_READING_H

#include "attributes.h"
#include "mesh.h"
#include "repair.h"

#include <string>

namespace surety::tool {

struct Reading {
  bool triangulate = false; ///< split faces of more than three corners instead of refusing them
  bool repair = false;      ///< make a manifold surface of what is none
  bool stitch = true;       ///< merge equal points if the file knows no connectivity
};

/// The mesh of an OFF, OBJ, PLY, STL or Medit file, its vertices and faces in the order of the
/// file; a Medit file's has `Marks`. \throws Bad_file if the file cannot be read or holds no valid
/// surface; the message names the offending element and the remedy.
Mesh read_mesh(const std::string& file, const Reading& options);
/// The same; adds what was repaired.
Mesh read_mesh(const std::string& file, const Reading& options, Repairs& repairs);
/// The same; also gives the colours, normals and texture coordinates of its corners.
Mesh read_mesh(
    const std::string& file, const Reading& options, Repairs& repairs, Attributes& attributes);

/// The triangles of a file as a mesh that serves to measure distances: if they are no manifold
/// surface, or not orientable, or degenerate, they do not hang together, which changes no distance.
/// \throws Bad_file if the file cannot be read or holds no triangles.
Mesh read_triangles(const std::string& file, const Reading& options);

} // namespace surety::tool

#endif // SURETY_TOOL_MESH_READING_H
