// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface as the graph of a polynomial over a plane: frame, monomials, and the curvature that the
// coefficients mean.
#ifndef SURETY_INTERNAL_CURVATURE_JET_H
#define SURETY_INTERNAL_CURVATURE_JET_H

#include <surety/curvature_field.h>
#include <surety/internal/linear.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surety::internal::curvature {

/// An orthonormal frame at a point, and the length that is one in its coordinates.
struct Frame {
  Vector origin = Vector::Zero();
  Vector first = Vector::Zero(), second = Vector::Zero(), normal = Vector::Zero();
  double unit = 1;

  Vector to_local(const Vector& p) const
  {
    const Vector d = (p - origin) * (1 / unit);
    return {d.dot(first), d.dot(second), d.dot(normal)};
  }
  Vector to_world(const Vector& direction) const
  {
    return direction.x() * first + direction.y() * second + direction.z() * normal;
  }
};

/// The coefficients of z = p x + q y + a x^2 + b x y + c y^2 + cubic and quartic terms, in this
/// order, and what noise of variance one in the samples makes of a, b and c.
struct Jet {
  static constexpr int quadratic = 5, cubic = 9, quartic = 14; ///< numbers of terms

  std::array<double, quartic> coefficient{};
  std::array<double, 3> variance{}; ///< of a, b, c
  int terms = 0;

  double p() const { return coefficient[0]; }
  double q() const { return coefficient[1]; }
  double second_order(int i) const { return coefficient[std::size_t(2 + i)]; }
  double largest_curvature() const
  {
    return (std::max)(
        {std::abs(2 * second_order(0)), std::abs(second_order(1)), std::abs(2 * second_order(2))});
  }
  double total_variance() const { return variance[0] + variance[1] + variance[2]; }
  double largest_variance() const { return *std::max_element(variance.begin(), variance.end()); }
};

/// Writes the monomials, without the constant one, in the order of `Jet`.
inline void write_quadratic(double x, double y, double* row)
{
  row[0] = x;
  row[1] = y;
  row[2] = x * x;
  row[3] = x * y;
  row[4] = y * y;
}

inline void write_quartic(double x, double y, double* row)
{
  write_quadratic(x, y, row);
  for (int i = 0; i < 3; ++i) row[5 + i] = x * row[2 + i];
  row[8] = y * row[4];
  for (int i = 0; i < 4; ++i) row[9 + i] = x * row[5 + i];
  row[13] = y * row[8];
}

/// A direction of the tangent plane in which the curvature is extreme.
struct Principal {
  double curvature = 0, derivative = 0;
  double cross_derivative = 0;       ///< along the other direction
  Vector direction = Vector::Zero(); ///< in the frame
};

/// \brief The principal curvatures of a jet, the smaller one first, in units of the frame.
///
/// With W = sqrt(1 + p^2 + q^2) the fundamental forms are I = [1 + p^2, p q; p q, 1 + q^2] and
/// II = [2a, b; b, 2c] / W. With I = L L^T the principal curvatures are the eigenvalues of the
/// symmetric matrix L^-1 II L^-T, and X L^-T w is the direction of an eigenvector w, where X maps
/// the plane of parameters to the tangent plane. For p = q = 0 these are equations (13) to (16) of
/// the paper without its division by b.
class Principal_solver
{
public:
  explicit Principal_solver(const Jet& jet) : jet_(jet)
  {
    const double p = jet.p(), q = jet.q();
    w_ = std::sqrt(1 + p * p + q * q);
    l11_ = std::sqrt(1 + p * p);
    l21_ = p * q / l11_;
    l22_ = w_ / l11_; // since det I = W^2
    solve();
  }

