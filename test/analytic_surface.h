// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces given by an equation, F = 0, with their curvatures in closed form: what estimates and
// metrics are compared with. The gradient of F points outwards.
#ifndef SURETY_TEST_ANALYTIC_SURFACE_H
#define SURETY_TEST_ANALYTIC_SURFACE_H

#include "meshes.h"

#include <surety/curvature_field.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <functional>

namespace surety::test {

inline Eigen::Vector3d eigen(const Point& p) { return {p.x(), p.y(), p.z()}; }
inline Point cgal(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

struct Analytic_surface {
  using V = Eigen::Vector3d;
  using M = Eigen::Matrix3d;

  const char* name;
  std::function<double(const V&)> value;
  std::function<V(const V&)> gradient;
  std::function<M(const V&)> hessian;

  /// A foot of a point near the surface, by Newton's method along the gradient.
  V projected(V x) const
  {
    for (int step = 0; step < 20; ++step) {
      const V g = gradient(x), way = value(x) / g.squaredNorm() * g;
      x -= way;
      if (way.squaredNorm() <= 1e-24 * x.squaredNorm()) break;
    }
    return x;
  }

  /// The distance of a point near the surface: its nearest point, not only the one along a
  /// gradient.
  double distance(const V& x) const
  {
    V foot = projected(x);
    for (int step = 0; step < 3; ++step) {
      const V n = gradient(foot).normalized(), difference = x - foot;
      foot = projected(foot + (difference - n.dot(difference) * n));
    }
    return (x - foot).norm();
  }

  /// Without derivatives.
  Side_curvature second_order(const V& x) const
  {
    const V g = gradient(x), n = g.normalized();
    const M tangential = M::Identity() - n * n.transpose();
    // The normal gets an eigenvalue of its own, below all others.
    const M shape = -tangential * hessian(x) * tangential / g.norm();
    const double below = -1 - 2 * shape.norm();
    const Eigen::SelfAdjointEigenSolver<M> solver(shape + below * n * n.transpose());
    Side_curvature c;
    c.normal = n;
    c.min_curvature = solver.eigenvalues()[1];
    c.max_curvature = solver.eigenvalues()[2];
    c.min_direction = solver.eigenvectors().col(1);
    c.max_direction = n.cross(c.min_direction);
    c.type = c.min_curvature * c.max_curvature > 0 ? Point_type::elliptic
        : c.min_curvature * c.max_curvature < 0    ? Point_type::hyperbolic
                                                   : Point_type::parabolic;
    return c;
  }

  Side_curvature curvature(const V& x) const
  {
    Side_curvature c = second_order(x);
    const double step = 1e-4;
    const auto there
        = [&](const V& direction) { return second_order(projected(x + step * direction)); };
    const Side_curvature after = there(c.min_direction), before = there(-c.min_direction);
    const Side_curvature left = there(c.max_direction), right = there(-c.max_direction);
    c.min_derivative = (after.min_curvature - before.min_curvature) / (2 * step);
    c.max_cross_derivative = (after.max_curvature - before.max_curvature) / (2 * step);
    c.max_derivative = (left.max_curvature - right.max_curvature) / (2 * step);
    c.min_cross_derivative = (left.min_curvature - right.min_curvature) / (2 * step);
    return c;
  }
};

/// (x/a)^2 + (y/b)^2 + (z/c)^2 = 1
inline Analytic_surface ellipsoid_surface(double a, double b, double c)
{
  using V = Eigen::Vector3d;
  using M = Eigen::Matrix3d;
  const V q(1 / (a * a), 1 / (b * b), 1 / (c * c));
  return {
      "ellipsoid", [q](const V& x) { return x.dot(q.cwiseProduct(x)) - 1; },
      [q](const V& x) -> V { return 2 * q.cwiseProduct(x); },
      [q](const V&) -> M { return 2 * M(q.asDiagonal()); }};
}

inline Analytic_surface sphere_surface(double radius)
{
  Analytic_surface result = ellipsoid_surface(radius, radius, radius);
  result.name = "sphere";
  return result;
}

/// z = x^2 - y^2, as `saddle()`
inline Analytic_surface saddle_surface()
{
  using V = Eigen::Vector3d;
  using M = Eigen::Matrix3d;
  return {
      "saddle", [](const V& x) { return x.z() - x.x() * x.x() + x.y() * x.y(); },
      [](const V& x) -> V {
        return {-2 * x.x(), 2 * x.y(), 1};
      },
      [](const V&) -> M { return V(-2, 2, 0).asDiagonal(); }};
}

/// (sqrt(x^2 + y^2) - major)^2 + z^2 = minor^2, as `torus()`
inline Analytic_surface torus_surface(double major, double minor)
{
  using V = Eigen::Vector3d;
  using M = Eigen::Matrix3d;
  return {
      "torus",
      [=](const V& x) {
        const double q = std::hypot(x.x(), x.y()) - major;
        return q * q + x.z() * x.z() - minor * minor;
      },
      [=](const V& x) -> V {
        const double r = std::hypot(x.x(), x.y()), f = 2 * (r - major) / r;
        return {f * x.x(), f * x.y(), 2 * x.z()};
      },
      [=](const V& x) -> M {
        const double r = std::hypot(x.x(), x.y());
        const V radial(x.x() / r, x.y() / r, 0), around(-radial.y(), radial.x(), 0);
        return 2 * radial * radial.transpose() + 2 * (1 - major / r) * around * around.transpose()
            + 2 * V::UnitZ() * V::UnitZ().transpose();
      }};
}

/// x^2 + y^2 = radius^2
inline Analytic_surface cylinder_surface(double radius)
{
  using V = Eigen::Vector3d;
  using M = Eigen::Matrix3d;
  return {
      "cylinder", [=](const V& x) { return x.x() * x.x() + x.y() * x.y() - radius * radius; },
      [](const V& x) -> V {
        return {2 * x.x(), 2 * x.y(), 0};
      },
      [](const V&) -> M { return V(2, 2, 0).asDiagonal(); }};
}

/// The exact field of a mesh whose vertices lie on a surface without features.
inline Curvature_field exact_field(const Mesh& mesh, const Analytic_surface& surface)
{
  Curvature_field field;
  Features none;
  none.edge.assign(mesh.num_edges(), false);
  none.corner.assign(mesh.num_vertices(), false);
  field.sides = find_sides(mesh, none);
  for (const std::uint32_t v : field.sides.vertex) {
    field.side.push_back(surface.curvature(eigen(mesh.point(Vertex(v)))));
  }
  field.curve.resize(mesh.num_vertices());
  return field;
}

} // namespace surety::test

#endif // SURETY_TEST_ANALYTIC_SURFACE_H
