// SPDX-License-Identifier: GPL-3.0-or-later
//
// Collapses in the order of their cost while any is admissible (section 2.2 of the paper).
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_GREEDY_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_GREEDY_H

#include <surety/internal/deviation/direct_bound.h>
#include <surety/internal/geometric_mesh/editor.h>
#include <surety/internal/geometric_mesh/quadric.h>
#include <surety/internal/geometric_mesh/surface_walk.h>
#include <surety/internal/geometric_mesh/vertex_queue.h>
#include <surety/parameters.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace surety::internal {

/// Told the stage and the share of it that is done; false cancels.
using Report_progress = std::function<bool(const char* stage, double fraction)>;

/// Until when a collapse stays refused, as long as nothing about it changes: up to a share of the
/// tolerance, in eighths of an octave, or for good.
class Refusal
{
public:
  Refusal() = default;
  static Refusal until(double share)
  {
    constexpr double least = -24, most = 7.5;
    const double octave = std::clamp(std::log2(share), least, most);
    return Refusal(static_cast<std::uint8_t>(1 + 8 * (octave - least)));
  }

  bool is_refused() const { return code_ != 0; }
  bool operator<(Refusal other) const { return code_ < other.code_; }

private:
  explicit Refusal(std::uint8_t code) : code_(code) {}

  std::uint8_t code_ = 0;
};

class Greedy
{
public:
  /// Given the bound, vertices are placed freely: the vertex that two become goes where its quadric
  /// is least. Where a bound adds up, what costs least must come first to the last bit.
  Greedy(
      const Reference& reference, Editor& editor, const Direct_bound* free_bound, bool adds_up,
      const Vector& origin)
    : reference_(reference),
      editor_(editor),
      deviation_(editor.deviation()),
      mesh_(editor.mesh()),
      walk_(reference),
      origin_(origin),
      bound_(free_bound),
      adds_up_(adds_up),
      queue_(reference.number_of_vertices()),
      slot_(reference.number_of_vertices(), none),
      best_(reference.number_of_vertices(), none),
      refused_(2 * std::size_t(reference.number_of_edges()))
  {
    initialise_quadrics();
  }

  /// Puts all vertices into the queue, for a stage with a share of the tolerance. What was refused
  /// at a smaller one may be tried again where this one may be enough.
  void start(double share)
  {
    share_ = share;
    const Refusal enough = Refusal::until(share);
    for (Refusal& refusal : refused_)
      if (!(enough < refusal)) refusal = Refusal();
    for (Index v = 0; v < reference_.number_of_vertices(); ++v)
      if (mesh_.is_live_vertex(v)) schedule(v);
  }

  /// Returns false when cancelled; M is valid and certified either way.
  bool run(const Report_progress& report, std::size_t fewest_faces)
  {
    const auto goal = static_cast<double>(std::max<std::size_t>(queue_.size(), 1));
    for (std::size_t tries = 0; !queue_.empty(); ++tries) {
      if (mesh_.number_of_live_faces() <= fewest_faces) return true;
      const double left = std::min(1.0, static_cast<double>(queue_.size()) / goal);
      if (tries % 1024 == 0 && !report("collapse", 1 - left)) return false;
      const Index p = queue_.pop();
      if (best_[p] != none)
        try_collapse(p);
      else
        schedule(p);
    }
    return true;
  }

  /// What a vertex stands for, to be handed over from one to another of the same origin.
  const Quadric& quadric(Index v) const { return quadrics_[slot_[v]]; }
  void set_quadric(Index v, const Quadric& quadric) { quadrics_[slot_[v]] = quadric; }

  /// To be called for what others do to M: vertices of a disc that has changed, and P -> Q.
  void retry_around(const Disc& disc)
  {
    for (const Index v : disc.ring) retry_around(v);
    if (disc.is_closed()) retry_around(disc.apex);
  }
  void retry_around(Index v);
  void merge(Index p, Index q)
  {
    quadrics_[slot_[q]] += quadric(p);
    queue_.remove(p);
  }

  Vector proposal(const Disc& disc) const;

