// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances from points to triangles in exact rational arithmetic, over all triangles: slow, and
// the last word.
#ifndef SURETY_TEST_EXACT_DISTANCE_H
#define SURETY_TEST_EXACT_DISTANCE_H

#include "meshes.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace surety::test {

using Rational = CGAL::Exact_rational;
using Exact = CGAL::Simple_cartesian<Rational>;
using Exact_point = Exact::Point_3;
using Exact_vector = Exact::Vector_3;
using Exact_triangle = std::array<Exact_point, 3>;

inline double largest_coordinate(const Mesh& mesh)
{
  double result = 0;
  for (const Vertex v : mesh.vertices()) {
    for (int i = 0; i < 3; ++i) result = (std::max)(result, std::abs(mesh.point(v)[i]));
  }
  return result;
}

inline Rational squared_distance_to_segment(
    const Exact_point& p, const Exact_point& a, const Exact_point& b)
{
  const Exact_vector ab = b - a, ap = p - a;
  const Rational length = ab * ab, along = ap * ab;
  if (along <= 0) return ap * ap;
  if (along >= length) return (p - b) * (p - b);
  return ap * ap - along * along / length;
}

inline Rational squared_distance_to_triangle(const Exact_point& p, const Exact_triangle& t)
{
  const Exact_vector n = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  const Rational area = n * n;
  bool is_inside = area > 0;
  for (int i = 0; i < 3 && is_inside; ++i) {
    const Exact_vector side = t[(i + 1) % 3] - t[i];
    is_inside = CGAL::cross_product(side, p - t[i]) * n >= 0;
  }
  if (is_inside) {
    const Rational height = n * (p - t[0]);
    return height * height / area;
  }
  Rational best = squared_distance_to_segment(p, t[0], t[1]);
  best = (std::min)(best, squared_distance_to_segment(p, t[1], t[2]));
  return (std::min)(best, squared_distance_to_segment(p, t[2], t[0]));
}

/// The triangles of a mesh, or one of them.
class Exact_triangles
{
public:
  explicit Exact_triangles(const Mesh& mesh)
  {
    for (const Face f : mesh.faces()) triangles_.push_back(triangle(mesh, f));
  }

  /// The face at a position of the iteration order.
  Exact_triangles(const Mesh& mesh, std::size_t position)
    : triangles_{triangle(mesh, *std::next(mesh.faces().begin(), std::ptrdiff_t(position)))}
  {}

  Rational squared_distance(const Exact_point& p) const
  {
    Rational best = squared_distance_to_triangle(p, triangles_.front());
    for (const Exact_triangle& t : triangles_) {
      best = (std::min)(best, squared_distance_to_triangle(p, t));
    }
    return best;
  }

  bool has_point_within(double distance, const Exact_point& p) const
  {
    const Rational limit = Rational(distance) * Rational(distance);
    return std::any_of(triangles_.begin(), triangles_.end(), [&](const Exact_triangle& t) {
      return squared_distance_to_triangle(p, t) <= limit;
    });
  }
  bool has_point_within(double distance, const std::array<double, 3>& p) const
  {
    return has_point_within(distance, exact(p));
  }

  bool are_no_closer_than(double distance, const std::array<double, 3>& p) const
  {
    return squared_distance(exact(p)) >= Rational(distance) * Rational(distance);
  }

  /// A point that lies exactly on a triangle.
  Exact_point random_point(Random& random) const
  {
    const Exact_triangle& t = triangles_[random.below(triangles_.size())];
    double s = random.unit(), r = random.unit();
    if (s + r > 1) s = 1 - s, r = 1 - r;
    return t[0] + Rational(s) * (t[1] - t[0]) + Rational(r) * (t[2] - t[0]);
  }

private:
  static Exact_point exact(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

  static Exact_triangle triangle(const Mesh& mesh, Face f)
  {
    const auto h = mesh.halfedge(f);
    Exact_triangle result;
    int i = 0;
    for (const Vertex v : mesh.vertices_around_face(h)) {
      const Point& p = mesh.point(v);
      result[i++] = Exact_point(p.x(), p.y(), p.z());
    }
    return result;
  }

  std::vector<Exact_triangle> triangles_;
};

} // namespace surety::test

#endif // SURETY_TEST_EXACT_DISTANCE_H
