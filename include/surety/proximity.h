// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes that know how much room there is between the curves of features.
#ifndef SURETY_PROXIMITY_H
#define SURETY_PROXIMITY_H

#include <surety/errors.h>
#include <surety/features.h>
#include <surety/internal/metric/proximity.h>
#include <surety/metric_field.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace surety {
namespace internal::metric {

/// Rows of unit faces are by this factor nearer to each other than the vertices of a row.
constexpr double size_of_strip = 1.1547005383792517; // 2 / sqrt(3)

/// \brief Finds what the strips beside curves, and the lengths of curves, allow.
template <class Mesh, class Points>
class Proximity
{
  using Halfedge = typename boost::graph_traits<Mesh>::halfedge_descriptor;

public:
  Proximity(
      const Mesh& mesh, const Points& points, const Features& features, double slope,
      const Metric_field& metric)
    : mesh_(mesh),
      features_(features),
      walk_(mesh, points, features.edge),
      slope_(slope),
      metric_(metric),
      limit_(metric.number_of_sides())
  {
    for (std::size_t s = 0; s < limit_.size(); ++s)
      limit_[s] = metric.size(static_cast<Metric_field::Side>(s));
  }

  /// The largest size that is allowed, by side; that of the metric where there is room.
  const std::vector<double>& find()
  {
    for (const auto h : halfedges(mesh_)) {
      if (!features_.edge[edge(h, mesh_)]) continue;
      if (!is_border(h, mesh_)) look_beside(h);
      if (features_.corner[source(h, mesh_)]) look_along(h);
    }
    return limit_;
  }

private:
  Metric_field::Side side_at_source(Halfedge h) const
  {
    return metric_.side_of_corner(is_border(h, mesh_) ? opposite(h, mesh_) : prev(h, mesh_));
  }
  Metric_field::Side side_at_target(Halfedge h) const
  {
    return metric_.side_of_corner(is_border(h, mesh_) ? prev(opposite(h, mesh_), mesh_) : h);
  }

  /// Samples are as near to each other as unit edges, up to a number that only edges need that are
  /// much longer than all sizes.
  void look_beside(Halfedge h)
  {
    constexpr double most = 32;
    const auto a = side_at_source(h), b = side_at_target(h);
    const double length = walk_.length(h), at_a = metric_.size(a), at_b = metric_.size(b);
    const double number = std::clamp(std::ceil(length / (std::min)(at_a, at_b)), 1., most);
    for (double i = .5; i < number; ++i) {
      const double share = i / number;
      // Where there is room for what is asked for, nothing else matters.
      const double reach = (at_a + share * (at_b - at_a)) / size_of_strip;
      const auto width = walk_.width(h, share, reach);
      if (!width) continue;
      lower(a, *width * size_of_strip + slope_ * share * length);
      lower(b, *width * size_of_strip + slope_ * (1 - share) * length);
    }
  }

  /// A curve between two corners is one edge at least.
  void look_along(Halfedge h)
  {
    const auto first = side_at_source(h);
    const double most = metric_.size(first);
    double length = walk_.length(h);
    while (!features_.corner[target(h, mesh_)] && length < most) {
      const Halfedge onward = next_on_curve(h);
      if (onward == opposite(h, mesh_)) return;
      h = onward;
      length += walk_.length(h);
    }
    if (length >= most) return;
    lower(first, length);
    lower(side_at_target(h), length);
  }
  /// Turns around the target until the curve goes on.
  Halfedge next_on_curve(Halfedge h) const
  {
    h = next(h, mesh_);
    while (!features_.edge[edge(h, mesh_)]) h = next(opposite(h, mesh_), mesh_);
    return h;
  }

  void lower(Metric_field::Side s, double size) { limit_[s] = (std::min)(limit_[s], size); }

  const Mesh& mesh_;
  const Features& features_;
  Strip_walk<Mesh, Points> walk_;
  double slope_;
  const Metric_field& metric_;
  std::vector<double> limit_;
};

} // namespace internal::metric

/// \brief Lowers the sizes of an isotropic metric where the curves of features leave less room.
///
/// Between two curves that run side by side, the size becomes so small that one row of equilateral
/// faces fits; between two corners, as small as the curve between them is long. Without this,
/// strips that are narrower than the sizes get long thin faces, whatever is done to them. Sizes
/// change at the vertices of the curves; `limit_gradation()` hands them on, and is to be called
/// afterwards.
///
/// Widths are measured over the surface, at right angles to a curve, from as many places as it will
/// have edges, at most 32 an edge of the mesh. Curves at more than 14 degrees to each other do not
/// count as side by side: near the corner where they meet sizes would have to vanish.
///
/// O(n) in the number of feature edges, times the faces that a size reaches over.
///
/// \param metric of `mesh`, isotropic; changed.
/// \return the number of sides whose size has changed.
/// \throws Invalid_input when the metric is anisotropic, it or the features do not belong to the
///         mesh, or a parameter is out of its range.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{minimum_size}
///     \cgalParamDescription{sizes are not lowered below it}
///     \cgalParamType{`double`, a length in mesh units, at least 0}
///     \cgalParamDefault{0}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradation}
///     \cgalParamDescription{by which factor sizes may grow along an edge of unit length: between a
///       narrow place and the ends of a long edge beside it}
///     \cgalParamType{`double`, at least 1}
///     \cgalParamDefault{1.3}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t limit_proximity(
    const Mesh& mesh, Metric_field& metric, const Features& features,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;

  const char* const function = "limit_proximity";
  internal::require_features_of(mesh, features, function);
  if (metric.sides().of_corner.size() != num_halfedges(mesh)
      || metric.sides().first.size() != num_vertices(mesh) + 1)
    throw Invalid_input(function, "metric", "it does not belong to the mesh");
  if (metric.kind() != Metric_kind::isotropic)
    throw Invalid_input(function, "metric", "it is anisotropic", "make an isotropic one");
  const double beta
      = choose_parameter(get_parameter(np, internal::gradation), internal::defaults::gradation);
  internal::require_in_range(
      beta, 1, std::numeric_limits<double>::infinity(), function, "gradation");
  const double least = choose_parameter(get_parameter(np, internal::minimum_size), 0.);
  internal::require_in_range(
      least, 0, std::numeric_limits<double>::infinity(), function, "minimum_size");

  internal::metric::Proximity proximity(
      mesh, internal::vertex_points(mesh, np), features, std::log(beta), metric);
  const std::vector<double>& limit = proximity.find();
  std::size_t changed = 0;
  for (std::size_t i = 0; i < limit.size(); ++i) {
    const auto s = static_cast<Metric_field::Side>(i);
    const double size = (std::max)(limit[i], least);
    if (!(size < metric.size(s))) continue;
    metric.set_size(s, size);
    ++changed;
  }
  return changed;
}

} // namespace surety

#endif // SURETY_PROXIMITY_H
