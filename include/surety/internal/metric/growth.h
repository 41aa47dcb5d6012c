// SPDX-License-Identifier: GPL-3.0-or-later
//
// How fast the principal curvatures of a field change over its mesh. A field tells the derivative
// of each along its own direction; the one across follows from the values at neighbouring vertices.
#ifndef SURETY_INTERNAL_METRIC_GROWTH_H
#define SURETY_INTERNAL_METRIC_GROWTH_H

#include <surety/curvature_field.h>
#include <surety/internal/metric/sizes.h>
#include <surety/internal/metric/tensor.h>

#include <CGAL/boost/graph/iterator.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace surety::internal::metric {

/// \brief The gradient of a function on a surface, fitted to its values at neighbours.
///
/// Least squares of the slopes along edges: units of length cancel in the matrix.
class Gradient_fit
{
public:
  explicit Gradient_fit(const Vector& normal) : basis_(tangent_basis(normal)) {}

  void add(const Vector& edge, double difference)
  {
    const double length = edge.norm();
    if (!(length > 0)) return;
    const double x = edge.dot(basis_[0]) / length, y = edge.dot(basis_[1]) / length;
    xx_ += x * x;
    xy_ += x * y;
    yy_ += y * y;
    xz_ += x * (difference / length);
    yz_ += y * (difference / length);
  }

  /// Zero where the edges do not span the plane.
  Vector gradient() const
  {
    const double determinant = xx_ * yy_ - xy_ * xy_, trace = xx_ + yy_;
    if (!(determinant > 1e-4 * trace * trace)) return Vector::Zero();
    return (yy_ * xz_ - xy_ * yz_) / determinant * basis_[0]
        + (xx_ * yz_ - xy_ * xz_) / determinant * basis_[1];
  }

private:
  std::array<Vector, 2> basis_;
  double xx_ = 0, xy_ = 0, yy_ = 0, xz_ = 0, yz_ = 0;
};

/// The gradients of both curvatures at a side, the smaller curvature's first.
template <class Mesh, class Points, class Vertex>
std::array<Vector, 2> curvature_gradients(
    const Mesh& mesh, const Points& points, const Curvature_field& field, Vertex v,
    std::uint32_t side, const Vector& normal)
{
  const Vector p = to_vector(get(points, v));
  const Side_curvature& here = field.side[side];
  Gradient_fit min_fit(normal), max_fit(normal);
  for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
    if (field.sides.of_corner[h] != side) continue;
    for (const auto corner : {prev(h, mesh), next(h, mesh)}) {
      const Side_curvature& there = field.side[field.sides.of_corner[corner]];
      const Vector edge = to_vector(get(points, target(corner, mesh))) - p;
      min_fit.add(edge, there.min_curvature - here.min_curvature);
      max_fit.add(edge, there.max_curvature - here.max_curvature);
    }
  }
  return {min_fit.gradient(), max_fit.gradient()};
}

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

template <class Mesh, class Points, class Vertex>
Principal_growth principal_growth(
    const Mesh& mesh, const Points& points, const Curvature_field& field, Vertex v,
    std::uint32_t side, const Vector& normal)
{
  const Side_curvature& c = field.side[side];
  const auto [min_gradient, max_gradient]
      = curvature_gradients(mesh, points, field, v, side, normal);
  const Vector max_direction = tangent_or_any(c.max_direction, normal);
  const Vector min_direction = normal.cross(max_direction);
  const double max_across = std::abs(max_gradient.dot(min_direction));
  const double min_across = std::abs(min_gradient.dot(max_direction));
  const double max_along = std::abs(c.max_derivative), min_along = std::abs(c.min_derivative);

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
