// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves a vertex, on its curve or over the surface.
#ifndef SURETY_INTERNAL_UNIT_MESH_RELOCATE_H
#define SURETY_INTERNAL_UNIT_MESH_RELOCATE_H

#include <surety/internal/unit_mesh/editor.h>

namespace surety::internal::unit_mesh {

/// Where the metric middle of the curve's two edges is.
inline Vector Editor::middle_on_curve(const Apex& from) const
{
  const Index p = disc_.ring[disc_.ridge[0]], q = disc_.ring[disc_.ridge[1]];
  const double to_p = length(p, from), to_q = length(q, from);
  const Vector& end = mesh_.point(to_p > to_q ? p : q);
  return from.point + std::abs(to_p - to_q) / (2 * std::max(to_p, to_q)) * (end - from.point);
}

/// The mean of the places that the faces around would like best.
template <class Place>
Vector Editor::mean_place(const Apex& from, Place place) const
{
  Vector sum = Vector::Zero();
  int number = 0;
  for_each_new_face([&](const std::array<Index, 3>& v) {
    sum += place(
        mesh_.point(v[1]), mesh_.point(v[2]), from.point,
        std::array<const Local_metric*, 3>{&metric_[v[0]], &metric_[v[1]], &metric_[v[2]]});
    ++number;
  });
  return sum / number;
}

inline double Editor::energy(const Apex& apex) const
{
  double sum = 0;
  for_each_new_face(
      [&](const std::array<Index, 3>& corners) { sum += shape_energy(quality(corners, apex)); });
  for (const Index r : disc_.ring)
    if (!mesh_.is_ghost_vertex(r)) sum += length_energy(length(r, apex));
  return sum;
}

/// The longest step towards the aim that improves things and is allowed. Where none improves, the
/// verdict is one of shape.
template <class Steps, class Improve>
Verdict Editor::move_towards(
    const Vector& aim, const Apex& from, const Steps& steps, Improve improves)
{
  const bool is_on_curve = from.stand.edge != none;
  Verdict verdict = Verdict::shape;
  for (const double step : steps) {
    const Vector target = from.point + step * (aim - from.point);
    const Standpoint stand = is_on_curve ? ground_.nearest_on_curve(target, from.stand.edge)
                                         : ground_.nearest(target, from.stand.face);
    Apex apex = apex_above(stand, from.share, from.offset);
    if (!improves(apex)) continue;
    verdict = check(apex);
    if (verdict != Verdict::accept) continue;
    move_apex(apex);
    break;
  }
  return verdict;
}

/// Whether a vertex may be moved; makes its disc.
inline bool Editor::begin_relocation(Index v)
{
  if (mesh_.is_fixed(v)) return false;
  make_relocation_disc(mesh_, v, disc_);
  return !mesh_.is_on_feature(v) || (disc_.ridge[1] != none && stand_[v].edge != none);
}

inline bool Editor::relocate(Index v, Aim aim)
{
  if (!begin_relocation(v)) return false;
  const Apex from = apex_of(v);
  const bool is_on_curve = from.stand.edge != none;
  // Not all of what evens the gaps on both sides of T, for each face has other vertices, too.
  constexpr double gain = 3e-3, evened = .4;
  const double before = energy(from);
  const auto improves = [&](Apex& apex) {
    if (!(energy(apex) < (1 - gain) * before)) return false;
    if (places_freely_ && !is_on_curve) shift(apex, evened);
    return true;
  };
  const auto try_to = [&](const Vector& place) {
    constexpr std::array<double, 3> steps{1., .4, .16};
    const Verdict verdict = move_towards(place, from, steps, improves);
    if (verdict != Verdict::accept && verdict != Verdict::shape) operations_.refuse(verdict);
    return verdict == Verdict::accept;
  };
  const auto ideal = [this](const auto&... face) { return measure_.ideal_apex(face...); };
  const auto equilateral
      = [this](const auto&... face) { return measure_.equilateral_apex(face...); };
  if (is_on_curve && try_to(middle_on_curve(from))) return true;
  if (try_to(mean_place(from, ideal))) return true;
  return aim == Aim::shape && try_to(mean_place(from, equilateral));
}

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_RELOCATE_H
