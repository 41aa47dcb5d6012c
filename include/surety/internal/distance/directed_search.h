// SPDX-License-Identifier: GPL-3.0-or-later
//
// One direction of the Hausdorff distance, by branch and bound: how far do the points of one mesh
// lie from another mesh?
#ifndef SURETY_INTERNAL_DISTANCE_DIRECTED_SEARCH_H
#define SURETY_INTERNAL_DISTANCE_DIRECTED_SEARCH_H

#include <surety/internal/distance/cell.h>
#include <surety/internal/distance/cover.h>
#include <surety/internal/distance/face_tree.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace surety {
namespace internal {
namespace hausdorff {

/// The interval for a directed distance, and the point that attains its lower end.
struct Search_result {
  double lower = 0;
  double upper = std::numeric_limits<double>::infinity();
  Point witness;
  std::uint32_t witness_face = 0;
  std::size_t cuts = 0;
};

/// \brief Bounds max {d(x, to): x in from} from both sides.
///
/// Every triangle of `from` is a cell. A cell whose corners are all within a threshold of one face,
/// or that one cut separates into two such cells, is done; another one is cut, and the nearest
/// faces of its corners raise the lower bound. Every cell ends by raising the upper bound to its
/// own, so the interval holds whenever a search ends: it is wide, not wrong, where the cuts were
/// used up. All lengths are in local coordinates.
class Directed_search
{
public:
  /// \param bound the search ends when a point is farther than that.
  /// \param slack width of the interval that is good enough.
  /// \param rounding how far points move when they are reported.
  Directed_search(
      const Triangle_set& from, const Face_tree& to, double bound, double slack, double rounding)
    : from_(from),
      to_(to),
      bound_(bound),
      slack_((std::max)({slack, resolution, 4 * rounding})),
      rounding_(rounding)
  {}

  /// The distances of the vertices: enough to refute most bounds. Vertices that cannot raise the
  /// lower bound by more than the slack keep the face of their neighbours.
  void locate_vertices()
  {
    vertices_.resize(from_.number_of_points());
    std::vector<bool> is_seen(from_.number_of_points(), false);
    result_.witness = from_.triangle(0)[0];
    std::uint32_t hint = 0;
    for (face_ = 0; face_ < from_.size() && !is_refuted(); ++face_) {
      for (const std::uint32_t v : from_.face(face_)) {
        Corner& vertex = vertices_[v];
        if (!is_seen[v]) {
          is_seen[v] = true;
          vertex.point = from_.point(v);
          vertex.upper = corner_distance(vertex, hint, to_);
          vertex.face = hint;
          if (vertex.upper > (std::min)(bound_, good_enough())) locate(vertex);
        }
        hint = vertex.face;
      }
    }
  }

  /// \brief Tries to prove the bound, as fast as possible; leaves an upper bound behind.
  ///
  /// \param maximum_cuts after which the cells that are left keep the bounds that they have.
  /// \pre The vertices are located.
  void prove(std::size_t maximum_cuts)
  {
    is_proof_ = true;
    search(maximum_cuts);
  }

  /// \brief Narrows the interval, until it is no wider than the slack.
  ///
  /// \param known a distance that occurs elsewhere: what is less interests nobody.
  /// \param maximum_cuts after which the cells that are left keep the bounds that they have.
  /// \pre The vertices are located.
  void measure(double known, std::size_t maximum_cuts)
  {
    known_ = known;
    is_proof_ = false;
    if (result_.upper > good_enough()) search(maximum_cuts);
  }

  bool is_refuted() const { return result_.lower > bound_; }
  const Search_result& result() const { return result_; }

private:
  struct Open_face {
    std::uint32_t face;
    double bound;
  };

  double good_enough() const { return (std::max)(result_.lower, known_) + slack_; }

  /// Cells within the threshold need no cuts.
  double threshold() const { return is_proof_ ? bound_ : good_enough(); }

  /// A proof ends where it fails; the lower bound may go on to rise.
  bool is_over() const { return is_refuted() || (is_proof_ && upper_ > bound_); }

  void search(std::size_t maximum_cuts)
  {
    cuts_left_ = maximum_cuts;
    upper_ = 0;
    for (const Open_face& f : open_faces()) {
      if (is_over()) break;
      if (f.bound <= threshold()) {
        upper_ = (std::max)(upper_, f.bound);
      } else {
        search(f);
      }
    }
    if (!is_over()) result_.upper = (std::min)(result_.upper, upper_);
    result_.cuts += maximum_cuts - cuts_left_;
  }

  void settle(const Cell& cell) { upper_ = (std::max)(upper_, cell.bound); }

  /// Finds the face nearest to a corner, and raises the lower bound.
  void locate(Corner& corner)
  {
    const Nearest_face nearest = to_.nearest(corner.point, corner.face);
    corner.face = nearest.face;
    corner.upper = nearest.upper + corner.error;
    corner.is_located = true;
    // Vertices are reported as they are, other points rounded.
    const double error = corner.error > 0 ? corner.error + rounding_ : 0;
    const double lower = nearest.lower - error;
    if (lower <= result_.lower) return;
    result_.lower = lower;
    result_.witness = corner.point;
    result_.witness_face = face_;
  }

  /// A face as a cell, alone in the pool of corners.
  Cell cell_of(std::uint32_t face)
  {
    Cell cell;
    cell.bound = std::numeric_limits<double>::infinity();
    corners_.clear();
    for (const std::uint32_t v : from_.face(face)) {
      cell.push_back(static_cast<std::uint32_t>(corners_.size()));
      corners_.push_back(vertices_[v]);
    }
    return cell;
  }

