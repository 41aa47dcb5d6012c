// SPDX-License-Identifier: GPL-3.0-or-later
//
// The loop of the geometric mesh (section 2 of the paper): collapses in the order of their cost
// while any is admissible, then flips that make room for more, and again.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_SIMPLIFIER_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_SIMPLIFIER_H

#include <surety/internal/deviation/policy.h>
#include <surety/internal/geometric_mesh/intersection_guard.h>
#include <surety/internal/geometric_mesh/quadric.h>
#include <surety/internal/geometric_mesh/roughness.h>
#include <surety/internal/geometric_mesh/shape.h>
#include <surety/internal/geometric_mesh/vertex_queue.h>
#include <surety/internal/operators/topology.h>
#include <surety/parameters.h>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace surety::internal {

struct Simplification_controls {
  double shape_ratio, shape_floor;
  double roughness_cosine;
  bool allow_self_intersections;
  unsigned flip_rounds;
};

class Simplifier
{
public:
  using Report_progress = std::function<bool(const Progress&)>;

  Simplifier(
      const Reference& reference, Working_mesh& mesh, Deviation_policy& deviation,
      const Simplification_controls& controls, Report_progress report)
    : reference_(reference),
      mesh_(mesh),
      deviation_(deviation),
      controls_(controls),
      shape_(controls.shape_ratio, controls.shape_floor),
      roughness_(reference, controls.roughness_cosine),
      report_(std::move(report)),
      queue_(reference.number_of_vertices()),
      quadric_(reference.number_of_vertices()),
      best_(reference.number_of_vertices(), none),
      refused_(2 * std::size_t(reference.number_of_edges()), false)
  {
    if (!controls.allow_self_intersections) guard_.emplace(reference, mesh);
    initialise_quadrics();
  }

  /// Returns false when the visitor cancelled; M is valid and certified either way.
  bool run()
  {
    for (Index v = 0; v < reference_.number_of_vertices(); ++v) schedule(v);
    if (!collapse_all()) return false;
    for (unsigned round = 0; round < controls_.flip_rounds; ++round) {
      const std::size_t flips = operations_.flips;
      if (!flip_all()) return false;
      if (operations_.flips == flips) break;
      if (!collapse_all()) return false;
    }
    return true;
  }

  const Operations& operations() const { return operations_; }

private:
  const Vector& point(Index v) const { return reference_.point(v); }
  auto points() const
  {
    return [this](Index v) -> const Vector& { return reference_.point(v); };
  }

  void initialise_quadrics();
  void schedule(Index p);
  double cost(Index p, Index q) const;
  bool collapse_all();
  void try_collapse(Index p);
  Verdict check_collapse(Index h);
  Verdict check_geometry();
  bool flip_all();
  void try_flip(Index e);
  bool improves(const Disc& disc) const;
  void retry_around(Index v);
  bool goes_on(const char* stage, double fraction)
  {
    return !report_ || report_({stage, fraction, mesh_.number_of_live_faces()});
  }

  const Reference& reference_;
  Working_mesh& mesh_;
  Deviation_policy& deviation_;
  Simplification_controls controls_;
  Shape_control shape_;
  Roughness_control roughness_;
  std::optional<Intersection_guard> guard_;
  Report_progress report_;
  Operations operations_;

  Vertex_queue queue_;
  std::vector<Quadric> quadric_; ///< relative to the first point
  std::vector<Index> best_;      ///< the cheapest half-edge out of a queued vertex
  std::vector<bool> refused_;    ///< a half-edge refused since its source's star last changed
  Disc disc_;
};

// Planes count alike whatever the size of their face: where T is fine it is fine for a reason.
inline void Simplifier::initialise_quadrics()
{
  const Vector origin = point(0);
  for (Index f = 0; f < reference_.number_of_faces(); ++f) {
    const auto v = reference_.vertices_of_face(f);
    const Quadric q = Quadric::of_plane(point(v[0]) - origin, reference_.normal_of_face(f), 1);
    for (const Index corner : v) quadric_[corner] += q;
  }
  // Feature edges resist by a plane through them, perpendicular to their face.
  for (Index e = 0; e < reference_.number_of_edges(); ++e) {
    if (!mesh_.is_feature(e)) continue;
    const auto [s, t] = reference_.vertices_of_edge(e);
    for (const Index f : reference_.faces_of_edge(e)) {
      if (f == none) continue;
      const Vector side = unit((point(t) - point(s)).cross(reference_.normal_of_face(f)));
      const Quadric q = Quadric::of_plane(point(s) - origin, side, 1);
      quadric_[s] += q;
      quadric_[t] += q;
    }
  }
}

/// The quadric error at q of what p and q stand for, by the length of the edge: of two collapses
/// that err alike the longer one turns the surface less. On flat ground, short edges first.
inline double Simplifier::cost(Index p, Index q) const
{
  constexpr double flat_ground = 1e-4;
  const Vector x = point(q) - point(0);
  const double length = (point(p) - point(q)).norm();
  return (quadric_[p](x) + quadric_[q](x)) / length + flat_ground * length;
}

