// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_adaptation.h"

#include <surety/background_metric.h>
#include <surety/gradation.h>
#include <surety/solution_metric.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>

namespace surety::tool {
namespace {

double diagonal_of(const Mesh& mesh)
{
  const auto box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

Metric_field metric_of(const Carried_field& field, const Adaptation_controls& controls)
{
  const Remesh_controls& sizes = controls.remeshing;
  const double diagonal = diagonal_of(field.mesh);
  const double largest = sizes.maximum_size > 0 ? sizes.maximum_size : diagonal / 10;
  const auto limits
      = parameters::norm_exponent(controls.norm_exponent)
            .metric_kind(sizes.kind)
            .maximum_aspect_ratio(sizes.maximum_aspect_ratio)
            .maximum_size(largest)
            .minimum_size(
                sizes.minimum_size > 0 ? sizes.minimum_size : std::min(largest, diagonal / 1000));
  const auto values = CGAL::make_property_map(field.values);
  if (controls.target_vertices)
    return make_solution_metric(
        field.mesh, field.features, values, limits.target_vertices(*controls.target_vertices));
  return make_solution_metric(
      field.mesh, field.features, values, limits.target_error(*controls.target_error));
}

} // namespace

Adaptation adapt(
    Mesh& mesh, const Features& features, double tolerance, const Carried_field& field,
    const Adaptation_controls& controls, const Visitor& visitor)
{
  using internal::solution_metric::vertices_per_complexity;
  Metric_field metric = metric_of(field, controls);
  const double before = metric_complexity(field.mesh, metric) * vertices_per_complexity;
  const double gradation = controls.remeshing.gradation;
  limit_gradation(
      field.mesh, metric,
      parameters::gradation(gradation > 0 ? gradation : internal::defaults::gradation));
  const double after = metric_complexity(field.mesh, metric) * vertices_per_complexity;
  const Background_metric background(field.mesh, metric);
  const Remesh_controls& r = controls.remeshing;
  const auto all = parameters::metric_kind(r.kind)
                       .background_metric(background)
                       .placement(r.placement)
                       .fewest_faces(r.fewest_faces)
                       .proximity(r.limits_proximity && !r.fewest_faces)
                       .gradation(r.gradation)
                       .minimum_size(r.minimum_size)
                       .maximum_size(r.maximum_size)
                       .maximum_aspect_ratio(r.maximum_aspect_ratio)
                       .allow_self_intersections(r.allow_self_intersections)
                       .number_of_iterations(r.iterations)
                       .visitor(visitor);
  return {remesh(mesh, features, tolerance, all).unit_mesh, before, after};
}

} // namespace surety::tool