  const Principal& smaller() const { return principal_[0]; }
  const Principal& larger() const { return principal_[1]; }
  Vector normal() const { return Vector(-jet_.p(), -jet_.q(), 1) / w_; }

private:
  void solve()
  {
    const double l = 2 * jet_.second_order(0) / w_, m = jet_.second_order(1) / w_;
    const double n = 2 * jet_.second_order(2) / w_;
    // S = L^-1 II L^-T
    const double s11 = l / (l11_ * l11_);
    const double s12 = (m / l11_ - l21_ * s11) / l22_;
    const double s22 = ((n - l21_ * l21_ * s11) / l22_ - 2 * l21_ * s12) / l22_;
    const double mean = (s11 + s22) / 2, half = (s11 - s22) / 2, radius = std::hypot(half, s12);
    const double angle = std::atan2(s12, half) / 2; // of the larger one
    const double c = std::cos(angle), s = std::sin(angle);
    principal_[1] = along(mean + radius, c, s);
    principal_[0] = along(mean - radius, -s, c);
    const auto u = unscaled(c, s), v = unscaled(-s, c);
    principal_[1].cross_derivative = cross_derivative(u, v);
    principal_[0].cross_derivative = cross_derivative(v, u);
  }

  /// L^-T w
  std::array<double, 2> unscaled(double w1, double w2) const
  {
    const double v = w2 / l22_;
    return {(w1 - l21_ * v) / l11_, v};
  }

  Principal along(double curvature, double w1, double w2) const
  {
    const auto [u, v] = unscaled(w1, w2);
    return {curvature, derivative(u, v), 0, Vector(u, v, jet_.p() * u + jet_.q() * v)};
  }

  /// \brief The derivative of a principal curvature along its own direction (u, v).
  ///
  /// In the frame of the tangent plane it is the third derivative of the height. There, with f2 and
  /// f3 the quadratic and the cubic part of the jet, the cubic part is (f3 - f2' g f2) / W: the
  /// foot of a point moves by f2 times g = I^-1 (p, q), the tangential part of the z axis.
  double derivative(double u, double v) const
  {
    if (jet_.terms < Jet::cubic) return 0;
    const auto& k = jet_.coefficient;
    const double a = k[2], b = k[3], c = k[4], w2 = w_ * w_;
    const double f2 = a * u * u + b * u * v + c * v * v;
    const double f3 = k[5] * u * u * u + k[6] * u * u * v + k[7] * u * v * v + k[8] * v * v * v;
    const double g1 = jet_.p() / w2, g2 = jet_.q() / w2; // I^-1 (p, q) = (p, q) / W^2
    const double slope = (2 * a * u + b * v) * g1 + (b * u + 2 * c * v) * g2;
    return 6 * (f3 - slope * f2) / w_;
  }

  /// \brief The derivative along e of the principal curvature whose direction is d.
  ///
  /// By Codazzi's equation it is the symmetric trilinear form T(d, d, e) of which the derivative
  /// above is T(d, d, d): a third of its derivative by d towards e.
  double cross_derivative(const std::array<double, 2>& d, const std::array<double, 2>& e) const
  {
    if (jet_.terms < Jet::cubic) return 0;
    const auto& k = jet_.coefficient;
    const auto [u, v] = d;
    const double a = k[2], b = k[3], c = k[4], w2 = w_ * w_;
    const double f2 = a * u * u + b * u * v + c * v * v;
    const double f2_e = (2 * a * u + b * v) * e[0] + (b * u + 2 * c * v) * e[1];
    const double f3_e = (3 * k[5] * u * u + 2 * k[6] * u * v + k[7] * v * v) * e[0]
        + (k[6] * u * u + 2 * k[7] * u * v + 3 * k[8] * v * v) * e[1];
    const double g1 = jet_.p() / w2, g2 = jet_.q() / w2;
    const auto slope
        = [=](double x, double y) { return (2 * a * x + b * y) * g1 + (b * x + 2 * c * y) * g2; };
    return 2 * (f3_e - slope(e[0], e[1]) * f2 - slope(u, v) * f2_e) / w_;
  }

  const Jet& jet_;
  double w_, l11_, l21_, l22_;
  std::array<Principal, 2> principal_;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_JET_H
