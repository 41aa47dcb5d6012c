// SPDX-License-Identifier: GPL-3.0-or-later
//
// A jet seen from another point: at the edge of a side the fit of a neighbour inside tells more
// than one whose samples all lie on one hand.
#ifndef SURETY_INTERNAL_CURVATURE_SHIFTED_H
#define SURETY_INTERNAL_CURVATURE_SHIFTED_H

#include <surety/internal/curvature/jet.h>
#include <surety/internal/curvature/side_graph.h>

#include <array>
#include <cstddef>
#include <limits>

namespace surety::internal::curvature {

/// \brief The jet of the same polynomial about the point (x, y): its Taylor expansion there.
///
/// The variances remain those at the first point.
inline Jet shifted(const Jet& jet, double x, double y)
{
  // The powers of x and y in the terms, in the order of the coefficients.
  constexpr std::array<int, Jet::quartic> in_x = {1, 0, 2, 1, 0, 3, 2, 1, 0, 4, 3, 2, 1, 0};
  constexpr std::array<int, Jet::quartic> in_y = {0, 1, 0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 3, 4};
  constexpr double binomial[5][5]
      = {{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};
  std::array<double, 5> px{1}, py{1};
  for (std::size_t i = 1; i < 5; ++i) {
    px[i] = x * px[i - 1];
    py[i] = y * py[i - 1];
  }
  Jet result = jet;
  for (std::size_t to = 0; to < std::size_t(Jet::quartic); ++to) {
    result.coefficient[to] = 0;
    for (std::size_t from = to; from < std::size_t(Jet::quartic); ++from) {
      const int i = in_x[from] - in_x[to], j = in_y[from] - in_y[to];
      if (i < 0 || j < 0) continue;
      result.coefficient[to] += jet.coefficient[from] * binomial[in_x[from]][in_x[to]]
          * binomial[in_y[from]][in_y[to]] * px[std::size_t(i)] * py[std::size_t(j)];
    }
  }
  return result;
}

/// \brief The nearest neighbour of a side that features and borders do not bound; none if all are
/// bounded.
///
/// Neighbours nearer than half the mean edge hardly lie inside: they count only if there is no
/// other.
inline Index inner_neighbour(const Side_graph& graph, Index side, double mean_edge)
{
  constexpr double smallest_cosine = 0.5;
  Index best = Sides::no_side;
  double least = std::numeric_limits<double>::infinity();
  for (Index i = graph.first[side]; i < graph.first[side + 1]; ++i) {
    const Index other = graph.neighbour[i];
    if (other == Sides::no_side || !graph.is_closed[other] || graph.is_ridge_end[other]) continue;
    if (!(graph.normal[other].dot(graph.normal[side]) >= smallest_cosine)) continue;
    const double distance = (graph.point_of(other) - graph.point_of(side)).norm();
    // Those that are near come last, the farthest of them first.
    const double rank
        = distance < mean_edge / 2 ? 1e6 - distance / mean_edge : distance / mean_edge;
    if (rank < least || (rank == least && other < best)) {
      least = rank;
      best = other;
    }
  }
  return best;
}

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_SHIFTED_H
