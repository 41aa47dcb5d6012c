// SPDX-License-Identifier: GPL-3.0-or-later
//
// The overlay of what an operation takes away and what it puts there: cases i) and ii) of section
// 2.1 of the paper. Both are drawn in the plane; points drawn at the same place correspond.
//
// A drawing gives each vertex of the ring, and P, a place. The paper's places are projections, and
// so are ours, but nothing below depends on it: whatever doubles are stored are the drawing,
// exactly. Let all faces, old and new, be drawn counter-clockwise, and the old star go once round
// P. Then the star covers once a region of which P sees everything, so that the drawn ring, its
// boundary, is simple. Faces that all turn left cover a place as often as their common boundary
// winds round it: the fan covers the same region, once. Hence "drawn at the same place" is a
// homeomorphism from the old faces to the new ones, the identity on the ring. On each cell, the
// overlap of an old and a new face, it is linear; its displacement is the length of a linear
// function, which is convex, and so largest at a corner of the cell:
//   - a vertex of the ring, which does not move;
//   - P, in each new face that contains it (the paper's delta_3);
//   - a crossing of an old spoke P r_i and a new spoke Q r_j (the paper's delta_2).
// The corners of a cell on the ring are common to an old and a new face, two at most; the cell has
// three or more. So each cell has P or a crossing as a corner, and who visits these visits it.
//
// Which spokes cross follows from the side of Q r_j on which P is drawn. The spoke cuts the region
// in two, with the r_i for i < j on its right and those for i > j on its left; P r_i is straight
// and stays inside, so that it crosses the spoke if and only if its ends are on different sides.
//
// Where a ridge or a border runs from Q through P to R = r_m, its two sides are drawn apart
// (`Part`), each with P on the segment QR. The curve is then moved to the edge QR, in the same way
// on both sides, and all that was said holds for either side with half a turn round P for a whole
// one.
//
// All signs are those of exact predicates. Only weights and lengths are rounded, by the caller's
// choice of a number type.
#ifndef SURETY_INTERNAL_DEVIATION_DRAWING_H
#define SURETY_INTERNAL_DEVIATION_DRAWING_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <surety/internal/linear.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace surety::internal {

/// The run r_low .. r_high of a ring of k vertices, where r_k is Q = r_0 again: the whole ring, 0
/// .. k, or one side of a ridge, 0 .. m or m .. k. Old faces (P, r_i, r_{i+1}) and new ones (Q,
/// r_j, r_{j+1}) go by the number of their first ring vertex.
struct Part {
  Index low, high, ring_size;

  Index first_old() const { return low; }
  Index last_old() const { return high - 1; }
  Index first_new() const { return std::max<Index>(low, 1); }
  Index last_new() const { return std::min(high, ring_size - 1) - 1; }
};

class Drawing
{
public:
  using Place = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;

  /// Starts over, with all vertices at the origin. Q stays there.
  void start(const Part& part)
  {
    part_ = part;
    ring_.assign(part.ring_size + 1, Place(0, 0));
    removed_ = Place(0, 0);
  }

  void place_ring(Index i, double x, double y) { ring_[i] = Place(x, y); }
  void place_removed(double x, double y) { removed_ = Place(x, y); }

  /// Whether the drawing is as above. If so, the members below may be asked.
  bool is_valid()
  {
    return is_finite() && fan_turns_left() && star_turns_left() && star_goes_round_once();
  }

  const Part& part() const { return part_; }

  /// Whether P is drawn in the closed new face j.
  bool contains_removed(Index j) const
  {
    return side_[j] != CGAL::NEGATIVE && side_[j + 1] != CGAL::POSITIVE;
  }

  /// Calls visit(i, j) for each old spoke P r_i and each new spoke Q r_j that cross, until one call
  /// returns false; returns whether none did.
  template <class Visit>
  bool all_of_crossings(Visit visit) const
  {
    for (Index j = part_.first_new() + 1; j <= part_.last_new(); ++j) {
      if (side_[j] == CGAL::ZERO) continue;
      const bool is_left = side_[j] == CGAL::POSITIVE;
      const Index first = is_left ? part_.first_new() : j + 1;
      const Index last = is_left ? j - 1 : part_.last_new() + 1;
      for (Index i = first; i <= last; ++i)
        if (!visit(i, j)) return false;
    }
    return true;
  }

