// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps on the support: in a patch along a line of its coordinates, and from patch to patch by
// turning about the tangent of their common edge.
#ifndef SURETY_INTERNAL_SUPPORT_WALK_H
#define SURETY_INTERNAL_SUPPORT_WALK_H

#include <surety/internal/support/location.h>
#include <surety/internal/support/surface.h>

#include <algorithm>

namespace surety {

/// Where a walk ended.
struct Support_walk {
  Support_location location;
  Eigen::Vector3d remaining; ///< tangent step that a border or a feature cut off; else zero
};

namespace internal {

class Walk
{
public:
  Walk(const Support_surface& surface, bool may_cross_features)
    : surface_(surface), may_cross_features_(may_cross_features)
  {}

  Support_walk from(Support_location at, Vector step) const
  {
    const Flat_mesh& mesh = surface_.mesh();
    for (int crossings = 0; crossings < largest_crossings; ++crossings) {
      const Jet jet = surface_.first_order(at.face, at.barycentric);
      const Vector way = coordinates(jet, step);
      double share = 1;
      int hit = -1;
      for (int k = 0; k < 3; ++k) {
        if (!(way[k] < 0) || at.barycentric[k] + share * way[k] >= 0) continue;
        share = at.barycentric[k] / -way[k];
        hit = k;
      }
      at.barycentric = (at.barycentric + share * way).cwiseMax(0.0);
      if (hit >= 0) at.barycentric[hit] = 0;
      at.barycentric /= at.barycentric.sum();
      if (hit < 0) return {at, Vector::Zero()};
      step *= 1 - share;
      const int i = next_corner(hit);
      const bool is_stop = mesh.neighbour[at.face][i] == none
          || (mesh.is_feature[mesh.edge[at.face][i]] && !may_cross_features_);
      if (is_stop) return {at, step};
      step = turned(at, i, step);
      at = across(mesh, at, i);
    }
    return {at, step};
  }

private:
  static constexpr int largest_crossings = 100000;

  /// The change of barycentric coordinates that moves by the tangent part of a step.
  static Vector coordinates(const Jet& jet, const Vector& step)
  {
    const double vv = jet.v.squaredNorm(), vw = jet.v.dot(jet.w), ww = jet.w.squaredNorm();
    const double determinant = vv * ww - vw * vw;
    if (!(determinant > 1e-20 * vv * ww)) return Vector::Zero();
    const double sv = step.dot(jet.v), sw = step.dot(jet.w);
    const double v = (ww * sv - vw * sw) / determinant, w = (vv * sw - vw * sv) / determinant;
    return {-v - w, v, w};
  }

  /// A step that leaves a face by its edge i, as the face across it goes on.
  Vector turned(const Support_location& at, int i, const Vector& step) const
  {
    const Jet here = surface_.first_order(at.face, at.barycentric);
    const Support_location beyond = across(surface_.mesh(), at, i);
    const Jet there = surface_.first_order(beyond.face, beyond.barycentric);
    const std::array<Vector, 3> along = {here.v, here.w - here.v, -here.w};
    const Vector e = unit(along[i]);
    const Vector old_way = surface_.normal(at.face, here).cross(e);
    const Vector new_way = surface_.normal(beyond.face, there).cross(e);
    return step.dot(e) * e + step.dot(old_way) * new_way;
  }

  const Support_surface& surface_;
  bool may_cross_features_;
};

} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_SUPPORT_WALK_H
