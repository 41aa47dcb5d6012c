// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a point of the support downhill to a closest point: Newton's method on the squared distance,
// with the three coordinates kept from becoming negative, walking to the next patch where a step
// leaves by an edge. Ends at a local minimum, which is the closest point for points near the
// surface.
#ifndef SURETY_INTERNAL_SUPPORT_DESCENT_H
#define SURETY_INTERNAL_SUPPORT_DESCENT_H

#include <surety/internal/support/location.h>
#include <surety/internal/support/surface.h>

#include <Eigen/Core>

#include <cmath>

namespace surety::internal {

/// `admits(face)` tells which faces may be entered.
template <class Filter>
class Descent
{
public:
  Descent(const Support_surface& surface, const Filter& admits, const Vector& target)
    : surface_(surface), admits_(admits), target_(target)
  {}

  Support_point from(const Support_location& start)
  {
    move_to(start);
    int turns = 0;       // crossings since the last step
    int entered_by = -1; // the edge of the last of them
    for (int iteration = 0; iteration < largest_iterations; ++iteration) {
      const Vector step = newton_step();
      const int blocked = blocked_coordinate(step);
      if (blocked >= 0) {
        // The edge opposite to a corner is the one that begins at the next corner.
        const int i = next_corner(blocked);
        if (i != entered_by && turns < largest_turns && may_cross(i)) {
          const Index place = surface_.mesh().neighbour[at_.face][i];
          move_to(across(surface_.mesh(), at_, i));
          entered_by = int(place % 3);
          ++turns;
          continue;
        }
        if (!advance(step_along(i))) break;
      } else if (!advance(step)) {
        break;
      }
      turns = 0;
      entered_by = -1;
    }
    return {at_, jet_.point, squared_};
  }

private:
  static constexpr int largest_iterations = 40;
  static constexpr int largest_turns = 24;
  static constexpr double negligible = 1e-7; // change of barycentric coordinates

  void move_to(const Support_location& to)
  {
    at_ = to;
    jet_ = surface_.second_order(at_.face, at_.barycentric);
    squared_ = (jet_.point - target_).squaredNorm();
  }

  bool may_cross(int i) const
  {
    const Index place = surface_.mesh().neighbour[at_.face][i];
    return place != none && admits_(place / 3);
  }

  /// Half the squared distance to second order, along v and w.
  struct Model {
    double gv, gw, hvv, hvw, hww; // gradient and matrix
  };

  /// With the full matrix where it is positive definite enough, else with that of Gauss and Newton.
  Model model() const
  {
    const Vector r = jet_.point - target_;
    const double jvv = jet_.v.squaredNorm(), jvw = jet_.v.dot(jet_.w), jww = jet_.w.squaredNorm();
    Model m{
        r.dot(jet_.v), r.dot(jet_.w), jvv + r.dot(jet_.vv), jvw + r.dot(jet_.vw),
        jww + r.dot(jet_.ww)};
    const double determinant = m.hvv * m.hww - m.hvw * m.hvw;
    if (!(determinant > 1e-3 * (jvv * jww - jvw * jvw)) || !(m.hvv > 0)) {
      m.hvv = jvv;
      m.hvw = jvw;
      m.hww = jww;
    }
    return m;
  }

  Vector newton_step() const
  {
    const Model m = model();
    const double determinant = m.hvv * m.hww - m.hvw * m.hvw;
    double v, w;
    if (determinant > 1e-14 * m.hvv * m.hww) {
      v = (m.hvw * m.gw - m.hww * m.gv) / determinant;
      w = (m.hvw * m.gv - m.hvv * m.gw) / determinant;
    } else {
      const double scale = m.hvv + m.hww;
      v = scale > 0 ? -m.gv / scale : 0;
      w = scale > 0 ? -m.gw / scale : 0;
    }
    return {-v - w, v, w};
  }

  /// The step along edge i only.
  Vector step_along(int i) const
  {
    const Model m = model();
    Vector way = Vector::Zero();
    way[i] = -1;
    way[next_corner(i)] = 1;
    const double v = way[1], w = way[2];
    const double slope = m.gv * v + m.gw * w;
    const double bend = m.hvv * v * v + 2 * m.hvw * v * w + m.hww * w * w;
    return bend > 0 ? Vector(-slope / bend * way) : Vector(Vector::Zero());
  }

  /// The coordinate that is zero and would become negative soonest, or -1.
  int blocked_coordinate(const Vector& step) const
  {
    int worst = -1;
    for (int k = 0; k < 3; ++k) {
      if (at_.barycentric[k] > 0 || !(step[k] < 0)) continue;
      if (worst < 0 || step[k] < step[worst]) worst = k;
    }
    return worst;
  }

  /// Makes a step, cut at the border of the triangle and halved until the distance does not grow.
  /// Whether there is more to do.
  bool advance(const Vector& step)
  {
    double share = 1;
    int hit = -1;
    for (int k = 0; k < 3; ++k) {
      if (!(step[k] < 0) || at_.barycentric[k] + share * step[k] >= 0) continue;
      share = at_.barycentric[k] / -step[k];
      hit = k;
    }
    const double size = step.cwiseAbs().maxCoeff();
    const Support_location old = at_;
    const Jet old_jet = jet_;
    const double old_squared = squared_;
    for (int halvings = 0; halvings < 8; ++halvings, share /= 2, hit = -1) {
      const bool is_small = share * size <= negligible;
      if (is_small && hit < 0) return false;
      move_to({old.face, moved(old.barycentric, share * step, hit)});
      if (squared_ <= old_squared) return true;
      at_ = old;
      jet_ = old_jet;
      squared_ = old_squared;
    }
    return false;
  }

  static Vector moved(const Vector& from, const Vector& step, int hit)
  {
    Vector to = (from + step).cwiseMax(0.0);
    if (hit >= 0) to[hit] = 0;
    return to / to.sum();
  }

  const Support_surface& surface_;
  const Filter& admits_;
  const Vector target_;
  Support_location at_;
  Jet jet_;
  double squared_ = 0;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_DESCENT_H