  /// Settles the faces that need no search; the others, those with the largest bounds first, so
  /// that the lower bound rises early.
  std::vector<Open_face> open_faces()
  {
    std::vector<Open_face> open;
    std::uint32_t last = 0;
    for (std::uint32_t f = 0; f < from_.size(); ++f) {
      Cell cell = cell_of(f);
      Cover cover(cell, corners_, to_);
      if (is_covered(cell, cover, last)) {
        settle(cell);
        continue;
      }
      const auto covering = std::find_if(corners_.begin(), corners_.end(), [&](const Corner& c) {
        return is_covered(cell, cover, c.face);
      });
      if (covering != corners_.end()) {
        settle(cell);
        last = covering->face;
      } else {
        open.push_back({f, cell.bound});
      }
    }
    std::sort(open.begin(), open.end(), [](const Open_face& f, const Open_face& g) {
      return f.bound > g.bound || (f.bound == g.bound && f.face < g.face);
    });
    return open;
  }

  /// Tries one face on a cell.
  bool is_covered(Cell& cell, Cover& cover, std::uint32_t face) const
  {
    cell.bound = (std::min)(cell.bound, cover.bound(face, cell.bound));
    return cell.bound <= threshold();
  }

  void search(const Open_face& open)
  {
    face_ = open.face;
    Cell root = cell_of(open.face);
    root.bound = open.bound;
    root.hint = corners_[0].face;
    stack_.assign(1, root);
    while (!stack_.empty() && !is_over()) {
      const Cell cell = stack_.back();
      stack_.pop_back();
      examine(cell);
    }
  }

  /// Settles a cell, or puts two halves in its place.
  void examine(Cell cell)
  {
    Cover cover(cell, corners_, to_);
    if (is_covered_at_all(cell, cover)) return settle(cell);
    if (is_refuted()) return;
    if (cannot_be_covered(cell) || cuts_left_ == 0) return settle(cell);
    --cuts_left_;
    const double by_two = cover.bound_by_two(threshold());
    if (by_two <= threshold()) {
      cell.bound = by_two;
      return settle(cell);
    }
    Cell_values values;
    if (cell.size() > Cell::comfortable) {
      values = chord_values(cell);
    } else if (!cover.choose_cut(values, cell.hint)) {
      return settle(cell);
    }
    const auto pieces = cut(cell, values, corners_);
    stack_.push_back(pieces.first);
    stack_.push_back(pieces.second);
  }

  /// Tries the faces that are near, in the order of their cost. Corners within the threshold of one
  /// of them need not be located.
  bool is_covered_at_all(Cell& cell, Cover& cover)
  {
    if (cell.bound <= threshold() || is_covered(cell, cover, cell.hint)) return true;
    for (int i = 0; i < cell.size(); ++i) {
      const Corner& corner = corners_[cell[i]];
      if (is_measured(corner) && is_covered(cell, cover, corner.face)) return true;
    }
    const std::uint32_t middle = to_.nearest(centre(cell), cell.hint).face;
    if (is_covered(cell, cover, middle)) return true;
    for (int i = 0; i < cell.size(); ++i) {
      Corner& corner = corners_[cell[i]];
      if (corner.is_located) continue;
      for (const std::uint32_t face : {cell.hint, middle}) approach(corner, face);
      if (corner.upper <= threshold()) continue;
      locate(corner);
      if (is_refuted()) return false;
      if (is_covered(cell, cover, corner.face)) return true;
    }
    return false;
  }

  static bool is_measured(const Corner& corner)
  {
    return corner.upper < std::numeric_limits<double>::infinity();
  }

  /// Gives a corner a face that is closer than its own.
  void approach(Corner& corner, std::uint32_t face) const
  {
    const double upper = corner_distance(corner, face, to_);
    if (upper >= corner.upper) return;
    corner.upper = upper;
    corner.face = face;
  }

  /// Whether a corner is, up to rounding, too far from all faces, or the cell too small to cut.
  bool cannot_be_covered(const Cell& cell) const
  {
    for (int i = 0; i < cell.size(); ++i) {
      const Corner& corner = corners_[cell[i]];
      if (corner.is_located && corner.upper > threshold()) return true;
    }
    return cell.depth >= greatest_depth;
  }

  Point centre(const Cell& cell) const
  {
    Vector sum(0, 0, 0);
    for (int i = 0; i < cell.size(); ++i) sum = sum + (corners_[cell[i]].point - CGAL::ORIGIN);
    return CGAL::ORIGIN + sum / cell.size();
  }

  /// Narrower intervals are not sought: rounding would get in the way. Errors of cells stay below
  /// a hundredth of it.
  static constexpr double resolution = 0x1p-40;
  /// Bisection reaches the resolution of a double after some hundred cuts.
  static constexpr int greatest_depth = 200;

  const Triangle_set& from_;
  const Face_tree& to_;
  double bound_;
  double slack_;
  double rounding_;
  Search_result result_;

  // Of the search that is running.
  bool is_proof_ = false;
  double known_ = 0;
  double upper_ = 0;
  std::size_t cuts_left_ = 0;

  std::vector<Corner> vertices_;
  std::vector<Corner> corners_; ///< of the cells of the current face
  std::vector<Cell> stack_;
  std::uint32_t face_ = 0;
};

} // namespace hausdorff
} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_DISTANCE_DIRECTED_SEARCH_H
