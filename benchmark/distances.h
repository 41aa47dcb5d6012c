// SPDX-License-Identifier: GPL-3.0-or-later
//
// The true distance of a result to its input, whoever made it, as columns of a table.
#ifndef SURETY_BENCHMARK_DISTANCES_H
#define SURETY_BENCHMARK_DISTANCES_H

#include "child.h"
#include "models.h"

#include <surety/distance.h>

#include <string>
#include <vector>

namespace surety::benchmark {

inline const std::vector<std::string>& distance_columns()
{
  static const std::vector<std::string> columns
      = {"distance_lower_over_tolerance", "distance_upper_over_tolerance", "within_tolerance",
         "distance_seconds"};
  return columns;
}

/// The two-sided Hausdorff distance, known to a hundredth of the tolerance, and whether it is
/// within the tolerance, for certain.
void report_distance(const Mesh& input, const Mesh& output, double tolerance, const Report& report);

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_DISTANCES_H
