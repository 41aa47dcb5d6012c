// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of a geometric support on a lattice in each face, with the triangles between them: for
// pictures, and for whoever needs triangles.
#ifndef SURETY_SUPPORT_TESSELLATION_H
#define SURETY_SUPPORT_TESSELLATION_H

#include <surety/errors.h>
#include <surety/geometric_support.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace surety {

/// Locations by point, and triangles that look the way of their faces.
struct Support_tessellation {
  std::vector<Support_location> location;           ///< of each point
  std::vector<std::array<std::size_t, 3>> triangle; ///< indices of points
};

namespace internal {

/// The lattice of one face: row i has the points whose coordinate 1 is i/n.
inline void tessellate_face(std::uint32_t face, std::size_t n, Support_tessellation& result)
{
  const std::size_t first = result.location.size();
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t j = 0; i + j <= n; ++j) {
      result.location.push_back(
          {face, Eigen::Vector3d(double(n - i - j), double(i), double(j)) / double(n)});
    }
  }
  std::size_t row = first;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = row + n - i + 1;
    for (std::size_t j = 0; i + j < n; ++j) {
      result.triangle.push_back({row + j, next + j, row + j + 1});
      if (i + j + 1 < n) result.triangle.push_back({next + j, next + j + 1, row + j + 1});
    }
    row = next;
  }
}

} // namespace internal

/// \brief Cuts each patch of a support into triangles.
///
/// Faces share no points, since each has its own normals and curvatures there: at ridges, and where
/// patches saturate or were refused. Neighbours have the same points along their common edge, up to
/// rounding. Faces come in order, each with (n + 1)(n + 2)/2 points and n^2 triangles.
///
/// The triangles are as near to the mesh as the support is: `report().deviation` bounds the
/// distance of a tessellation, too, up to the rounding of its points.
///
/// \param subdivisions n, of each edge: at least 1.
/// \throws Invalid_input when it is 0.
inline Support_tessellation tessellate(
    const Geometric_support& support, std::size_t subdivisions = 4)
{
  if (subdivisions == 0) throw Invalid_input("tessellate", "subdivisions", "it is 0");
  Support_tessellation result;
  for (std::uint32_t f = 0; f < support.number_of_faces(); ++f) {
    const bool is_face = support.corners(f)[0] != Support_location::no_face;
    if (is_face) internal::tessellate_face(f, subdivisions, result);
  }
  return result;
}

} // namespace surety

#endif // SURETY_SUPPORT_TESSELLATION_H
