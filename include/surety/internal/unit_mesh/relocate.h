// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves a vertex, on its curve or over the surface.
#ifndef SURETY_INTERNAL_UNIT_MESH_RELOCATE_H
#define SURETY_INTERNAL_UNIT_MESH_RELOCATE_H

#include <surety/internal/unit_mesh/editor.h>

namespace surety::internal::unit_mesh {

inline bool Editor::relocate(Index v)
{
  if (mesh_.is_fixed(v)) return false;
  make_relocation_disc(mesh_, v, disc_);
  const Apex from = apex_of(v);
  const auto energy = [&](const Apex& apex) {
    double sum = 0;
    for_each_new_face(
        [&](const std::array<Index, 3>& corners) { sum += shape_energy(quality(corners, apex)); });
    for (const Index r : disc_.ring)
      if (!mesh_.is_ghost_vertex(r)) sum += length_energy(length(r, apex));
    return sum;
  };
  Vector aim = Vector::Zero();
  const bool is_on_curve = mesh_.is_on_feature(v);
  if (is_on_curve) {
    if (disc_.ridge[1] == none || stand_[v].edge == none) return false;
    const Index p = disc_.ring[disc_.ridge[0]], q = disc_.ring[disc_.ridge[1]];
    const double to_p = length(p, from), to_q = length(q, from);
    const Vector& end = mesh_.point(to_p > to_q ? p : q);
    aim = from.point + std::abs(to_p - to_q) / (2 * std::max(to_p, to_q)) * (end - from.point);
  } else {
    int number = 0;
    for_each_new_face([&](const std::array<Index, 3>& corners) {
      aim += measure_.ideal_apex(
          mesh_.point(corners[1]), mesh_.point(corners[2]), from.point,
          {&metric_[v], &metric_[corners[1]], &metric_[corners[2]]});
      ++number;
    });
    aim /= number;
  }

  // Not all of what evens the gaps on both sides of T, for each face has other vertices, too.
  constexpr double gain = 3e-3, evened = .4;
  const double before = energy(from);
  Verdict verdict = Verdict::accept;
  for (const double step : {1., .4, .16}) {
    const Vector target = from.point + step * (aim - from.point);
    const Standpoint stand = is_on_curve ? ground_.nearest_on_curve(target, stand_[v].edge)
                                         : ground_.nearest(target, stand_[v].face);
    Apex apex = apex_above(stand, share_[v], offset_[v]);
    if (!(energy(apex) < (1 - gain) * before)) continue;
    if (places_freely_ && !is_on_curve) shift(apex, evened);
    verdict = check(apex);
    if (verdict != Verdict::accept) continue;
    move_apex(apex);
    return true;
  }
  if (verdict != Verdict::accept) operations_.refuse(verdict);
  return false;
}

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_RELOCATE_H
