// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order of operations that makes a mesh unit: coarse first, then finer, then only better
// (section 5 of the paper, with its two-step schedule of lengths).
#ifndef SURETY_INTERNAL_UNIT_MESH_REMESHER_H
#define SURETY_INTERNAL_UNIT_MESH_REMESHER_H

#include <surety/internal/unit_mesh/editor.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace surety::internal::unit_mesh {

class Remesher
{
public:
  /// \param goes_on asked between operations, with the share that is done and the number of faces;
  ///   false ends the work
  Remesher(Editor& editor, double collapse_below, std::function<bool(double, std::size_t)> goes_on)
    : editor_(editor), collapse_below_(collapse_below), goes_on_(std::move(goes_on))
  {}

  /// How much of the work is done, for those who watch.
  void set_fraction(double fraction) { fraction_ = fraction; }

  /// The vertices that an edge too short has at both ends, which the tolerance forbids to take
  /// away.
  const std::vector<Index>& blocked() const { return blocked_; }
  bool is_cancelled() const { return is_cancelled_; }

  /// From T to edges of some 1/3 to 2: the bulk of the operations.
  void run_coarse()
  {
    flip();
    collapse(.3, 2);
    flip();
    // Each pass halves what is long; the longest edge of a part can be a thousand units.
    constexpr int most_passes = 20;
    constexpr std::size_t few = 20;
    for (int pass = 0; pass < most_passes && !is_cancelled_; ++pass) {
      const std::size_t splits = split(2);
      collapse(.3, 2);
      flip();
      if (splits < few) break;
      relocate();
    }
  }

  /// One pass with the lengths of a unit mesh; the number of splits and collapses.
  std::size_t run_pass()
  {
    const std::size_t splits = split(longest_unit);
    const std::size_t collapses = collapse(collapse_below_, longest_unit);
    for (int sweep = 0; sweep < 3; ++sweep)
      if (flip() == 0) break;
    relocate();
    return splits + collapses;
  }

  /// Lengths once more, with the limits of unit edges for collapses, too.
  void settle()
  {
    for (int round = 0; round < 2; ++round) {
      collapse(shortest_unit, longest_unit);
      split(longest_unit);
      flip();
      relocate();
    }
  }

  /// Only better: no vertex comes or goes but to mend a face.
  void polish()
  {
    for (int round = 0; round < 4; ++round) {
      mend();
      flip();
      relocate(Editor::Aim::shape);
      mend_edges();
    }
    mend();
    for (int round = 0; round < 3; ++round)
      if (mend_edges() == 0) break;
  }

private:
  using Entry = std::pair<double, Index>; ///< length and edge, or quality and face

  bool may_go_on()
  {
    if (++asked_ % 256 != 0) return !is_cancelled_;
    editor_.clean_up();
    if (goes_on_ && !goes_on_(fraction_, editor_.mesh().number_of_live_faces()))
      is_cancelled_ = true;
    return !is_cancelled_;
  }

  template <class Wanted>
  std::vector<Entry> edges_of_length(const Wanted& is_wanted) const
  {
    std::vector<Entry> edges;
    for (Index e = 0; e < editor_.mesh().number_of_real_edges(); ++e) {
      if (!editor_.is_real(e)) continue;
      const double length = editor_.length(e);
      if (is_wanted(length)) edges.emplace_back(length, e);
    }
    return edges;
  }

