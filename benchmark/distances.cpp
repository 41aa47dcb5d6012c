// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one instantiation of the verifier.
#include "distances.h"

#include <surety/distance.h>

#include <algorithm>

namespace surety::benchmark {

Distance measure_distance(const Mesh& input, const Mesh& output, double tolerance)
{
  const auto proof = certify_distance(input, output, tolerance, parameters::relative_slack(1));
  const auto distance = hausdorff_distance(input, output, tolerance / 100);
  return {
      std::max(distance.lower(), proof.lower_bound()),
      std::min(distance.upper(), proof.upper_bound()),
      proof.holds()         ? "yes"
          : proof.refuted() ? "no"
                            : "undecided"};
}

} // namespace surety::benchmark
