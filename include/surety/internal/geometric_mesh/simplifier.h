// SPDX-License-Identifier: GPL-3.0-or-later
//
// The loop of the geometric mesh (section 2 of the paper): collapses in the order of their cost
// while any is admissible, then what makes room for more, and again.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_SIMPLIFIER_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_SIMPLIFIER_H

#include <surety/internal/geometric_mesh/smoother.h>
#include <surety/internal/geometric_mesh/transaction.h>

#include <optional>

namespace surety::internal {

struct Simplification_plan {
  unsigned flip_rounds = 3;
  bool places_freely = false;
  /// Factors of the tolerance that transactions may overshoot to, one pass each. Before the last
  /// stage there are none.
  std::vector<double> overshoots;
  std::size_t fewest_faces = 0;
  /// Of relocations and flips for the shape of the faces, at the end of it all.
  unsigned smoothing_sweeps = 0;
  /// Shares of the tolerance, one stage each, growing up to 1 (the loop of section 2.3 of the
  /// paper).
  std::vector<double> stages{1.0};
  /// Whether edges are flipped in all stages, or in the last one only.
  bool flips_in_all_stages = true;
  /// Whether the stages are to be found out, so that the goal is met at a small tolerance.
  bool seeks_goal = false;
  /// Called after each stage; false ends the work.
  std::function<bool(std::size_t stage)> on_stage;
  /// Receives the operations, if there is one.
  std::vector<Step>* log = nullptr;
};

/// When new self-intersections are looked for.
enum class Guarding {
  never,
  /// After the collapses of a stage, when M has few faces and a look at all of them is cheap; what
  /// was done must be done again with the guard if there are any.
  late,
  always
};

enum class Outcome {
  complete,
  cancelled,
  intersects, ///< a late look found self-intersections: to be done again
  unusable    ///< the same, and cancelled
};

class Simplifier
{
public:
  /// Without a direct bound vertices stay where they are.
  Simplifier(
      const Reference& reference, Working_mesh& mesh, Deviation_policy& deviation,
      Direct_bound* direct, const Simplification_controls& controls,
      const Simplification_plan& plan, Guarding guarding, Journal& journal, const Vector& origin,
      std::function<bool(const Progress&)> visitor)
    : mesh_(mesh),
      plan_(plan),
      guarding_(guarding),
      editor_(reference, mesh, deviation, controls, journal),
      greedy_(reference, editor_, plan.places_freely ? direct : nullptr, direct == nullptr, origin),
      improver_(editor_, deviation, plan.flip_rounds > 0, plan.places_freely),
      deviation_(deviation),
      visitor_(std::move(visitor))
  {
    if (direct != nullptr && !plan.overshoots.empty())
      transactions_.emplace(reference, editor_, *direct, greedy_, improver_, !plan.places_freely);
    if (direct != nullptr && plan.smoothing_sweeps > 0)
      smoother_.emplace(reference, editor_, *direct, !plan.places_freely);
    if (guarding == Guarding::always) editor_.start_guard();
  }

  /// M is valid and certified whatever the outcome.
  Outcome run()
  {
    if (plan_.log != nullptr) plan_.log->clear();
    const bool is_complete = plan_.seeks_goal ? seek() : run_stages();
    if (is_complete) return Outcome::complete;
    return intersects_ ? Outcome::intersects : cancel();
  }

  /// Ends before anything else is done.
  Outcome cancel() { return is_guarded() ? Outcome::cancelled : Outcome::unusable; }

  const Operations& operations() const { return editor_.operations(); }
  Greedy& greedy() { return greedy_; }

private:
  bool run_stages()
  {
    for (std::size_t stage = 0; stage < plan_.stages.size(); ++stage) {
      const bool is_last = stage + 1 == plan_.stages.size();
      if (!run_stage(plan_.stages[stage], is_last)) return false;
      if ((is_last || is_done()) && !smooth()) return false;
      if ((plan_.on_stage && !plan_.on_stage(stage)) || is_done()) return true;
    }
    return true;
  }

  /// Lets the tolerance grow until few enough faces are left: fast while there are many too many.
  bool seek()
  {
    for (double share = 0x1p-14;; share *= mesh_.number_of_live_faces() > 4 * goal() ? 2 : 1.15) {
      const bool is_last = share >= 1;
      if (!run_stage(std::min(share, 1.0), is_last || is_near_goal())) return false;
      if (is_last || is_done()) return smooth();
    }
  }

  bool run_stage(double share, bool with_transactions)
  {
    deviation_.set_stage(share);
    edges_swept_at_ = vertices_swept_at_ = 0;
    return run_collapses(share, share >= 1 || plan_.flips_in_all_stages)
        && (!with_transactions || run_transactions());
  }

