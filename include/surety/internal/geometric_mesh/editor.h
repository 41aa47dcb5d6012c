// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one door through which M changes: every operation passes all controls, cheapest first, before
// it is made, and can be undone within a transaction.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_EDITOR_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_EDITOR_H

#include <surety/internal/deviation/policy.h>
#include <surety/internal/geometric_mesh/intersection_guard.h>
#include <surety/internal/geometric_mesh/roughness.h>
#include <surety/internal/geometric_mesh/shape.h>
#include <surety/internal/operators/topology.h>

#include <optional>
#include <vector>

namespace surety::internal {

/// An operation that was made: enough to make it again.
struct Step {
  Disc::Kind kind;
  Index halfedge;
  Vector point; ///< where the apex of a closed fan went
  Index anchor;
  Index source, target; ///< of the half-edge, before
  bool is_boundary; ///< whether M complies with the tolerance afterwards: not inside transactions
};

struct Simplification_controls {
  double shape_ratio, shape_floor;
  double roughness_cosine;
  bool allow_self_intersections;
  bool single_precision; ///< vertices that move go to points whose coordinates are floats
  std::vector<Step>* log = nullptr; ///< receives every operation that is not undone
};

/// Makes an operation that was made before, from the same state.
inline void replay(const Step& step, Working_mesh& mesh)
{
  const Index h = step.halfedge;
  switch (step.kind) {
  case Disc::Kind::collapse:
    mesh.collapse(h);
    break;
  case Disc::Kind::flip:
    mesh.flip(h);
    break;
  case Disc::Kind::placement: {
    const Index q = mesh.target(h);
    mesh.collapse(h);
    mesh.move(q, step.point, step.anchor);
    break;
  }
  case Disc::Kind::relocation:
    mesh.move(mesh.source(h), step.point, step.anchor);
    break;
  case Disc::Kind::split: // no operation of a geometric mesh
    break;
  }
}

class Editor
{
public:
  Editor(
      const Reference& reference, Working_mesh& mesh, Deviation_policy& deviation,
      const Simplification_controls& controls, Journal& journal)
    : mesh_(mesh),
      deviation_(deviation),
      journal_(journal),
      log_(controls.log),
      single_precision_(controls.single_precision),
      changed_at_(mesh.number_of_real_vertices(), 0),
      shape_(controls.shape_ratio, controls.shape_floor),
      roughness_(reference, controls.roughness_cosine)
  {}

  /// From now on no operation may make a face that meets another one. Tells whether M has none.
  bool start_guard()
  {
    guard_.emplace(mesh_);
    return guard_->finds_none();
  }
  void stop_guard() { guard_.reset(); }

  const Working_mesh& mesh() const { return mesh_; }
  const Deviation_policy& deviation() const { return deviation_; }
  const Operations& operations() const { return operations_; }

  /// A time that grows as M changes, and the time when M last changed at a vertex, failed
  /// transactions apart.
  Index clock() const { return clock_; }
  Index changed_at(Index v) const { return changed_at_[v]; }

  /// Whether an operation may be made, and why not.
  Verdict check(Disc& disc)
  {
    if (single_precision_ && disc.is_closed())
      for (double& x : disc.apex_point) x = static_cast<float>(x);
    Verdict verdict = check_topology(disc);
    if (verdict == Verdict::accept) verdict = check_geometry(disc);
    if (verdict != Verdict::accept) operations_.refuse(verdict);
    return verdict;
  }

  /// Makes the operation that check() has just accepted.
  void commit(const Disc& disc)
  {
    deviation_.commit(disc);
    const Step step{
        disc.kind,
        disc.halfedge,
        disc.apex_point,
        disc.anchor,
        mesh_.source(disc.halfedge),
        mesh_.target(disc.halfedge),
        !journal_.is_recording()};
    replay(step, mesh_);
    if (log_ != nullptr) log_->push_back(step);
    count(disc.kind);
    if (guard_) guard_->commit(disc);
    if (journal_.is_recording()) {
      note_touched(disc);
      return;
    }
    if (guard_) guard_->clean_up();
    ++clock_;
    touch(disc.apex);
    for (const Index v : disc.ring) touch(v);
  }

