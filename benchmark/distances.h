// SPDX-License-Identifier: GPL-3.0-or-later
//
// The true distance of a result to its input, whoever made it.
#ifndef SURETY_BENCHMARK_DISTANCES_H
#define SURETY_BENCHMARK_DISTANCES_H

#include "models.h"

#include <string>

namespace surety::benchmark {

/// The two-sided Hausdorff distance of two meshes, certified.
struct Distance {
  double lower, upper;
  std::string is_within; ///< the tolerance: yes, no, or undecided
};

/// Encloses the distance to a hundredth of the tolerance.
Distance measure_distance(const Mesh& input, const Mesh& output, double tolerance);

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_DISTANCES_H