  /// The weights of r_j and r_{j+1} at the place of P in the new face j; the rest is Q's.
  template <class Number>
  std::array<Number, 2> weights_of_removed(Index j) const
  {
    const Number area = cross<Number>(ring_[j], ring_[j + 1]);
    return {cross<Number>(removed_, ring_[j + 1]) / area, cross<Number>(ring_[j], removed_) / area};
  }

  /// Where P r_i and Q r_j cross: the weight of r_i, the rest being P's, and the weight of r_j, the
  /// rest being Q's. Solves (1 - a) p + a r_i = b r_j.
  template <class Number>
  std::array<Number, 2> weights_of_crossing(Index i, Index j) const
  {
    const Number p_at_i = cross<Number>(ring_[i], removed_);
    const Number p_at_j = cross<Number>(ring_[j], removed_);
    const Number determinant = cross<Number>(ring_[i], ring_[j]) + p_at_j;
    return {p_at_j / determinant, p_at_i / determinant};
  }

  /// A flip has no P: the old faces are (r_0, r_1, r_3) and (r_1, r_2, r_3), the new ones (r_0,
  /// r_1, r_2) and (r_0, r_2, r_3). When all four turn left the quadrangle is convex, the diagonals
  /// cross, and this is the only corner of cells beside the ring.
  bool is_valid_flip() const
  {
    return is_finite() && fan_turns_left() && turns_left(ring_[0], ring_[1], ring_[3])
        && turns_left(ring_[1], ring_[2], ring_[3]);
  }

  /// Where the diagonals cross: the weight of r_3 on r_1 r_3 and of r_2 on r_0 r_2.
  template <class Number>
  std::array<Number, 2> weights_of_flip() const
  {
    const Number at_1 = cross<Number>(ring_[1], ring_[2]), at_3 = cross<Number>(ring_[2], ring_[3]);
    const Number determinant = at_1 + at_3;
    return {at_1 / determinant, cross<Number>(ring_[1], ring_[3]) / determinant};
  }

private:
  template <class Number>
  static Number cross(const Place& a, const Place& b)
  {
    return Number(a.x()) * Number(b.y()) - Number(a.y()) * Number(b.x());
  }
  static bool turns_left(const Place& a, const Place& b, const Place& c)
  {
    return CGAL::orientation(a, b, c) == CGAL::LEFT_TURN;
  }

  /// Predicates know no infinity; coordinates near the largest double may overflow.
  bool is_finite() const
  {
    double sum = std::abs(removed_.x()) + std::abs(removed_.y());
    for (const Place& place : ring_) sum += std::abs(place.x()) + std::abs(place.y());
    return std::isfinite(sum);
  }
  bool fan_turns_left() const
  {
    for (Index j = part_.first_new(); j <= part_.last_new(); ++j)
      if (!turns_left(ring_[0], ring_[j], ring_[j + 1])) return false;
    return true;
  }
  bool star_turns_left() const
  {
    for (Index i = part_.first_old(); i <= part_.last_old(); ++i)
      if (!turns_left(removed_, ring_[i], ring_[i + 1])) return false;
    return true;
  }

  /// Seen from P, the r_i follow one another at angles between zero and half a turn. From Q on they
  /// are on the left of the ray PQ, then perhaps one opposite to Q, then on the right. To come to
  /// the left, or to the line, from the right is to begin a second turn.
  bool star_goes_round_once()
  {
    side_.assign(ring_.size(), CGAL::ZERO);
    bool was_left = true;
    for (Index j = part_.first_new(); j <= part_.last_new() + 1; ++j) {
      side_[j] = CGAL::orientation(ring_[0], ring_[j], removed_);
      if (side_[j] != CGAL::NEGATIVE && !was_left) return false;
      was_left = side_[j] == CGAL::POSITIVE;
    }
    return true;
  }

  Part part_{};
  std::vector<Place> ring_;
  Place removed_;
  std::vector<CGAL::Sign> side_; ///< on which P is of the spoke Q r_j: positive for left
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_DRAWING_H
