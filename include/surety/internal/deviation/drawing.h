// SPDX-License-Identifier: GPL-3.0-or-later
//
// The overlay of what a collapse takes away and what it puts there: cases i) and ii) of section 2.1
// of the paper. Both are drawn in the plane; points drawn at the same place correspond.
//
// A drawing gives each vertex of the ring, and P, a place in the plane. The paper takes projections;
// nothing below depends on it, and the places are whatever doubles are stored. Let all faces, old
// and new, be drawn counter-clockwise, and the old star once round P. Then the star covers, once, a
// region that P sees all of, so that the drawn ring bounds it and is simple. Faces that all turn
// the same way cover a place as often as their common boundary winds round it: the fan covers the
// region once too. Hence "drawn at the same place" is a homeomorphism from the old faces to the new
// ones, the identity on the ring. On each cell, old face times new face, it is linear, its
// displacement is the length of a linear function, and the largest is at a corner of the cell:
//   - a vertex of the ring, which does not move;
//   - P, in each new face that contains it (the paper's delta_3);
//   - a crossing of an old spoke P r_i and a new spoke Q r_j (the paper's delta_2).
// A cell is convex and has at most two corners on the ring, those of one edge, so that it has one
// of the others, and visiting these visits all cells.
//
// Which spokes cross follows from the side of Q r_j on which P lies: the spoke cuts the region in
// two, with r_i for i < j on its right and for i > j on its left, and P r_i, being straight and
// inside, crosses it if and only if its ends lie on different sides. All these are signs of exact
// predicates; only lengths are rounded.
//
// When a ridge or a border goes through P, from Q to R = r_m, the two sides of it are drawn apart
// (`Part`), each with P on the segment QR: the curve then goes to the edge QR, and what was said
// holds for each side with a half turn round P instead of a whole one.
#ifndef SURETY_INTERNAL_DEVIATION_DRAWING_H
#define SURETY_INTERNAL_DEVIATION_DRAWING_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <surety/internal/linear.h>

#include <algorithm>
#include <vector>

namespace surety::internal {

/// The run r_low .. r_high of a ring of k vertices, where r_k is Q = r_0 again: the whole, 0 .. k, or
/// one side of a ridge, 0 .. m or m .. k. Old faces (P, r_i, r_{i+1}) and new ones (Q, r_j, r_{j+1})
/// go by the number of their first ring vertex.
struct Part {
  Index low, high, ring_size;

  Index first_new() const { return std::max<Index>(low, 1); }
  Index last_new() const { return std::min(high, ring_size - 1) - 1; }
  Index first_old() const { return low; }
  Index last_old() const { return high - 1; }
};

class Drawing
{
public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Place = Kernel::Point_2;

  /// Where r_i is drawn; Q is drawn at the origin.
  std::vector<Place> ring;
  Place removed;

  void start(const Part& part)
  {
    part_ = part;
    ring.assign(part.ring_size + 1, Place(0, 0));
  }

  const Part& part() const { return part_; }

  /// Whether all of the above is true. Decides the sides.
  bool is_valid()
  {
    return fan_turns_left() && star_turns_left() && goes_round_once();
  }

  /// On which side of Q r_j P lies: positive for left.
  CGAL::Sign side(Index j) const { return side_[j]; }
  bool contains_removed(Index j) const
  {
    return side_[j] != CGAL::NEGATIVE && side_[j + 1] != CGAL::POSITIVE;
  }

  /// Calls visit(i, j) for each old spoke P r_i that crosses the new spoke Q r_j.
  template <class Visit>
  bool all_of_crossings(Visit visit) const
  {
    for (Index j = part_.first_new() + 1; j <= part_.last_new(); ++j) {
      if (side_[j] == CGAL::POSITIVE) {
        for (Index i = part_.first_new(); i < j; ++i)
          if (!visit(i, j)) return false;
      } else if (side_[j] == CGAL::NEGATIVE) {
        for (Index i = j + 1; i <= part_.last_new() + 1; ++i)
          if (!visit(i, j)) return false;
      }
    }
    return true;
  }

  /// Weights of r_j and r_{j+1} at the place of P in the new face j; the rest is Q's.
  template <class Number>
  std::array<Number, 2> weights_of_removed(Index j) const
  {
    const Number area = cross<Number>(ring[j], ring[j + 1]);
    return {cross<Number>(removed, ring[j + 1]) / area, cross<Number>(ring[j], removed) / area};
  }

  /// Weights of r_i, the rest P's, and of r_j, the rest Q's, where P r_i and Q r_j cross.
  template <class Number>
  std::array<Number, 2> weights_of_crossing(Index i, Index j) const
  {
    // With everything relative to Q, (1-a) p + a r_i = c r_j.
    const Number p_from_j = cross<Number>(ring[j], removed);
    const Number p_from_i = cross<Number>(ring[i], removed);
    const Number determinant = cross<Number>(ring[i], ring[j]) + p_from_j;
    return {p_from_j / determinant, p_from_i / determinant};
  }

private:
  template <class Number>
  static Number cross(const Place& a, const Place& b)
  {
    return Number(a.x()) * Number(b.y()) - Number(a.y()) * Number(b.x());
  }

  bool fan_turns_left() const
  {
    for (Index j = part_.first_new(); j <= part_.last_new(); ++j)
      if (CGAL::orientation(ring[0], ring[j], ring[j + 1]) != CGAL::LEFT_TURN) return false;
    return true;
  }
  bool star_turns_left() const
  {
    for (Index i = part_.first_old(); i <= part_.last_old(); ++i)
      if (CGAL::orientation(removed, ring[i], ring[i + 1]) != CGAL::LEFT_TURN) return false;
    return true;
  }

  /// Seen from P, the r_i follow one another at less than half a turn. Starting from Q they are
  /// first on the one side of the line PQ, perhaps one on it, then on the other side; coming back
  /// to the first side or to the line would begin a second turn.
  bool goes_round_once()
  {
    side_.assign(ring.size(), CGAL::ZERO);
    CGAL::Sign last = CGAL::POSITIVE;
    for (Index j = part_.first_new(); j <= part_.last_new() + 1; ++j) {
      side_[j] = CGAL::orientation(ring[0], ring[j], removed);
      const bool goes_on = side_[j] == CGAL::NEGATIVE || last == CGAL::POSITIVE;
      if (!goes_on) return false;
      last = side_[j];
    }
    return true;
  }

  Part part_{};
  std::vector<CGAL::Sign> side_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_DRAWING_H
