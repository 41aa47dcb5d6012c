// SPDX-License-Identifier: GPL-3.0-or-later
//
// Invariant I3: the items around a triangle of T, a polygon in weakly convex position, are cut into
// triangles whose three items lie in one closed face of M each. An inner item, if the triangle has
// one, may be one more corner of them, in the interior.
//
// Ears are cut while there are any. An ear (i-1, i, i+1) may be cut if its three items share a
// face. For an item i on a face or an edge this is never a mistake. Take a triangulation of the
// polygon, and in it the fan of i: triangles (i, q_j, q_j+1), q_0 = i-1, ..., q_k = i+1, each in a
// face that contains i. One of the q_j may be the inner item.
//   i on a face f: all of them are in f, hence so are all q_j. Cut (q_0, i, q_k), and triangulate
//   the polygon q_0 ... q_k in f as you like.
//   i on an edge of f and g, and f the face of the ear: where the fan changes from f to g or back,
//   at q_j, this item lies in both, as q_0 and q_k lie in f. Cut (q_0, i, q_k), join the changes
//   and the ends of the fan: the polygon of q_0, q_k and the changes is in f, those cut off by its
//   sides are each in f or in g.
// Nothing in this asks which of the q_j are corners of the polygon, and what is not in the fan of i
// stays. So the cuts of such items lose nothing, with an inner item or without.
//
// The ears at vertices of M are cut only when nothing else is left; that may be a mistake, when the
// image of the triangle winds about the vertex. With an inner item c, what should be left is the
// fan of c: (c, i, i+1) for every side of the polygon. So then an ear at a vertex is cut only if
// one of its two sides does not fit into that fan. The fan goes before a cut without c: where both
// are possible, as when the corners are also those of a face of M on the other side, c was recorded
// for a reason. If it is not possible, c is not needed for the cells, or not enough: such an item
// is measured like all others, and otherwise does not matter.
//
// If the polygon gets stuck, dynamic programming over its intervals decides, from the state before
// the first ear at a vertex. An item that was cut changes the ears of its neighbours only, so all
// is linear but for the dynamic program, which has a limit of size and of work.
#ifndef SURETY_INTERNAL_CERTIFICATE_POLYGON_CUTTER_H
#define SURETY_INTERNAL_CERTIFICATE_POLYGON_CUTTER_H

#include <surety/internal/certificate/record.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace surety::internal::checker {

/// Three items, in the orientation of their triangle of T, and the closed face that holds them.
struct Cell {
  std::array<Index, 3> items;
  Index face;
};

/// Answers of the cutter: impossible is proven, too_large is a limit of the cutter.
enum class Cutting { done, impossible, too_large };

/// Complex needs `common_face(i, j, k)`, none if there is none, and `is_at_vertex(i)`.
template <class Complex>
class Polygon_cutter
{
public:
  /// Sides of a polygon that the dynamic program admits, after all safe cuts.
  static constexpr std::size_t largest_program = 400;
  /// Triples that all dynamic programs of one check may look at together.
  static constexpr std::size_t largest_work = 50'000'000;

  explicit Polygon_cutter(const Complex& complex) : complex_(complex) {}

  /// Appends the cells of the polygon of items, with a corner at the inner item, or none, inside.
  Cutting cut(const std::vector<Index>& polygon, Index inner, std::vector<Cell>& cells)
  {
    start(polygon, inner);
    cut_ears(cells);
    if ((inner != none && fan(cells)) || (left_ == 3 && finish(cells))) return Cutting::done;
    if (!safe_cells_) {
      if (inner == none) return Cutting::impossible;
      remember(some_corner_, cells.size());
    }
    cells.resize(*safe_cells_);
    return cut_by_program(cells);
  }

private:
  Index item(Index corner) const { return (*polygon_)[corner]; }

  Index ear(Index corner) const
  {
    return complex_.common_face(item(previous_[corner]), item(corner), item(next_[corner]));
  }

  void start(const std::vector<Index>& polygon, Index inner)
  {
    polygon_ = &polygon;
    inner_ = inner;
    safe_cells_.reset();
    left_ = polygon.size();
    previous_.resize(left_);
    next_.resize(left_);
    waits_.assign(left_, false);
    safe_.clear();
    unsafe_.clear();
    for (Index i = static_cast<Index>(left_); i-- > 0;) {
      previous_[i] = i == 0 ? static_cast<Index>(left_) - 1 : i - 1;
      next_[i] = i + 1 == left_ ? 0 : i + 1;
      wait(i);
    }
    some_corner_ = 0;
  }

