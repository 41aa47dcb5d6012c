// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mends bad faces and edges. Flips and relocations lessen a sum over faces, and few bad ones do not
// weigh in it: here the worst face alone counts, and of edges what they are too long or too short.
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
  if (!begin_relocation(v)) return false;
  const Apex from = apex_of(v);
  Vector aim = from.point;
  for_each_new_face([&](const std::array<Index, 3>& corners) {
    if (!mesh_.has_vertex(f, corners[1]) || !mesh_.has_vertex(f, corners[2])) return;
    aim = measure_.ideal_apex(
        mesh_.point(corners[1]), mesh_.point(corners[2]), from.point,
        {&metric_[v], &metric_[corners[1]], &metric_[corners[2]]});
  });
  constexpr std::array<double, 4> steps{.8, .4, .2, .1};
  const auto improves = [this](const Apex& apex) { return is_remedy(apex); };
  return move_towards(aim, from, steps, improves) == Verdict::accept;
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

/// How far, in logarithms, the edges around are from being unit.
inline double Editor::excess(const Apex& apex) const
{
  constexpr double limit = .345; // a little below the logarithm of sqrt(2)
  double sum = 0;
  for (const Index r : disc_.ring)
    if (!mesh_.is_ghost_vertex(r)) sum += std::max(0., std::abs(std::log(length(r, apex))) - limit);
  return sum;
}

inline bool Editor::mend_edge(Index e)
{
  constexpr double good_enough = 1.6, gain = .1;
  const double before = length(e);
  for (const Index h : {2 * e, 2 * e + 1}) {
    if (!begin_relocation(mesh_.source(h))) continue;
    const Apex from = apex_of(mesh_.source(h));
    const double most = (1 - gain) * excess(from);
    const double worst = std::max(good_enough, worst_old_quality());
    const auto improves
        = [&](const Apex& apex) { return excess(apex) < most && worst_new_quality(apex) <= worst; };
    // To well within the limits, or just so.
    for (const double shortest : {.85, .78, .72}) {
      const double wanted = before < 1 ? shortest : 1 / shortest;
      const Vector& end = mesh_.point(mesh_.target(h));
      const Vector aim = end + wanted / before * (from.point - end);
      constexpr std::array<double, 1> whole{1.};
      if (move_towards(aim, from, whole, improves) == Verdict::accept) return true;
    }
  }
  return false;
}

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_MEND_H
