// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which vertices on feature edges are corners: where the curves end, branch or turn.
#ifndef SURETY_INTERNAL_FEATURES_CORNERS_H
#define SURETY_INTERNAL_FEATURES_CORNERS_H

#include <surety/internal/features/normals.h>

#include <CGAL/boost/graph/iterator.h>

#include <array>
#include <vector>

namespace surety {
namespace internal {

/// By how much the curve turns that passes a -> p -> b: 0 where it is straight, pi at a cusp.
inline double turn(const Vector& a, const Vector& p, const Vector& b)
{
  return angle_between(unit(p - a), unit(b - p));
}

/// Whether curves of feature edges end, branch, or turn by more than an angle (in radians) at v.
template <class Mesh, class Points, class Vertex>
bool is_corner(
    const Mesh& mesh, const Points& points, const std::vector<bool>& is_feature, Vertex v,
    double corner_angle)
{
  std::size_t number = 0;
  std::array<Vertex, 2> neighbour{};
  for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
    if (!is_feature[edge(h, mesh)]) continue;
    if (number < 2) neighbour[number] = source(h, mesh);
    ++number;
  }
  if (number != 2) return number > 0;
  const double angle = turn(
      to_vector(get(points, neighbour[0])), to_vector(get(points, v)),
      to_vector(get(points, neighbour[1])));
  return angle > corner_angle;
}

} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_FEATURES_CORNERS_H
