// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sound bounds of a patch from its control net.
//
// Displacement. That of a point of the patch is a convex combination of those of control points,
// whose length is at most the same combination of their lengths. With q = uv+vw+wu,
// p = uvw the weights of the three kinds of inner points add up to
//   f = 4 d_e (q - 2q^2 - p) + 6 d_m (q^2 - 2p) + 12 d_i p,
// d_e, d_m, d_i the largest length of each kind: outer and middle points of the edges, interior.
// For a given q, f is linear in p, and p lies between max(0, (4q - 1)/9) and q^2/3: the maximum is
// that of three quadratics in q.
//
// Second derivatives. The patch is a quartic with the mean of each pair of Gregory points, plus
// 12 a^2 bc(b - c)/(2(b + c)) times their difference at each corner. Along a direction inside the
// triangle, of barycentric components at most 1, the second derivative of the former is at most 18
// times the largest second difference of the net along an edge (12 for quartics, 3/2 because a
// direction between two edges takes half of the third); that of the latter factor is at most
// 12 max(.1 (1-a)^2 + 4 a (1-a) + 3 a^2) = 36. First derivatives: 4 times the largest difference,
// and 2.
#ifndef SURETY_INTERNAL_SUPPORT_BOUND_H
#define SURETY_INTERNAL_SUPPORT_BOUND_H

#include <surety/internal/support/control_net.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surety::internal {

/// The largest value of a q^2 + b q + c between two values of q.
inline double largest_of_quadratic(double a, double b, double c, double low, double high)
{
  const auto value = [&](double q) { return (a * q + b) * q + c; };
  double largest = (std::max)(value(low), value(high));
  if (a < 0 && b > -2 * a * low && b < -2 * a * high)
    largest = (std::max)(largest, c - b * b / (4 * a));
  return largest;
}

/// The maximum of f above.
inline double largest_combination(double outer, double middle, double interior)
{
  // f = square q^2 + outer_4 q + slope p.
  const double square = 6 * middle - 8 * outer, linear = 4 * outer;
  const double slope = 12 * interior - 12 * middle - 4 * outer;
  return (std::max)(
      {largest_of_quadratic(square + slope / 3, linear, 0, 0, 1. / 3),
       largest_of_quadratic(square, linear, 0, 0, 0.25),
       largest_of_quadratic(square, linear + slope * 4 / 9, -slope / 9, 0.25, 1. / 3)});
}

/// Applies a function to all control points, and bounds the patch from the three largest values.
template <class Function>
double bound_from_points(const Function& value_of)
{
  double outer = 0, middle = 0, interior = 0;
  for (int i = 0; i < 3; ++i) {
    outer = (std::max)(
        {outer, value_of(Control_net::edge_column(i, 0)),
         value_of(Control_net::edge_column(i, 2))});
    middle = (std::max)(middle, value_of(Control_net::edge_column(i, 1)));
    interior = (std::max)(
        {interior, value_of(Control_net::gregory_column(i, 0)),
         value_of(Control_net::gregory_column(i, 1))});
  }
  // The evaluation of f has some twenty operations on terms of at most 16 times the result.
  return largest_combination(outer, middle, interior) * (1 + 0x1p-40);
}

/// The largest displacement of a point of the triangle.
inline double displacement_bound(const Control_net& net)
{
  return bound_from_points([&](int k) { return net.displacement.col(k).norm(); });
}

/// How fast the displacement of a patch may change, along directions inside the triangle.
struct Derivative_bounds {
  double first = 0, second = 0;
};

/// The displacements of a quartic net with the mean of each pair of Gregory points, in an array by
/// the multiplicity of corners 1 and 2.
class Mean_net
{
public:
  explicit Mean_net(const Control_net& net)
  {
    for (auto& row : point_) row.fill(Vector::Zero());
    for (int i = 0; i < 3; ++i) {
      const int j = next_corner(i), p = previous_corner(i);
      for (int k = 1; k < 4; ++k) {
        std::array<int, 3> m = {0, 0, 0};
        m[i] = 4 - k;
        m[j] = k;
        point_[m[1]][m[2]] = net.edge_point(i, k - 1);
      }
      std::array<int, 3> m = {1, 1, 1};
      m[i] = 2;
      const Vector one = net.gregory_point(i, 0), other = net.gregory_point(p, 1);
      point_[m[1]][m[2]] = (one + other) / 2;
      gaps_ += (one - other).norm();
    }
  }

  Derivative_bounds bounds() const
  {
    constexpr std::array<std::array<int, 2>, 3> way = {{{1, 0}, {0, 1}, {1, -1}}};
    Derivative_bounds largest;
    for (int v = 0; v <= 4; ++v) {
      for (int w = 0; v + w <= 4; ++w) {
        for (const auto& [dv, dw] : way) {
          if (!is_inside(v + dv, w + dw)) continue;
          const Vector one = point_[v + dv][w + dw] - point_[v][w];
          largest.first = (std::max)(largest.first, one.norm());
          if (!is_inside(v + 2 * dv, w + 2 * dw)) continue;
          const Vector next = point_[v + 2 * dv][w + 2 * dw] - point_[v + dv][w + dw];
          largest.second = (std::max)(largest.second, (next - one).norm());
        }
      }
    }
    return {4 * largest.first + 2 * gaps_, 18 * largest.second + 36 * gaps_};
  }

private:
  static bool is_inside(int v, int w) { return v >= 0 && w >= 0 && v + w <= 4; }

  std::array<std::array<Vector, 5>, 5> point_;
  double gaps_ = 0; // sum of the distances of the pairs
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_BOUND_H
