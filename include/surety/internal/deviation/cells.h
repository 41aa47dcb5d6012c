// SPDX-License-Identifier: GPL-3.0-or-later
//
// Invariant I3: the image of the boundary of a T triangle extends over the triangle, cell by cell,
// each cell inside one face of M.
#ifndef SURETY_INTERNAL_DEVIATION_CELLS_H
#define SURETY_INTERNAL_DEVIATION_CELLS_H

#include <surety/internal/deviation/map.h>

#include <algorithm>
#include <vector>

namespace surety::internal {

/// A point on the boundary of a T triangle, by the element of M that holds its image. The faces
/// that contain the element are `face` for an item on a face or edge; a vertex lies in many.
struct Item {
  Element element;
  Index face[2];

  bool is_vertex() const { return element.kind() == Element::Kind::vertex; }
};

/// Searches a triangulation of the polygon of items, in cyclic order, each triangle of which has
/// its three items in one closed face of M. The polygon is in (weakly) convex position on the
/// boundary of a T triangle and maps linearly triangle by triangle, so that any triangulation found
/// is a proof of I3; none found refuses the operation.
///
/// Ears are cut greedily. An ear at a node whose neighbours share a face with it is the step
/// "cancel equal adjacent crossings"; what remains about one pinned corner is its fan. Pinned
/// corners are kept as long as anything else can be cut, since only they can absorb a residue. The
/// residue that no corner absorbs may wind about a vertex of M: winding_vertex().
class Cell_search
{
public:
  /// Faces answers has_vertex(face, vertex), vertices_of(face), face_of(u, v, w),
  /// for_each_face_at(vertex, visit) for the mesh after the operation, and admits(face): whether
  /// the T triangle may have a cell in it. What cannot be cut is left
  /// in `items`.
  template <class Faces>
  bool triangulates(std::vector<Item>& items, const Faces& faces)
  {
    bool cut_vertices = false;
    while (items.size() > 3) {
      const std::size_t before = items.size();
      cut_ears(items, faces, cut_vertices);
      if (items.size() < before) {
        cut_vertices = false;
        // The next pass starts elsewhere, so that ears across the seam are seen.
        std::rotate(items.begin(), items.begin() + 2, items.end());
      } else if (rotations_++ < 1) {
        std::rotate(items.begin(), items.begin() + 2, items.end());
        continue;
      } else if (!cut_vertices) {
        cut_vertices = true;
      } else {
        rotations_ = 0;
        return false;
      }
      rotations_ = 0;
    }
    rotations_ = 0;
    return in_one_face(items[0], items[1], items[2], faces);
  }

  /// For what triangulates() left of a polygon: the vertex W of M about which it winds, so that the
  /// cells (c, item, next item) lie in one closed face of M each once a point c of the T triangle
  /// goes to W. `none` where there is no such vertex.
  template <class Faces>
  static Index winding_vertex(const std::vector<Item>& items, const Faces& faces)
  {
    Index found = none;
    const auto try_corners = [&](Index f) {
      if (f == none || found != none || !lies_in(items[1], f, faces)) return;
      for (const Index w : faces.vertices_of(f))
        if (winds_about(w, items, faces)) found = w;
    };
    if (items[0].is_vertex())
      faces.for_each_face_at(items[0].element.id(), try_corners);
    else
      for (const Index f : items[0].face) try_corners(f);
    return found;
  }

  template <class Faces>
  static bool in_one_face(const Item& a, const Item& b, const Item& c, const Faces& faces)
  {
    const Item& guide = !a.is_vertex() ? a : !b.is_vertex() ? b : c;
    if (guide.is_vertex())
      return faces.face_of(a.element.id(), b.element.id(), c.element.id()) != none;
    for (const Index f : guide.face)
      if (f != none && lies_in(a, f, faces) && lies_in(b, f, faces) && lies_in(c, f, faces)
          && faces.admits(f))
        return true;
    return false;
  }

private:
  template <class Faces>
  static bool winds_about(Index w, const std::vector<Item>& items, const Faces& faces)
  {
    const Item centre{Element(Element::Kind::vertex, w), {none, none}};
    for (std::size_t i = 0; i < items.size(); ++i)
      if (!in_one_face(items[i], items[(i + 1) % items.size()], centre, faces)) return false;
    return true;
  }

  template <class Faces>
  static bool lies_in(const Item& item, Index f, const Faces& faces)
  {
    if (item.is_vertex()) return faces.has_vertex(f, item.element.id());
    return item.face[0] == f || item.face[1] == f;
  }

  template <class Faces>
  void cut_ears(std::vector<Item>& items, const Faces& faces, bool cut_vertices)
  {
    std::size_t top = 0;
    std::size_t left = items.size();
    for (std::size_t i = 0; i < items.size(); ++i) {
      items[top++] = items[i];
      while (top >= 3 && left > 3 && (cut_vertices || !items[top - 2].is_vertex())
             && in_one_face(items[top - 3], items[top - 2], items[top - 1], faces)) {
        items[top - 2] = items[top - 1];
        --top, --left;
      }
    }
    items.resize(top);
  }

  int rotations_ = 0;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_CELLS_H
