// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tensors in a tangent plane: symmetric positive definite 2x2 matrices, in closed form.
#ifndef SURETY_INTERNAL_GRADATION_PLANE_TENSOR_H
#define SURETY_INTERNAL_GRADATION_PLANE_TENSOR_H

#include <surety/internal/linear.h>
#include <surety/internal/metric/tensor.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surety::internal::grading {

/// [a b; b c]
struct Plane_tensor {
  double a, b, c;

  double of(double x, double y) const { return a * x * x + 2 * b * x * y + c * y * y; }
};

/// x x^T + y y^T, weighted
inline Plane_tensor sum_of_squares(
    double wx, const std::array<double, 2>& x, double wy, const std::array<double, 2>& y)
{
  return {
      wx * x[0] * x[0] + wy * y[0] * y[0], wx * x[0] * x[1] + wy * y[0] * y[1],
      wx * x[1] * x[1] + wy * y[1] * y[1]};
}

/// The eigenvalues, the larger first, and the unit eigenvector of the larger one.
struct Plane_axes {
  explicit Plane_axes(const Plane_tensor& m)
  {
    // Half the difference and b are cosine and sine of twice the angle; of the two ways to halve it
    // the one that does not cancel is taken.
    const double mean = (m.a + m.c) / 2, half = (m.a - m.c) / 2;
    const double radius = std::sqrt(half * half + m.b * m.b);
    larger = mean + radius;
    smaller = larger > 0 ? (m.a / larger) * m.c - (m.b / larger) * m.b : 0;
    if (!(radius > 0)) return;
    const double x = half >= 0 ? half + radius : m.b, y = half >= 0 ? m.b : radius - half;
    const double length = std::sqrt(x * x + y * y);
    axis = {x / length, y / length};
  }

  double larger, smaller;
  std::array<double, 2> axis = {1, 0};
};

inline Plane_tensor from_axes(double larger, double smaller, const std::array<double, 2>& axis)
{
  return sum_of_squares(larger, axis, smaller, {-axis[1], axis[0]});
}

/// Up to this factor in squared length a tensor counts as satisfied: half a per cent of a size, for
/// which no tensor needs to change.
constexpr double slack = 1.01;

/// Whether g asks for more than m in some direction: the largest eigenvalue of m^-1 g.
inline bool asks_more(const Plane_tensor& g, const Plane_tensor& m)
{
  // g - slack m is negative semidefinite unless its trace or its determinant says otherwise.
  const double a = slack * m.a - g.a, b = slack * m.b - g.b, c = slack * m.c - g.c;
  return !(a >= 0 && c >= 0 && a * c >= b * b);
}

/// \brief The intersection by simultaneous reduction: with m = L L^T and L^-1 g L^-T = V D V^T it
/// is (L V) max(D, 1) (L V)^T.
inline Plane_tensor intersection(const Plane_tensor& m, const Plane_tensor& g)
{
  const double l11 = std::sqrt(m.a), l21 = m.b / l11;
  const double l22 = std::sqrt((std::max)(m.c - l21 * l21, 0.));
  const double ca = g.a / (l11 * l11);
  const double half = g.b / l11 - ca * l21;
  const double cb = half / l22;
  const double cc = (g.c - 2 * l21 * (g.b / l11) + ca * l21 * l21) / (l22 * l22);
  const Plane_axes reduced({ca, cb, cc});
  const auto [x, y] = reduced.axis;
  return sum_of_squares(
      (std::max)(reduced.larger, 1.), {l11 * x, l21 * x + l22 * y}, (std::max)(reduced.smaller, 1.),
      {-l11 * y, -l21 * y + l22 * x});
}

/// \brief Lowers eigenvalues to a limit.
///
/// An intersection may ask for sizes below those of both its tensors, and gradation would then
/// shrink sizes for ever.
inline Plane_tensor clamped(const Plane_tensor& m, double limit)
{
  const Plane_axes axes(m);
  if (axes.larger <= limit) return m;
  return from_axes(limit, (std::min)(axes.smaller, limit), axes.axis);
}

} // namespace surety::internal::grading

#endif // SURETY_INTERNAL_GRADATION_PLANE_TENSOR_H
