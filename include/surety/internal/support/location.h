// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of a support, and how to get from one face's coordinates to another's.
#ifndef SURETY_INTERNAL_SUPPORT_LOCATION_H
#define SURETY_INTERNAL_SUPPORT_LOCATION_H

#include <surety/internal/support/flat_mesh.h>

#include <Eigen/Core>

#include <cstdint>

namespace surety {

/// \brief A face and barycentric coordinates in it.
///
/// Coordinate 0 belongs to the source of the face's halfedge, 1 to its target, 2 to the target of
/// the next one, as in CGAL's face locations. They are not negative and add up to 1.
struct Support_location {
  static constexpr std::uint32_t no_face = internal::none;

  std::uint32_t face = no_face;
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();
};

/// The point of a support that a search found.
struct Support_point {
  Support_location location; ///< its face is `no_face` if a filter excluded all faces
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double squared_distance = 0; ///< from the point that was asked for

  bool is_found() const { return location.face != Support_location::no_face; }
};

namespace internal {

/// The same point of edge i in the face across it, which must exist.
inline Support_location across(const Flat_mesh& mesh, const Support_location& from, int i)
{
  const Index place = mesh.neighbour[from.face][i];
  const int j = int(place % 3);
  Support_location to{place / 3, Vector::Zero()};
  to.barycentric[j] = from.barycentric[next_corner(i)];
  to.barycentric[next_corner(j)] = 1 - to.barycentric[j];
  return to;
}

/// The point of an edge at a parameter from 0, its source, to 1.
inline Support_location on_edge(const Flat_mesh& mesh, Index edge, double t)
{
  const Index place = mesh.places[edge][0];
  const int i = int(place % 3);
  Support_location at{place / 3, Vector::Zero()};
  const bool is_along = mesh.is_along(at.face, i);
  at.barycentric[next_corner(i)] = is_along ? t : 1 - t;
  at.barycentric[i] = is_along ? 1 - t : t;
  return at;
}

} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_SUPPORT_LOCATION_H
