// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one instantiation of make_geometric_mesh without threads.
#include "simplification.h"

#include <surety/geometric_mesh.h>

#include <map>
#include <string>

namespace surety::benchmark {

void add_options(CLI::App& program, Controls& controls)
{
  add_quality_options(program, controls);
  const std::map<std::string, Placement> placements
      = {{"on-surface", Placement::on_surface}, {"free", Placement::free}};
  program.add_option("--placement", controls.placement, "Of ours: where vertices may go")
      ->transform(CLI::CheckedTransformer(placements).description("on-surface|free"))
      ->default_str("on-surface");
  const std::map<std::string, Effort> efforts
      = {{"fast", Effort::fast}, {"default", Effort::standard}, {"best", Effort::best}};
  program.add_option("--effort", controls.effort, "Of ours: the work spent on having few faces")
      ->transform(CLI::CheckedTransformer(efforts).description("fast|default|best"))
      ->default_str("default");
}

void add_quality_options(CLI::App& program, Controls& controls)
{
  program.add_option("--feature-angle", controls.feature_angle, "Of ours: ridges, in degrees")
      ->capture_default_str();
  program.add_flag(
      "--allow-self-intersections", controls.allow_self_intersections,
      "Of ours: do not guard against self-intersections, as the peers");
}

const char* name_of(Effort effort)
{
  switch (effort) {
  case Effort::fast:
    return "fast";
  case Effort::standard:
    return "default";
  case Effort::best:
    return "best";
  }
  return "";
}

Certificate simplify(Mesh& mesh, double tolerance, const Controls& controls)
{
  return make_geometric_mesh(
      mesh, tolerance,
      parameters::placement(controls.placement)
          .effort(controls.effort)
          .feature_angle(controls.feature_angle)
          .deviation_bound(controls.bound)
          .allow_self_intersections(controls.allow_self_intersections));
}

} // namespace surety::benchmark
