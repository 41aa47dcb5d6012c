// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well a few faces of the other mesh cover a cell, and where to cut the cell if they do not.
#ifndef SURETY_INTERNAL_DISTANCE_COVER_H
#define SURETY_INTERNAL_DISTANCE_COVER_H

#include <surety/internal/distance/cell.h>
#include <surety/internal/distance/face_tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace surety {
namespace internal {
namespace hausdorff {

/// Upper bound of the distance of the exact point of a corner to a face.
inline double corner_distance(const Corner& c, std::uint32_t face, const Face_tree& faces)
{
  if (c.face == face && c.upper < std::numeric_limits<double>::infinity()) return c.upper;
  return distance_upper_bound(c.point, faces.triangle(face)) + c.error;
}

/// The faces that were tried on a cell, with the distances of its corners.
class Cover
{
public:
  Cover(const Cell& cell, const std::vector<Corner>& corners, const Face_tree& faces)
    : cell_(cell), corners_(corners), faces_(faces)
  {}

  /// \brief An upper bound of the distance from the cell to a face.
  ///
  /// Infinity for a face that was tried before, and as soon as the bound exceeds the limit.
  double bound(std::uint32_t face, double limit)
  {
    for (int k = 0; k < size_; ++k) {
      if (tried_[k].face == face) return infinity;
    }
    CGAL_assertion(size_ < static_cast<int>(tried_.size()));
    Trial& trial = tried_[size_++];
    trial.face = face;
    trial.known = 0;
    double result = 0;
    for (int i = 0; i < cell_.size(); ++i) {
      result = (std::max)(result, extend(trial));
      if (result > limit) return infinity;
    }
    return result;
  }

  /// \brief An upper bound of the distance from the cell to two faces, infinity above the limit.
  ///
  /// Cutting the cell where it is equally far from both leaves two cells, each close to one: on a
  /// concave crease no other cut ends so soon. The cut is only thought, since both cells are done.
  double bound_by_two(double limit)
  {
    for (int k = 0; k < size_; ++k) {
      while (tried_[k].known < cell_.size()) extend(tried_[k]);
      for (int l = 0; l < k; ++l) {
        const double result = bound_by_two(tried_[k], tried_[l], limit);
        if (result <= limit) return result;
      }
    }
    return infinity;
  }

  /// \brief Values that cut the cell, and in `hint` the face that a piece may be close to.
  ///
  /// The planes are normal to the faces tried and pass through their edges: what is inside all
  /// three planes of a face has its closest point in the interior of that face. The deepest cut
  /// wins, so that large cells are halved rather than whittled. Without one, the cell is bisected.
  /// Returns whether the values are a proper cut.
  bool choose_cut(Cell_values& values, std::uint32_t& hint) const
  {
    const double size = bisector_values(values);
    double deepest = least_depth * size;
    bool found = false;
    for (int k = 0; k < size_; ++k) {
      const Triangle& t = faces_.triangle(tried_[k].face);
      const Vector normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
      for (int e = 0; e < 3; ++e) {
        const Vector outwards = CGAL::cross_product(t[(e + 1) % 3] - t[e], normal);
        Cell_values trial;
        const double depth = plane_values(t[e], outwards, trial);
        if (!(depth > deepest) || !is_proper_cut(cell_, trial)) continue;
        deepest = depth;
        values = trial;
        hint = tried_[k].face;
        found = true;
      }
    }
    return found || is_proper_cut(cell_, values);
  }

private:
  struct Trial {
    std::uint32_t face;
    int known; ///< number of corners measured so far
    Cell_values distance;
  };

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// Cuts that take off less than this fraction of the cell's size are not worth while. Bisection
  /// takes their place, and the fraction grows as cells get smaller.
  static constexpr double least_depth = 1e-6;
  /// Corners this close to a plane, relative to the cell, are taken to lie on it: it costs nothing
  /// and avoids pieces without extent.
  static constexpr double snap = 16 * unit_roundoff;

  double extend(Trial& trial)
  {
    const Corner& corner = corners_[cell_[trial.known]];
    return trial.distance[trial.known++] = corner_distance(corner, trial.face, faces_);
  }

  double bound_by_two(const Trial& f, const Trial& g, double limit) const
  {
    Cell_values difference;
    double result = 0;
    for (int i = 0; i < cell_.size(); ++i) {
      difference[i] = f.distance[i] - g.distance[i];
      result = (std::max)(result, (std::min)(f.distance[i], g.distance[i]));
    }
    if (result > limit || !is_proper_cut(cell_, difference)) return infinity;
    for (int i = 0; i < cell_.size(); ++i) {
      const int j = cell_.after(i);
      if ((difference[i] < 0) == (difference[j] < 0) || difference[i] == 0 || difference[j] == 0) {
        continue;
      }
      const Corner cut
          = corner_between(corners_[cell_[i]], corners_[cell_[j]], difference[i], difference[j]);
      result = (std::max)(
          {result, corner_distance(cut, f.face, faces_), corner_distance(cut, g.face, faces_)});
      if (result > limit) break;
    }
    return result;
  }

  /// Signed distances from a plane, times a constant. Returns how deep the plane cuts.
  double plane_values(const Point& origin, const Vector& normal, Cell_values& values) const
  {
    double low = 0, high = 0;
    for (int i = 0; i < cell_.size(); ++i) {
      values[i] = normal * (corners_[cell_[i]].point - origin);
      low = (std::min)(low, values[i]);
      high = (std::max)(high, values[i]);
    }
    const double margin = snap * (std::max)(-low, high);
    for (int i = 0; i < cell_.size(); ++i) {
      if (std::abs(values[i]) <= margin) values[i] = 0;
    }
    return (std::min)(-low, high) / std::sqrt(normal * normal);
  }

  /// Signed distances from the middle plane of the two corners farthest apart, times a constant.
  /// Returns the distance of the two.
  double bisector_values(Cell_values& values) const
  {
    Point a = corners_[cell_[0]].point, b = a;
    double longest = 0;
    for (int i = 0; i < cell_.size(); ++i) {
      for (int j = i + 1; j < cell_.size(); ++j) {
        const Point& p = corners_[cell_[i]].point;
        const Point& q = corners_[cell_[j]].point;
        const double squared = CGAL::squared_distance(p, q);
        if (squared <= longest) continue;
        longest = squared;
        a = p;
        b = q;
      }
    }
    plane_values(CGAL::midpoint(a, b), b - a, values);
    return std::sqrt(longest);
  }

  const Cell& cell_;
  const std::vector<Corner>& corners_;
  const Face_tree& faces_;
  std::array<Trial, 2 * Cell::capacity> tried_;
  int size_ = 0;
};

} // namespace hausdorff
} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_DISTANCE_COVER_H
