// SPDX-License-Identifier: GPL-3.0-or-later
//
// Overshoot transactions: a collapse that leaves the tolerance for a while, and the relocations and
// flips that bring its neighbourhood back within it; if they do not, all is undone.
//
// Invariants I1, I3 and I4 and the continuity of phi do not depend on the tolerance, so that every
// step keeps the map sound; before the transaction is kept, all that it has touched is measured
// against the true tolerance, and what it has not touched was within it before.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_TRANSACTION_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_TRANSACTION_H

#include <surety/internal/geometric_mesh/greedy.h>
#include <surety/internal/geometric_mesh/improver.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace surety::internal {

class Transactions
{
public:
  Transactions(
      const Reference& reference, Editor& editor, Direct_bound& bound, Greedy& greedy,
      Improver& improver, bool on_surface)
    : editor_(editor),
      mesh_(editor.mesh()),
      bound_(bound),
      greedy_(greedy),
      improver_(improver),
      on_surface_(on_surface),
      optimizer_(reference, mesh_, bound, on_surface),
      failed_(reference.number_of_edges())
  {}

  Fan_optimizer& optimizer() { return optimizer_; }

  /// Tries all edges once, the most promising first. Returns false when cancelled.
  bool run(double overshoot, const Report_progress& report, std::size_t fewest_faces)
  {
    struct Candidate {
      double predicted;
      Index edge;
      bool operator<(const Candidate& o) const
      {
        return std::tie(predicted, edge) < std::tie(o.predicted, o.edge);
      }
    };
    std::vector<Candidate> candidates;
    for (Index e = 0; e < mesh_.number_of_real_edges(); ++e) {
      if (e % 4096 == 0 && !report("predict", double(e) / mesh_.number_of_real_edges()))
        return false;
      if (!is_eligible(e) || has_failed(e, overshoot)) continue;
      const double predicted = predict(e, overshoot);
      if (predicted <= overshoot * overshoot)
        candidates.push_back({predicted, e});
      else
        remember_failure(e, overshoot);
    }
    std::sort(candidates.begin(), candidates.end());
    std::size_t tried = 0;
    for (const Candidate& candidate : candidates) {
      if (mesh_.number_of_live_faces() <= fewest_faces) return true;
      if (++tried % 64 == 0 && !report("collapse", double(tried) / double(candidates.size())))
        return false;
      if (is_eligible(candidate.edge) && !has_failed(candidate.edge, overshoot)
          && !collapse(candidate.edge, overshoot))
        remember_failure(candidate.edge, overshoot);
    }
    return true;
  }

private:
  static constexpr int most_sweeps = 6;

  bool is_eligible(Index e) const
  {
    if (!mesh_.is_live_edge(e)) return false;
    const Index p = mesh_.source(mesh_.halfedge(e)), q = mesh_.target(mesh_.halfedge(e));
    if (mesh_.is_fixed(p) || mesh_.is_fixed(q)) return false;
    const bool on_features = mesh_.is_on_feature(p) || mesh_.is_on_feature(q);
    return !on_features || (mesh_.is_feature(e) && !on_surface_);
  }

  /// An edge that failed need not be tried again while nothing near it has changed.
  struct Failure {
    Index clock = none;
    float overshoot = 0;
  };
  bool has_failed(Index e, double overshoot) const
  {
    const Failure& failure = failed_[e];
    if (failure.clock == none || overshoot > failure.overshoot) return false;
    const Index h = mesh_.halfedge(e);
    return editor_.changed_at(mesh_.source(h)) <= failure.clock
        && editor_.changed_at(mesh_.target(h)) <= failure.clock;
  }
  void remember_failure(Index e, double overshoot)
  {
    failed_[e] = {editor_.clock(), static_cast<float>(overshoot)};
  }

  /// The largest ratio, squared, that the collapse of an edge would leave; the place is in disc_.
  double predict(Index e, double overshoot)
  {
    const Index h = mesh_.halfedge(e);
    make_placement_disc(mesh_, h, disc_);
    if (mesh_.is_feature(e) && !disc_.keeps_pin) return std::numeric_limits<double>::infinity();
    optimizer_.look_at(disc_);
    return optimizer_.optimize(
        disc_, greedy_.proposal(disc_), Objective::largest, overshoot * overshoot);
  }

