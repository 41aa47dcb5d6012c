// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colours, normals and texture coordinates in the formats that have room for them.
#ifndef SURETY_TOOL_ATTRIBUTE_WRITING_H
#define SURETY_TOOL_ATTRIBUTE_WRITING_H

#include "attributes.h"
#include "mesh.h"
#include "vtp.h"

#include <iosfwd>
#include <vector>

namespace surety::tool {

/// A mesh with the attributes of its corners: colours behind the coordinates of the vertices,
/// normals and texture coordinates by corner, each value once.
void write_obj(std::ostream& stream, const Mesh& mesh, const Attributes& attributes);

/// Gives a copy the properties from which CGAL writes PLY.
/// \param mesh with the attributes; the copy has the same vertices.
void add_ply_properties(Mesh& copy, const Attributes& attributes, const Mesh& mesh);

/// As arrays `color`, `normal` and `texture` of the vertices.
std::vector<Vtp_array> vtp_arrays(const Attributes& attributes, const Mesh& mesh);

} // namespace surety::tool

#endif // SURETY_TOOL_ATTRIBUTE_WRITING_H
