// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tangent and curvature of the curves that feature edges form.
#ifndef SURETY_INTERNAL_CURVATURE_CURVE_H
#define SURETY_INTERNAL_CURVATURE_CURVE_H

#include <surety/curvature_field.h>
#include <surety/features.h>
#include <surety/internal/curvature/side_graph.h>

#include <CGAL/boost/graph/iterator.h>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace surety::internal::curvature {

/// The neighbours of each vertex along its curve; `none` off the curves and at corners.
class Feature_curves
{
public:
  template <class Mesh>
  Feature_curves(const Mesh& mesh, const Features& features)
    : neighbours_(num_vertices(mesh), {none, none})
  {
    std::vector<Index> number(num_vertices(mesh), 0);
    for (const auto e : edges(mesh)) {
      if (!features.edge[e]) continue;
      add(number, source(e, mesh), target(e, mesh));
      add(number, target(e, mesh), source(e, mesh));
    }
    for (Index v = 0; v < number.size(); ++v) {
      if (number[v] != 2 || features.corner[v]) neighbours_[v] = {none, none};
    }
  }

  bool has(Index v) const { return neighbours_[v][0] != none; }

  /// The vertices along the curve on one side of v, at most `number`, a corner as the last. A
  /// closed curve is followed half round at most: the two sides stay disjoint.
  std::vector<Index> walk(Index v, int side, int number) const
  {
    std::vector<Index> path;
    Index previous = v, current = neighbours_[v][std::size_t(side)];
    Index ahead = v, ahead_of = neighbours_[v][std::size_t(1 - side)];
    while (int(path.size()) < number) {
      path.push_back(current);
      // The other side walks as fast: stop where the two meet.
      if (current == ahead_of || !has(current)) break;
      step(previous, current);
      if (current == ahead_of) break;
      if (has(ahead_of)) step(ahead, ahead_of);
    }
    return path;
  }

private:
  template <class Vertex>
  void add(std::vector<Index>& number, Vertex v, Vertex other)
  {
    if (number[v] < 2) neighbours_[v][number[v]] = static_cast<Index>(other);
    ++number[v];
  }

  void step(Index& previous, Index& current) const
  {
    const auto& n = neighbours_[current];
    const Index next = n[0] == previous ? n[1] : n[0];
    previous = current;
    current = next;
  }

  std::vector<std::array<Index, 2>> neighbours_;
};

/// \brief Fits a space curve over the length along the polygon, through the vertex.
///
/// A cubic over three vertices a side, weighted by the inverse of the length, a quadratic where
/// corners leave fewer. The length along the polygon falls short of that of the curve by a third-
/// order term, which moves points along the tangent only and leaves the curvature of second order.
inline Curve_curvature fit_curve(const Side_graph& graph, const Feature_curves& curves, Index v)
{
  constexpr int reach = 3;
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 2 * reach, 3> powers(2 * reach, 3),
      points(2 * reach, 3);
  int number = 0;
  double unit_length = 0;
  for (const int side : {0, 1}) {
    double length = 0;
    Vector last = graph.point[v];
    for (const Index w : curves.walk(v, side, reach)) {
      length += (graph.point[w] - last).norm();
      last = graph.point[w];
      if (unit_length == 0) unit_length = length;
      if (!(length > 0)) continue;
      const double s = (side == 0 ? -length : length) / unit_length, weight = 1 / std::abs(s);
      powers.row(number) << weight * s, weight * s * s, weight * s * s * s;
      points.row(number) = weight * (last - graph.point[v]).transpose() / unit_length;
      ++number;
    }
  }
  Curve_curvature result;
  if (number < 2) return result;
  const int terms = number > 4 ? 3 : 2;
  using Powers = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * reach, 3>;
  const Powers system = powers.topLeftCorner(number, terms);
  const Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> x
      = system.colPivHouseholderQr().solve(points.topRows(number));
  const Vector first = x.row(0), second = 2 * x.row(1);
  const double speed = first.norm();
  if (!(speed > 0) || !x.allFinite()) return result;
  result.tangent = first / speed;
  const double curvature = first.cross(second).norm() / (speed * speed * speed);
  const double scaled = std::ldexp(curvature / unit_length, -graph.exponent);
  result.curvature = (std::min)(scaled, std::numeric_limits<double>::max());
  return result;
}

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_CURVE_H
