// SPDX-License-Identifier: GPL-3.0-or-later
//
// What keeps the support inside the tolerance: displacements d become F(d) = f(|d|) d/|d|, where f
// is the identity up to a start a and then grows to a limit L that it never reaches,
//   f(r) = a + b g((r - a)/b),  b = L - a,  g(z) = z/sqrt(1 + z^2).
// g(0) = 0, g'(0) = 1, g''(0) = 0: F is C2, and the same on all machines, having only roots.
#ifndef SURETY_INTERNAL_SUPPORT_SATURATION_H
#define SURETY_INTERNAL_SUPPORT_SATURATION_H

#include <surety/internal/support/evaluation.h>

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

  /// \brief A bound of |D2 F[e, e]|/|e|^2.
  ///
  /// With m = |f' - f/r|/r <= 1/a, the radial and tangential parts add up to at most |f''| + 2m,
  /// and |f''| = 3 z (1 + z^2)^(-5/2)/b <= 0.86/b.
  double second_derivative() const { return 0.86 / room_ + 2 / start_; }

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
