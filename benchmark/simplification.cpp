// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one instantiation of make_geometric_mesh.
#include "simplification.h"

#include <surety/geometric_mesh.h>

namespace surety::benchmark {

void add_options(CLI::App& program, Controls& controls)
{
  program.add_option("--feature-angle", controls.feature_angle, "Of ours: ridges, in degrees")
      ->capture_default_str();
  program.add_flag(
      "--allow-self-intersections", controls.allow_self_intersections,
      "Of ours: do not guard against self-intersections, as the peers");
}

Certificate simplify(Mesh& mesh, double tolerance, const Controls& controls)
{
  return make_geometric_mesh(
      mesh, tolerance,
      parameters::feature_angle(controls.feature_angle)
          .deviation_bound(controls.bound)
          .allow_self_intersections(controls.allow_self_intersections));
}

} // namespace surety::benchmark
