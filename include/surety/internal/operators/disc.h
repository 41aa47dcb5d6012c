// SPDX-License-Identifier: GPL-3.0-or-later
//
// The disc that an operator retriangulates: its ring, what goes and what comes. The new faces are a
// fan about an apex. In an *open* fan the apex is the first vertex of the ring: a half-edge
// collapse P -> Q (the star of P becomes a fan about Q) or a flip (two faces become a fan about one
// of their apices). In a *closed* fan the apex is inside the ring: a collapse P -> Q with placement
// (the stars of both become the star of Q) or a relocation of Q.
#ifndef SURETY_INTERNAL_OPERATORS_DISC_H
#define SURETY_INTERNAL_OPERATORS_DISC_H

#include <surety/internal/working_mesh.h>

#include <algorithm>
#include <array>
#include <vector>

namespace surety::internal {

/// With k ring vertices the new faces are F_i = (apex, r_i, r_{i+1}): for i = 1 .. k-2 in an open
/// fan, where r_0 is the apex; for all i, modulo k, in a closed one. The new spoke s_i = (apex,
/// r_i) parts F_{i-1} from F_i.
struct Disc {
  /// A run of consecutive new faces, modulo k where the fan is closed.
  struct Side {
    Index low, count;
  };

  enum class Kind { collapse, flip, placement, relocation, split };

  Kind kind = Kind::collapse;
  Index halfedge = none; ///< P -> Q, or the half-edge that is flipped
  Index apex = none;
  Vector apex_point;    ///< where the apex comes to lie
  Index anchor = none;  ///< a vertex of T near that point
  Index removed = none; ///< P, or none

  std::vector<Index> ring;            ///< r_0, r_1, ..., r_{k-1}, counter-clockwise
  std::vector<Index> link;            ///< edge (r_i, r_{i+1}) of the ring
  std::vector<Index> inner;           ///< its half-edge inside the disc
  std::vector<Index> face;            ///< face[i]: index that F_i takes
  std::vector<Index> spoke;           ///< spoke[i]: index that s_i takes
  std::vector<Index> old_face;        ///< faces of the disc before
  std::vector<Index> old_place;       ///< for each of them, the place in the ring that it touches
  std::vector<Index> old_spoke;       ///< edges inside the disc before
  std::vector<Index> old_spoke_place; ///< the same for these, where the fan is closed

  /// New spokes that carry the ridge or border through the disc, the smaller first, or none. An
  /// open fan has one at most: the ridge leaves it at the apex.
  std::array<Index, 2> ridge{none, none};
  /// Edges inside the disc, before, whose T vertices belong on each of the new ridge spokes.
  std::array<std::array<Index, 2>, 2> old_ridge;
  bool keeps_pin = false; ///< the T vertex that goes to the apex goes there still
  /// Or another one does, which goes to one of the ridge spokes before, so that the apex slides
  /// along the ridge; and the T vertices that it leaves behind, which go to the other.
  Index new_pin = none, new_pin_side = 0;
  std::vector<Index> passed;
  Index first = 1, last = 0; ///< of an open fan: its real faces are F_first .. F_last

  bool is_closed() const { return kind != Kind::collapse && kind != Kind::flip; }
  Index size() const { return static_cast<Index>(ring.size()); }
  Index after(Index i) const { return i + 1 == size() ? 0 : i + 1; }
  Index before(Index i) const { return i == 0 ? size() - 1 : i - 1; }
  bool is_ridge_spoke(Index i) const { return i == ridge[0] || i == ridge[1]; }

  /// The new faces on that side of the ridge on which an old element at a place of the ring lies.
  Side side_of_place(Index place) const
  {
    const auto [left, right] = ridge;
    if (is_closed()) {
      if (left == none) return {0, size()};
      const bool between = left <= place && place < right;
      return between ? Side{left, right - left} : Side{right, size() - (right - left)};
    }
    if (left == none) return {first, last + 1 - first};
    return place < left ? Side{first, left - first} : Side{left, last + 1 - left};
  }

  /// Calls visit(i) for each new face F_i, ghosts included where the fan is closed.
  template <class Visit>
  void for_each_new_face(Visit visit) const
  {
    if (is_closed())
      for (Index i = 0; i < size(); ++i) visit(i);
    else
      for (Index i = first; i <= last; ++i) visit(i);
  }

