// SPDX-License-Identifier: GPL-3.0-or-later
//
// The weights of a patch's control points, with first and second derivatives. With barycentric
// coordinates (a, b, c), c of the corner that an edge ab does not have, the weights are those of a
// quartic Bezier triangle, 4 a^3 b, 6 a^2 b^2, 4 a b^3, and for the two Gregory points next to
// corner a, 12 a^2 (b^2 c/(b + c)) and 12 a^2 (b c^2/(b + c)).
#ifndef SURETY_INTERNAL_SUPPORT_EVALUATION_H
#define SURETY_INTERNAL_SUPPORT_EVALUATION_H

#include <surety/internal/support/control_net.h>

#include <Eigen/Core>

namespace surety::internal {

/// A point and its derivatives along v and w, the coordinates of corners 1 and 2; that of corner 0
/// is 1 - v - w.
struct Jet {
  Vector point, v, w, vv, vw, ww;
};

/// A scalar function of v and w, to second order.
struct Scalar_jet {
  double value, v, w, vv, vw, ww;
};

/// The derivatives of a function of two of the three coordinates, along these two.
struct Two_jet {
  double value, a, b, aa, ab, bb;
};

/// b^2 c/(b + c) and its derivatives along b and c. Where both vanish, the second derivatives have
/// no limit and those along b = c are taken.
inline Two_jet gregory_blend(double b, double c)
{
  const double s = b + c;
  const double x = s > 0 ? b / s : 0.5, y = s > 0 ? c / s : 0.5;
  return {b * x * c,     c * x * (x + 2 * y),     b * x * x,
          2 * y * y * y, 1 - y * y * (3 - 2 * y), -2 * x * x * x};
}

class Patch_weights
{
  using Weights = Eigen::Matrix<double, 15, 1>;

public:
  explicit Patch_weights(const Vector& barycentric)
  {
    for (int i = 0; i < 3; ++i) {
      const int j = next_corner(i), p = previous_corner(i);
      const double a = barycentric[i], b = barycentric[j], c = barycentric[p];
      const double aa = a * a, ab = a * b, bb = b * b;
      add(Control_net::edge_column(i, 0), i, j,
          {4 * aa * ab, 12 * aa * b, 4 * aa * a, 24 * ab, 12 * aa, 0});
      add(Control_net::edge_column(i, 1), i, j,
          {6 * ab * ab, 12 * a * bb, 12 * aa * b, 12 * bb, 24 * ab, 12 * aa});
      add(Control_net::edge_column(i, 2), i, j,
          {4 * ab * bb, 4 * bb * b, 12 * a * bb, 0, 12 * bb, 24 * ab});
      add_gregory(Control_net::gregory_column(i, 0), j, p, a, gregory_blend(b, c));
      add_gregory(Control_net::gregory_column(p, 1), p, j, a, gregory_blend(c, b));
    }
  }

  Vector point(const Control_net& net) const { return net.displacement * value_; }

  void first(const Control_net& net, Jet& jet) const
  {
    jet.v = net.displacement * v_;
    jet.w = net.displacement * w_;
  }

  void second(const Control_net& net, Jet& jet) const
  {
    jet.vv = net.displacement * vv_;
    jet.vw = net.displacement * vw_;
    jet.ww = net.displacement * ww_;
  }

private:
  static constexpr double along_v(int i) { return i == 0 ? -1 : i == 1 ? 1 : 0; }
  static constexpr double along_w(int i) { return i == 0 ? -1 : i == 2 ? 1 : 0; }

  void add(int column, int i, int j, const Two_jet& f)
  {
    const double iv = along_v(i), iw = along_w(i), jv = along_v(j), jw = along_w(j);
    value_[column] = f.value;
    v_[column] = f.a * iv + f.b * jv;
    w_[column] = f.a * iw + f.b * jw;
    vv_[column] = f.aa * iv * iv + 2 * f.ab * iv * jv + f.bb * jv * jv;
    vw_[column] = f.aa * iv * iw + f.ab * (iv * jw + iw * jv) + f.bb * jv * jw;
    ww_[column] = f.aa * iw * iw + 2 * f.ab * iw * jw + f.bb * jw * jw;
  }

  /// 12 a^2 g(b, c), where a = 1 - b - c: derivatives along b and c, then along v and w.
  void add_gregory(int column, int j, int p, double a, const Two_jet& g)
  {
    const double f = 12 * a * a, fb = -24 * a, fbb = 24;
    add(column, j, p,
        {f * g.value, fb * g.value + f * g.a, fb * g.value + f * g.b,
         fbb * g.value + 2 * fb * g.a + f * g.aa, fbb * g.value + fb * (g.a + g.b) + f * g.ab,
         fbb * g.value + 2 * fb * g.b + f * g.bb});
  }

  Weights value_, v_, w_, vv_, vw_, ww_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_EVALUATION_H