  bool collapse(Index e, double overshoot)
  {
    if (!(predict(e, overshoot) <= overshoot * overshoot)) return false;
    const Index p = disc_.removed, q = disc_.apex;
    overshoot_ = overshoot;
    bound_.overshoot(overshoot);
    bound_.begin_transaction();
    editor_.begin();
    const bool done = editor_.try_to(disc_) && repair(q) && is_within_tolerance();
    bound_.overshoot(1);
    if (!done) {
      editor_.undo();
      bound_.forget_transaction();
      return false;
    }
    editor_.keep();
    greedy_.merge(p, q);
    for (const Index v : set_) greedy_.retry_around(v);
    return true;
  }

  /// Flips and relocates Q and its neighbours until all of them are within the tolerance.
  bool repair(Index q)
  {
    set_.assign(1, q);
    mesh_.for_each_outgoing(q, [&](Index h) {
      if (!mesh_.is_ghost_vertex(mesh_.target(h))) set_.push_back(mesh_.target(h));
    });
    double before = std::numeric_limits<double>::infinity();
    for (int sweep = 0; sweep <= most_sweeps; ++sweep) {
      const double ratio = largest_ratio_of_set();
      if (ratio <= 1) return true;
      if (sweep == most_sweeps || (sweep >= 1 && is_hopeless(before, ratio, most_sweeps - sweep)))
        return false;
      before = ratio;
      for (const Index v : set_) {
        flip_around(v);
        improver_.relocate(v, optimizer_, 0.01);
      }
    }
    return false;
  }

  /// Whether the largest distance falls too slowly to come within the tolerance in time.
  static bool is_hopeless(double before, double now, int sweeps_left)
  {
    const double fall = std::sqrt(before) - std::sqrt(now);
    return fall < 0.005 * std::sqrt(before) || std::sqrt(now) - sweeps_left * fall > 1;
  }

  void flip_around(Index v)
  {
    edges_.clear();
    mesh_.for_each_outgoing(v, [&](Index h) {
      if (mesh_.edge(h) < mesh_.number_of_real_edges()) edges_.push_back(mesh_.edge(h));
    });
    for (const Index e : edges_) improver_.flip(e);
  }

  /// Of what maps near the set, to the true tolerance.
  double largest_ratio_of_set()
  {
    bound_.overshoot(1);
    double largest = 0;
    for (const Index v : set_) {
      largest = std::max(largest, bound_.largest_ratio_at_vertex(v));
      mesh_.for_each_outgoing(v, [&](Index h) {
        if (!mesh_.is_ghost_face(mesh_.face(h)))
          largest = std::max(largest, bound_.largest_ratio_on_face(mesh_.face(h)));
        largest = std::max(largest, bound_.largest_ratio_on_edge(mesh_.edge(h)));
      });
    }
    bound_.overshoot(overshoot_);
    return largest;
  }

  /// Measures all that the transaction has touched against the true tolerance.
  bool is_within_tolerance()
  {
    bound_.overshoot(1);
    for (const Index v : editor_.touched_vertices())
      if (mesh_.is_live_vertex(v) && bound_.largest_ratio_at_vertex(v) > 1) return false;
    for (const Index f : editor_.touched_faces())
      if (!mesh_.is_ghost_face(f) && mesh_.is_live_face(f) && bound_.largest_ratio_on_face(f) > 1)
        return false;
    for (const Index e : editor_.touched_edges())
      if (mesh_.is_live_edge(e) && bound_.largest_ratio_on_edge(e) > 1) return false;
    return bound_.largest_inner_ratio_of_transaction() <= 1;
  }

  Editor& editor_;
  const Working_mesh& mesh_;
  Direct_bound& bound_;
  Greedy& greedy_;
  Improver& improver_;
  bool on_surface_;
  Fan_optimizer optimizer_;

  Disc disc_;
  double overshoot_ = 1;
  std::vector<Index> set_, edges_;
  std::vector<Failure> failed_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_TRANSACTION_H
