// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the command line passes to the library: its controls, and one chain of named parameters a
// function. The functions themselves are declared by stage, in the headers library_*.h, since each
// of them takes seconds to read; they are instantiated once, in the files of the same names.
#ifndef SURETY_TOOL_PARAMETER_CHAINS_H
#define SURETY_TOOL_PARAMETER_CHAINS_H

#include "constraints.h"
#include "mesh.h"
#include "progress.h"

#include <surety/parameters.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace surety::tool {

/// The controls of `make_geometric_mesh`, with the library's defaults.
struct Controls {
  Placement placement = internal::defaults::placement;
  Effort effort = internal::defaults::effort;
  std::size_t target_faces = internal::defaults::target_faces;
  Deviation_bound deviation_bound = internal::defaults::deviation_bound;
  double feature_angle = internal::defaults::feature_angle;
  double corner_angle = internal::defaults::corner_angle;
  double roughness_angle = internal::defaults::roughness_angle;
  double shape_ratio = internal::defaults::shape_ratio;
  double shape_floor = internal::defaults::shape_floor;
  unsigned flip_rounds = internal::defaults::flip_rounds;
  unsigned smoothing_sweeps = internal::defaults::smoothing_sweeps;
  unsigned stages = internal::defaults::stages;
  double normal_tolerance = internal::defaults::normal_tolerance;
  std::string ridge_tolerance; ///< as it was given; empty: that of the surface
  double ridge_length = 0;     ///< the same in mesh units, see set_ridge_length()
  bool allow_self_intersections = internal::defaults::allow_self_intersections;
  bool single_precision = false;
};

/// A tolerance at each vertex of the input.
using Tolerances = Mesh::Property_map<Mesh::Vertex_index, double>;

/// What every command that simplifies passes on.
inline auto control_parameters(const Controls& controls, const Visitor& visitor)
{
  return parameters::placement(controls.placement)
      .effort(controls.effort)
      .target_faces(controls.target_faces)
      .deviation_bound(controls.deviation_bound)
      .feature_angle(controls.feature_angle)
      .corner_angle(controls.corner_angle)
      .roughness_angle(controls.roughness_angle)
      .shape_ratio(controls.shape_ratio)
      .shape_floor(controls.shape_floor)
      .flip_rounds(controls.flip_rounds)
      .allow_self_intersections(controls.allow_self_intersections)
      .smoothing_sweeps(controls.smoothing_sweeps)
      .stages(controls.stages)
      .normal_tolerance(controls.normal_tolerance)
      .ridge_tolerance(controls.ridge_length)
      .single_precision(controls.single_precision)
      .visitor(visitor);
}

inline auto simplify_parameters(
    const Controls& controls, const Tolerances& tolerances, const Constraints& constraints,
    const Visitor& visitor)
{
  return control_parameters(controls, visitor)
      .vertex_tolerance_map(tolerances)
      .edge_is_constrained_map(constraints.edges)
      .vertex_is_constrained_map(constraints.vertices);
}

inline auto need_parameters(double corner_angle, const Constraints& constraints = {})
{
  return parameters::corner_angle(corner_angle)
      .edge_is_constrained_map(constraints.edges)
      .vertex_is_constrained_map(constraints.vertices);
}

inline auto feature_parameters(
    double feature_angle, double corner_angle, const Constraints& constraints = {})
{
  return need_parameters(corner_angle, constraints).feature_angle(feature_angle);
}

inline auto curvature_parameters(double noise_floor)
{
  return parameters::noise_floor(noise_floor);
}

/// The controls of `make_geometric_metric`, lengths in mesh units.
struct Metric_controls {
  double tolerance, minimum_size, maximum_size;
  Metric_kind kind;
};

inline auto metric_parameters(const Metric_controls& controls)
{
  return parameters::metric_tolerance(controls.tolerance)
      .minimum_size(controls.minimum_size)
      .maximum_size(controls.maximum_size)
      .metric_kind(controls.kind);
}

/// On all threads where TBB is there; the result is the same.
using Concurrency = CGAL::Parallel_if_available_tag;

using No_parameters = CGAL::parameters::Default_named_parameters;
using Simplify_parameters = decltype(simplify_parameters(
    std::declval<Controls>(), std::declval<Tolerances>(), std::declval<Constraints>(),
    std::declval<Visitor>()));
using Hierarchy_parameters
    = decltype(control_parameters(std::declval<Controls>(), std::declval<Visitor>()));
using Feature_parameters = decltype(feature_parameters(0, 0));
using Need_parameters = decltype(need_parameters(0));
using Curvature_parameters = decltype(curvature_parameters(0));
using Metric_parameters = decltype(metric_parameters(std::declval<Metric_controls>()));
using Gradation_parameters = decltype(parameters::gradation(1));

} // namespace surety::tool

#endif // SURETY_TOOL_PARAMETER_CHAINS_H
