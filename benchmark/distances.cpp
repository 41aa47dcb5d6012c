// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one instantiation of the verifier.
#include "distances.h"

#include "stopwatch.h"

namespace surety::benchmark {

void report_distance(const Mesh& input, const Mesh& output, double tolerance, const Report& report)
{
  const Stopwatch stopwatch;
  const auto proof = certify_distance(input, output, tolerance, parameters::relative_slack(1));
  const auto distance = hausdorff_distance(input, output, tolerance / 100);
  report.set("distance_seconds", stopwatch.seconds());
  report.set("distance_lower_over_tolerance", distance.lower() / tolerance);
  report.set("distance_upper_over_tolerance", distance.upper() / tolerance);
  report.set("within_tolerance", proof.holds() ? "yes" : proof.refuted() ? "no" : "undecided");
}

} // namespace surety::benchmark
