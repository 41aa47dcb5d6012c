// SPDX-License-Identifier: GPL-3.0-or-later
//
// Convex pieces of a triangle, and how they are cut in two. Distance to a triangle is a convex
// function, so that a piece whose corners all lie within a distance of one triangle does so whole.
//
// Soundness. Cuts are combinatorial. A corner stands for an exact point of the original triangle:
// a vertex, or (1 - t) x + t y on the segment between the exact points x, y of two earlier corners,
// t a double. A cut follows the chord between two points of the boundary of a convex polygon, so
// the exact pieces cover the triangle whatever the rounding of s, t and the stored points. `error`
// bounds the distance from the stored to the exact point: a convex combination keeps the larger
// error of its ends; x + t (y - x) errs by at most u (2 |y - x| + |result|) a coordinate.
#ifndef SURETY_INTERNAL_DISTANCE_CELL_H
#define SURETY_INTERNAL_DISTANCE_CELL_H

#include <surety/internal/distance/point_triangle.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace surety {
namespace internal {
namespace hausdorff {

/// A corner of cells, and a face of the other mesh: the nearest one if `is_located`.
struct Corner {
  Point point;
  double error = 0; ///< zero for a vertex of the mesh
  /// Bound of the distance from the exact point to the face, infinite if not measured.
  double upper = std::numeric_limits<double>::infinity();
  std::uint32_t face = 0;
  bool is_located = false;
};

/// A convex polygon with a bounded number of corners, in cyclic order, numbers in a pool.
class Cell
{
public:
  static constexpr int capacity = 16;
  /// A cut adds at most one corner; larger cells are cut along a chord between two corners.
  static constexpr int comfortable = 12;

  int size() const { return size_; }
  std::uint32_t operator[](int i) const { return corners_[i]; }
  int after(int i) const { return i + 1 < size_ ? i + 1 : 0; }
  void push_back(std::uint32_t corner)
  {
    CGAL_assertion(size_ < capacity);
    corners_[size_++] = corner;
  }

  double bound = 0;       ///< upper bound of the distance of all its points
  std::uint32_t hint = 0; ///< a face that may be close to all of it
  int depth = 0;          ///< number of cuts that led to it

private:
  std::array<std::uint32_t, capacity> corners_;
  int size_ = 0;
};

/// Values of an affine function at the corners of a cell.
using Cell_values = std::array<double, Cell::capacity>;

/// The point where an affine function vanishes between two corners of opposite signs.
inline Corner corner_between(const Corner& x, const Corner& y, double value_x, double value_y)
{
  const double t = (std::min)(1., (std::max)(0., value_x / (value_x - value_y)));
  const Vector xy = y.point - x.point;
  Corner result;
  result.point = x.point + t * xy;
  const double size = 2 * largest_coordinate(xy) + largest_coordinate(result.point - CGAL::ORIGIN);
  // 2 > sqrt(3) covers the norm, and the rounding of this line itself.
  result.error = (std::max)(x.error, y.error) + 2 * unit_roundoff * size + underflow_margin;
  return result;
}

/// Whether the signs change exactly twice round the cell, as those of an affine function do.
inline bool is_proper_cut(const Cell& cell, const Cell_values& values)
{
  int changes = 0, last = 0, first = 0;
  for (int i = 0; i < cell.size(); ++i) {
    const int sign = (values[i] > 0) - (values[i] < 0);
    if (sign == 0) continue;
    if (first == 0) first = sign;
    changes += last != 0 && sign != last;
    last = sign;
  }
  changes += last != first;
  return changes == 2;
}

/// \brief Cuts a cell where the values vanish; corners of value zero go to both pieces.
///
/// \pre `is_proper_cut(cell, values)`: then each piece contains the part of the cell on its side of
/// the chord, whatever the values.
inline std::pair<Cell, Cell> cut(
    const Cell& cell, const Cell_values& values, std::vector<Corner>& pool)
{
  std::pair<Cell, Cell> pieces;
  pieces.first.bound = pieces.second.bound = cell.bound;
  pieces.first.hint = pieces.second.hint = cell.hint;
  pieces.first.depth = pieces.second.depth = cell.depth + 1;
  for (int i = 0; i < cell.size(); ++i) {
    if (values[i] <= 0) pieces.first.push_back(cell[i]);
    if (values[i] >= 0) pieces.second.push_back(cell[i]);
    const int j = cell.after(i);
    if ((values[i] < 0 && values[j] > 0) || (values[i] > 0 && values[j] < 0)) {
      const auto crossing = static_cast<std::uint32_t>(pool.size());
      pool.push_back(corner_between(pool[cell[i]], pool[cell[j]], values[i], values[j]));
      pieces.first.push_back(crossing);
      pieces.second.push_back(crossing);
    }
  }
  return pieces;
}

/// Values that cut a cell of four or more corners along the chord between two of them.
inline Cell_values chord_values(const Cell& cell)
{
  Cell_values values;
  const int half = cell.size() / 2;
  for (int i = 0; i < cell.size(); ++i) values[i] = i == 0 || i == half ? 0 : i < half ? -1 : 1;
  return values;
}

} // namespace hausdorff
} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_DISTANCE_CELL_H
