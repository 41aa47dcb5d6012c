// SPDX-License-Identifier: GPL-3.0-or-later
//
// Turns an edge into the other diagonal of its two faces.
#ifndef SURETY_INTERNAL_UNIT_MESH_FLIP_H
#define SURETY_INTERNAL_UNIT_MESH_FLIP_H

#include <surety/internal/unit_mesh/editor.h>

namespace surety::internal::unit_mesh {

inline bool Editor::flip(Index e)
{
  constexpr double good_enough = 3, gain = .02, weight = .5;
  make_flip_disc(mesh_, 2 * e, disc_);
  const Verdict topology = check_flip_topology(mesh_, disc_);
  if (topology != Verdict::accept || mesh_.is_border(e)) return false;
  const Apex apex = apex_of(disc_.apex);
  double before = weight * length_energy(length(e)), worst_before = 1;
  for_each_old_face([&](Index f) {
    const double q = quality(f);
    before += shape_energy(q);
    worst_before = std::max(worst_before, q);
  });
  double after = weight * length_energy(length(disc_.ring[2], apex)), worst_after = 1;
  for_each_new_face([&](const std::array<Index, 3>& v) {
    const double q = quality(v, apex);
    after += shape_energy(q);
    worst_after = std::max(worst_after, q);
  });
  if (!(after < (1 - gain) * before)) return false;
  if (worst_after > good_enough && worst_after > worst_before) return false;
  const Verdict verdict = check(apex);
  if (verdict != Verdict::accept) return refuse(verdict);
  make_flip(e);
  return true;
}

inline void Editor::make_flip(Index e)
{
  bound_.commit(disc_);
  mesh_.flip(2 * e);
  if (guard_) guard_->commit(disc_);
  ++operations_.flips;
}

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_FLIP_H
