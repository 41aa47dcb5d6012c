// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles of a mesh as a flat array, in coordinates that suit floating point: moved near the
// origin and scaled to size one, both without rounding.
#ifndef SURETY_INTERNAL_DISTANCE_TRIANGLE_SET_H
#define SURETY_INTERNAL_DISTANCE_TRIANGLE_SET_H

#include <surety/internal/distance/point_triangle.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace surety {
namespace internal {
namespace hausdorff {

using Coordinates = std::array<double, 3>;

/// The vertices and faces of a mesh, in the order of iteration; vertices without a face left out.
struct Soup {
  std::vector<Coordinates> points;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

/// \brief The change of coordinates shared by two meshes: x -> (x - shift) 2^-exponent.
///
/// A coordinate moves only if all its values lie within a factor of two, where the subtraction is
/// exact (Sterbenz); elsewhere the extent is at least half the largest magnitude and moving gains
/// nothing. Scaling by a power of two is exact but for underflow, far below any margin. So local
/// coordinates are below 1 in magnitude, and results scale exactly with the input.
class Frame
{
public:
  Frame(const Soup& first, const Soup& second)
  {
    double magnitude = 0, largest_moved = 0;
    for (int i = 0; i < 3; ++i) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Soup* soup : {&first, &second}) {
        for (const Coordinates& p : soup->points) {
          low = (std::min)(low, p[i]);
          high = (std::max)(high, p[i]);
        }
      }
      if (low > 0 && high / 2 <= low) shift_[i] = low;
      if (high < 0 && low / 2 >= high) shift_[i] = high;
      magnitude = (std::max)({magnitude, std::abs(low - shift_[i]), std::abs(high - shift_[i])});
      if (shift_[i] != 0) {
        largest_moved = (std::max)({largest_moved, std::abs(low), std::abs(high)});
      }
    }
    if (magnitude > 0) std::frexp(magnitude, &exponent_);
    rounding_ = to_local(
        2 * unit_roundoff * largest_moved + 2 * std::numeric_limits<double>::denorm_min());
  }

  Point to_local(const Coordinates& p) const
  {
    return Point(local(p[0], 0), local(p[1], 1), local(p[2], 2));
  }

  double to_local(double length) const { return std::ldexp(length, -exponent_); }

  /// Exact for the vertices of the meshes; other points are rounded by at most `rounding()`.
  Coordinates to_mesh(const Point& p) const
  {
    return {mesh(p.x(), 0), mesh(p.y(), 1), mesh(p.z(), 2)};
  }

  /// How far a point may move when its coordinates are rounded to those of the meshes: half a unit
  /// in the last place of each coordinate that was shifted. A local length.
  double rounding() const { return rounding_; }

  /// Rounded upwards where the result is subnormal, elsewhere exact.
  double upper_to_mesh(double length) const
  {
    const double result = std::ldexp(length, exponent_);
    if (is_exact(length, result)) return result;
    return std::nextafter(result, std::numeric_limits<double>::infinity());
  }

  /// Rounded downwards where the result is subnormal, elsewhere exact.
  double lower_to_mesh(double length) const
  {
    const double result = std::ldexp(length, exponent_);
    return is_exact(length, result) ? result : std::nextafter(result, 0.);
  }

private:
  double local(double x, int i) const { return std::ldexp(x - shift_[i], -exponent_); }
  double mesh(double x, int i) const { return std::ldexp(x, exponent_) + shift_[i]; }

  static bool is_exact(double length, double scaled)
  {
    return length == 0 || scaled >= (std::numeric_limits<double>::min)();
  }

  Coordinates shift_ = {0, 0, 0};
  int exponent_ = 0;
  double rounding_ = 0;
};

/// A soup in local coordinates.
class Triangle_set
{
public:
  Triangle_set(const Soup& soup, const Frame& frame) : faces_(soup.faces)
  {
    points_.reserve(soup.points.size());
    for (const Coordinates& p : soup.points) points_.push_back(frame.to_local(p));
    triangles_.reserve(faces_.size());
    for (const auto& f : faces_) {
      triangles_.push_back({points_[f[0]], points_[f[1]], points_[f[2]]});
    }
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(faces_.size()); }
  std::uint32_t number_of_points() const { return static_cast<std::uint32_t>(points_.size()); }
  const Point& point(std::uint32_t vertex) const { return points_[vertex]; }
  const std::array<std::uint32_t, 3>& face(std::uint32_t f) const { return faces_[f]; }
  const Triangle& triangle(std::uint32_t f) const { return triangles_[f]; }

private:
  std::vector<Point> points_;
  std::vector<std::array<std::uint32_t, 3>> faces_;
  std::vector<Triangle> triangles_;
};

} // namespace hausdorff
} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_DISTANCE_TRIANGLE_SET_H