  /// The worst or the longest first.
  static void sort_descending(std::vector<Entry>& entries)
  {
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return a.first > b.first || (a.first == b.first && a.second < b.second);
    });
  }

  std::size_t split(double above)
  {
    std::vector<Entry> edges = edges_of_length([&](double length) { return length > above; });
    sort_descending(edges);
    std::size_t done = 0;
    for (const auto& [length, e] : edges) {
      if (!may_go_on()) break;
      if (editor_.is_real(e) && editor_.length(e) > above && editor_.split(e)) ++done;
    }
    return done;
  }

  /// Shortest first; what changes is looked at again.
  std::size_t collapse(double below, double longest)
  {
    blocked_.clear();
    std::vector<Entry> edges = edges_of_length([&](double length) { return length < below; });
    const auto later = [](const Entry& a, const Entry& b) {
      return a.first > b.first || (a.first == b.first && a.second > b.second);
    };
    std::priority_queue<Entry, std::vector<Entry>, decltype(later)> queue(later, std::move(edges));
    std::size_t done = 0;
    while (!queue.empty() && may_go_on()) {
      const auto [length, e] = queue.top();
      queue.pop();
      // What has become longer comes again later, what has become shorter is there already.
      if (!editor_.is_real(e)) continue;
      const double now = editor_.length(e);
      if (now >= below) continue;
      if (now > length * (1 + 1e-9)) {
        queue.emplace(now, e);
        continue;
      }
      const Index a = editor_.mesh().source(2 * e), b = editor_.mesh().target(2 * e);
      const Verdict verdict = editor_.collapse(e, longest);
      if (verdict == Verdict::deviation && now < shortest_unit) {
        blocked_.push_back(a);
        blocked_.push_back(b);
      }
      if (verdict != Verdict::accept) continue;
      ++done;
      editor_.mesh().for_each_outgoing(editor_.apex(), [&](Index h) {
        const Index k = Working_mesh::edge(h);
        if (!editor_.is_real(k)) return;
        const double shorter = editor_.length(k);
        if (shorter < below) queue.emplace(shorter, k);
      });
    }
    return done;
  }

  std::size_t flip()
  {
    std::size_t done = 0;
    for (Index e = 0; e < editor_.mesh().number_of_real_edges(); ++e) {
      if (!may_go_on()) break;
      if (editor_.is_real(e) && editor_.flip(e)) ++done;
    }
    return done;
  }

  template <class Try>
  std::size_t for_each_vertex(const Try& try_to)
  {
    std::size_t done = 0;
    for (Index v = 0; v < editor_.mesh().number_of_real_vertices(); ++v) {
      if (!may_go_on()) break;
      if (editor_.mesh().is_live_vertex(v) && try_to(v)) ++done;
    }
    return done;
  }
  std::size_t relocate(Editor::Aim aim = Editor::Aim::length)
  {
    return for_each_vertex([&](Index v) { return editor_.relocate(v, aim); });
  }
  static bool is_unit(double length) { return length >= shortest_unit && length <= longest_unit; }
  std::size_t mend_edges()
  {
    std::vector<Entry> edges = edges_of_length([](double length) { return !is_unit(length); });
    for (Entry& entry : edges) entry.first = std::abs(std::log(entry.first));
    sort_descending(edges);
    std::size_t done = 0;
    for (const auto& [excess, e] : edges) {
      if (!may_go_on()) break;
      if (!is_unit(editor_.length(e)) && editor_.mend_edge(e)) ++done;
    }
    return done;
  }
  std::size_t mend()
  {
    constexpr double good_enough = 1.5;
    std::vector<Entry> faces;
    for (Index f = 0; f < editor_.mesh().number_of_real_faces(); ++f) {
      if (!editor_.mesh().is_live_face(f)) continue;
      const double quality = editor_.quality(f);
      if (quality > good_enough) faces.emplace_back(quality, f);
    }
    sort_descending(faces);
    std::size_t done = 0;
    for (const auto& [quality, f] : faces) {
      if (!may_go_on()) break;
      if (editor_.mesh().is_live_face(f) && editor_.quality(f) > good_enough && editor_.mend(f))
        ++done;
    }
    return done;
  }

  Editor& editor_;
  double collapse_below_;
  std::function<bool(double, std::size_t)> goes_on_;
  double fraction_ = 0;
  std::vector<Index> blocked_;
  std::size_t asked_ = 0;
  bool is_cancelled_ = false;
};

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_REMESHER_H
