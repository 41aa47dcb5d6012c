// SPDX-License-Identifier: GPL-3.0-or-later
#include "controls.h"

#include "commands.h"
#include "failure.h"
#include "length.h"

#include <algorithm>
#include <limits>

namespace surety::tool {

const Names<Placement>& names_of_placements()
{
  static const Names<Placement> names
      = {{"on-surface", Placement::on_surface}, {"free", Placement::free}};
  return names;
}

const Names<Effort>& names_of_efforts()
{
  static const Names<Effort> names
      = {{"fast", Effort::fast}, {"default", Effort::standard}, {"best", Effort::best}};
  return names;
}

const Names<Deviation_bound>& names_of_bounds()
{
  static const Names<Deviation_bound> names
      = {{"direct", Deviation_bound::direct}, {"accumulated", Deviation_bound::accumulated}};
  return names;
}

void add_controls(CLI::App& command, Controls& controls)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto number
      = [&](const char* name, auto& value, const char* text, double low, double high) {
          command.add_option(name, value, text)->check(between(low, high))->capture_default_str();
        };
  command
      .add_option(
          "--placement", controls.placement,
          "where vertices may go; free: anywhere within the tolerance, which takes fewer faces")
      ->transform(CLI::CheckedTransformer(names_of_placements()).description("on-surface|free"))
      ->default_str(name_of(controls.placement, names_of_placements()));
  command
      .add_option(
          "--effort", controls.effort,
          "how much work to spend on having few faces; fast: less than a third of the time")
      ->transform(CLI::CheckedTransformer(names_of_efforts()).description("fast|default|best"))
      ->default_str(name_of(controls.effort, names_of_efforts()));
  number(
      "--feature-angle", controls.feature_angle,
      "keep edges that turn by more, in degrees, as ridges; 180: none", 0, 180);
  number(
      "--corner-angle", controls.corner_angle,
      "keep vertices where ridges or borders turn by more, in degrees", 0, 180);
  number(
      "--roughness-angle", controls.roughness_angle,
      "largest angle of a face to the original normals, in degrees; 180: any", 1e-6, 180);
  number(
      "--shape-ratio", controls.shape_ratio, "how much worse than the old faces new ones may be", 1,
      infinity);
  number(
      "--shape-floor", controls.shape_floor, "quality Q up to which any new face is admitted", 1,
      infinity);
  number("--flip-rounds", controls.flip_rounds, "rounds of edge flips; 0: none", 0, 1000);
  number(
      "--smoothing", controls.smoothing_sweeps,
      "sweeps at the end that make faces rounder within the tolerance; 0: none", 0, 1000);
  command.add_flag(
      "--allow-self-intersections", controls.allow_self_intersections,
      "do not prevent new self-intersections");
  number(
      "--target-faces", controls.target_faces,
      "stop at this number of faces, with the smallest bound on the way; 0: as few as the "
      "tolerance allows",
      0, 4e9);
  number(
      "--stages", controls.stages, "stages in which each tolerance grows, in equal steps", 1, 1000);
  number(
      "--normal-tolerance", controls.normal_tolerance,
      "largest angle between a face and the original faces that correspond to it, in degrees; "
      "180: any",
      1e-6, 180);
  command.add_option(
      "--ridge-tolerance", controls.ridge_tolerance,
      "largest distance between ridges and borders as curves, either way: a length or a per cent; "
      "the tolerance if left out");
  command.add_option("--bound", controls.deviation_bound, "how the distance is bounded")
      ->transform(CLI::CheckedTransformer(names_of_bounds()).description("direct|accumulated"))
      ->default_str(name_of(controls.deviation_bound, names_of_bounds()));
}

void require_compatible(const Controls& controls)
{
  if (!controls.ridge_tolerance.empty())
    Length::parse(controls.ridge_tolerance, "--ridge-tolerance");
  if (controls.deviation_bound != Deviation_bound::accumulated) return;
  if (controls.placement == Placement::free)
    throw Failure(
        usage,
        "--placement: the accumulated bound has no operation that places vertices freely; leave "
        "one of the two options out");
  if (controls.smoothing_sweeps > 0)
    throw Failure(
        usage,
        "--smoothing: the accumulated bound has no operation that moves vertices; leave one of the "
        "two options out");
  if (controls.normal_tolerance < 180)
    throw Failure(
        usage, "--bound: the accumulated bound knows no normals; leave --normal-tolerance out");
  if (!controls.ridge_tolerance.empty())
    throw Failure(
        usage,
        "--bound: the accumulated bound knows one tolerance only; leave --ridge-tolerance out");
}

void set_ridge_length(Controls& controls, double tolerance, double diagonal)
{
  controls.ridge_length = tolerance;
  if (controls.ridge_tolerance.empty()) return;
  const Length length = Length::parse(controls.ridge_tolerance, "--ridge-tolerance");
  controls.ridge_length = std::min(tolerance, length.in_units(diagonal));
}

Json describe(const Controls& controls)
{
  return {
      {"placement", name_of(controls.placement, names_of_placements())},
      {"effort", name_of(controls.effort, names_of_efforts())},
      {"target_faces", controls.target_faces},
      {"bound", name_of(controls.deviation_bound, names_of_bounds())},
      {"feature_angle", controls.feature_angle},
      {"corner_angle", controls.corner_angle},
      {"roughness_angle", controls.roughness_angle},
      {"shape_ratio", controls.shape_ratio},
      {"shape_floor", controls.shape_floor},
      {"flip_rounds", controls.flip_rounds},
      {"smoothing", controls.smoothing_sweeps},
      {"stages", controls.stages},
      {"normal_tolerance", controls.normal_tolerance},
      {"ridge_tolerance", controls.ridge_length},
      {"allow_self_intersections", controls.allow_self_intersections}};
}

} // namespace surety::tool
