// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distance from a point to a triangle, from both sides: an upper bound from a point of the
// triangle, a lower bound from a plane that separates the two. Neither trusts how the point or the
// plane was found, so that needles and degenerate triangles cost sharpness, never soundness.
//
// Rounding. u = 2^-53; coordinates are at most 1 in magnitude (see Frame). Let A, B, C be the
// corners minus the point p, each coordinate rounded once, and R the largest magnitude of their
// coordinates.
//
// Upper bound. The closest point, seen from p, is a convex combination y of A, B, C, evaluated
// either as A + t (B - A) with 0 <= t <= 1, whose coordinates err by at most 2u |t (B - A)| + u R
// <= 5 u R, or as (r A + s B + t C) / (r + s + t) with r, s, t >= 0, by at most 6 u R (product, two
// sums, denominator 2, quotient). The rounding of A, B, C adds u R. The norm of an error of 7 u R a
// coordinate is at most sqrt(3) 7 u R < 12.2 u R. Squares, sums, root and the addition of the
// margin err by less than 4 u |y|, |y| <= sqrt(3) R: together below 19.2 u R.
//
// Lower bound. For any vector g, the triangle lies in the half-space {x: g.x >= min g.A, g.B, g.C},
// so that its distance from p is at least that minimum over |g|. The products err by at most
// 4 u |g|_1 R <= 4 sqrt(3) u |g| R; norm, quotient and the final subtraction by 5 u sqrt(3) R:
// together below 16 u R.
//
// The constant used is 24: it leaves room for terms of second order and one more addition.
// Underflow: a product errs by at most 2^-1075 absolutely. Squares of lengths thus err by less than
// 2^-1072, lengths by 2^-536; quotients are formed only with denominators above 2^-500. 2^-500
// covers all that.
#ifndef SURETY_INTERNAL_DISTANCE_POINT_TRIANGLE_H
#define SURETY_INTERNAL_DISTANCE_POINT_TRIANGLE_H

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace surety {
namespace internal {
namespace hausdorff {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Triangle = std::array<Point, 3>;

/// Half the distance from 1 to the next double.
constexpr double unit_roundoff = 0x1p-53;
/// Covers every underflow; far below the rounding error of any length that matters.
constexpr double underflow_margin = 0x1p-500;

/// A certified interval for a distance.
struct Bounds {
  double lower;
  double upper;
};

inline double largest_coordinate(const Vector& v)
{
  return (std::max)({std::abs(v.x()), std::abs(v.y()), std::abs(v.z())});
}

/// The corners of a triangle, seen from a point, and what their rounding may cost a length.
struct Relative_triangle {
  Relative_triangle(const Point& p, const Triangle& triangle)
    : a(triangle[0] - p),
      b(triangle[1] - p),
      c(triangle[2] - p),
      error(
          24 * unit_roundoff
              * (std::max)({largest_coordinate(a), largest_coordinate(b), largest_coordinate(c)})
          + underflow_margin)
  {}

  Vector a, b, c;
  double error;
};

/// The point of the segment ab closest to the origin, and its squared distance.
struct Segment_point {
  Segment_point(const Vector& a, const Vector& b)
  {
    const Vector ab = b - a;
    const double length = ab * ab, along = -(a * ab);
    const double t = along <= 0 ? 0 : along >= length ? 1 : along / length;
    offset = a + t * ab;
    squared = offset * offset;
  }

  Vector offset;
  double squared;
};

/// \brief The point of a triangle closest to the origin, and the normal of a separating plane.
///
/// Found in floating point: close to the best, not certainly the best.
struct Closest {
  explicit Closest(const Relative_triangle& t)
  {
    const Vector ab = t.b - t.a, ac = t.c - t.a;
    const Vector normal = CGAL::cross_product(ab, ac);
    // Barycentric coordinates of the projection, times the squared norm of the normal.
    const double ra = CGAL::cross_product(t.b, t.c) * normal;
    const double rb = CGAL::cross_product(t.c, t.a) * normal;
    const double rc = CGAL::cross_product(t.a, t.b) * normal;
    const double sum = ra + rb + rc;
    const bool inside = ra >= 0 && rb >= 0 && rc >= 0 && sum > underflow_margin;
    if (inside) {
      offset = (ra * t.a + rb * t.b + rc * t.c) / sum;
      squared = offset * offset;
      direction = t.a * normal < 0 ? -normal : normal;
      if (!is_thin(ab, ac, normal)) return;
    }
    // The projection on the plane of a needle is ill-conditioned: its edges may do better.
    const Segment_point first(t.a, t.b), second(t.b, t.c), third(t.c, t.a);
    const Segment_point& edge = first.squared <= second.squared
        ? (first.squared <= third.squared ? first : third)
        : (second.squared <= third.squared ? second : third);
    if (inside && squared <= edge.squared) return;
    offset = direction = edge.offset;
    squared = edge.squared;
  }

  Vector offset;
  Vector direction;
  double squared;

private:
  /// Whether the height is below a hundredth of the longer side at the first corner.
  static bool is_thin(const Vector& ab, const Vector& ac, const Vector& normal)
  {
    const double side = (std::max)(ab * ab, ac * ac);
    return normal * normal < 1e-4 * side * side;
  }
};

/// Lower bound of the distance from the origin to the triangle, from the plane normal to direction.
inline double separation(const Relative_triangle& t, const Vector& direction)
{
  const double squared = direction * direction;
  if (squared <= underflow_margin) return 0;
  const double least = (std::min)({direction * t.a, direction * t.b, direction * t.c});
  return (std::max)(0., least / std::sqrt(squared) - t.error);
}

inline double distance_upper_bound(const Point& p, const Triangle& triangle)
{
  const Relative_triangle t(p, triangle);
  return std::sqrt(Closest(t).squared) + t.error;
}

inline Bounds distance_bounds(const Point& p, const Triangle& triangle)
{
  const Relative_triangle t(p, triangle);
  const Closest closest(t);
  return {separation(t, closest.direction), std::sqrt(closest.squared) + t.error};
}

} // namespace hausdorff
} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_DISTANCE_POINT_TRIANGLE_H
