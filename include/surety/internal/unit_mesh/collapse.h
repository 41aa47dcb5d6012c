// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removes an end of a short edge; where neither end may take the place of both, a point between
// them does.
#ifndef SURETY_INTERNAL_UNIT_MESH_COLLAPSE_H
#define SURETY_INTERNAL_UNIT_MESH_COLLAPSE_H

#include <surety/internal/unit_mesh/editor.h>

namespace surety::internal::unit_mesh {

inline bool Editor::has_long_edge(const Apex& apex, double longest) const
{
  bool found = false;
  disc_.for_each_new_spoke([&](Index i) {
    const Index r = disc_.ring[i];
    if (!mesh_.is_ghost_vertex(r)) found = found || length(r, apex) > longest;
  });
  return found;
}

inline Verdict Editor::collapse_into(Index h, double longest)
{
  make_collapse_disc(mesh_, h, disc_);
  Verdict verdict = check_collapse_topology(mesh_, disc_);
  const Apex apex = apex_of(disc_.apex);
  if (verdict == Verdict::accept && (has_long_edge(apex, longest) || refuses_shape(apex)))
    verdict = Verdict::shape;
  if (verdict == Verdict::accept) verdict = check(apex);
  if (verdict == Verdict::accept) make_collapse(h);
  return verdict;
}

inline void Editor::make_collapse(Index h)
{
  bound_.commit(disc_);
  mesh_.collapse(h);
  if (guard_) guard_->commit(disc_);
  ++operations_.collapses;
}

/// Both ends go, to a point of the support: the middle between the two, or nearer to Q.
inline Verdict Editor::collapse_to_better_place(Index h, double longest)
{
  make_placement_disc(mesh_, h, disc_);
  Verdict verdict = check_placement_topology(mesh_, disc_);
  if (verdict != Verdict::accept) return verdict;
  const Index p = disc_.removed, q = disc_.apex;
  const bool is_on_curve = mesh_.is_on_feature(q);
  if (is_on_curve && (curve_[Working_mesh::edge(h)] == none)) return Verdict::feature;
  for (const double share : {.5, .75, .25}) {
    const Vector aim = mesh_.point(p) + share * (mesh_.point(q) - mesh_.point(p));
    const Standpoint stand = is_on_curve
        ? ground_.nearest_on_curve(aim, curve_[Working_mesh::edge(h)])
        : ground_.nearest(aim, stand_[q].face);
    Apex apex = apex_above(
        stand, (share_[p] + share_[q]) / 2, is_on_curve ? 0 : (offset_[p] + offset_[q]) / 2);
    if (places_freely_ && !is_on_curve)
      for (int round = 0; round < 2; ++round) shift(apex, .5);
    if (has_long_edge(apex, longest) || refuses_shape(apex)) {
      verdict = Verdict::shape;
      continue;
    }
    verdict = check(apex);
    if (verdict != Verdict::accept) continue;
    bound_.commit(disc_);
    mesh_.collapse(h);
    mesh_.move(q, apex.point, none);
    stand_at(q, apex);
    if (guard_) guard_->commit(disc_);
    ++operations_.collapses;
    return verdict;
  }
  return verdict;
}

inline Verdict Editor::collapse(Index e, double longest)
{
  // The end with the larger size goes first: it is where the mesh is to be coarser.
  const Index a = mesh_.source(2 * e), b = mesh_.target(2 * e);
  const Vector along = mesh_.point(b) - mesh_.point(a);
  const bool b_goes = measure_.length_at(along, metric_[b]) < measure_.length_at(along, metric_[a]);
  const Index first = 2 * e + (b_goes ? 1 : 0);
  Verdict verdict = Verdict::accept;
  for (const Index h : {first, first ^ 1}) {
    const Verdict answer = collapse_into(h, longest);
    if (answer == Verdict::accept) return answer;
    if (verdict != Verdict::deviation) verdict = answer;
  }
  if (verdict == Verdict::feature || verdict == Verdict::topology) {
    operations_.refuse(verdict);
    return verdict;
  }
  const Verdict answer = collapse_to_better_place(first, longest);
  if (answer == Verdict::accept) return answer;
  if (verdict != Verdict::deviation) verdict = answer;
  operations_.refuse(verdict);
  return verdict;
}

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_COLLAPSE_H
