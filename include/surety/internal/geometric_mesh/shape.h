// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shape control (section 2.2 of the paper): Q(new) <= max(omega max Q(old), floor).
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_SHAPE_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_SHAPE_H

#include <surety/internal/linear.h>
#include <surety/internal/operators/disc.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surety::internal {

/// Q(K) = (sqrt(3)/6) h_max / inradius, and the inradius is twice the area over the perimeter.
inline double shape_quality(const Vector& a, const Vector& b, const Vector& c)
{
  const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
  const double double_area = (b - a).cross(c - a).norm();
  if (!(double_area > 0)) return std::numeric_limits<double>::infinity();
  constexpr double sqrt3_over_6 = 0.28867513459481287;
  return sqrt3_over_6 * std::max({ab, bc, ca}) * (ab + bc + ca) / double_area;
}

class Shape_control
{
public:
  Shape_control(double ratio, double floor) : ratio_(ratio), floor_(floor) {}

  bool admits(const Disc& disc, const Working_mesh& mesh) const
  {
    double worst = 0;
    disc.for_each_new_face([&](Index i) {
      if (mesh.is_ghost_face(disc.face[i])) return;
      worst = std::max(
          worst,
          shape_quality(
              disc.apex_point, mesh.point(disc.ring[i]), mesh.point(disc.ring[disc.after(i)])));
    });
    if (worst <= floor_) return true;
    if (!std::isfinite(worst)) return false;
    for (const Index f : disc.old_face) {
      if (mesh.is_ghost_face(f)) continue;
      const auto v = mesh.vertices_of(f);
      if (worst <= ratio_ * shape_quality(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])))
        return true;
    }
    return false;
  }

private:
  double ratio_, floor_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_SHAPE_H