  void wait(Index corner)
  {
    if (waits_[corner]) return;
    waits_[corner] = true;
    (complex_.is_at_vertex(item(corner)) ? unsafe_ : safe_).push_back(corner);
  }

  void cut_ears(std::vector<Cell>& cells)
  {
    while (left_ > 3) {
      const bool safe = !safe_.empty();
      std::vector<Index>& waiting = safe ? safe_ : unsafe_;
      if (waiting.empty()) return;
      const Index corner = waiting.back();
      waiting.pop_back();
      waits_[corner] = false;
      if (!safe && is_in_fan(corner)) continue;
      const Index face = ear(corner);
      if (face == none) continue;
      if (!safe && !safe_cells_) remember(corner, cells.size());
      cut_ear(corner, face, cells);
    }
  }

  void cut_ear(Index corner, Index face, std::vector<Cell>& cells)
  {
    const Index before = previous_[corner], after = next_[corner];
    cells.push_back({{item(before), item(corner), item(after)}, face});
    next_[before] = after;
    previous_[after] = before;
    some_corner_ = after;
    --left_;
    wait(before);
    wait(after);
  }

  bool finish(std::vector<Cell>& cells)
  {
    const Index corner = some_corner_, before = previous_[corner], after = next_[corner];
    const Index face = ear(corner);
    if (face != none) cells.push_back({{item(before), item(corner), item(after)}, face});
    return face != none;
  }

  /// The face of the cell of the inner item and the side that starts at a corner, or none.
  Index face_of_fan(Index corner) const
  {
    return complex_.common_face(inner_, item(corner), item(next_[corner]));
  }

  bool is_in_fan(Index corner) const
  {
    return inner_ != none && face_of_fan(previous_[corner]) != none && face_of_fan(corner) != none;
  }

  /// The cells about the inner item, if all are possible.
  bool fan(std::vector<Cell>& cells) const
  {
    const std::size_t before = cells.size();
    Index corner = some_corner_;
    do {
      const Index face = face_of_fan(corner);
      if (face == none) {
        cells.resize(before);
        return false;
      }
      cells.push_back({{inner_, item(corner), item(next_[corner])}, face});
      corner = next_[corner];
    } while (corner != some_corner_);
    return true;
  }

  /// The state before the first cut that may be a mistake.
  void remember(Index corner, std::size_t number_of_cells)
  {
    safe_cells_ = number_of_cells;
    reduced_.clear();
    Index i = corner;
    do {
      reduced_.push_back(item(i));
      i = next_[i];
    } while (i != corner);
  }

  /// apex_[i n + j]: the third corner of the triangle on the diagonal (i, j), in a triangulation of
  /// the polygon i, i + 1, ..., j without the inner item; none if there is no triangulation.
  Cutting cut_by_program(std::vector<Cell>& cells)
  {
    const std::size_t n = reduced_.size(), work = (inner_ == none ? 1 : 4) * (n * n * n / 6);
    if (n > largest_program || work_ + work > largest_work) return Cutting::too_large;
    work_ += work;
    apex_.assign(n * n, none);
    for (std::size_t length = 2; length < n; ++length) {
      for (std::size_t i = 0; i + length < n; ++i) find_apex(i, i + length);
    }
    if (inner_ != none && cut_about_inner(cells)) return Cutting::done;
    if (apex_[n - 1] == none) return Cutting::impossible;
    collect(0, n - 1, cells);
    return Cutting::done;
  }

  bool is_cut(std::size_t i, std::size_t j) const
  {
    return j == i + 1 || apex_[i * reduced_.size() + j] != none;
  }

  void find_apex(std::size_t i, std::size_t j)
  {
    const Index p = reduced_[i], r = reduced_[j];
    if (complex_.common_face(p, r, r) == none) return;
    for (std::size_t k = i + 1; k < j; ++k) {
      if (!is_cut(i, k) || !is_cut(k, j)) continue;
      if (complex_.common_face(p, reduced_[k], r) == none) continue;
      apex_[i * reduced_.size() + j] = static_cast<Index>(k);
      return;
    }
  }