  bool try_to(Disc& disc)
  {
    if (check(disc) != Verdict::accept) return false;
    commit(disc);
    return true;
  }

  /// Everything from here on can be undone, until keep() or undo().
  void begin()
  {
    journal_.begin();
    operations_before_ = operations_;
    steps_before_ = log_ != nullptr ? log_->size() : 0;
    touched_vertices_.clear();
    touched_faces_.clear();
    touched_edges_.clear();
  }
  void keep()
  {
    journal_.keep();
    if (log_ != nullptr && log_->size() > steps_before_) log_->back().is_boundary = true;
    if (guard_) guard_->clean_up();
    ++clock_;
    for (const Index f : touched_faces_)
      if (!mesh_.is_ghost_face(f) && mesh_.is_live_face(f))
        for (const Index v : mesh_.vertices_of(f)) touch(v);
  }
  void undo()
  {
    journal_.undo();
    operations_ = operations_before_;
    if (log_ != nullptr) log_->resize(steps_before_);
    if (guard_) guard_->refresh(touched_faces_);
  }
  /// The vertices that the transaction has moved, and the faces and edges that it has touched, with
  /// repetitions; some are gone.
  const std::vector<Index>& touched_vertices() const { return touched_vertices_; }
  const std::vector<Index>& touched_faces() const { return touched_faces_; }
  const std::vector<Index>& touched_edges() const { return touched_edges_; }

private:
  void count(Disc::Kind kind)
  {
    if (kind == Disc::Kind::flip)
      ++operations_.flips;
    else if (kind == Disc::Kind::relocation)
      ++operations_.relocations;
    else
      ++operations_.collapses;
  }
  void touch(Index v)
  {
    if (!mesh_.is_ghost_vertex(v)) changed_at_[v] = clock_;
  }
  Verdict check_topology(Disc& disc) const
  {
    switch (disc.kind) {
    case Disc::Kind::flip:
      return check_flip_topology(mesh_, disc);
    case Disc::Kind::relocation:
      return mesh_.is_fixed(disc.apex) ? Verdict::feature : Verdict::accept;
    case Disc::Kind::collapse:
      return check_collapse_topology(mesh_, disc);
    case Disc::Kind::placement:
      return check_placement_topology(mesh_, disc);
    case Disc::Kind::split:
      break;
    }
    return Verdict::topology;
  }

  Verdict check_geometry(const Disc& disc)
  {
    if (deviation_.is_blocked(disc)) return Verdict::deviation;
    if (!shape_.admits(disc, mesh_)) return Verdict::shape;
    if (!roughness_.admits(disc, mesh_)) return Verdict::roughness;
    const Verdict verdict = deviation_.check(disc);
    if (verdict != Verdict::accept) return verdict;
    if (guard_ && !guard_->admits(disc)) return Verdict::self_intersection;
    return Verdict::accept;
  }

  void note_touched(const Disc& disc)
  {
    if (disc.is_closed()) touched_vertices_.push_back(disc.apex);
    touched_faces_.insert(touched_faces_.end(), disc.old_face.begin(), disc.old_face.end());
    touched_edges_.insert(touched_edges_.end(), disc.old_spoke.begin(), disc.old_spoke.end());
    touched_edges_.insert(touched_edges_.end(), disc.link.begin(), disc.link.end());
  }

  Working_mesh& mesh_;
  Deviation_policy& deviation_;
  Journal& journal_;
  std::vector<Step>* log_;
  bool single_precision_;
  Index clock_ = 0;
  std::vector<Index> changed_at_;
  Shape_control shape_;
  Roughness_control roughness_;
  std::optional<Intersection_guard> guard_;
  Operations operations_, operations_before_;
  std::size_t steps_before_ = 0;
  std::vector<Index> touched_vertices_, touched_faces_, touched_edges_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_EDITOR_H
