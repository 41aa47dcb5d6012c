// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order of points along the Morton curve. Half of the time of a large simplification would go
// into cache misses without it.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_SPACE_FILLING_ORDER_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_SPACE_FILLING_ORDER_H

#include <surety/internal/linear.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace surety::internal {

/// 21 bits of a number in [0, 1], with two zeros after each.
inline std::uint64_t spread_bits(double x)
{
  auto bits = static_cast<std::uint64_t>(std::clamp(x, 0.0, 1.0) * 2097151.0) & 0x1fffff;
  bits = (bits | bits << 32) & 0x1f00000000ffff;
  bits = (bits | bits << 16) & 0x1f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

/// The positions of the points, sorted along the curve; equal places keep their order.
inline std::vector<Index> space_filling_order(const std::vector<Vector>& points)
{
  Vector low = points.front(), high = points.front();
  for (const Vector& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double extent = (high - low).maxCoeff();

  std::vector<std::pair<std::uint64_t, Index>> order(points.size());
  for (Index i = 0; i < points.size(); ++i) {
    const Vector place = (points[i] - low) / extent;
    order[i]
        = {spread_bits(place.x()) | spread_bits(place.y()) << 1 | spread_bits(place.z()) << 2, i};
  }
  std::sort(order.begin(), order.end());

  std::vector<Index> result;
  result.reserve(order.size());
  for (const auto& entry : order) result.push_back(entry.second);
  return result;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_SPACE_FILLING_ORDER_H
