// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unit normals of faces, and of the sectors that feature edges cut out of the faces round a vertex.
#ifndef SURETY_INTERNAL_FEATURES_NORMALS_H
#define SURETY_INTERNAL_FEATURES_NORMALS_H

#include <surety/internal/linear.h>

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surety {
namespace internal {

/// The angle between two vectors, from 0 to pi; accurate near both ends, where an arc cosine is
/// not.
inline double angle_between(const Vector& a, const Vector& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The unit normal of a triangle, zero for a flat one. Sides are divided by their largest
/// component first: no size of triangle can overflow or underflow, and the result is the same, to
/// the last bit, for a triangle scaled by a power of two.
inline Vector unit_normal(const Vector& p, const Vector& q, const Vector& r)
{
  const Vector u = q - p, v = r - p;
  const double size = (std::max)(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff());
  if (!(size > 0)) return Vector::Zero();
  return unit((u / size).cross(v / size));
}

/// The unit normals of all faces, by face index.
template <class Mesh, class Points>
std::vector<Vector> face_normals(const Mesh& mesh, const Points& points)
{
  std::vector<Vector> normals(num_faces(mesh), Vector::Zero());
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    normals[f] = unit_normal(
        to_vector(get(points, source(h, mesh))), to_vector(get(points, target(h, mesh))),
        to_vector(get(points, target(next(h, mesh), mesh))));
  }
  return normals;
}

/// \brief The normal of the sector that begins with the corner of `first`, at its target.
///
/// `corners` lists one halfedge a corner of the sector. Each face counts by its angle, so that the
/// normal does not depend on how the surface is cut into triangles.
template <class Mesh, class Points, class Halfedge>
Vector sector_normal(
    const Mesh& mesh, const Points& points, const std::vector<Vector>& normals,
    const std::vector<Halfedge>& corners)
{
  Vector sum = Vector::Zero();
  for (const Halfedge h : corners) {
    const Vector p = to_vector(get(points, target(h, mesh)));
    const double angle = angle_between(
        unit(to_vector(get(points, source(h, mesh))) - p),
        unit(to_vector(get(points, target(next(h, mesh), mesh))) - p));
    sum += angle * normals[face(h, mesh)];
  }
  return unit(sum);
}

/// The corners of the sector that holds the corner of `inside`, in order round its target.
template <class Mesh, class Halfedge>
std::vector<Halfedge> sector(const Mesh& mesh, const std::vector<bool>& is_feature, Halfedge inside)
{
  const auto ends_sector
      = [&](Halfedge h) { return is_feature[edge(h, mesh)] || CGAL::is_border_edge(h, mesh); };
  Halfedge first = inside;
  while (!ends_sector(first)) {
    first = prev(opposite(first, mesh), mesh);
    if (first == inside) break;
  }
  std::vector<Halfedge> corners(1, first);
  for (Halfedge h = first; !ends_sector(next(h, mesh));) {
    h = opposite(next(h, mesh), mesh);
    if (h == first) break;
    corners.push_back(h);
  }
  return corners;
}

} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_FEATURES_NORMALS_H
