// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patches that fold, or look away from their triangle, are refused: a matter of shape, never of the
// bound, so that the tests may be empirical.
#ifndef SURETY_INTERNAL_SUPPORT_FOLD_GUARD_H
#define SURETY_INTERNAL_SUPPORT_FOLD_GUARD_H

#include <surety/internal/support/control_net.h>
#include <surety/internal/support/evaluation.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surety::internal {

/// Whether the normal turns so far about an edge that the field A cannot join its ends.
inline bool is_twisted(const Patch_data& data)
{
  for (int i = 0; i < 3; ++i) {
    if (data.curve[i].is_straight) continue;
    const Vector a0 = unit(data.normal[i].cross(data.curve[i].start));
    const Vector a2 = unit(data.normal[next_corner(i)].cross(data.curve[i].end));
    if (a0.dot(a2) < -0.9) return true;
  }
  return false;
}

/// \brief How near a patch is to folding: the largest displacement in the plane of the triangle,
/// over the triangle's smallest altitude.
///
/// Empirical: no patch below the limit was seen to fold. It decides on shape, never on the bound.
constexpr double largest_fold = 0.35;
/// Below, only the normals at the corners are looked at.
constexpr double harmless_fold = 0.1;

inline double fold(const Control_net& net, const std::array<Vector, 3>& chord)
{
  const Vector normal = chord[0].cross(-chord[2]);
  const double area = normal.norm();
  const double longest = std::sqrt(
      (std::max)({chord[0].squaredNorm(), chord[1].squaredNorm(), chord[2].squaredNorm()}));
  const Vector n = unit(normal);
  double largest = 0;
  for (int k = 0; k < 15; ++k) {
    const Vector d = net.displacement.col(k);
    largest = (std::max)(largest, (d - d.dot(n) * n).squaredNorm());
  }
  return std::sqrt(largest) * longest / area;
}

/// Whether the patch turns its back on its triangle: at a corner, or at a point of a lattice.
inline bool is_turned(const Control_net& net, const Patch_data& data, double how_near)
{
  const Vector n = unit(data.chord[0].cross(-data.chord[2]));
  for (const Vector& normal : data.normal)
    if (!(normal.dot(n) > 0.05)) return true;
  if (how_near <= harmless_fold) return false;
  constexpr int density = 6;
  for (int i = 0; i <= density; ++i) {
    for (int j = 0; i + j <= density; ++j) {
      const double v = double(i) / density, w = double(j) / density;
      Jet jet;
      Patch_weights(Vector((std::max)(0., 1 - v - w), v, w)).first(net, jet);
      if (!((data.chord[0] + jet.v).cross(jet.w - data.chord[2]).dot(n) > 0)) return true;
    }
  }
  return false;
}

/// The guard as a whole. Written so that it refuses what is not a number.
inline bool may_fold(const Control_net& net, const Patch_data& data)
{
  const double how_near = fold(net, data.chord);
  return !(how_near <= largest_fold) || is_twisted(data) || is_turned(net, data, how_near);
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_FOLD_GUARD_H
