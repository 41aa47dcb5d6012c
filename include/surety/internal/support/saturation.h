// SPDX-License-Identifier: GPL-3.0-or-later
//
// What keeps the support inside the tolerance: displacements d become F(d) = f(|d|) d/|d|, where f
// is the identity up to a start a and then grows to a limit L that it never reaches,
//   f(r) = a + b g((r - a)/b),  b = L - a,  g(z) = z/sqrt(1 + z^2).
// g(0) = 0, g'(0) = 1, g''(0) = 0: F is C2, and the same on all machines, having only roots.
#ifndef SURETY_INTERNAL_SUPPORT_SATURATION_H
#define SURETY_INTERNAL_SUPPORT_SATURATION_H

#include <surety/internal/support/evaluation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surety::internal {

class Saturation
{
public:
  /// Of the limit. Displacements below are left alone.
  static constexpr double start_share = 0.75;

  /// Without a limit: the identity.
  Saturation() : Saturation(std::numeric_limits<double>::infinity()) {}
  explicit Saturation(double limit) : start_(start_share * limit), room_(limit - start_) {}

  double start() const { return start_; }
  bool acts_on(const Vector& d) const { return d.squaredNorm() > start_ * start_; }

  Vector operator()(const Vector& d) const { return acts_on(d) ? Vector(of(d).ratio * d) : d; }

  /// Replaces a displacement and its derivatives along v and w by those of F(d).
  void apply(Jet& jet, bool to_second_order) const
  {
    if (!acts_on(jet.point)) return;
    const Factors s = of(jet.point);
    const Vector d = jet.point, v = jet.v, w = jet.w;
    const double dv = d.dot(v), dw = d.dot(w);
    jet.point = s.ratio * d;
    jet.v = s.ratio * v + s.slope * dv * d;
    jet.w = s.ratio * w + s.slope * dw * d;
    if (!to_second_order) return;
    const auto second
        = [&](const Vector& x, const Vector& y, double dx, double dy, const Vector& xy) {
            return Vector(
                s.ratio * xy + s.slope * (dx * y + dy * x + (x.dot(y) + d.dot(xy)) * d)
                + s.bend * dx * dy * d);
          };
    jet.vv = second(v, v, dv, dv, jet.vv);
    jet.vw = second(v, w, dv, dw, jet.vw);
    jet.ww = second(w, w, dw, dw, jet.ww);
  }

  /// How much F may shorten and bend, for displacements in a range of lengths.
  struct Bounds {
    double first;  ///< of |DF[e]|/|e|
    double second; ///< of |D2 F[e, e]|/|e|^2
  };

  /// \brief The radial part of DF is f' <= f/r and the tangential one f/r <= L/r, at most 1.
  ///
  /// With m = |f' - f/r|/r <= L/r^2, the two parts of D2 F add up to at most |f''| + 2m, where
  /// |f''| = 3 z (1 + z^2)^(-5/2)/b grows up to z = 1/2, to less than 0.86/b, and falls from there.
  Bounds bounds(double least_length, double largest_length) const
  {
    if (largest_length <= start_) return {1, 0};
    const double r = (std::max)(least_length, start_), limit = start_ + room_;
    const double z = (r - start_) / room_, q = 1 + z * z;
    const double f2 = z < 0.5 ? 0.86 : 3 * z / (q * q * std::sqrt(q));
    return {
        least_length > start_ ? (std::min)(1., limit / r) : 1,
        (f2 / room_ + 2 * limit / (r * r)) * (1 + 0x1p-40)};
  }

private:
  /// F(d) = ratio d; slope and bend are the derivatives of ratio and slope by |d|^2/2.
  struct Factors {
    double ratio, slope, bend;
  };

  Factors of(const Vector& d) const
  {
    const double r = d.norm(), z = (r - start_) / room_, q = 1 / std::sqrt(1 + z * z);
    const double f = start_ + room_ * z * q, f1 = q * q * q, f2 = -3 * z / room_ * f1 * q * q;
    const double ratio = f / r, slope = (f1 - ratio) / (r * r);
    return {ratio, slope, ((f2 - (f1 - ratio) / r) / (r * r) - 2 * slope / r) / r};
  }

  double start_, room_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_SATURATION_H