  /// Where the vertex that P and Q become is best according to their quadrics.
  Vector best_place(Index p, Index q) const
  {
    const Vector middle = (mesh_.point(p) + mesh_.point(q)) / 2 - origin();
    return origin() + (quadric(p) + quadric(q)).minimum_near(middle);
  }

private:
  /// The factor by which the tolerance must grow, at least, before what was refused can be
  /// accepted; infinite where that has nothing to do with the tolerance.
  double growth_needed(Verdict verdict) const
  {
    if (verdict == Verdict::deviation) return deviation_.growth_needed();
    if (verdict == Verdict::correspondence) return 1;
    return std::numeric_limits<double>::infinity();
  }

  const Vector& origin() const { return origin_; }
  void initialise_quadrics();
  void schedule(Index p);
  double cost(Index h) const;
  static float magnitude(double cost);
  /// Two interior vertices, or two successive ones on a ridge or border.
  bool can_be_placed(Index h) const
  {
    const Index p = mesh_.source(h), q = mesh_.target(h);
    if (bound_ == nullptr || mesh_.is_fixed(p) || mesh_.is_fixed(q)) return false;
    const bool on_features = mesh_.is_on_feature(p) || mesh_.is_on_feature(q);
    return on_features ? mesh_.is_feature(mesh_.edge(h)) : true;
  }
  void try_collapse(Index p);
  Verdict collapse_with_placement(Index h);

  const Reference& reference_;
  Editor& editor_;
  const Deviation_policy& deviation_;
  const Working_mesh& mesh_;
  Surface_walk walk_;
  Vector origin_;             ///< that quadrics are relative to
  const Direct_bound* bound_; ///< with free placement
  bool adds_up_;
  double share_ = 1; ///< of the tolerance, in this stage

  Vertex_queue queue_;
  std::vector<Index> slot_;       ///< of the quadric of a vertex that is there at first
  std::vector<Quadric> quadrics_; ///< relative to the origin
  std::vector<Index> best_; ///< the cheapest half-edge out of a queued vertex; `none`: not known
  std::vector<Refusal> refused_; ///< of a half-edge since its source's star last changed
  Disc disc_;
};

// Planes count alike whatever the size of their face: where T is fine it is fine for a reason.
inline void Greedy::initialise_quadrics()
{
  Index live = 0;
  for (Index v = 0; v < slot_.size(); ++v)
    if (mesh_.is_live_vertex(v)) slot_[v] = live++;
  quadrics_.resize(live);
  const auto add = [&](Index v, const Quadric& q) {
    if (slot_[v] != none) quadrics_[slot_[v]] += q;
  };
  const auto point = [&](Index v) -> const Vector& { return reference_.point(v); };
  for (Index f = 0; f < reference_.number_of_faces(); ++f) {
    const auto v = reference_.vertices_of_face(f);
    const Quadric q = Quadric::of_plane(point(v[0]) - origin(), reference_.normal_of_face(f), 1);
    for (const Index corner : v) add(corner, q);
  }
  // Feature edges resist by a plane through them, perpendicular to their face.
  for (Index e = 0; e < reference_.number_of_edges(); ++e) {
    if (!mesh_.is_feature(e)) continue;
    const auto [s, t] = reference_.vertices_of_edge(e);
    for (const Index f : reference_.faces_of_edge(e)) {
      if (f == none) continue;
      const Vector side = unit((point(t) - point(s)).cross(reference_.normal_of_face(f)));
      const Quadric q = Quadric::of_plane(point(s) - origin(), side, 1);
      add(s, q);
      add(t, q);
    }
  }
}

/// The quadric error of what p and q stand for where they are to merge, by the length of the edge:
/// of two collapses that err alike the longer one turns the surface less. On flat ground, short
/// edges first.
inline double Greedy::cost(Index h) const
{
  constexpr double flat_ground = 1e-4;
  const Index p = mesh_.source(h), q = mesh_.target(h);
  const double length = (mesh_.point(p) - mesh_.point(q)).norm();
  const Vector x = (can_be_placed(h) && !mesh_.is_on_feature(p) ? best_place(p, q) : mesh_.point(q))
      - origin();
  return (quadric(p)(x) + quadric(q)(x)) / length + flat_ground * length;
}

