// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles that may cover a cell, and what a point knows of them.
#ifndef SURETY_INTERNAL_COVERING_TRIANGLES_H
#define SURETY_INTERNAL_COVERING_TRIANGLES_H

#include <surety/internal/deviation/closest_point.h>
#include <surety/internal/linear.h>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace surety::internal::covering {

/// A triangle a, a + ab, a + ac.
struct Triangle {
  Triangle() = default;
  Triangle(const Vector& p, const Vector& q, const Vector& r, Index name)
    : a(p), ab(q - p), ac(r - p), normal(unit(ab.cross(ac))), face(name)
  {}

  double squared_distance(const Vector& p) const
  {
    return squared_distance_to_triangle(p, a, ab, ac);
  }
  std::array<Vector, 3> corners() const { return {a, a + ab, a + ac}; }

  Vector a, ab, ac, normal;
  Index face = none;
};

/// Which of up to 64 candidates are within the tolerance of a point, and which one is nearest.
struct Nearness {
  std::uint64_t within = 0;
  Index nearest = none;
};

/// Candidates to cover a cell. What comes after the first 64 is left out: fewer candidates make
/// fewer cells coverable, and none wrongly so.
class Candidates
{
public:
  static constexpr std::size_t most = 64;

  void clear() { triangles_.clear(); }
  void add(const Triangle& triangle)
  {
    if (triangles_.size() < most) triangles_.push_back(triangle);
  }
  std::size_t size() const { return triangles_.size(); }
  const Triangle& operator[](std::size_t i) const { return triangles_[i]; }

  Nearness around(const Vector& p, double squared_limit) const
  {
    Nearness result;
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < triangles_.size(); ++i) {
      const Triangle& t = triangles_[i];
      // Triangles whose planes are far are not within, and they are not nearest where others are.
      const double height = t.normal.dot(p - t.a);
      if (height * height > squared_limit * (1 + 1e-9) && height * height > least) continue;
      const double d = t.squared_distance(p);
      if (d <= squared_limit) result.within |= std::uint64_t(1) << i;
      if (d < least) {
        least = d;
        result.nearest = i;
      }
    }
    return result;
  }

private:
  std::vector<Triangle> triangles_;
};

} // namespace surety::internal::covering

#endif // SURETY_INTERNAL_COVERING_TRIANGLES_H
