// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a page shows of a mesh.
#ifndef SURETY_TOOL_SHOWN_MESH_H
#define SURETY_TOOL_SHOWN_MESH_H

#include "mesh.h"
#include "report.h"

#include <cstddef>
#include <string>
#include <vector>

namespace surety::tool {

/// A value for each face, shown as a colour between two limits.
struct Shown_field {
  std::string name, label;
  double low, high;
  std::vector<double> values;
};

/// A mesh for the eye, and how far it may lie from the full one.
struct Display_mesh {
  Mesh mesh;
  double bound;
};

/// The mesh with about this number of faces, or as many as its topology needs.
Display_mesh simplified_for_display(const Mesh& mesh, std::size_t faces);

/// Points, faces and fields as base64 of little-endian integers: points by 16 bits of the largest
/// extent, which moves them by less than a hundred-thousandth of it; indices by 16 bits where these
/// suffice and 32 otherwise; values by 8 bits.
Json describe_shape(const Mesh& mesh, const std::vector<Shown_field>& fields);

} // namespace surety::tool

#endif // SURETY_TOOL_SHOWN_MESH_H
