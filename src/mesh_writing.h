// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writing of meshes. Coordinates survive exactly, and vertices and faces keep their order, so
// that a certificate holds for the file as it holds for the mesh.
#ifndef SURETY_TOOL_MESH_WRITING_H
#define SURETY_TOOL_MESH_WRITING_H

#include "attributes.h"
#include "mesh.h"

#include <iosfwd>
#include <string>

namespace surety::tool {

/// Whether a mesh can be written with this extension.
bool is_writable(const std::string& extension);

/// Whether files with this extension have ridges, corners and references.
bool is_medit(const std::string& extension);

/// Whether every coordinate is a single-precision number: such meshes go to binary STL.
bool has_float_coordinates(const Mesh& mesh);

/// How far each face may lie from the input, and the most that was allowed.
struct Deviation {
  Mesh::Property_map<Mesh::Face_index, double> bound;
  double tolerance;
};

/// Writes a mesh. PLY and VTP also carry the deviation and the quality of each face; PLY shows the
/// former as colours, from dark (0) to bright (the tolerance), unless the vertices have colours.
/// Medit's files have what is marked. PLY, OBJ and VTP have the attributes: OBJ those of each
/// corner, the others one value a vertex.
void write_mesh(
    std::ostream& stream, const std::string& extension, const Mesh& mesh,
    const Deviation& deviation, const Attributes& attributes = {});

} // namespace surety::tool

#endif // SURETY_TOOL_MESH_WRITING_H
