// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metric at a vertex of M, and what it says of edges and faces.
#ifndef SURETY_INTERNAL_UNIT_MESH_LOCAL_METRIC_H
#define SURETY_INTERNAL_UNIT_MESH_LOCAL_METRIC_H

#include <surety/internal/linear.h>
#include <surety/internal/metric/length.h>
#include <surety/internal/metric/tensor.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace surety::internal::unit_mesh {

using metric::Tensor;

/// Edges between these metric lengths are unit.
constexpr double shortest_unit = 0.7071067811865476, longest_unit = 1.4142135623730951;

/// How much of the surface passes a vertex. Where sizes depend on the direction, the smoother one
/// of two knows better what the surface between them wants.
enum class Vertex_kind : unsigned char { smooth, ridge, corner };

/// A size, or tensors where sizes depend on the direction.
struct Local_metric {
  double size = 1;
  Tensor sizes = Tensor::Identity();  ///< eigenvalues are sizes: what is linear inside faces of T
  Tensor metric = Tensor::Identity(); ///< its inverse squared
  Vertex_kind kind = Vertex_kind::smooth;

  /// Of a tensor of sizes.
  void set_sizes(const Tensor& tensor)
  {
    sizes = tensor;
    const Tensor inverse = tensor.inverse();
    metric = inverse * inverse;
  }
  void scale_sizes(double factor)
  {
    size *= factor;
    sizes *= factor;
    metric /= factor * factor;
  }
};

/// Lengths and shapes in a metric of either kind.
class Measure
{
public:
  explicit Measure(bool is_isotropic) : is_isotropic_(is_isotropic) {}

  double length_at(const Vector& e, const Local_metric& at) const
  {
    return is_isotropic_ ? e.norm() / at.size : metric::length_in(at.metric, e);
  }
  /// Whether both have a say in what is between them.
  bool counts_both(const Local_metric& a, const Local_metric& b) const
  {
    return is_isotropic_ || a.kind == b.kind;
  }
  /// Of the edge e from a to b.
  double length(const Vector& e, const Local_metric& a, const Local_metric& b) const
  {
    if (!counts_both(a, b)) return length_at(e, a.kind < b.kind ? a : b);
    if (is_isotropic_) {
      const double length = e.norm();
      return metric::length_of_linear_size(length / a.size, length / b.size);
    }
    return metric::length_of_linear_size(
        metric::length_in(a.metric, e), metric::length_in(b.metric, e));
  }

  double least_size(const Local_metric& at) const
  {
    if (is_isotropic_) return at.size;
    return Eigen::SelfAdjointEigenSolver<Tensor>(at.sizes, Eigen::EigenvaluesOnly).eigenvalues()[0];
  }

  /// Q of a triangle as it is, or as the metric of its smoothest corners sees it.
  double quality(const std::array<Vector, 3>& p, const std::array<const Local_metric*, 3>& at) const
  {
    const Vector ab = p[1] - p[0], ac = p[2] - p[0];
    if (is_isotropic_) return quality_of(ab, ac);
    const Tensor inverse = mean_sizes(at).inverse();
    return quality_of(inverse * ab, inverse * ac);
  }

  /// The mean tensor of sizes of the smoothest of three.
  static Tensor mean_sizes(const std::array<const Local_metric*, 3>& at)
  {
    const Vertex_kind least = std::min({at[0]->kind, at[1]->kind, at[2]->kind});
    Tensor sum = Tensor::Zero();
    int number = 0;
    for (const Local_metric* one : at)
      if (one->kind == least) sum += one->sizes, ++number;
    return sum / number;
  }

  /// Where the apex of a triangle on the edge from p to q would make it equilateral and, by the
  /// height, unit: on the side where x is.
  Vector ideal_apex(
      const Vector& p, const Vector& q, const Vector& x,
      const std::array<const Local_metric*, 3>& at) const
  {
    const Vector middle = (p + q) / 2;
    if (is_isotropic_) {
      const Vector e = unit(q - p), to_x = x - middle;
      const double size = mean_size(at);
      return middle + height * size * unit(to_x - to_x.dot(e) * e);
    }
    const Tensor sizes = mean_sizes(at);
    const Tensor inverse = sizes.inverse();
    const Vector e = unit(inverse * (q - p)), to_x = inverse * (x - middle);
    return middle + height * (sizes * unit(to_x - to_x.dot(e) * e));
  }

  /// Where the apex of a triangle on the edge from p to q would make it equilateral, whatever its
  /// size: on the side where x is.
  Vector equilateral_apex(
      const Vector& p, const Vector& q, const Vector& x,
      const std::array<const Local_metric*, 3>& at) const
  {
    const Vector middle = (p + q) / 2;
    if (is_isotropic_) {
      const Vector e = q - p, to_x = x - middle;
      const Vector direction = unit(e);
      return middle + height * e.norm() * unit(to_x - to_x.dot(direction) * direction);
    }
    const Tensor sizes = mean_sizes(at);
    const Tensor inverse = sizes.inverse();
    const Vector e = inverse * (q - p), to_x = inverse * (x - middle), direction = unit(e);
    return middle + height * e.norm() * (sizes * unit(to_x - to_x.dot(direction) * direction));
  }

private:
  static constexpr double height = 0.8660254037844386; ///< of an equilateral triangle
  static double mean_size(const std::array<const Local_metric*, 3>& at)
  {
    return (at[0]->size + at[1]->size + at[2]->size) / 3;
  }
  static double quality_of(const Vector& ab, const Vector& ac)
  {
    const double b = ab.norm(), c = ac.norm(), a = (ac - ab).norm();
    const double double_area = ab.cross(ac).norm();
    if (!(double_area > 0)) return std::numeric_limits<double>::infinity();
    constexpr double sqrt3_over_6 = 0.28867513459481287;
    return sqrt3_over_6 * std::max({a, b, c}) * (a + b + c) / double_area;
  }

  bool is_isotropic_;
};

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_LOCAL_METRIC_H
