// SPDX-License-Identifier: GPL-3.0-or-later
//
// Our own simplification with the options that the benchmarks share, instantiated once.
#ifndef SURETY_BENCHMARK_SIMPLIFICATION_H
#define SURETY_BENCHMARK_SIMPLIFICATION_H

#include "models.h"

#include <surety/certificate.h>
#include <surety/parameters.h>

#include <CLI/CLI.hpp>

namespace surety::benchmark {

struct Controls {
  Placement placement = surety::internal::defaults::placement;
  Effort effort = surety::internal::defaults::effort;
  double feature_angle = surety::internal::defaults::feature_angle;
  Deviation_bound bound = surety::internal::defaults::deviation_bound;
  bool allow_self_intersections = surety::internal::defaults::allow_self_intersections;
};

/// Adds --feature-angle and --allow-self-intersections.
void add_quality_options(CLI::App& program, Controls& controls);

/// Adds these, --placement and --effort.
void add_options(CLI::App& program, Controls& controls);

/// The name of an effort at the command line.
const char* name_of(Effort effort);

Certificate simplify(Mesh& mesh, double tolerance, const Controls& controls);

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_SIMPLIFICATION_H
