// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tangent plane of each side and the tangent of each feature curve, from the mesh alone.
#ifndef SURETY_INTERNAL_METRIC_FRAMES_H
#define SURETY_INTERNAL_METRIC_FRAMES_H

#include <surety/features.h>
#include <surety/internal/linear.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace surety::internal::metric {

/// Whether different sides of a vertex, or the border, lie to the left and right of a halfedge.
template <class Mesh, class Halfedge>
bool separates_sides(const Mesh& mesh, const Sides& sides, Halfedge h)
{
  const Halfedge o = opposite(h, mesh);
  if (CGAL::is_border(h, mesh) || CGAL::is_border(o, mesh)) return true;
  return sides.of_corner[h] != sides.of_corner[prev(o, mesh)]
      || sides.of_corner[o] != sides.of_corner[prev(h, mesh)];
}

/// The sum of vectors, the same to the last bit whatever their order.
inline Vector sum_in_any_order(std::vector<Vector>& terms)
{
  std::sort(terms.begin(), terms.end(), [](const Vector& a, const Vector& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  Vector sum = Vector::Zero();
  for (const Vector& term : terms) sum += term;
  return sum;
}

/// \brief One unit normal a side: the mean of the normals of its faces with weights that are exact
/// on spheres (N. Max, *Weights for computing vertex normals from facet normals*, 1999).
template <class Mesh, class Points>
std::vector<Vector> side_normals(const Mesh& mesh, const Sides& sides, const Points& points)
{
  std::vector<Vector> normals(sides.size(), Vector::Zero());
  std::vector<Vector> terms;
  for (const auto v : vertices(mesh)) {
    const Vector p = to_vector(get(points, v));
    for (std::uint32_t s = sides.first[v]; s < sides.first[v + 1]; ++s) {
      terms.clear();
      for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
        if (sides.of_corner[h] != s) continue;
        const Vector a = to_vector(get(points, target(next(h, mesh), mesh))) - p;
        const Vector b = to_vector(get(points, source(h, mesh))) - p;
        terms.push_back((a / a.squaredNorm()).cross(b / b.squaredNorm()));
      }
      // Lengths of edges appear to the power -2: in the unit of the longest, nothing underflows.
      double largest = 0;
      for (const Vector& term : terms) largest = (std::max)(largest, term.cwiseAbs().maxCoeff());
      if (!(largest > 0)) continue;
      for (Vector& term : terms) term /= largest;
      normals[s] = unit(sum_in_any_order(terms));
    }
  }
  for (Vector& n : normals) {
    // Faces that cancel leave no normal; any frame is as good as another there.
    if (n.isZero(0)) n = Vector::UnitZ();
  }
  return normals;
}

/// \brief The unit tangents of the curves between sides, by vertex; zero where there is no curve,
/// and where a number of them meet that is not two.
template <class Mesh, class Points>
std::vector<Vector> curve_tangents(const Mesh& mesh, const Sides& sides, const Points& points)
{
  std::vector<Vector> tangents(num_vertices(mesh), Vector::Zero());
  std::vector<Vector> ways;
  for (const auto v : vertices(mesh)) {
    ways.clear();
    const Vector p = to_vector(get(points, v));
    for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
      if (!separates_sides(mesh, sides, h)) continue;
      ways.push_back(unit(to_vector(get(points, source(h, mesh))) - p));
    }
    if (ways.size() == 2) tangents[v] = unit(ways[0] - ways[1]);
  }
  return tangents;
}

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_FRAMES_H
