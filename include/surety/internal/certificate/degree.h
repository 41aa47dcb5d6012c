// SPDX-License-Identifier: GPL-3.0-or-later
//
// Invariant I4: the map covers every face of M once.
//
// F, linear on each cell, maps the complex S of all cells into M: cells of one triangle of T are
// glued along the diagonals of their polygon and the spokes of its inner item, if they use it, and
// triangles of T along their edges. M is an abstract simplicial complex (two of its faces meet in a
// vertex, an edge or not at all), and an item stands for a point of its closed element. Take F(S)
// as a singular chain, the sum of the affine simplices F|cell, each in its face. A segment of S
// inside T, diagonal, spoke or side, lies in two cells, with opposite orientation; if their faces K
// and K' differ, both its items lie in K and in K', hence so does its image, which is then the same
// simplex for both: it cancels. What remains of the boundary of F(S) comes from borders of T, and
// lies in the border of M, because of the border rule (curves.h). So F(S) is a cycle relative to
// the border, and at an inner point p of a face K its local degree in H_2(M, M - p) = Z is defined
// and is the same for all p in K. If it is not zero, F covers p: otherwise F(S) would be a chain in
// M - p. If it is 1 for every face, F is onto, components and closed surfaces included.
//
// The degree is a homotopy invariant: we may move every item inside its closed element, since this
// keeps cells in their faces, simplices shared by two cells shared, and borders in borders. Items
// on an edge go to its midpoint, items on a face to its centroid. Then each cell of K is a triangle
// with corners among seven points with integer coordinates (6, 0, 0), ..., (3, 3, 0), ..., (2, 2,
// 2) in barycentric coordinates times six. The relative cycle F(S) in (K, boundary of K) covers
// almost every point the same signed number of times, the degree, so the degree is the sum of the
// signed areas of the cells over the area of K: integers, no test point and no rounding. Areas are
// determinants of the coordinates, 216 for K itself. A cell that lies in several faces lies in
// their common edge and has no area: it does not matter which of them it is given to.
//
// Signs are those of the orientations of T and M, so the degree 1 says as well that M is oriented
// as T. A map that covers a face twice, or twice there and once back, may honour a tolerance too;
// we refuse the former, because it is not what a simplification does.
#ifndef SURETY_INTERNAL_CERTIFICATE_DEGREE_H
#define SURETY_INTERNAL_CERTIFICATE_DEGREE_H

#include <surety/internal/certificate/items.h>
#include <surety/internal/certificate/polygon_cutter.h>

namespace surety::internal::checker {

constexpr int area_of_face = 216;

constexpr int signed_area(unsigned p, unsigned q, unsigned r)
{
  constexpr int at[7][3]
      = {{6, 0, 0}, {0, 6, 0}, {0, 0, 6}, {3, 3, 0}, {0, 3, 3}, {3, 0, 3}, {2, 2, 2}};
  const int(&a)[3] = at[p], (&b)[3] = at[q], (&c)[3] = at[r];
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
      + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static_assert(
    signed_area(0, 1, 2) == area_of_face && signed_area(0, 3, 1) == 0
    && signed_area(0, 3, 5) + signed_area(3, 1, 4) + signed_area(3, 4, 5) + signed_area(5, 4, 2)
        == area_of_face);

/// The first face of M that is not covered once, or an empty string.
inline std::string degree_defect(const Items& items, const std::vector<Cell>& cells)
{
  std::vector<std::int64_t> area(items.output().number_of_faces(), 0);
  for (const Cell& cell : cells) {
    area[cell.face] += signed_area(
        items.position_in_face(cell.items[0], cell.face),
        items.position_in_face(cell.items[1], cell.face),
        items.position_in_face(cell.items[2], cell.face));
  }
  for (std::size_t f = 0; f < area.size(); ++f) {
    if (area[f] == area_of_face) continue;
    return "output face " + std::to_string(f) + " is covered "
        + std::to_string(area[f] / area_of_face) + " times instead of once";
  }
  return "";
}

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_DEGREE_H
