// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric metric (section 3.3 of the paper): how long edges may be, and in which direction,
// for a mesh to follow a surface within a gap. Metrics of the user, the intersection of metrics,
// and lengths of edges in them.
#ifndef SURETY_METRIC_H
#define SURETY_METRIC_H

#include <surety/curvature_field.h>
#include <surety/internal/metric/geometric.h>
#include <surety/internal/metric/input.h>
#include <surety/internal/metric/length.h>
#include <surety/internal/metric/user_sizes.h>
#include <surety/internal/validation.h>
#include <surety/metric_field.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace surety {
/// \brief A tensor whose unit ball lies in those of both: what satisfies both metrics.
///
/// By simultaneous reduction: each axis that is common to both takes the smaller of its two sizes.
/// The order of the arguments does not matter, to the last bit.
///
/// \throws Invalid_input unless both are finite, symmetric and positive definite.
inline Eigen::Matrix3d intersect(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b)
{
  internal::metric::require_metric(a, "intersect", "a");
  internal::metric::require_metric(b, "intersect", "b");
  return internal::metric::intersection(a, b);
}

/// \brief Makes a metric satisfy another one of the same mesh, too.
///
/// An isotropic metric takes the smaller size, of a tensor its least one.
///
/// \throws Invalid_input when the two do not have the same sides.
inline void intersect(Metric_field& metric, const Metric_field& other)
{
  internal::metric::require_same_sides(metric, other, "intersect");
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    if (metric.kind() == Metric_kind::isotropic) {
      metric.set_size(s, std::min(metric.size(s), other.size(s)));
    } else {
      const Eigen::Matrix3d m = metric.tensor(s);
      const Eigen::Matrix3d both = internal::metric::intersection(
          m, internal::metric::tangential(other.tensor(s), metric.normal(s)));
      if (both != m) metric.set_tensor(s, both);
    }
  }
}

/// \brief The metric that the user asks for, on a mesh.
///
/// \param field what `size_field` takes: a function from points, or a property map from vertices,
///   to a size (`double`) or a tensor (`Eigen::Matrix3d`); or a `Medit_solution`.
/// \throws Invalid_input when a size is not positive, a tensor not positive definite, or a solution
///   has not one value a vertex.
///
/// Reads `metric_kind` and `vertex_point_map`. Sizes are taken as they are.
template <
    class Mesh, class Field, class NamedParameters = CGAL::parameters::Default_named_parameters>
Metric_field make_metric(
    const Mesh& mesh, const Sides& sides, const Field& field,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  Metric_field metric = make_uniform_metric(mesh, sides, 1, np);
  internal::metric::for_each_wanted(
      mesh, internal::vertex_points(mesh, np), sides, field, "make_metric",
      [&](std::uint32_t s, const internal::metric::Wanted& w) {
        internal::metric::assign(metric, s, w);
      });
  return metric;
}

