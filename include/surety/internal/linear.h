// SPDX-License-Identifier: GPL-3.0-or-later
//
// The few types that every internal header shares: indices, vectors, and the way from a CGAL point
// to a vector.
#ifndef SURETY_INTERNAL_LINEAR_H
#define SURETY_INTERNAL_LINEAR_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <limits>

namespace surety::internal {

using Index = std::uint32_t;
constexpr Index none = std::numeric_limits<Index>::max();

using Vector = Eigen::Vector3d;

template <class Point>
Vector to_vector(const Point& p)
{
  return {p.x(), p.y(), p.z()};
}

/// The unit vector along v, or zero where v has no direction.
inline Vector unit(const Vector& v)
{
  const double length = v.norm();
  return length > 0 ? Vector(v / length) : Vector(Vector::Zero());
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_LINEAR_H
