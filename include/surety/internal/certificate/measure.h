// SPDX-License-Identifier: GPL-3.0-or-later
//
// Upper bounds, rounding included, of the distance from an item of T to its element of M.
//
// An item is the exact point x = s + lambda (t - s), all stored doubles (lambda = 0 for a vertex).
// A point of the element is y = p + v (q - p) + w (r - p) with computed, then exact, weights v, w
// >= 0 and v + w <= 1. *Any* such y gives an upper bound, so rounding in the choice of the weights
// costs tightness and never soundness. Remains the evaluation of
//   x - y = (s - p) + lambda (t - s) - v (q - p) - w (r - p),
// which is done with these four differences, not with coordinates: it is as accurate far from the
// origin as near it. Let e = 2^-52, which bounds the relative error of one operation in every
// rounding mode, and m the largest coordinate of a difference. In each coordinate, first order:
//   the four differences 1 + 1 + 1 + 1, of which the products carry their own and add 1 + 1 + 1,
//   (s - p) + lambda (t - s): 2;  v (q - p) + w (r - p): 1;  their difference: 3,
// that is 13 e m; the test v + w <= 1 is made in floating point, so the exact sum may reach 1 + e
// and y lie outside by e m: 14 e m. Second-order terms and the rounding of m itself do not reach
// 16 e m, or 16 sqrt(3) e m < 28 e m for the vector; we add 32 e m, and nothing where x and y are
// stored points.
//
// An inner item is the exact point x = a + lambda (b - a) + mu (c - a), and y a stored vertex:
//   x - y = (a - y) + lambda (b - a) + mu (c - a),
// with three differences. In each coordinate, first order, and with lambda + mu <= 1:
//   a - y: 1;  the two products, each with its difference: 2 lambda + 2 mu <= 2;
//   the sum of the first two terms, at most 2 m: 2;  that of all three, at most 2 m: 2,
// that is 7 e m. The test lambda + mu <= 1 is made in floating point, so the exact sum s may reach
// 1 + e. If it exceeds 1, the item stands for x' = a + (x - a) / s, a point of the triangle; as x -
// x' = (s - 1) (x' - a), this is e m more: 8 e m, and 32 e m for the vector is enough again.
// With y in an element as above, v (q - p) + w (r - p) adds 2 + 1, the difference of both 3, and
// the test v + w <= 1 another one: 14 e m, as above.
//
// The norm of a computed vector: 3 e relative (square 1, two sums 2, halved by the root, root 1,
// rounded up), then a sum and a product: 5 e < 8 e.
// Underflow: a product errs by at most 2^-1074, and by 2^-1022 where subnormals are flushed; nine
// of them below a root by less than 2^-508; we add 2^-500, unless x and y are the same stored
// point. Overflow gives an infinity or a NaN, which no tolerance admits.
#ifndef SURETY_INTERNAL_CERTIFICATE_MEASURE_H
#define SURETY_INTERNAL_CERTIFICATE_MEASURE_H

#include <surety/internal/certificate/triangle_table.h>

#include <algorithm>
#include <cmath>

namespace surety::internal::checker {

/// The exact point start + lambda (end - start).
struct Place {
  Point start, end;
  double lambda = 0;
};

inline Point difference(const Point& a, const Point& b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double dot(const Point& a, const Point& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Point cross(const Point& a, const Point& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double largest_coordinate(const Point& a)
{
  return (std::max)({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

/// From a computed difference of two points and the absolute error of its length.
inline double rounded_up_length(const Point& d, double error)
{
  return (std::sqrt(dot(d, d)) + (error + 0x1p-500)) * (1 + 0x1p-49);
}

inline double distance_to_vertex(const Point& x, const Point& y)
{
  return x == y ? 0 : rounded_up_length(difference(x, y), 0);
}

/// The exact point a + lambda (b - a) + mu (c - a) of a triangle with the corners a, b, c.
struct Inner_place {
  std::array<Point, 3> corners;
  double lambda = 0, mu = 0;
};

/// The offset of a place from the origin p of an element, and the m of the comment above.
struct Offset {
  Point vector;
  double magnitude;

  Offset(const Place& x, const Point& p) : vector(difference(x.start, p))
  {
    const Point along = difference(x.end, x.start);
    magnitude = (std::max)(largest_coordinate(vector), largest_coordinate(along));
    for (int i = 0; i < 3; ++i) vector[i] += x.lambda * along[i];
  }
  Offset(const Inner_place& x, const Point& p)
  {
    const auto& [a, b, c] = x.corners;
    const Point offset = difference(a, p), first = difference(b, a), second = difference(c, a);
    magnitude = (std::max)(
        {largest_coordinate(offset), largest_coordinate(first), largest_coordinate(second)});
    for (int i = 0; i < 3; ++i) vector[i] = offset[i] + x.lambda * first[i] + x.mu * second[i];
  }
};

/// The bound for y = v first + w second, relative to the origin of the element.
inline double distance_to_combination(
    const Offset& x, const Point& first, double v, const Point& second, double w)
{
  const double m = (std::max)({x.magnitude, largest_coordinate(first), largest_coordinate(second)});
  Point d;
  for (int i = 0; i < 3; ++i) d[i] = x.vector[i] - (v * first[i] + w * second[i]);
  return rounded_up_length(d, 0x1p-47 * m);
}

inline double distance_to_vertex(const Inner_place& x, const Point& y)
{
  const Offset offset(x, y);
  return rounded_up_length(offset.vector, 0x1p-47 * offset.magnitude);
}

/// \tparam Any a `Place` or an `Inner_place`
template <class Any>
double distance_to_segment(const Any& x, const Point& p, const Point& q)
{
  const Offset offset(x, p);
  const Point along = difference(q, p);
  const double v = dot(offset.vector, along) / dot(along, along);
  const double inside = v > 0 ? (std::min)(v, 1.0) : 0.0; // and 0 for NaN
  return distance_to_combination(offset, along, inside, {0, 0, 0}, 0);
}

template <class Any>
double distance_to_triangle(const Any& x, const Point& p, const Point& q, const Point& r)
{
  const double nearest_side = (std::min)(
      {distance_to_segment(x, p, q), distance_to_segment(x, q, r), distance_to_segment(x, r, p)});
  const Offset offset(x, p);
  const Point first = difference(q, p), second = difference(r, p);
  const Point normal = cross(first, second);
  const double area = dot(normal, normal);
  const double v = dot(cross(offset.vector, second), normal) / area;
  const double w = dot(cross(first, offset.vector), normal) / area;
  if (!(v >= 0 && w >= 0 && v + w <= 1)) return nearest_side;
  return (std::min)(nearest_side, distance_to_combination(offset, first, v, second, w));
}

/// A power of two that keeps products of four lengths from over- and underflow when a mesh is very
/// large or very small; 1, so that messages show the user's own lengths, for all others.
inline double scale_of_products(const Triangle_table& mesh)
{
  double largest = 0;
  for (Index v = 0; v < mesh.number_of_vertices(); ++v)
    for (const double c : mesh.point(v)) largest = (std::max)(largest, std::abs(c));
  int exponent = 0;
  if (std::isfinite(largest)) std::frexp(largest, &exponent);
  return std::abs(exponent) < 150 ? 1.0 : std::ldexp(1.0, -exponent);
}

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_MEASURE_H