/// \brief The geometric metric: the largest sizes with which a mesh follows a surface closely.
///
/// A triangle with its vertices on the surface, equilateral with sides of length 1 in the metric at
/// its centre, lies within `metric_tolerance` of the surface, up to terms of higher order: a few
/// per cent at a tolerance of 1 % of the diagonal, or less. That assumes that neither
/// `minimum_size` nor `gap_constant` interferes. Every size lies between `minimum_size` and
/// `maximum_size`, so that planes and points of any curvature have finite, positive definite
/// metrics.
///
/// At a vertex that a feature curve passes, each side has a tensor of its own, with the tangent of
/// the curve as an axis; all sides agree on the size along it, which respects the curvature of the
/// curve. Corners are isotropic, with one size for all sides. A size field of the user is
/// intersected with all that.
///
/// Linear in the size of the mesh.
///
/// \param curvature estimated on `mesh`.
/// \throws Invalid_input when the field does not belong to the mesh or has values that are not
///   finite, when no tolerance is given, or a parameter is out of its range.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{metric_tolerance}
///     \cgalParamDescription{largest distance of a face to the surface}
///     \cgalParamType{`double`, a length in mesh units, positive}
///     \cgalParamDefault{none; at least one of this and the next two must be given, and where
///       several are the least size counts}
///   \cgalParamNEnd
///   \cgalParamNBegin{relative_gap}
///     \cgalParamDescription{the same, as a fraction of each radius of curvature: the paper's eps}
///     \cgalParamType{`double`, greater than 0, at most 1}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{turning_angle}
///     \cgalParamDescription{by how much the normal turns along an edge, at most}
///     \cgalParamType{`double`, in degrees, greater than 0, at most 180}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{metric_kind}
///     \cgalParamDescription{whether sizes depend on direction}
///     \cgalParamType{`Metric_kind`}
///     \cgalParamDefault{`Metric_kind::anisotropic`}
///   \cgalParamNEnd
///   \cgalParamNBegin{gap_constant}
///     \cgalParamDescription{gap over curvature times size squared}
///     \cgalParamType{`double`, positive}
///     \cgalParamDefault{that of the equilateral triangle: 1/8 on parabolic and hyperbolic points,
///       up to 1/6 on elliptic ones, by the ratio of the curvatures in units of the sizes}
///   \cgalParamNEnd
///   \cgalParamNBegin{minimum_size}
///     \cgalParamDescription{the least size}
///     \cgalParamType{`double`, a length in mesh units, positive}
///     \cgalParamDefault{the tolerance; without one, a thousandth of the diagonal}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_size}
///     \cgalParamDescription{the largest size}
///     \cgalParamType{`double`, a length in mesh units, at least the minimum}
///     \cgalParamDefault{a tenth of the diagonal of the bounding box}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_aspect_ratio}
///     \cgalParamDescription{largest ratio of the two sizes at one place}
///     \cgalParamType{`double`, at least 1}
///     \cgalParamDefault{10}
///   \cgalParamNEnd
///   \cgalParamNBegin{size_field}
///     \cgalParamDescription{sizes to respect as well}
///     \cgalParamType{what `make_metric()` takes}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Metric_field make_geometric_metric(
    const Mesh& mesh, const Curvature_field& curvature,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const char* const function = "make_geometric_metric";
  const auto points = internal::vertex_points(mesh, np);
  internal::metric::require_curvatures_of(mesh, curvature, function);
  const internal::metric::Size_law law = internal::metric::size_law(np, function);
  const internal::metric::Size_range range = internal::metric::size_range(
      np, law, internal::metric::bounding_box_diagonal(mesh, points), function);
  const auto kind = CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(np, internal::metric_kind), internal::defaults::metric_kind);

  Metric_field metric(
      kind, curvature.sides, internal::metric::normals_of(mesh, curvature, points),
      internal::metric::tangents_of(curvature), range.maximum);
  internal::metric::Geometric_metric_maker<Mesh>(mesh, curvature, law, range).fill(metric);
  if constexpr (!CGAL::parameters::is_default_parameter<
                    NamedParameters, internal::size_field_t>::value) {
    const auto& field = CGAL::parameters::get_parameter_reference(np, internal::size_field);
    intersect(metric, make_metric(mesh, curvature.sides, field, np));
    for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
      internal::metric::clamp_side(metric, s, range);
    }
  }
  return metric;
}

/// \brief Length of a vector from a point with metric `m_a` to one with metric `m_b`.
///
/// Between the points the metric is interpolated by `rule`. All rules but `end_only` are symmetric
/// to the last bit.
inline double metric_length(
    const Eigen::Vector3d& edge, const Eigen::Matrix3d& m_a, const Eigen::Matrix3d& m_b,
    Length_rule rule = internal::defaults::length_rule)
{
  return internal::metric::edge_length(edge, m_a, m_b, rule);
}

/// \brief Length of an edge in a metric; of a feature edge, the larger of those on its two sides.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{length_rule}
///     \cgalParamDescription{how the metric is interpolated along the edge}
///     \cgalParamType{`Length_rule`}
///     \cgalParamDefault{`Length_rule::linear_size`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <
    class Mesh, class Edge, class NamedParameters = CGAL::parameters::Default_named_parameters>
double edge_length(
    const Mesh& mesh, const Metric_field& metric, Edge e,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const auto rule = CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(np, internal::length_rule), internal::defaults::length_rule);
  const auto points = internal::vertex_points(mesh, np);
  const auto h = halfedge(e, mesh), o = opposite(h, mesh);
  const internal::Vector vector = internal::to_vector(get(points, target(h, mesh)))
      - internal::to_vector(get(points, source(h, mesh)));
  const auto between = [&](auto from, auto to) {
    if (CGAL::is_border(to, mesh)) return 0.;
    const auto a = metric.side_of_corner(from), b = metric.side_of_corner(to);
    return metric.kind() == Metric_kind::isotropic
        ? internal::metric::edge_length(vector.norm(), metric.size(a), metric.size(b), rule)
        : internal::metric::edge_length(vector, metric.tensor(a), metric.tensor(b), rule);
  };
  const double left = between(prev(h, mesh), h);
  if (!internal::metric::separates_sides(mesh, metric.sides(), h)) return left;
  const double right = CGAL::is_border(o, mesh) ? 0. : between(o, prev(o, mesh));
  return std::max(left, right);
}

} // namespace surety

#endif // SURETY_METRIC_H
