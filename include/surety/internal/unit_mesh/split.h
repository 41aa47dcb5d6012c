// SPDX-License-Identifier: GPL-3.0-or-later
//
// Divides a long edge in its metric middle.
#ifndef SURETY_INTERNAL_UNIT_MESH_SPLIT_H
#define SURETY_INTERNAL_UNIT_MESH_SPLIT_H

#include <surety/internal/unit_mesh/editor.h>

namespace surety::internal::unit_mesh {

/// The point of T nearest to one of an edge of M that is on no curve. The walk starts where a
/// vertex of its faces stands that is on none; where that ends too far away, curves bar the way,
/// and other starts may do better.
inline Standpoint Editor::nearest_below(const Vector& p, Index e) const
{
  for (const Index h : {2 * e, 2 * e + 1}) {
    if (mesh_.is_ghost_face(mesh_.face(h))) continue;
    for (const Index v : {mesh_.source(h), mesh_.target(mesh_.next(h))}) {
      if (stand_[v].edge != none || normal_[v].isZero(0)) continue;
      const Standpoint foot = ground_.nearest(p, stand_[v].face);
      if ((ground_.point(foot) - p).norm() <= bound_.tolerance()) return foot;
    }
  }
  return nearest_from_known_faces(p, e);
}

/// Of the faces of T that are known around an edge, from those that look the way that its faces do.
inline Standpoint Editor::nearest_from_known_faces(const Vector& p, Index e) const
{
  Vector looks = Vector::Zero();
  std::vector<Index> known;
  for (const Index h : {2 * e, 2 * e + 1}) {
    if (mesh_.is_ghost_face(mesh_.face(h))) continue;
    const auto corner = mesh_.vertices_of(mesh_.face(h));
    looks += (mesh_.point(corner[1]) - mesh_.point(corner[0]))
                 .cross(mesh_.point(corner[2]) - mesh_.point(corner[0]));
    known.push_back(bound_.seed_of(mesh_.face(h)));
    for (const Index v : corner) {
      if (stand_[v].edge == none && !normal_[v].isZero(0)) known.push_back(stand_[v].face);
      if (stand_[v].edge == none) continue;
      for (const Index f : ground_.faces_beside(stand_[v].edge))
        if (f != none) known.push_back(f);
    }
  }
  constexpr double agrees = .7; // what a face beside a ridge does not
  looks = unit(looks);
  double most = -1, least = std::numeric_limits<double>::infinity();
  for (const Index f : known) most = std::max(most, looks.dot(ground_.normal_of_face(f)));
  Standpoint best;
  for (const Index f : known) {
    if (looks.dot(ground_.normal_of_face(f)) < std::min(most, agrees)) continue;
    const Standpoint foot = ground_.nearest(p, f);
    const double distance = (ground_.point(foot) - p).squaredNorm();
    if (distance < least) least = distance, best = foot;
  }
  return best;
}

/// The point of the ground below the metric middle of an edge: where both halves are as long.
inline std::optional<Editor::Apex> Editor::middle_of(Index e) const
{
  const Index a = mesh_.source(2 * e), b = mesh_.target(2 * e);
  const Vector along = mesh_.point(b) - mesh_.point(a);
  double t = .5;
  if (measure_.counts_both(metric_[a], metric_[b])) {
    // Sizes are linear between a and b; r is their ratio.
    const double r = measure_.length_at(along, metric_[a]) / measure_.length_at(along, metric_[b]);
    if (std::abs(r - 1) > 1e-6) t = (std::sqrt(r) - 1) / (r - 1);
  }
  const Vector middle = mesh_.point(a) + std::clamp(t, .2, .8) * along;
  const double share = (share_[a] + share_[b]) / 2;
  if (mesh_.is_feature(e)) {
    if (curve_[e] == none) return std::nullopt;
    return apex_at(ground_.nearest_on_curve(middle, curve_[e]), middle, share);
  }
  return apex_at(nearest_below(middle, e), middle, share);
}

inline bool Editor::split(Index e)
{
  constexpr double longest_half = .85, cap = 8;
  if (is_whole(e)) return false;
  // A flat face with a longer edge is mended there first: else caps are split for ever.
  for (const Index h : {2 * e, 2 * e + 1}) {
    const Index f = mesh_.face(h);
    if (mesh_.is_ghost_face(f) || quality(f) < cap) continue;
    const double here = length(e);
    for (const Index k : {mesh_.next(h), mesh_.prev(h)})
      if (length(Working_mesh::edge(k)) > here) return refuse(Verdict::shape);
  }
  const auto with = mesh_.elements_for_split(2 * e);
  make_split_disc(mesh_, 2 * e, with, disc_);
  auto apex = middle_of(e);
  if (!apex) return refuse(Verdict::feature);

  const Vector middle = apex->point;
  const Vector above = apex_above(apex->stand, apex->share, mean_offset(2 * e, *apex)).point;
  const Index a = mesh_.source(2 * e), b = mesh_.target(2 * e);
  const double whole = (mesh_.point(b) - mesh_.point(a)).norm();
  Verdict verdict = Verdict::shape;
  for (const double share : {0., .5, .75, 1.}) {
    apex->point = above + share * (middle - above);
    // Metric lengths may add up to more than the whole, where sizes are small in the middle.
    if (std::max((apex->point - mesh_.point(a)).norm(), (apex->point - mesh_.point(b)).norm())
        > longest_half * whole) {
      verdict = Verdict::shape;
      continue;
    }
    verdict = check(*apex);
    if (verdict != Verdict::accept) continue;
    apex->offset = (apex->point - ground_.support_point(apex->stand)).dot(apex->normal);
    bound_.commit(disc_);
    mesh_.split(2 * e, with, apex->point, none);
    stand_at(with.vertex, *apex);
    for (const Index i : with.edge)
      if (i >= curve_.size()) curve_.resize(i + 1, none);
    curve_[with.edge[0]] = curve_[e] = apex->stand.edge;
    curve_[with.edge[1]] = curve_[with.edge[2]] = none;
    if (guard_) guard_->commit(disc_);
    ++operations_.splits;
    return true;
  }
  return refuse(verdict);
}

} // namespace surety::internal::unit_mesh

#endif // SURETY_INTERNAL_UNIT_MESH_SPLIT_H