  void add_cell(Index p, Index q, Index r, std::vector<Cell>& cells) const
  {
    cells.push_back({{p, q, r}, complex_.common_face(p, q, r)});
  }

  /// The cells of the polygon i, i + 1, ..., j, by apex_.
  void collect(std::size_t first, std::size_t last, std::vector<Cell>& cells) const
  {
    std::vector<std::array<std::size_t, 2>> open = {{first, last}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j == i + 1) continue;
      const std::size_t k = apex_[i * reduced_.size() + j];
      add_cell(reduced_[i], reduced_[k], reduced_[j], cells);
      open.push_back({i, k});
      open.push_back({k, j});
    }
  }

  /// The same with the inner item c. path_[i n + j]: the corner before j on a path i, ..., j of
  /// corners around c, at least one between them, with a cell of c on each step and the polygon
  /// beyond the step cut; none if there is no path. If i = j - 1 or the polygon i, ..., j can be
  /// cut, (i, j) may be a step itself. inside_[i n + j]: whether i, ..., j can be cut with c
  /// inside.
  bool cut_about_inner(std::vector<Cell>& cells)
  {
    const std::size_t n = reduced_.size();
    path_.assign(n * n, none);
    inside_.assign(n * n, false);
    for (std::size_t length = 1; length < n; ++length) {
      for (std::size_t i = 0; i + length < n; ++i) {
        const std::size_t j = i + length;
        path_[i * n + j] = last_corner_before(i, j);
        inside_[i * n + j] = third_corner(i, j) != none;
      }
    }
    if (!inside_[n - 1]) return false;
    collect_about_inner(cells);
    return true;
  }

  bool is_in_face_of_inner(std::size_t i, std::size_t j) const
  {
    return complex_.common_face(inner_, reduced_[i], reduced_[j]) != none;
  }

  bool is_step(std::size_t i, std::size_t j) const
  {
    return is_cut(i, j) && is_in_face_of_inner(i, j);
  }

  Index last_corner_before(std::size_t i, std::size_t j) const
  {
    for (std::size_t k = i + 1; k < j; ++k) {
      const bool arrives = path_[i * reduced_.size() + k] != none || is_step(i, k);
      if (arrives && is_step(k, j)) return static_cast<Index>(k);
    }
    return none;
  }

  /// The triangle on the diagonal (i, j) with c beyond or at its third corner, which is then n.
  Index third_corner(std::size_t i, std::size_t j) const
  {
    const std::size_t n = reduced_.size();
    const Index p = reduced_[i], r = reduced_[j];
    if (complex_.common_face(p, r, r) == none) return none;
    if (path_[i * n + j] != none && is_in_face_of_inner(i, j)) return static_cast<Index>(n);
    for (std::size_t k = i + 1; k < j; ++k) {
      const bool left = inside_[i * n + k] && is_cut(k, j);
      const bool right = is_cut(i, k) && inside_[k * n + j];
      if (!left && !right) continue;
      if (complex_.common_face(p, reduced_[k], r) != none) return static_cast<Index>(k);
    }
    return none;
  }

  void collect_about_inner(std::vector<Cell>& cells) const
  {
    const std::size_t n = reduced_.size();
    std::size_t i = 0, j = n - 1;
    for (std::size_t k = third_corner(i, j); k < n; k = third_corner(i, j)) {
      add_cell(reduced_[i], reduced_[k], reduced_[j], cells);
      const bool left = inside_[i * n + k] && is_cut(k, j);
      collect(left ? k : i, left ? j : k, cells);
      (left ? j : i) = k;
    }
    add_cell(reduced_[i], inner_, reduced_[j], cells);
    while (j != i) {
      const std::size_t before = path_[i * n + j] != none ? path_[i * n + j] : i;
      add_cell(inner_, reduced_[before], reduced_[j], cells);
      collect(before, j, cells);
      j = before;
    }
  }

  const Complex& complex_;
  const std::vector<Index>* polygon_ = nullptr;
  std::vector<Index> previous_, next_, safe_, unsafe_, reduced_, apex_, path_;
  std::vector<bool> waits_, inside_;
  std::optional<std::size_t> safe_cells_; ///< cells before the first cut that may be a mistake
  std::size_t left_ = 0, work_ = 0;
  Index some_corner_ = 0, inner_ = none;
};

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_POLYGON_CUTTER_H
