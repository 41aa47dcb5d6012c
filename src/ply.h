// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes with colours and data of their vertices, as binary PLY.
#ifndef SURETY_TOOL_PLY_H
#define SURETY_TOOL_PLY_H

#include "mesh.h"
#include "vtp.h"

#include <CGAL/IO/Color.h>

#include <iosfwd>
#include <vector>

namespace surety::tool {

/// PLY knows numbers only: arrays of several components become one property each, symmetric
/// matrices the six that differ. Whatever properties the mesh itself has are not written.
/// \param colors,vertex_data by vertex
void write_colored_ply(
    std::ostream& stream, const Mesh& mesh, const std::vector<CGAL::IO::Color>& colors,
    const std::vector<Vtp_array>& vertex_data);

} // namespace surety::tool

#endif // SURETY_TOOL_PLY_H