  /// Position of a vertex in the ring, of a face among the new or the old ones; `none` where it is
  /// not there. Rings are short, so that a scan is the fastest index.
  Index position_in_ring(Index v) const { return position(ring, v); }
  Index position_of_old_face(Index f) const { return position(old_face, f); }
  Index position_of_new_face(Index f) const
  {
    if (is_closed()) return position(face, f);
    for (Index i = 1; i + 1 < size(); ++i)
      if (face[i] == f) return i;
    return none;
  }
  /// Calls visit(i) for each new spoke s_i.
  template <class Visit>
  void for_each_new_spoke(Visit visit) const
  {
    const Index low = is_closed() ? 0 : 2, high = is_closed() ? size() : size() - 1;
    for (Index i = low; i < high; ++i) visit(i);
  }

  /// The new face on the inner side of link edge i.
  Index fan_face_at_link(Index i) const
  {
    return is_closed() ? i : std::clamp<Index>(i, 1, size() - 2);
  }

  /// Puts the apex where it is before the operation.
  void stay_at(const Working_mesh& mesh)
  {
    apex_point = mesh.point(apex);
    anchor = mesh.anchor(apex);
  }
  /// Where a vertex of M lies after the operation.
  const Vector& point(const Working_mesh& mesh, Index v) const
  {
    return v == apex ? apex_point : mesh.point(v);
  }

