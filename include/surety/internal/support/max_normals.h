// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals of the sides from the faces alone (N. Max, Weights for computing vertex normals from
// facet normals, 1999): the cross product of the two edges of a corner over the product of their
// squared lengths. Exact on spheres. Stands in where no fitted normal is given.
#ifndef SURETY_INTERNAL_SUPPORT_MAX_NORMALS_H
#define SURETY_INTERNAL_SUPPORT_MAX_NORMALS_H

#include <surety/internal/support/flat_mesh.h>

#include <vector>

namespace surety::internal {

/// What a corner adds, times a length that is the same for all corners at its vertex.
inline Vector max_weighted_normal(const Vector& a, const Vector& b)
{
  const double aa = a.squaredNorm(), bb = b.squaredNorm();
  if (!(aa > 0) || !(bb > 0)) return Vector::Zero();
  return (a / aa).cross(b / bb);
}

/// By side. Zero where the corners of a side cancel.
inline std::vector<Vector> max_normals(const Flat_mesh& mesh)
{
  std::vector<Vector> normal(mesh.side_vertex.size(), Vector::Zero());
  for (Index f = 0; f < mesh.faces(); ++f) {
    if (!mesh.is_face(f)) continue;
    for (int i = 0; i < 3; ++i) {
      normal[mesh.side[f][i]]
          += max_weighted_normal(mesh.chord(f, i), -mesh.chord(f, previous_corner(i)));
    }
  }
  for (Vector& n : normal) n = unit(n);
  return normal;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_MAX_NORMALS_H
