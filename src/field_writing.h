// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature and metric, one value a vertex, for viewers and for other mesh generators.
//
// Where features pass, a vertex has several curvatures, one a side: files show the side whose
// curvature is largest in absolute value, the first of equal ones, and name a face of it. Of
// metrics they show what satisfies all sides.
#ifndef SURETY_TOOL_FIELD_WRITING_H
#define SURETY_TOOL_FIELD_WRITING_H

#include "fields.h"

#include <iosfwd>
#include <string>

namespace surety::tool {

/// The colours of a PLY file: those of the mean curvature go from blue (-limit) by grey to red
/// (limit); those of sizes from blue (the least) to red (the largest), by logarithm.
struct Color_range {
  std::string quantity;
  double low, high;
};

/// The mean curvature if the request has it, otherwise the least size. Of 100 vertices the two
/// most curved ones do not count, for one sharp spot would leave the rest grey.
Color_range color_range(const Mesh& mesh, const Fields& fields, const Field_request& request);

/// \throws Failure (usage) if the request cannot be written with this extension.
void require_field_format(
    const std::string& file, const std::string& extension, const Field_request& request);

/// Writes vtp, ply or sol.
void write_fields(
    std::ostream& stream, const std::string& extension, const Mesh& mesh, const Fields& fields,
    const Field_request& request);

} // namespace surety::tool

#endif // SURETY_TOOL_FIELD_WRITING_H
