// SPDX-License-Identifier: GPL-3.0-or-later
//
// The disc that an operator retriangulates: its ring, what goes and what comes. The new faces are a
// fan about the first vertex of the ring, which serves a collapse P -> Q (the star of P becomes a
// fan about Q) and a flip (two faces become a fan about one of their apices) alike.
#ifndef SURETY_INTERNAL_OPERATORS_DISC_H
#define SURETY_INTERNAL_OPERATORS_DISC_H

#include <surety/internal/working_mesh.h>

#include <algorithm>
#include <vector>

namespace surety::internal {

/// ring[0] is the apex Q. With k ring vertices the new faces are F_i = (Q, r_i, r_{i+1}) for
/// i = 1 .. k-2, in linear order; the new spoke s_i = (Q, r_i), i = 2 .. k-2, parts F_{i-1} from
/// F_i.
struct Disc {
  std::vector<Index> ring;  ///< r_0 = Q, r_1, ..., r_{k-1}, counter-clockwise
  std::vector<Index> link;  ///< edge (r_i, r_{i+1}) of the ring
  std::vector<Index> face;  ///< face[i] = index that F_i takes; entries 0 and k-1 unused
  std::vector<Index> spoke; ///< spoke[i] = index that s_i takes; entries 0, 1, k-1 unused
  std::vector<Index>
      old_face; ///< faces of the disc before; for a collapse old_face[i] = (P, r_i, r_{i+1})
  std::vector<Index> old_spoke; ///< edges inside the disc before; for a collapse (P, r_i)
  Index removed = none;         ///< P, or none for a flip
  Index ridge = 0;              ///< m where the ridge through P goes on along s_m; 0: no ridge
  Index first = 1, last = 0;    ///< the fan's faces that are not ghosts: F_first .. F_last

  Index size() const { return static_cast<Index>(ring.size()); }
  Index apex() const { return ring[0]; }

  /// Position of an edge in the link, of a vertex in the ring, of a face among the new or the old
  /// ones; `none` where it is not there. Rings are short, so that a scan is the fastest index.
  Index position_in_link(Index e) const { return position(link, e); }
  Index position_in_ring(Index v) const { return position(ring, v); }
  Index position_of_old_face(Index f) const { return position(old_face, f); }
  Index position_of_old_spoke(Index e) const { return position(old_spoke, e); }
  Index position_of_new_face(Index f) const
  {
    for (Index i = 1; i + 1 < size(); ++i)
      if (face[i] == f) return i;
    return none;
  }
  Index position_of_new_spoke(Index e) const
  {
    for (Index i = 2; i + 1 < size(); ++i)
      if (spoke[i] == e) return i;
    return none;
  }

  /// The new face on the inner side of link edge i.
  Index fan_face_at_link(Index i) const { return std::clamp<Index>(i, 1, size() - 2); }

private:
  static Index position(const std::vector<Index>& list, Index value)
  {
    for (Index i = 0; i < list.size(); ++i)
      if (list[i] == value) return i;
    return none;
  }
};

/// Fills `disc` with the collapse of the source of h into its target.
inline void make_collapse_disc(const Working_mesh& mesh, Index h, Disc& disc)
{
  disc.ring.clear(), disc.link.clear(), disc.face.clear();
  disc.spoke.clear(), disc.old_face.clear(), disc.old_spoke.clear();
  disc.removed = mesh.source(h);
  disc.ridge = 0;
  Index spoke = h;
  do {
    disc.ring.push_back(mesh.target(spoke));
    disc.link.push_back(mesh.edge(mesh.next(spoke)));
    disc.old_face.push_back(mesh.face(spoke));
    disc.old_spoke.push_back(mesh.edge(spoke));
    spoke = mesh.opposite(mesh.prev(spoke));
  } while (spoke != h);
  disc.face = disc.old_face;
  disc.spoke = disc.old_spoke;

  disc.first = 1;
  disc.last = disc.size() - 2;
  if (mesh.is_ghost_vertex(disc.ring[1])) ++disc.first;
  if (mesh.is_ghost_vertex(disc.ring.back())) --disc.last;
}

/// Fills `disc` with the flip of h = a -> b into d -> c: a fan about c.
inline void make_flip_disc(const Working_mesh& mesh, Index h, Disc& disc)
{
  const Index o = mesh.opposite(h);
  const Index bc = mesh.next(h), ca = mesh.prev(h), ad = mesh.next(o), db = mesh.prev(o);
  disc.ring = {mesh.target(bc), mesh.target(ca), mesh.target(ad), mesh.target(db)};
  disc.link = {mesh.edge(ca), mesh.edge(ad), mesh.edge(db), mesh.edge(bc)};
  disc.face = {none, mesh.face(h), mesh.face(o), none};
  disc.spoke = {none, none, mesh.edge(h), none};
  disc.old_face = {mesh.face(h), mesh.face(o)};
  disc.old_spoke = {mesh.edge(h)};
  disc.removed = none;
  disc.ridge = 0;
  disc.first = 1;
  disc.last = 2;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_OPERATORS_DISC_H
