// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cubic curve of an edge, from the tangents at its ends, and the quartic that it is raised to.
// Everything is stored as displacement from the straight edge, so that no digit is lost to the
// position of the model and a flat edge has exactly no displacement.
#ifndef SURETY_INTERNAL_SUPPORT_EDGE_CURVE_H
#define SURETY_INTERNAL_SUPPORT_EDGE_CURVE_H

#include <surety/internal/linear.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surety::internal {

/// \brief The arms of a cubic Bezier curve: first inner point minus start, end minus second one.
///
/// The curve is tangent to its arms. One that is straight follows the chord at constant speed, and
/// its arms are not used.
struct Edge_curve {
  Vector start = Vector::Zero();
  Vector end = Vector::Zero();
  bool is_straight = true;
  /// That the surface should have in the middle; zero where only the ends are known.
  Vector middle_normal = Vector::Zero();

  Edge_curve reversed() const { return {-end, -start, is_straight, middle_normal}; }

  /// What the three inner points of the quartic add to the even division of the chord.
  std::array<Vector, 3> displacements(const Vector& chord) const
  {
    if (is_straight) return {Vector::Zero(), Vector::Zero(), Vector::Zero()};
    return {(3 * start - chord) / 4, (start - end) / 2, (chord - 3 * end) / 4};
  }
};

/// The curve of length d between unit tangents t0, t1: its arms have the length that makes a cubic
/// follow the circle that turns as much. Half the cosine's bound keeps arms finite at U turns.
inline Edge_curve curve_between(double d, const Vector& t0, const Vector& t1)
{
  const double cosine = std::clamp(t0.dot(t1), -0.9, 1.0);
  const double arm = 2 * d / (3 * (1 + std::sqrt((1 + cosine) / 2)));
  return {arm * t0, arm * t1, false, Vector::Zero()};
}

/// The direction of a chord in the plane normal to n; zero where it has none.
inline Vector projected_direction(const Vector& direction, const Vector& n)
{
  const Vector projected = direction - direction.dot(n) * n;
  constexpr double least = 0.05; // the plane is within 3 degrees of perpendicular to the chord
  return projected.squaredNorm() > least * least ? unit(projected) : Vector(Vector::Zero());
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_EDGE_CURVE_H
