// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tolerances that vary over the mesh, from a text file.
#ifndef SURETY_TOOL_TOLERANCE_FIELD_H
#define SURETY_TOOL_TOLERANCE_FIELD_H

#include "mesh.h"

#include <string>

namespace surety::tool {

using Tolerances = Mesh::Property_map<Mesh::Vertex_index, double>;

/// Adds the property "v:tolerance" to a mesh: `tolerance` everywhere, or, if a file is named, what
/// it says where that is less. The file holds one number for each vertex or one for each face, in
/// the order of the mesh's own file, apart by blanks or line ends; a face gives its tolerance to
/// its vertices, which take the least of them. \throws Bad_file if the file cannot be read, holds
/// another number of numbers, or one that is not positive and finite.
Tolerances add_tolerances(Mesh& mesh, double tolerance, const std::string& file);

} // namespace surety::tool

#endif // SURETY_TOOL_TOLERANCE_FIELD_H
