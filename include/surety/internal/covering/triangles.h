// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles that may cover a cell, and what a point knows of them.
#ifndef SURETY_INTERNAL_COVERING_TRIANGLES_H
#define SURETY_INTERNAL_COVERING_TRIANGLES_H

#include <surety/internal/deviation/closest_point.h>
#include <surety/internal/linear.h>

#include <array>
#include <cmath>
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

  void clear()
  {
    triangles_.clear();
    slabs_.clear();
  }
  void add(const Triangle& triangle)
  {
    if (triangles_.size() == most) return;
    triangles_.push_back(triangle);
    slabs_.emplace_back(triangle);
  }
  std::size_t size() const { return triangles_.size(); }
  const Triangle& operator[](std::size_t i) const { return triangles_[i]; }

  Nearness around(const Vector& p, double squared_limit) const
  {
    Nearness result;
    const double limit = std::sqrt(squared_limit) * (1 + 1e-9);
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < triangles_.size(); ++i) {
      if (slabs_[i].is_far(p, limit)) continue;
      const double d = triangles_[i].squared_distance(p);
      if (d <= squared_limit) result.within |= std::uint64_t(1) << i;
      if (d < least) {
        least = d;
        result.nearest = i;
      }
    }
    return result;
  }

private:
  /// The planes that bound a triangle: its own, and those through its edges and upright on it. Who
  /// is far from one of them, on its outer side, is as far from the triangle.
  struct Slab {
    explicit Slab(const Triangle& t) : normal(t.normal), height(t.normal.dot(t.a))
    {
      const auto corner = t.corners();
      for (int i = 0; i < 3; ++i) {
        outwards[i] = unit((corner[(i + 1) % 3] - corner[i]).cross(t.normal));
        reach[i] = outwards[i].dot(corner[i]);
      }
    }
    bool is_far(const Vector& p, double limit) const
    {
      return std::abs(normal.dot(p) - height) > limit || outwards[0].dot(p) - reach[0] > limit
          || outwards[1].dot(p) - reach[1] > limit || outwards[2].dot(p) - reach[2] > limit;
    }

    Vector normal;
    double height;
    std::array<Vector, 3> outwards;
    std::array<double, 3> reach;
  };

  std::vector<Triangle> triangles_;
  std::vector<Slab> slabs_;
};

} // namespace surety::internal::covering

#endif // SURETY_INTERNAL_COVERING_TRIANGLES_H
