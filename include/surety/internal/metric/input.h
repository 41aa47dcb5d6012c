// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the makers of metrics read and refuse: laws and ranges of sizes from named parameters,
// fields that belong to another mesh or are not finite.
#ifndef SURETY_INTERNAL_METRIC_INPUT_H
#define SURETY_INTERNAL_METRIC_INPUT_H

#include <surety/curvature_field.h>
#include <surety/internal/metric/frames.h>
#include <surety/internal/metric/sizes.h>
#include <surety/internal/validation.h>
#include <surety/metric_field.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace surety::internal::metric {

/// The diagonal of the bounding box.
template <class Mesh, class Points>
double bounding_box_diagonal(const Mesh& mesh, const Points& points)
{
  Vector low = Vector::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const auto v : vertices(mesh)) {
    const Vector p = to_vector(get(points, v));
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

template <class NamedParameters, class Tag>
std::optional<double> optional_parameter(const NamedParameters& np, Tag tag)
{
  if constexpr (CGAL::parameters::is_default_parameter<NamedParameters, Tag>::value) {
    return std::nullopt;
  } else {
    return static_cast<double>(CGAL::parameters::get_parameter(np, tag));
  }
}

template <class NamedParameters>
Size_law size_law(const NamedParameters& np, const char* function)
{
  Size_law law;
  law.tolerance = optional_parameter(np, metric_tolerance);
  law.relative_gap = optional_parameter(np, relative_gap);
  law.turning_angle = optional_parameter(np, turning_angle);
  law.gap_constant = optional_parameter(np, gap_constant);
  if (!law.tolerance && !law.relative_gap && !law.turning_angle) {
    throw Invalid_input(
        function, "np", "nothing says how close faces must be to the surface",
        "give at least one of metric_tolerance, relative_gap and turning_angle");
  }
  if (law.tolerance) require_positive(*law.tolerance, function, "metric_tolerance");
  if (law.relative_gap) {
    require_positive(*law.relative_gap, function, "relative_gap");
    require_in_range(*law.relative_gap, 0, 1, function, "relative_gap");
  }
  if (law.turning_angle) {
    require_positive(*law.turning_angle, function, "turning_angle");
    require_in_range(*law.turning_angle, 0, 180, function, "turning_angle");
    *law.turning_angle *= radians_per_degree;
  }
  if (law.gap_constant) require_positive(*law.gap_constant, function, "gap_constant");
  return law;
}

/// Sizes below the tolerance resolve what the tolerance lets vanish.
template <class NamedParameters>
Size_range size_range(
    const NamedParameters& np, const Size_law& law, double diagonal, const char* function)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const auto wanted_minimum = optional_parameter(np, minimum_size);
  const auto wanted_maximum = optional_parameter(np, maximum_size);
  Size_range range;
  range.maximum = wanted_maximum.value_or(diagonal / 10);
  range.minimum
      = wanted_minimum.value_or(std::min(law.tolerance.value_or(diagonal / 1000), range.maximum));
  if (!wanted_maximum) range.maximum = std::max(range.maximum, range.minimum);
  range.aspect_ratio
      = choose_parameter(get_parameter(np, maximum_aspect_ratio), defaults::maximum_aspect_ratio);
  require_positive(range.maximum, function, "maximum_size");
  require_positive(range.minimum, function, "minimum_size");
  require_in_range(range.minimum, 0, range.maximum, function, "minimum_size");
  require_in_range(
      range.aspect_ratio, 1, std::numeric_limits<double>::infinity(), function,
      "maximum_aspect_ratio");
  return range;
}

/// A field belongs to a mesh if it numbers its sides, and all that it says is finite.
template <class Mesh>
void require_curvatures_of(const Mesh& mesh, const Curvature_field& field, const char* function)
{
  const bool fits = field.sides.of_corner.size() == num_halfedges(mesh)
      && field.sides.first.size() == num_vertices(mesh) + 1
      && field.side.size() == field.sides.size() && field.curve.size() == num_vertices(mesh);
  if (!fits) {
    throw Invalid_input(
        function, "curvature", "the field does not belong to the mesh",
        "estimate it on this mesh, in its present state");
  }
  for (std::size_t s = 0; s < field.side.size(); ++s) {
    const Side_curvature& c = field.side[s];
    const bool is_finite = std::isfinite(c.min_curvature) && std::isfinite(c.max_curvature)
        && std::isfinite(c.min_derivative) && std::isfinite(c.max_derivative)
        && c.normal.allFinite() && c.min_direction.allFinite() && c.max_direction.allFinite();
    if (!is_finite) {
      throw Invalid_input(
          function, "curvature",
          "a value at vertex " + std::to_string(field.sides.vertex[s]) + " is not finite");
    }
  }
  for (std::size_t v = 0; v < field.curve.size(); ++v) {
    const Curve_curvature& c = field.curve[v];
    if (std::isfinite(c.curvature) && c.curvature >= 0 && c.tangent.allFinite()) continue;
    throw Invalid_input(
        function, "curvature",
        "the curvature of the curve at vertex " + std::to_string(v)
            + " is not a finite number from 0 on");
  }
}

/// The normals of a curvature field; the mesh's where it has none.
template <class Mesh, class Points>
std::vector<Vector> normals_of(const Mesh& mesh, const Curvature_field& field, const Points& points)
{
  std::vector<Vector> normals = side_normals(mesh, field.sides, points);
  for (std::size_t s = 0; s < normals.size(); ++s) {
    const Vector fitted = unit(field.side[s].normal);
    if (!fitted.isZero(0)) normals[s] = fitted;
  }
  return normals;
}

inline std::vector<Vector> tangents_of(const Curvature_field& field)
{
  std::vector<Vector> tangents;
  tangents.reserve(field.curve.size());
  for (const Curve_curvature& c : field.curve) tangents.push_back(unit(c.tangent));
  return tangents;
}

inline void require_same_sides(const Metric_field& a, const Metric_field& b, const char* function)
{
  if (a.sides().of_corner == b.sides().of_corner && a.sides().first == b.sides().first) return;
  throw Invalid_input(function, "other", "the two metrics do not have the same sides");
}

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_INPUT_H
