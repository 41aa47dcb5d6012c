// SPDX-License-Identifier: GPL-3.0-or-later
//
// Measures of one triangle: its shape Q, its area and its angles.
#ifndef SURETY_INTERNAL_STATISTICS_TRIANGLE_H
#define SURETY_INTERNAL_STATISTICS_TRIANGLE_H

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace surety {
namespace internal {

/// The side lengths of a triangle, and its area in units of the square of the longest one. Keeping
/// that square out of the way lets every length work whose own square is a double.
struct Triangle_sides {
  std::array<double, 3> length; ///< pq, qr, rp
  double longest;
  double relative_area;
};

template <class Point>
Triangle_sides triangle_sides(const Point& p, const Point& q, const Point& r)
{
  const auto vector = [](const Point& a, const Point& b) {
    return std::array<double, 3>{
        CGAL::to_double(b.x()) - CGAL::to_double(a.x()),
        CGAL::to_double(b.y()) - CGAL::to_double(a.y()),
        CGAL::to_double(b.z()) - CGAL::to_double(a.z())};
  };
  const auto norm = [](double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); };

  const std::array<std::array<double, 3>, 3> side = {vector(p, q), vector(q, r), vector(r, p)};
  Triangle_sides sides;
  for (int i = 0; i < 3; ++i) sides.length[i] = norm(side[i][0], side[i][1], side[i][2]);

  // The two shorter sides give the area with the least cancellation.
  const int long_side = static_cast<int>(
      std::max_element(sides.length.begin(), sides.length.end()) - sides.length.begin());
  sides.longest = sides.length[long_side];
  std::array<double, 3> u = side[(long_side + 1) % 3], v = side[(long_side + 2) % 3];
  for (int i = 0; i < 3; ++i) {
    u[i] /= sides.longest;
    v[i] /= sides.longest;
  }
  sides.relative_area
      = 0.5 * norm(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  return sides;
}

/// Q = sqrt(3)/6 h_max / inradius, with inradius = 2 area / perimeter.
inline double quality(const Triangle_sides& sides)
{
  if (!(sides.relative_area > 0)) return std::numeric_limits<double>::infinity();
  const double perimeter = (sides.length[0] + sides.length[1] + sides.length[2]) / sides.longest;
  return std::sqrt(3.0) / 12 * perimeter / sides.relative_area;
}

inline double area(const Triangle_sides& sides)
{
  return sides.longest > 0 ? sides.relative_area * sides.longest * sides.longest : 0;
}

/// The three angles in degrees, opposite the sides qr, rp and pq. A side of length zero faces the
/// angle 0; the others of a flat triangle are 0 and 180.
inline std::array<double, 3> angles(const Triangle_sides& sides)
{
  std::array<double, 3> result{};
  if (!(sides.longest > 0)) return result;
  const std::array<double, 3> l
      = {sides.length[0] / sides.longest, sides.length[1] / sides.longest,
         sides.length[2] / sides.longest};
  for (int i = 0; i < 3; ++i) {
    const double a = l[(i + 1) % 3], b = l[i], c = l[(i + 2) % 3];
    // tan = 4 area / (b^2 + c^2 - a^2): accurate for needles and caps, where an arc cosine is not.
    constexpr double degrees = 180 / 3.14159265358979323846;
    result[i] = degrees * std::atan2(4 * sides.relative_area, (b - a) * (b + a) + c * c);
  }
  return result;
}

} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_STATISTICS_TRIANGLE_H
