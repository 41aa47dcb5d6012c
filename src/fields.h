// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature and metric of a mesh, as the command line asks for them.
#ifndef SURETY_TOOL_FIELDS_H
#define SURETY_TOOL_FIELDS_H

#include "mesh.h"
#include "report.h"

#include <surety/curvature_field.h>
#include <surety/metric_field.h>
#include <surety/parameters.h>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace surety::tool {

/// What the user wants to know; lengths as they were given, empty where they were not.
struct Field_request {
  bool curvature = false, metric = false;
  std::string noise_floor, tolerance, minimum_size, maximum_size;
  Metric_kind kind = internal::defaults::metric_kind;
  double gradation = internal::defaults::gradation;

  bool is_empty() const { return !curvature && !metric; }
};

/// A metric, and what was decided on the way to it.
struct Graded_metric {
  Metric_field field;
  double tolerance = 0, minimum_size = 0, maximum_size = 0, gradation = 1;
  std::size_t changed_sides = 0; ///< by gradation
  double predicted_faces = 0;    ///< area in the metric over that of a unit triangle
};

struct Fields {
  Curvature_field curvature; ///< from which the metric follows, too
  std::optional<Graded_metric> metric;
};

/// Adds --curvature, --metric and the options that go with them.
void add_field_options(CLI::App& command, Field_request& request);

/// \throws Failure (usage) where the options do not make sense together, or a length is none.
void check(const Field_request& request);

/// \throws Failure (usage) where a length does not suit this mesh.
Fields make_fields(
    const Mesh& mesh, const Features& features, const Field_request& request, Stopwatch& watch);

/// Ranges, counts and fallbacks, over all sides of all vertices.
Json describe(const Curvature_field& curvature);
Json describe(const Graded_metric& metric);

/// The same for people, a line each.
std::string to_text(const Curvature_field& curvature);
std::string to_text(const Graded_metric& metric);

} // namespace surety::tool

#endif // SURETY_TOOL_FIELDS_H