  void clear()
  {
    for (auto* list :
         {&ring, &link, &inner, &face, &spoke, &old_face, &old_place, &old_spoke, &old_spoke_place})
      list->clear();
    removed = none;
    ridge = {none, none};
    keeps_pin = false;
    new_pin = none;
    passed.clear();
  }

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
  disc.clear();
  disc.kind = Disc::Kind::collapse;
  disc.halfedge = h;
  disc.removed = mesh.source(h);
  disc.apex = mesh.target(h);
  disc.stay_at(mesh);
  disc.keeps_pin = true;
  Index spoke = h;
  do {
    disc.old_place.push_back(disc.size());
    disc.ring.push_back(mesh.target(spoke));
    disc.link.push_back(mesh.edge(mesh.next(spoke)));
    disc.inner.push_back(mesh.next(spoke));
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
  disc.clear();
  disc.kind = Disc::Kind::flip;
  disc.halfedge = h;
  disc.ring = {mesh.target(bc), mesh.target(ca), mesh.target(ad), mesh.target(db)};
  disc.apex = disc.ring[0];
  disc.stay_at(mesh);
  disc.keeps_pin = true;
  disc.link = {mesh.edge(ca), mesh.edge(ad), mesh.edge(db), mesh.edge(bc)};
  disc.inner = {ca, ad, db, bc};
  disc.face = {none, mesh.face(h), mesh.face(o), none};
  disc.spoke = {none, none, mesh.edge(h), none};
  disc.old_face = {mesh.face(h), mesh.face(o)};
  disc.old_place = {0, 1};
  disc.old_spoke = {mesh.edge(h)};
  disc.first = 1;
  disc.last = 2;
}

namespace discs {

/// Appends the part of the star of an apex that lies between two of its half-edges, the faces on
/// the left of each but the last.
inline void append_star(const Working_mesh& mesh, Index first, Index last, Disc& disc)
{
  for (Index h = first;;) {
    disc.old_face.push_back(mesh.face(h));
    disc.old_place.push_back(disc.size());
    disc.old_spoke.push_back(mesh.edge(h));
    disc.old_spoke_place.push_back(disc.size());
    disc.ring.push_back(mesh.target(h));
    disc.link.push_back(mesh.edge(mesh.next(h)));
    disc.inner.push_back(mesh.next(h));
    disc.face.push_back(mesh.face(h));
    disc.spoke.push_back(mesh.edge(h));
    h = mesh.opposite(mesh.prev(h));
    if (h == last) return;
  }
}

/// Where a ridge comes from P's side of the ring, goes along PQ, and leaves on Q's side: there are
/// two new ridge spokes. They are left unset where the ridge runs along an apex of PQ or branches.
inline void find_ridge_of_placement(const Working_mesh& mesh, Index right, Disc& disc)
{
  Index at_p = none, at_q = none, features = 0;
  for (Index i = 0; i < disc.size(); ++i) {
    if (!mesh.is_feature(disc.old_spoke[i])) continue;
    ++features;
    (i < right ? at_p : at_q) = i;
  }
  // Spoke 0 is P's and spoke `right` Q's: next to PQ both are refused, and so are their twins.
  if (features != 2 || at_p == none || at_q == none || at_p == 0 || at_q == right) return;
  if (mesh.is_feature(disc.spoke[0])) return;
  if (mesh.is_feature(mesh.edge(mesh.next(mesh.opposite(disc.halfedge))))) return;
  disc.ridge = {at_p, at_q};
  disc.old_ridge[0] = {disc.old_spoke[at_p], mesh.edge(disc.halfedge)};
  disc.old_ridge[1] = {disc.old_spoke[at_q], none};
  disc.keeps_pin = true;
}

} // namespace discs

/// Fills `disc` with the relocation of vertex q to a point that is still to be chosen.
inline void make_relocation_disc(const Working_mesh& mesh, Index q, Disc& disc)
{
  disc.clear();
  disc.kind = Disc::Kind::relocation;
  disc.apex = q;
  disc.stay_at(mesh);
  const Index h = mesh.opposite(mesh.halfedge_to(q));
  disc.halfedge = h;
  discs::append_star(mesh, h, h, disc);
  Index ridges = 0;
  for (Index i = 0; i < disc.size(); ++i) {
    if (!mesh.is_feature(disc.spoke[i]) || ridges == 2) continue;
    disc.old_ridge[ridges] = {disc.spoke[i], none};
    disc.ridge[ridges++] = i;
  }
  disc.keeps_pin = ridges > 0;
}

/// Fills `disc` with the collapse of P = source of h into Q = its target, at a point that is still
/// to be chosen. The ring goes from the apex left of PQ around P to the one on the right, and back
/// around Q.
inline void make_placement_disc(const Working_mesh& mesh, Index h, Disc& disc)
{
  const Index o = mesh.opposite(h);
  const Index left_of_p = mesh.opposite(mesh.prev(h)), right_of_q = mesh.opposite(mesh.prev(o));
  disc.clear();
  disc.kind = Disc::Kind::placement;
  disc.halfedge = h;
  disc.removed = mesh.source(h);
  disc.apex = mesh.target(h);
  disc.stay_at(mesh);

  // Around P from r_1 up to the face before P -> r_{k-1} -> Q, around Q likewise; where the two
  // meet the spokes of Q survive.
  discs::append_star(mesh, left_of_p, mesh.next(o), disc);
  const Index right = disc.size();
  discs::append_star(mesh, right_of_q, mesh.next(h), disc);
  disc.spoke[0] = mesh.edge(mesh.next(h));
  disc.old_spoke.insert(
      disc.old_spoke.end(), {mesh.edge(h), mesh.edge(mesh.next(h)), mesh.edge(mesh.next(o))});
  disc.old_face.insert(disc.old_face.end(), {mesh.face(h), mesh.face(o)});
  // Left of PQ the ring begins and ends, right of it the two parts meet.
  disc.old_place.insert(disc.old_place.end(), {0, right});
  disc.old_spoke_place.insert(disc.old_spoke_place.end(), {0, 0, right});
  if (mesh.is_feature(mesh.edge(h))) discs::find_ridge_of_placement(mesh, right, disc);
}

/// Fills `disc` with the split of h = a -> b by a vertex that is a corner of four faces then. It
/// lies at a point that is still to be chosen; `with` are the elements that the split will take.
inline void make_split_disc(
    const Working_mesh& mesh, Index h, const Working_mesh::Split_elements& with, Disc& disc)
{
  const Index o = mesh.opposite(h);
  const Index bc = mesh.next(h), ca = mesh.prev(h), ad = mesh.next(o), db = mesh.prev(o);
  const Index left = mesh.face(h), right = mesh.face(o);
  disc.clear();
  disc.kind = Disc::Kind::split;
  disc.halfedge = h;
  disc.apex = with.vertex;
  disc.anchor = none;
  disc.ring = {mesh.target(h), mesh.target(bc), mesh.source(h), mesh.target(ad)};
  disc.link = {mesh.edge(bc), mesh.edge(ca), mesh.edge(ad), mesh.edge(db)};
  disc.inner = {bc, ca, ad, db};
  disc.face = {with.face[0], left, right, with.face[1]};
  disc.spoke = {with.edge[0], with.edge[1], mesh.edge(h), with.edge[2]};
  disc.old_face = {left, right};
  disc.old_place = {0, 2};
  disc.old_spoke = {mesh.edge(h)};
  disc.old_spoke_place = {0};
  if (mesh.is_feature(mesh.edge(h))) disc.ridge = {0, 2};
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_OPERATORS_DISC_H
