// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tests of an operation that need no coordinates: link condition and feature rules.
#ifndef SURETY_INTERNAL_OPERATORS_TOPOLOGY_H
#define SURETY_INTERNAL_OPERATORS_TOPOLOGY_H

#include <surety/internal/operators/disc.h>
#include <surety/operations.h>

namespace surety::internal {

/// Whether P -> Q keeps the surface a surface (Dey, Edelsbrunner, Guha, Nekhayev, 1999): the only
/// common neighbours are the two apices on PQ, and M does not shrink below a tetrahedron.
inline bool satisfies_link_condition(const Working_mesh& mesh, const Disc& disc)
{
  Index common = 0, degree = 0;
  mesh.for_each_outgoing(disc.apex, [&](Index h) {
    ++degree;
    if (disc.position_in_ring(mesh.target(h)) != none) ++common;
  });
  return common == 2 && !(disc.size() == 3 && degree == 3);
}

/// The ridge rule: P has no feature edge, or exactly two of which PQ is one. In the second case
/// sets the disc's ridge to the place of the other one, which the new ridge edge takes.
inline bool satisfies_ridge_rule(const Working_mesh& mesh, Disc& disc)
{
  Index features = 0, other = 0;
  for (Index i = 0; i < disc.size(); ++i)
    if (mesh.is_feature(disc.old_spoke[i])) {
      ++features;
      if (i != 0) other = i;
    }
  if (features == 0) return true;
  // Next to PQ the new ridge edge would fall on one that exists already.
  if (features != 2 || !mesh.is_feature(disc.old_spoke[0]) || other < 2 || other + 2 > disc.size())
    return false;
  disc.ridge[0] = other;
  disc.old_ridge[0] = {disc.old_spoke[0], disc.old_spoke[other]};
  return true;
}

inline Verdict check_collapse_topology(const Working_mesh& mesh, Disc& disc)
{
  if (mesh.is_fixed(disc.removed) || mesh.is_ghost_vertex(disc.apex) || mesh.is_sealed(disc.apex)
      || !satisfies_ridge_rule(mesh, disc))
    return Verdict::feature;
  return satisfies_link_condition(mesh, disc) ? Verdict::accept : Verdict::topology;
}

/// A placement moves Q as well: both ends are free of features, or both lie on one ridge or border
/// whose other two edges leave the disc apart from the apices on PQ.
inline Verdict check_placement_topology(const Working_mesh& mesh, Disc& disc)
{
  const Index p = disc.removed, q = disc.apex;
  if (mesh.is_fixed(p) || mesh.is_fixed(q)) return Verdict::feature;
  if ((mesh.is_on_feature(p) || mesh.is_on_feature(q)) && disc.ridge[1] == none)
    return Verdict::feature;
  Index common = 0;
  mesh.for_each_outgoing(p, [&](Index h) {
    const Index r = mesh.target(h);
    if (r == q) return;
    mesh.for_each_outgoing(q, [&](Index k) { common += mesh.target(k) == r ? 1 : 0; });
  });
  // With two in the ring M would shrink below a tetrahedron.
  return common == 2 && disc.size() > 2 ? Verdict::accept : Verdict::topology;
}

/// Whether the diagonal of a flip's disc is free to go to a place where no edge is.
inline Verdict check_flip_topology(const Working_mesh& mesh, const Disc& disc)
{
  if (mesh.is_feature(disc.old_spoke[0])) return Verdict::feature;
  if (mesh.is_sealed(disc.ring[0]) && mesh.is_sealed(disc.ring[2])) return Verdict::topology;
  bool exists = false;
  mesh.for_each_outgoing(
      disc.apex, [&](Index h) { exists = exists || mesh.target(h) == disc.ring[2]; });
  return exists ? Verdict::topology : Verdict::accept;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_OPERATORS_TOPOLOGY_H
