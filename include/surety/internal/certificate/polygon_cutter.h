// SPDX-License-Identifier: GPL-3.0-or-later
//
// Invariant I3: the items around a triangle of T, a polygon in weakly convex position, are cut into
// triangles whose three items lie in one closed face of M each.
//
// Ears are cut while there are any. An ear (i-1, i, i+1) may be cut if its three items share a
// face. For an item i on a face or an edge this is never a mistake. Take a triangulation of the
// polygon, and in it the fan of i: triangles (i, q_j, q_j+1), q_0 = i-1, ..., q_k = i+1, each in a
// face that contains i.
//   i on a face f: all of them are in f, hence so are all q_j. Cut (q_0, i, q_k), and triangulate
//   the polygon q_0 ... q_k in f as you like.
//   i on an edge of f and g, and f the face of the ear: where the fan changes from f to g or back,
//   at q_j, this item lies in both, as q_0 and q_k lie in f. Cut (q_0, i, q_k), join the changes
//   and the ends of the fan: the polygon of q_0, q_k and the changes is in f, those cut off by its
//   sides are each in f or in g.
// So the cuts of such items lose nothing. The ears at vertices of M are cut only when nothing else
// is left; that may be a mistake, when the image of the triangle winds about the vertex. If the
// polygon gets stuck after such a cut, dynamic programming over its intervals decides, from the
// state before the first of them. An item that was cut changes the ears of its neighbours only, so
// all is linear but for the dynamic program, which has a limit of size and of work.
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

  /// Appends the cells of the polygon of items.
  Cutting cut(const std::vector<Index>& polygon, std::vector<Cell>& cells)
  {
    start(polygon);
    std::optional<std::size_t> safe_cells; // cells before the first cut that may be a mistake
    while (left_ > 3) {
      const bool safe = !safe_.empty();
      std::vector<Index>& waiting = safe ? safe_ : unsafe_;
      if (waiting.empty()) break;
      const Index corner = waiting.back();
      waiting.pop_back();
      waits_[corner] = false;
      const Index face = ear(corner);
      if (face == none) continue;
      if (!safe && !safe_cells) {
        safe_cells = cells.size();
        remember(corner);
      }
      cut_ear(corner, face, cells);
    }
    if (left_ == 3 && finish(cells)) return Cutting::done;
    if (!safe_cells) return Cutting::impossible;
    cells.resize(*safe_cells);
    return cut_by_program(cells);
  }

private:
  Index item(Index corner) const { return (*polygon_)[corner]; }

  Index ear(Index corner) const
  {
    return complex_.common_face(item(previous_[corner]), item(corner), item(next_[corner]));
  }

  void start(const std::vector<Index>& polygon)
  {
    polygon_ = &polygon;
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

  void remember(Index corner)
  {
    reduced_.clear();
    Index i = corner;
    do {
      reduced_.push_back(item(i));
      i = next_[i];
    } while (i != corner);
  }

  /// apex_[i n + j]: the third corner of the triangle on the diagonal (i, j), in a triangulation of
  /// the polygon i, i + 1, ..., j; none if there is no triangulation.
  Cutting cut_by_program(std::vector<Cell>& cells)
  {
    const std::size_t n = reduced_.size();
    if (n > largest_program || work_ + n * n * n / 6 > largest_work) return Cutting::too_large;
    work_ += n * n * n / 6;
    apex_.assign(n * n, none);
    for (std::size_t length = 2; length < n; ++length) {
      for (std::size_t i = 0; i + length < n; ++i) find_apex(i, i + length);
    }
    if (apex_[n - 1] == none) return Cutting::impossible;
    collect(cells);
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

  void collect(std::vector<Cell>& cells)
  {
    const std::size_t n = reduced_.size();
    std::vector<std::array<std::size_t, 2>> open = {{0, n - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j == i + 1) continue;
      const std::size_t k = apex_[i * n + j];
      const std::array<Index, 3> items = {reduced_[i], reduced_[k], reduced_[j]};
      cells.push_back({items, complex_.common_face(items[0], items[1], items[2])});
      open.push_back({i, k});
      open.push_back({k, j});
    }
  }

  const Complex& complex_;
  const std::vector<Index>* polygon_ = nullptr;
  std::vector<Index> previous_, next_, safe_, unsafe_, reduced_, apex_;
  std::vector<bool> waits_;
  std::size_t left_ = 0, work_ = 0;
  Index some_corner_ = 0;
};

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_POLYGON_CUTTER_H