  bool run_collapses(double share, bool with_flips)
  {
    greedy_.start(share);
    if (guarding_ == Guarding::late) editor_.stop_guard();
    if (!collapse() || !is_guarded()) return false;
    for (unsigned round = 0; with_flips && round < plan_.flip_rounds && !is_done(); ++round) {
      const std::size_t flips = editor_.operations().flips;
      if (!sweep(false)) return false;
      if (editor_.operations().flips == flips) break;
      if (!collapse()) return false;
    }
    return true;
  }

  /// Starts a late guard, and tells whether it comes in time.
  bool is_guarded()
  {
    if (guarding_ == Guarding::late) intersects_ = !editor_.start_guard();
    return !intersects_;
  }

  bool run_transactions()
  {
    if (!transactions_ || is_done()) return true;
    if (!sweep(true) || !collapse()) return false;
    for (const double overshoot : plan_.overshoots) {
      if (is_done()) return true;
      if (!transactions_->run(overshoot, report(), goal()) || !sweep(true) || !sweep(true)
          || !collapse())
        return false;
    }
    return true;
  }

  /// Few enough faces for transactions to bring them to the goal.
  bool is_near_goal() const
  {
    return static_cast<double>(mesh_.number_of_live_faces()) < 1.5 * static_cast<double>(goal());
  }
  bool is_done() const { return mesh_.number_of_live_faces() <= goal(); }
  std::size_t goal() const { return plan_.fewest_faces; }
  bool collapse() { return greedy_.run(report(), goal()); }

  /// Flips edges, and relocates vertices, wherever that helps.
  bool sweep(bool relocates) { return sweep_edges() && (!relocates || sweep_vertices()); }

  bool sweep_edges()
  {
    const Index since = std::exchange(edges_swept_at_, editor_.clock() + 1);
    const Index edges = mesh_.number_of_real_edges();
    for (Index e = 0; e < edges; ++e) {
      if (e % 4096 == 0 && !report()("flip", double(e) / edges)) return false;
      // Whatever changes a face of the edge changes the stars of both ends.
      const Index h = mesh_.halfedge(e);
      if (!mesh_.is_live_edge(e) || editor_.changed_at(mesh_.source(h)) < since
          || editor_.changed_at(mesh_.target(h)) < since)
        continue;
      if (improver_.flip(e)) greedy_.retry_around(improver_.disc());
    }
    return true;
  }

  /// Until nothing gets better, or often enough.
  bool smooth()
  {
    if (!smoother_) return true;
    Index since = 0;
    for (unsigned sweep = 0; sweep < plan_.smoothing_sweeps; ++sweep) {
      const Index now = editor_.clock();
      if (!smooth_vertices(since) || !smooth_edges(since)) return false;
      if (editor_.clock() == now) break;
      since = now + 1;
    }
    return true;
  }

  bool smooth_vertices(Index since)
  {
    const Index vertices = mesh_.number_of_real_vertices();
    for (Index v = 0; v < vertices; ++v) {
      if (v % 4096 == 0 && !report()("smooth", double(v) / vertices)) return false;
      if (editor_.changed_at(v) >= since) smoother_->relocate(v);
    }
    return true;
  }

  bool smooth_edges(Index since)
  {
    const Index edges = mesh_.number_of_real_edges();
    for (Index e = 0; e < edges; ++e) {
      if (e % 4096 == 0 && !report()("smooth", double(e) / edges)) return false;
      const Index h = mesh_.halfedge(e);
      if (mesh_.is_live_edge(e) && editor_.changed_at(mesh_.source(h)) >= since
          && editor_.changed_at(mesh_.target(h)) >= since)
        smoother_->flip(e);
    }
    return true;
  }

  bool sweep_vertices()
  {
    const Index since = std::exchange(vertices_swept_at_, editor_.clock() + 1);
    const Index vertices = mesh_.number_of_real_vertices();
    for (Index v = 0; v < vertices; ++v) {
      if (v % 4096 == 0 && !report()("relocate", double(v) / vertices)) return false;
      if (editor_.changed_at(v) < since) continue;
      if (improver_.relocate(v, transactions_->optimizer(), 0.02))
        greedy_.retry_around(improver_.disc());
    }
    return true;
  }

  Report_progress report() const
  {
    return [this](const char* stage, double fraction) {
      return !visitor_ || visitor_({stage, fraction, mesh_.number_of_live_faces()});
    };
  }

  Working_mesh& mesh_;
  Simplification_plan plan_;
  Guarding guarding_;
  Editor editor_;
  Greedy greedy_;
  Improver improver_;
  Deviation_policy& deviation_;
  std::optional<Transactions> transactions_;
  std::optional<Smoother> smoother_;
  bool intersects_ = false;
  /// What has not changed since the last sweep need not be tried again: the time then.
  Index edges_swept_at_ = 0, vertices_swept_at_ = 0;
  std::function<bool(const Progress&)> visitor_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_SIMPLIFIER_H