/// Queues p with its cheapest half-edge that has not been refused.
inline void Simplifier::schedule(Index p)
{
  if (mesh_.is_fixed(p)) return;
  Index best = none;
  double least = 0;
  mesh_.for_each_outgoing(p, [&](Index h) {
    const Index q = mesh_.target(h);
    if (mesh_.is_ghost_vertex(q) || refused_[h]) return;
    const double c = cost(p, q);
    if (best == none || c < least || (c == least && h < best)) best = h, least = c;
  });
  best_[p] = best;
  if (best == none)
    queue_.remove(p);
  else
    queue_.set(p, least);
}

inline bool Simplifier::collapse_all()
{
  const auto goal = static_cast<double>(std::max<std::size_t>(queue_.size(), 1));
  for (std::size_t tries = 0; !queue_.empty(); ++tries) {
    const double left = std::min(1.0, static_cast<double>(queue_.size()) / goal);
    if (tries % 1024 == 0 && !goes_on("collapse", 1 - left)) return false;
    try_collapse(queue_.pop());
  }
  return true;
}

inline void Simplifier::try_collapse(Index p)
{
  const Index h = best_[p];
  const Verdict verdict = check_collapse(h);
  if (verdict != Verdict::accept) {
    operations_.refuse(verdict);
    refused_[h] = true;
    schedule(p);
    return;
  }
  const Index q = mesh_.target(h);
  deviation_.commit(disc_);
  mesh_.collapse(h);
  if (guard_) guard_->commit(disc_);
  quadric_[q] += quadric_[p];
  ++operations_.collapses;
  for (const Index v : disc_.ring) retry_around(v);
}

inline void Simplifier::retry_around(Index v)
{
  if (mesh_.is_fixed(v)) return;
  mesh_.for_each_outgoing(v, [&](Index h) {
    if (h < refused_.size()) refused_[h] = false;
  });
  schedule(v);
}

inline Verdict Simplifier::check_collapse(Index h)
{
  make_collapse_disc(mesh_, h, disc_);
  const Verdict verdict = check_collapse_topology(mesh_, disc_);
  return verdict == Verdict::accept ? check_geometry() : verdict;
}

inline Verdict Simplifier::check_geometry()
{
  if (!shape_.admits(disc_, mesh_, points())) return Verdict::shape;
  if (!roughness_.admits(disc_, mesh_, points())) return Verdict::roughness;
  const Verdict verdict = deviation_.check(disc_);
  if (verdict != Verdict::accept) return verdict;
  if (guard_ && !guard_->admits(disc_)) return Verdict::self_intersection;
  return Verdict::accept;
}

inline bool Simplifier::flip_all()
{
  for (Index e = 0; e < mesh_.number_of_real_edges(); ++e) {
    if (mesh_.is_live_edge(e) && !mesh_.is_border(e) && !mesh_.is_feature(e)) try_flip(e);
    if (e % 4096 == 0 && !goes_on("flip", double(e) / mesh_.number_of_real_edges())) return false;
  }
  return true;
}

/// Whether the flip brings M closer to T, or makes the worse of the two faces better without taking
/// M away from T.
inline bool Simplifier::improves(const Disc& disc) const
{
  constexpr double closer = 0.92, about_as_close = 1.1, rounder = 0.99;
  const auto squared = deviation_.forecast(disc);
  if (squared.after < closer * squared.before) return true;
  if (squared.after > about_as_close * squared.before) return false;
  const Vector &c = point(disc.ring[0]), &a = point(disc.ring[1]), &d = point(disc.ring[2]),
               &b = point(disc.ring[3]);
  const double before = std::max(shape_quality(a, b, c), shape_quality(b, a, d));
  const double after = std::max(shape_quality(c, a, d), shape_quality(c, d, b));
  return after < rounder * before;
}

inline void Simplifier::try_flip(Index e)
{
  const Index h = mesh_.halfedge(e);
  make_flip_disc(mesh_, h, disc_);
  if (!improves(disc_)) return;
  Verdict verdict = check_flip_topology(mesh_, disc_);
  if (verdict == Verdict::accept) verdict = check_geometry();
  if (verdict != Verdict::accept) {
    operations_.refuse(verdict);
    return;
  }
  deviation_.commit(disc_);
  mesh_.flip(h);
  if (guard_) guard_->commit(disc_);
  ++operations_.flips;
  for (const Index v : disc_.ring) retry_around(v);
}

/// Runs the loop; tells the operations, and whether it came to its end. What it keeps beside M is
/// gone when it returns.
inline std::pair<Operations, bool> simplify(
    const Reference& reference, Working_mesh& mesh, Deviation_policy& deviation,
    const Simplification_controls& controls, Simplifier::Report_progress report)
{
  Simplifier simplifier(reference, mesh, deviation, controls, std::move(report));
  const bool is_complete = simplifier.run();
  return {simplifier.operations(), is_complete};
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_SIMPLIFIER_H
