// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric support of a mesh, as the command line asks for it, and files that show it.
#ifndef SURETY_TOOL_SUPPORT_H
#define SURETY_TOOL_SUPPORT_H

#include "mesh.h"
#include "report.h"

#include <surety/features.h>
#include <surety/geometric_support.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>

namespace surety::tool {

/// What the user wants to know; lengths as they were given, empty where they were not.
struct Support_request {
  bool is_wanted = false;
  std::string tolerance, noise_floor;
  std::size_t subdivisions = 4;
  double corner_angle = internal::defaults::corner_angle;
  /// Of ridges; none: the ridges that the tolerance needs.
  std::optional<double> feature_angle;
};

struct Support {
  Features features;
  Geometric_support surface;
};

/// Adds --support and --subdivisions.
void add_support_options(CLI::App& command, Support_request& request);

/// \throws Failure (usage) where a length does not suit this mesh.
Support make_support(const Mesh& mesh, const Support_request& request, Stopwatch& watch);

Json describe(const Support& support);

/// The same for people.
std::string to_text(const Support& support);

/// \throws Failure (usage) if supports are not written with this extension.
void require_support_format(const std::string& file, const std::string& extension);

/// Writes the patches, cut into triangles, as vtp or ply.
void write_support(
    std::ostream& stream, const std::string& extension, const Mesh& mesh,
    const Geometric_support& support, std::size_t subdivisions);

} // namespace surety::tool

#endif // SURETY_TOOL_SUPPORT_H
