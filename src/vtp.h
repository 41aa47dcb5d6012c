// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes with data for ParaView, as XML text. CGAL writes VTP with the VTK library only, and the
// format is simple enough to write here.
#ifndef SURETY_TOOL_VTP_H
#define SURETY_TOOL_VTP_H

#include "mesh.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace surety::tool {

/// Values of vertices or of faces, in the order of the mesh.
struct Vtp_array {
  std::string name;
  int components = 1;
  std::vector<double> values;
  bool is_integral = false;
  bool is_color = false; ///< integers from 0 to 255, which viewers show as they are
};

/// \param shown_first an array that a viewer selects; empty: none.
void write_vtp(
    std::ostream& stream, const Mesh& mesh, const std::vector<Vtp_array>& vertex_data,
    const std::vector<Vtp_array>& face_data, const std::string& shown_first);

} // namespace surety::tool

#endif // SURETY_TOOL_VTP_H