/// The order of magnitude of a cost, one for every factor of 16. Vertices that agree in it come in
/// the order of their indices, which follow a space-filling curve: successive collapses are
/// neighbours and find their data in the cache, and they leave fewer faces than those in the exact
/// order of their cost.
inline float Greedy::magnitude(double cost)
{
  constexpr int below_all = -1200;
  if (!(cost > 0)) return below_all;
  int exponent = 0;
  std::frexp(cost, &exponent);
  return static_cast<float>((exponent - below_all) / 4);
}

/// Queues p with its cheapest half-edge that has not been refused.
inline void Greedy::schedule(Index p)
{
  if (mesh_.is_fixed(p)) return;
  Index best = none;
  double least = 0;
  mesh_.for_each_outgoing(p, [&](Index h) {
    const Index q = mesh_.target(h);
    if (mesh_.is_ghost_vertex(q) || refused_[h].is_refused()) return;
    const double c = cost(h);
    if (best == none || c < least || (c == least && h < best)) best = h, least = c;
  });
  best_[p] = best;
  if (best == none)
    queue_.remove(p);
  else
    queue_.set(p, adds_up_ ? static_cast<float>(least) : magnitude(least));
}

/// Tells what refused it last.
inline Verdict Greedy::collapse_with_placement(Index h)
{
  make_placement_disc(mesh_, h, disc_);
  const bool is_on_ridge = disc_.keeps_pin;
  const Vector place = proposal(disc_);
  Verdict verdict = Verdict::accept;
  for (const double share : {1.0, 0.5, 0.25}) {
    const Vector& still = mesh_.point(disc_.apex);
    disc_.apex_point = is_on_ridge ? Vector(still + share * (place - still)) : place;
    disc_.anchor = walk_.closest(disc_.apex_point, walk_.face_at(mesh_.anchor(disc_.apex))).nearest;
    verdict = editor_.check(disc_);
    if (verdict == Verdict::accept) editor_.commit(disc_);
    if (verdict == Verdict::accept || !is_on_ridge) break;
  }
  return verdict;
}

/// Where the apex of a placement should go. On a ridge it stays near the vertex of T that it stands
/// for, and does not slide along the ridge.
inline Vector Greedy::proposal(const Disc& disc) const
{
  constexpr double clamp = 0.95;
  const Vector best = best_place(disc.removed, disc.apex);
  if (!disc.keeps_pin) return best;
  const Index pin = bound_->map().pin(disc.apex);
  const Vector& x = reference_.point(pin);
  const Vector along
      = unit(mesh_.point(disc.ring[disc.ridge[1]]) - mesh_.point(disc.ring[disc.ridge[0]]));
  Vector offset = best - x;
  offset -= offset.dot(along) * along;
  const double limit
      = clamp * std::sqrt(std::max(0.0, bound_->tolerance().squared_limit_on_curve(pin)));
  if (offset.norm() > limit) offset *= limit / offset.norm();
  return x + offset;
}

inline void Greedy::try_collapse(Index p)
{
  const Index h = best_[p], q = mesh_.target(h);
  double needed = std::numeric_limits<double>::infinity();
  Verdict verdict = Verdict::feature;
  if (can_be_placed(h)) {
    verdict = collapse_with_placement(h);
    // Where a vertex goes on a ridge depends on the tolerance.
    needed = disc_.keeps_pin ? 1 : growth_needed(verdict);
  }
  if (verdict != Verdict::accept) {
    make_collapse_disc(mesh_, h, disc_);
    verdict = editor_.check(disc_);
    if (verdict == Verdict::accept) editor_.commit(disc_);
    needed = std::min(needed, growth_needed(verdict));
  }
  if (verdict != Verdict::accept) {
    refused_[h] = Refusal::until(share_ * needed);
    schedule(p);
    return;
  }
  quadrics_[slot_[q]] += quadric(p);
  retry_around(disc_);
}

inline void Greedy::retry_around(Index v)
{
  if (mesh_.is_fixed(v)) return;
  mesh_.for_each_outgoing(v, [&](Index h) {
    if (h < refused_.size()) refused_[h] = Refusal();
  });
  // Its turn does not change until it comes: most vertices change many times before.
  if (!adds_up_ && queue_.contains(v))
    best_[v] = none;
  else
    schedule(v);
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_GREEDY_H
