// SPDX-License-Identifier: GPL-3.0-or-later
//
// How fast the principal curvatures of a side change, the larger one first.
#ifndef SURETY_INTERNAL_METRIC_GROWTH_H
#define SURETY_INTERNAL_METRIC_GROWTH_H

#include <surety/curvature_field.h>
#include <surety/internal/metric/sizes.h>
#include <surety/internal/metric/tensor.h>

#include <cmath>

namespace surety::internal::metric {

/// What sizes depend on, and the direction of the larger curvature.
struct Principal_growth {
  Curvature_and_growth values;
  Vector direction;
};

/// Directions that a field leaves open (on planes, on spheres) may be any.
inline Vector tangent_or_any(const Vector& direction, const Vector& normal)
{
  const Vector projected = unit(direction - normal.dot(direction) * normal);
  return projected.isZero(0) ? tangent_basis(normal)[0] : projected;
}

inline Principal_growth principal_growth(const Side_curvature& c, const Vector& normal)
{
  const Vector max_direction = tangent_or_any(c.max_direction, normal);
  const Vector min_direction = normal.cross(max_direction);
  const double max_along = std::abs(c.max_derivative), min_along = std::abs(c.min_derivative);
  const double max_across = std::abs(c.max_cross_derivative);
  const double min_across = std::abs(c.min_cross_derivative);

  const bool is_elliptic = (c.min_curvature > 0 && c.max_curvature > 0)
      || (c.min_curvature < 0 && c.max_curvature < 0);
  const double min = std::abs(c.min_curvature), max = std::abs(c.max_curvature);
  if (max >= min) {
    return {{max, min, is_elliptic, max_along, max_across, min_along, min_across}, max_direction};
  }
  return {{min, max, is_elliptic, min_along, min_across, max_along, max_across}, min_direction};
}

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_GROWTH_H
