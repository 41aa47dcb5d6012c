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

/// What a search has to find out; lengths in local coordinates.
struct Search_options {
  double bound;    ///< the search ends when a point is farther
  double slack;    ///< width of the interval that is good enough
  double rounding; ///< how far points move when they are reported
};

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
/// Every triangle of `from` is a cell. A cell whose corners are all within the threshold of one
/// face, or that one cut separates into two such cells, is done; another one is cut, and the
/// nearest faces of its corners raise the lower bound. The threshold is the largest distance seen
/// plus the slack, at most the bound that is asked for. Every cell ends by raising the upper bound
/// to its own, so the interval holds whenever the search ends: it is wide, not wrong, where the
/// cuts were used up.
class Directed_search
{
public:
  Directed_search(const Triangle_set& from, const Face_tree& to, const Search_options& options)
    : from_(from), to_(to), options_(options)
  {}

  /// The distances of the vertices: enough to refute most bounds. Vertices that are within the
  /// threshold of a face of their neighbours cannot matter, and keep that face.
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
          if (vertex.upper > threshold()) locate(vertex);
        }
        hint = vertex.face;
      }
    }
  }

  /// \brief The distances of all other points.
  ///
  /// \param known a distance that occurs elsewhere: bounds below it interest nobody.
  /// \param maximum_cuts after which the cells that are left keep the bounds that they have.
  /// \pre The vertices are located.
  void search_interior(double known, std::size_t maximum_cuts)
  {
    known_ = known;
    maximum_cuts_ = maximum_cuts;
    result_.upper = 0;
    const std::vector<Open_face> open = open_faces();
    for (const Open_face& f : open) {
      if (is_refuted()) break;
      if (f.bound <= threshold()) {
        result_.upper = (std::max)(result_.upper, f.bound);
      } else {
        search(f);
      }
    }
    if (is_refuted()) result_.upper = std::numeric_limits<double>::infinity();
  }

  bool is_refuted() const { return result_.lower > options_.bound; }
  const Search_result& result() const { return result_; }

private:
  struct Open_face {
    std::uint32_t face;
    double bound;
  };

  /// A point that is neither within the bound nor beyond it, because of rounding, settles that the
  /// bound cannot be proven; the search goes on for the sake of the interval.
  double threshold() const
  {
    const double good_enough = (std::max)(result_.lower, known_) + options_.slack;
    return is_undecidable_ ? good_enough : (std::min)(options_.bound, good_enough);
  }

  void settle(const Cell& cell) { result_.upper = (std::max)(result_.upper, cell.bound); }

  /// Finds the face nearest to a corner, and raises the lower bound.
  void locate(Corner& corner)
  {
    const Nearest_face nearest = to_.nearest(corner.point, corner.face);
    corner.face = nearest.face;
    corner.upper = nearest.upper + corner.error;
    corner.is_located = true;
    // Vertices are reported as they are, other points rounded.
    const double error = corner.error > 0 ? corner.error + options_.rounding : 0;
    const double lower = nearest.lower - error;
    if (lower <= options_.bound && corner.upper > options_.bound) is_undecidable_ = true;
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
    while (!stack_.empty() && !is_refuted()) {
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
    if (cannot_improve(cell) || result_.cuts >= maximum_cuts_) return settle(cell);
    ++result_.cuts;
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
      for (const std::uint32_t face : {cell.hint, middle}) measure(corner, face);
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
  void measure(Corner& corner, std::uint32_t face) const
  {
    const double upper = corner_distance(corner, face, to_);
    if (upper >= corner.upper) return;
    corner.upper = upper;
    corner.face = face;
  }

  /// Whether a corner alone keeps the bound where it is, or the cell has become too small to cut.
  bool cannot_improve(const Cell& cell) const
  {
    double farthest = 0;
    for (int i = 0; i < cell.size(); ++i) {
      const Corner& corner = corners_[cell[i]];
      if (corner.is_located) farthest = (std::max)(farthest, corner.upper);
    }
    const double rounding = 64 * unit_roundoff; // in units of the largest coordinate
    return cell.bound <= farthest + rounding || cell.depth >= greatest_depth;
  }

  Point centre(const Cell& cell) const
  {
    Vector sum(0, 0, 0);
    for (int i = 0; i < cell.size(); ++i) sum = sum + (corners_[cell[i]].point - CGAL::ORIGIN);
    return CGAL::ORIGIN + sum / cell.size();
  }

  /// Bisection reaches the resolution of a double after some hundred cuts.
  static constexpr int greatest_depth = 200;

  const Triangle_set& from_;
  const Face_tree& to_;
  Search_options options_;
  Search_result result_;
  double known_ = 0;
  std::size_t maximum_cuts_ = 0;
  bool is_undecidable_ = false;
  std::vector<Corner> vertices_;
  std::vector<Corner> corners_; ///< of the cells of the current face
  std::vector<Cell> stack_;
  std::uint32_t face_ = 0;
};

} // namespace hausdorff
} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_DISTANCE_DIRECTED_SEARCH_H
