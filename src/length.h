// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lengths as users give them: in mesh units, or in per cent of a bounding-box diagonal.
#ifndef SURETY_TOOL_LENGTH_H
#define SURETY_TOOL_LENGTH_H

#include "mesh.h"

#include <string>

namespace surety::tool {

class Length
{
public:
  /// From a positive decimal number, with or without a '%' behind it.
  /// \throws Failure (usage) that names the option, for anything else: signs, infinities, blanks,
  /// letters, more than 100 %.
  static Length parse(const std::string& text, const std::string& option);

  /// The length in mesh units, for a mesh with this bounding-box diagonal.
  /// \throws Failure (usage) if that is longer than the diagonal, or rounds to nothing.
  double in_units(double diagonal) const;

private:
  Length(double value, bool is_per_cent, std::string option)
    : value_(value), is_per_cent_(is_per_cent), option_(std::move(option))
  {}

  double value_;
  bool is_per_cent_;
  std::string option_;
};

/// Length of the diagonal of the mesh's bounding box.
double diagonal(const Mesh& mesh);

} // namespace surety::tool

#endif // SURETY_TOOL_LENGTH_H
