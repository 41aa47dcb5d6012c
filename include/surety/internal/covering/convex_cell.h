// SPDX-License-Identifier: GPL-3.0-or-later
//
// A convex cell of a triangle, and its division by a straight cut.
//
// Cells are exact: a new corner is the point a + lambda (b - a) of an edge of the cell, lambda a
// stored double, and both parts share it, so that they make up the cell without gaps whatever the
// rounding. Only the coordinates that are computed for it are inexact. A cut adds at most 7Cu to
// the error of the coordinates (rounding.h): after `deepest_cut` cuts they err by less than
// 7 * 48 = 336Cu, which the covering bound adds to its distances.
#ifndef SURETY_INTERNAL_COVERING_CONVEX_CELL_H
#define SURETY_INTERNAL_COVERING_CONVEX_CELL_H

#include <surety/internal/linear.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace surety::internal::covering {

constexpr int deepest_cut = 48;
/// By how much larger than C (rounding.h) coordinates have to be taken for the error bound there to
/// hold for cells: 64 * 10 = 640Cu is more than sqrt(3) (336 + 24)Cu.
constexpr double rounding_factor = 10;

/// A corner of a cell, with whatever is known about it.
template <class Knowledge>
struct Cell_corner {
  Vector point;
  Knowledge known{};
};

/// Where a cut enters and leaves a cell: at a fraction of the edge from corner `edge` to the next.
/// A fraction of 0 is the corner itself.
struct Cut {
  std::array<unsigned, 2> edge;
  std::array<double, 2> fraction;
};

template <class Knowledge>
class Convex_cell
{
public:
  static constexpr unsigned most_corners = 10;
  using Corner = Cell_corner<Knowledge>;

  unsigned size() const { return size_; }
  Corner& operator[](unsigned i) { return corners_[i]; }
  const Corner& operator[](unsigned i) const { return corners_[i]; }
  unsigned after(unsigned i) const { return i + 1 == size_ ? 0 : i + 1; }
  void append(const Corner& corner) { corners_[size_++] = corner; }
  bool is_full() const { return size_ == most_corners; }

  /// The cut along the plane where `height(corner)` vanishes; none where the plane misses the cell.
  template <class Height>
  std::optional<Cut> cut_along(const Height& height) const
  {
    std::array<double, most_corners> h;
    double largest = 0;
    for (unsigned i = 0; i < size_; ++i) {
      h[i] = height(corners_[i].point);
      largest = std::max(largest, std::abs(h[i]));
    }
    // A corner that is next to the plane is taken for a point of it, lest cells shrink to nothing.
    const double next_to = 1e-6 * largest;
    Cut cut;
    unsigned found = 0;
    bool inside = false, outside = false;
    for (unsigned i = 0; i < size_; ++i) {
      const double a = h[i], b = h[after(i)];
      inside = inside || a > next_to;
      outside = outside || a < -next_to;
      const bool is_at = std::abs(a) <= next_to;
      const bool is_between = !is_at && std::abs(b) > next_to && (a > 0) != (b > 0);
      if (!is_at && !is_between) continue;
      if (found == 2) return std::nullopt;
      cut.edge[found] = i;
      cut.fraction[found++] = is_at ? 0 : a / (a - b);
    }
    if (found < 2 || !inside || !outside) return std::nullopt;
    return cut;
  }

  /// The cut from the middle of the longest edge to the opposite corner.
  Cut halving_cut() const
  {
    unsigned longest = 0;
    double most = -1;
    for (unsigned i = 0; i < size_; ++i) {
      const double length = (corners_[after(i)].point - corners_[i].point).squaredNorm();
      if (length > most) most = length, longest = i;
    }
    const unsigned across = (longest + (size_ + 1) / 2) % size_;
    if (across < longest) return {{across, longest}, {0, .5}};
    return {{longest, across}, {.5, 0}};
  }

  Vector point_at(unsigned edge, double fraction) const
  {
    const Vector& a = corners_[edge].point;
    if (fraction == 0) return a;
    return a + fraction * (corners_[after(edge)].point - a);
  }

  /// The two parts, with `known(point)` for new corners: the one after the first point of the cut,
  /// and the one after the second.
  template <class Know>
  std::pair<Convex_cell, Convex_cell> parts(const Cut& cut, const Know& known) const
  {
    std::array<Corner, 2> end;
    for (unsigned k = 0; k < 2; ++k) {
      if (cut.fraction[k] == 0) {
        end[k] = corners_[cut.edge[k]];
      } else {
        end[k].point = point_at(cut.edge[k], cut.fraction[k]);
        end[k].known = known(end[k].point);
      }
    }
    return {part(cut, end, 0), part(cut, end, 1)};
  }

private:
  Convex_cell part(const Cut& cut, const std::array<Corner, 2>& end, unsigned k) const
  {
    Convex_cell result;
    result.append(end[k]);
    const unsigned to = cut.edge[1 - k];
    for (unsigned i = cut.edge[k]; i != to;) {
      i = after(i);
      if (i != to || cut.fraction[1 - k] != 0) result.append(corners_[i]);
    }
    result.append(end[1 - k]);
    return result;
  }

  std::array<Corner, most_corners> corners_;
  unsigned size_ = 0;
};

} // namespace surety::internal::covering

#endif // SURETY_INTERNAL_COVERING_CONVEX_CELL_H
