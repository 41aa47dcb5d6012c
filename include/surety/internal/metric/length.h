// SPDX-License-Identifier: GPL-3.0-or-later
//
// Length of an edge in a metric that is known at its ends (equations 19 to 22 of the paper).
#ifndef SURETY_INTERNAL_METRIC_LENGTH_H
#define SURETY_INTERNAL_METRIC_LENGTH_H

#include <surety/internal/metric/tensor.h>
#include <surety/parameters.h>

#include <algorithm>
#include <cmath>

namespace surety::internal::metric {

/// \brief Length of an edge along which the size goes linearly from |e| / a to |e| / b.
///
/// The integral of dt / h(t) is a b ln(a/b) / (a - b), which log1p evaluates without cancellation
/// down to a = b.
inline double length_of_linear_size(double a, double b)
{
  const auto [smaller, larger] = std::minmax(a, b);
  const double excess = (larger - smaller) / smaller;
  return excess > 0 ? larger * (std::log1p(excess) / excess) : larger;
}

/// \brief Length of an edge along which the size is in geometric progression: (a - b) / ln(a/b).
///
/// Equation (22) with Id / H^2 in place of its Id / H.
inline double length_of_geometric_size(double a, double b)
{
  const auto [smaller, larger] = std::minmax(a, b);
  const double excess = (larger - smaller) / smaller;
  return excess > 0 ? smaller * (excess / std::log1p(excess)) : larger;
}

/// The length where nothing is known between the ends but their lengths a and b, and the length
/// that the metric in the middle would give.
inline double length_by_simpson(double a, double middle, double b)
{
  return (a + 4 * middle + b) / 6;
}

/// The length of an edge by a rule, from its lengths in the metrics of both ends and, where the
/// rule wants it, `middle()`, its length in the metric half way.
template <class Middle>
double edge_length_by(Length_rule rule, double a, double b, const Middle& middle)
{
  switch (rule) {
  case Length_rule::simpson:
    return length_by_simpson(a, middle(), b);
  case Length_rule::trapezoid:
    return (a + b) / 2;
  case Length_rule::end_only:
    return a;
  case Length_rule::logarithmic_mean:
    return length_of_geometric_size(a, b);
  case Length_rule::linear_size:
    break;
  }
  return length_of_linear_size(a, b);
}

/// Length of an edge of Euclidean length `length` between two isotropic sizes.
inline double edge_length(double length, double size_a, double size_b, Length_rule rule)
{
  return edge_length_by(
      rule, length / size_a, length / size_b, [&] { return length / ((size_a + size_b) / 2); });
}

/// Length of the vector e that leads from a point with metric m_a to one with metric m_b.
inline double edge_length(const Vector& e, const Tensor& m_a, const Tensor& m_b, Length_rule rule)
{
  return edge_length_by(rule, length_in(m_a, e), length_in(m_b, e), [&] {
    return length_in(metric_of_sizes((size_tensor(m_a) + size_tensor(m_b)) / 2), e);
  });
}

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_LENGTH_H
