// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes as binary glTF 2.0 (.glb), the format that viewers and engines load as it is.
#ifndef SURETY_TOOL_GLB_H
#define SURETY_TOOL_GLB_H

#include "mesh.h"

#include <iosfwd>

namespace surety::tool {

/// Writes points in single precision, and faces.
void write_glb(std::ostream& stream, const Mesh& mesh);

/// How far a vertex moves at most when its coordinates are rounded to single precision, rounded up;
/// infinite where a coordinate does not fit. No point of a face moves farther.
double single_precision_error(const Mesh& mesh);

} // namespace surety::tool

#endif // SURETY_TOOL_GLB_H
