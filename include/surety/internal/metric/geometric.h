// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric metric of every side, from its curvature, and what the curves of features add.
#ifndef SURETY_INTERNAL_METRIC_GEOMETRIC_H
#define SURETY_INTERNAL_METRIC_GEOMETRIC_H

#include <surety/curvature_field.h>
#include <surety/internal/metric/growth.h>
#include <surety/internal/metric/sizes.h>
#include <surety/metric_field.h>

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace surety::internal::metric {

/// \brief The least tensor with the axes t and u that satisfies a given one.
///
/// A curve of features wants its tangent to be an axis, so that both its sides agree on lengths
/// along it. For [a b; b c] in these axes the tensors diag(p, q) >= it have (p - a)(q - c) >= b^2;
/// of those, p = a + |b| sqrt(a/c), q = c + |b| sqrt(c/a) has the least determinant.
struct Aligned_tensor {
  Aligned_tensor(const Tensor& m, const Vector& t, const Vector& u)
    : a(t.dot(m * t)), b(std::abs(u.dot(m * t))), c(u.dot(m * u)), along(a + b * std::sqrt(a / c))
  {}

  /// What is needed across when more than `along` is asked for along the curve.
  double across(double wanted_along) const
  {
    return wanted_along > a ? c + b * (b / (wanted_along - a)) : c;
  }

  double a, b, c;
  double along;
};

/// \brief Fills a metric field side by side, then aligns it with the curves of features.
template <class Mesh>
class Geometric_metric_maker
{
  using Vertex = typename boost::graph_traits<Mesh>::vertex_descriptor;

public:
  Geometric_metric_maker(
      const Mesh& mesh, const Curvature_field& curvature, const Size_law& law,
      const Size_range& range)
    : mesh_(mesh), curvature_(curvature), law_(law), range_(range)
  {}

  void fill(Metric_field& metric) const
  {
    for (const Vertex v : vertices(mesh_)) {
      for (auto s = first(v); s < last(v); ++s) set_side(metric, s);
      if (metric.tangent(v).isZero(0)) {
        if (is_corner(v)) make_isotropic(metric, v);
      } else if (metric.kind() == Metric_kind::isotropic) {
        limit_by_curve(metric, v);
      } else {
        align_with_curve(metric, v);
      }
    }
  }

private:
  std::uint32_t first(Vertex v) const { return curvature_.sides.first[v]; }
  std::uint32_t last(Vertex v) const { return curvature_.sides.first[v + 1]; }

  void set_side(Metric_field& metric, std::uint32_t s) const
  {
    const Principal_growth growth = principal_growth(curvature_.side[s], metric.normal(s));
    if (metric.kind() == Metric_kind::isotropic) {
      metric.set_size(s, isotropic_size(growth.values, law_, range_));
    } else {
      const auto [h1, h2] = principal_sizes(growth.values, law_, range_);
      metric.set_tensor(s, tangential(metric.normal(s), growth.direction, h1, h2));
    }
  }

  /// Where curves end, branch or turn there are several sides, or the border passes.
  bool is_corner(Vertex v) const
  {
    return last(v) - first(v) > 1 || (last(v) > first(v) && CGAL::is_border(v, mesh_).has_value());
  }

  /// No direction is special at a corner, and its edges belong to all its sides.
  void make_isotropic(Metric_field& metric, Vertex v) const
  {
    const double size = metric.size_at_vertex(v);
    for (auto s = first(v); s < last(v); ++s) metric.set_size(s, size);
  }

  double curve_size(Vertex v) const
  {
    return range_.clamp(law_.size_on_curve(curvature_.curve[v].curvature));
  }

  void limit_by_curve(Metric_field& metric, Vertex v) const
  {
    const double limit = curve_size(v);
    for (auto s = first(v); s < last(v); ++s) metric.set_size(s, std::min(limit, metric.size(s)));
  }

  /// One size along the curve for all sides, each its own size across it.
  void align_with_curve(Metric_field& metric, Vertex v) const
  {
    const double limit = curve_size(v);
    double wanted_along = 1 / (limit * limit);
    std::vector<Aligned_tensor> demands;
    std::vector<Vector> tangents;
    for (auto s = first(v); s < last(v); ++s) {
      const Vector t = tangent_or_any(metric.tangent(v), metric.normal(s));
      demands.emplace_back(metric.tensor(s), t, metric.normal(s).cross(t));
      tangents.push_back(t);
      wanted_along = std::max(wanted_along, demands.back().along);
    }
    const double along = range_.clamp(1 / std::sqrt(wanted_along));
    for (auto s = first(v); s < last(v); ++s) {
      const std::size_t i = s - first(v);
      double across = range_.clamp(1 / std::sqrt(demands[i].across(wanted_along)));
      across = std::min(across, range_.aspect_ratio * along);
      metric.set_tensor(s, tangential(metric.normal(s), tangents[i], along, across));
    }
  }

  const Mesh& mesh_;
  const Curvature_field& curvature_;
  const Size_law& law_;
  const Size_range& range_;
};

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_GEOMETRIC_H
