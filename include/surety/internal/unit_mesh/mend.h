// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mends bad faces. Flips and relocations lessen a sum over faces, and few bad ones do not weigh in
// it: here the worst face alone counts.
#ifndef SURETY_INTERNAL_UNIT_MESH_MEND_H
#define SURETY_INTERNAL_UNIT_MESH_MEND_H

#include <surety/internal/unit_mesh/editor.h>

namespace surety::internal::unit_mesh {

inline bool Editor::mend(Index f)
{
  const std::array<Index, 3> corners = mesh_.vertices_of(f);
  const Index first = mesh_.halfedge_in(f);
  std::array<Index, 3> side{first, mesh_.next(first), mesh_.prev(first)};
  std::sort(side.begin(), side.end(), [this](Index a, Index b) {
    return length(Working_mesh::edge(a)) > length(Working_mesh::edge(b));
  });
  // The longest edge is that of caps, the shortest that of needles.
  for (const Index h : side)
    if (mend_by_flip(Working_mesh::edge(h))) return true;
  for (const Index v : corners)
    if (mend_by_relocation(v, f)) return true;
  for (int i = 2; i >= 0; --i)
    for (const Index h : {side[i], Working_mesh::opposite(side[i])})
      if (mend_by_collapse(h)) return true;
  return false;
}

inline bool Editor::mend_by_flip(Index e)
{
  if (mesh_.is_border(e)) return false;
  make_flip_disc(mesh_, 2 * e, disc_);
  if (check_flip_topology(mesh_, disc_) != Verdict::accept) return false;
  const Apex apex = apex_of(disc_.apex);
  if (!is_remedy(apex) || check(apex) != Verdict::accept) return false;
  make_flip(e);
  return true;
}

/// Towards where it would make the face equilateral.
inline bool Editor::mend_by_relocation(Index v, Index f)
{
  if (mesh_.is_fixed(v)) return false;
  make_relocation_disc(mesh_, v, disc_);
  const Apex from = apex_of(v);
  const bool is_on_curve = mesh_.is_on_feature(v);
  if (is_on_curve && stand_[v].edge == none) return false;
  Vector aim = from.point;
  for_each_new_face([&](const std::array<Index, 3>& corners) {
    if (!mesh_.has_vertex(f, corners[1]) || !mesh_.has_vertex(f, corners[2])) return;
    aim = measure_.ideal_apex(
        mesh_.point(corners[1]), mesh_.point(corners[2]), from.point,
        {&metric_[v], &metric_[corners[1]], &metric_[corners[2]]});
  });
  for (const double step : {.8, .4, .2, .1}) {
    const Vector target = from.point + step * (aim - from.point);
    const Standpoint stand = is_on_curve ? ground_.nearest_on_curve(target, stand_[v].edge)
                                         : ground_.nearest(target, stand_[v].face);
    const Apex apex = apex_above(stand, share_[v], offset_[v]);
    if (!is_remedy(apex) || check(apex) != Verdict::accept) continue;
    move_apex(apex);
    return true;
  }
  return false;
}

inline bool Editor::mend_by_collapse(Index h)
{
  constexpr double bad = 3;
  make_collapse_disc(mesh_, h, disc_);
  if (check_collapse_topology(mesh_, disc_) != Verdict::accept) return false;
  const Apex apex = apex_of(disc_.apex);
  const double longest = worst_old_quality() > bad ? 2 : longest_unit;
  if (has_long_edge(apex, longest) || !is_remedy(apex) || check(apex) != Verdict::accept)
    return false;
  make_collapse(h);
  return true;
}

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_MEND_H
