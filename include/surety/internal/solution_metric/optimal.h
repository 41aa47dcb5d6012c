// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metric whose unit meshes interpolate a field best in the L^p norm, for the number of their
// vertices: D det|H|^(-1/(2p+2)) |H| (A. Loseille and F. Alauzet, Continuous Mesh Framework, 2011,
// for surfaces).
#ifndef SURETY_INTERNAL_SOLUTION_METRIC_OPTIMAL_H
#define SURETY_INTERNAL_SOLUTION_METRIC_OPTIMAL_H

#include <surety/internal/metric/sizes.h>
#include <surety/internal/solution_metric/complexity.h>
#include <surety/internal/solution_metric/hessian.h>
#include <surety/parameters.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace surety::internal::solution_metric {

using metric::Size_range;
using metric::Tensor;

/// The Hessian at a side, and the normal there.
struct Frame_hessian {
  Vector normal;
  Absolute_hessian value;
};

/// \brief The L^p mean of the interpolation error on an equilateral triangle with sides of length
/// 1, for the identity as Hessian.
///
/// The error is (1/3 - r^2)/2 at the distance r from the centre, since the power of a point with
/// respect to the circumcircle is what linear interpolation misses. Integrated in closed form along
/// r, by Simpson's rule in the angle.
inline double mean_interpolation_error(double p)
{
  if (!std::isfinite(p)) return 1. / 6;
  constexpr double pi = 3.14159265358979323846, double_area = .8660254037844386;
  constexpr int steps = 256;
  // In units of 1/3, the value at the centre: large powers of smaller numbers underflow.
  const auto along_ray = [&](double angle) {
    const double inside = 1 - 1 / (4 * std::cos(angle) * std::cos(angle));
    return (1 - std::pow((std::max)(0., inside), p + 1)) / (2 * (p + 1));
  };
  double sum = 0;
  for (int i = 0; i <= steps; ++i)
    sum += (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2) * along_ray(pi / 3 * i / steps);
  const double integral = 6 * sum * (pi / 3 / steps) / 3;
  return std::pow(integral / 3 / (double_area / 2), 1 / p) / 6;
}

/// The optimal metric of a field for any factor D, within the range of sizes.
class Optimal_metric
{
public:
  /// \param hessians by side
  /// \param range in the unit of length of the graph
  Optimal_metric(
      std::vector<Frame_hessian> hessians, const Side_graph& graph, const Size_range& range,
      double p, Metric_kind kind)
    : hessian_(std::move(hessians)),
      area_(graph.area),
      range_(range),
      p_(p),
      constant_(mean_interpolation_error(p))
  {
    // Infinite p: the same error everywhere.
    const double power = std::isfinite(p) ? -1 / (2 * p + 2) : 0;
    for (const auto& [normal, h] : hessian_) {
      const double least = kind == Metric_kind::isotropic
          ? h.larger
          : std::max(h.smaller, h.larger / (range.aspect_ratio * range.aspect_ratio));
      const double factor = h.larger > 0 ? std::pow(h.larger * least, power) : 0;
      scaled_.push_back({factor * h.larger, factor * least});
    }
  }

  /// The smaller and the larger size at a side.
  std::pair<double, double> sizes(Index s, double d) const
  {
    const auto size = [&](double lambda) {
      return lambda > 0 ? range_.clamp(1 / std::sqrt(d * lambda)) : range_.maximum;
    };
    return {size(scaled_[s].first), size(scaled_[s].second)};
  }
  Tensor size_tensor(Index s, double d) const
  {
    const auto [small, large] = sizes(s, d);
    const auto& [n, hessian] = hessian_[s];
    const Vector along = small < large ? hessian.direction : metric::tangent_basis(n)[0];
    const Vector across = n.cross(along);
    return metric::symmetrized(
        small * along * along.transpose()
        + large * (across * across.transpose() + n * n.transpose()));
  }
  std::vector<Tensor> size_tensors(double d) const
  {
    std::vector<Tensor> result;
    for (Index s = 0; s < hessian_.size(); ++s) result.push_back(size_tensor(s, d));
    return result;
  }

  /// The L^p norm of the interpolation error that a unit mesh has.
  double error(double d) const
  {
    double result = 0;
    for (Index s = 0; s < hessian_.size(); ++s) {
      const auto [small, large] = sizes(s, d);
      const double mean = constant_
          * (hessian_[s].value.larger * small * small + hessian_[s].value.smaller * large * large)
          / 2;
      if (std::isfinite(p_)) {
        result += area_[s] * std::pow(mean, p_);
      } else {
        result = std::max(result, mean);
      }
    }
    return std::isfinite(p_) ? std::pow(result, 1 / p_) : result;
  }

  /// \brief The factor for which measure(d) is what is wanted, or as near as the range of sizes
  /// lets it come.
  ///
  /// \param measure positive and monotonic
  template <class Measure>
  double factor_for(double wanted, const Measure& measure) const
  {
    const auto [low, high] = range_of_factors();
    const auto miss = [&](double log_d) { return std::log(measure(std::exp(log_d)) / wanted); };
    const double at_low = miss(low), at_high = miss(high);
    if (at_low == 0 || (at_low > 0) == (at_high > 0))
      return std::exp(std::abs(at_low) <= std::abs(at_high) ? low : high);
    const auto is_close = [](double a, double b) { return std::abs(b - a) < 1e-5; };
    std::uintmax_t most_steps = 200;
    const auto [a, b]
        = boost::math::tools::toms748_solve(miss, low, high, at_low, at_high, is_close, most_steps);
    return std::exp((a + b) / 2);
  }

private:
  /// The logarithms of factors for which all sizes are the maximum, or the minimum.
  std::pair<double, double> range_of_factors() const
  {
    double least = std::numeric_limits<double>::infinity(), largest = 0;
    for (const auto& [a, b] : scaled_) {
      largest = std::max(largest, a);
      if (b > 0) least = std::min(least, b);
    }
    if (!(largest > 0)) return {0, 0};
    const double low = -std::log(largest * range_.maximum * range_.maximum);
    return {low, std::max(low, -std::log(least * range_.minimum * range_.minimum))};
  }

  std::vector<Frame_hessian> hessian_;
  const std::vector<double>& area_;
  Size_range range_;
  double p_, constant_;
  std::vector<std::pair<double, double>> scaled_; ///< eigenvalues for D = 1, the larger one first
};

} // namespace surety::internal::solution_metric

#endif // SURETY_INTERNAL_SOLUTION_METRIC_OPTIMAL_H
