// SPDX-License-Identifier: GPL-3.0-or-later
//
// Principal curvatures of a patch, from its first and second fundamental forms.
#ifndef SURETY_INTERNAL_SUPPORT_CURVATURE_H
#define SURETY_INTERNAL_SUPPORT_CURVATURE_H

#include <surety/curvature_field.h>
#include <surety/internal/support/evaluation.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <cmath>

namespace surety::internal {

/// \brief The symmetric eigenproblem of the shape operator in an orthonormal frame of the tangent
/// plane; all zero where the patch has no tangent plane.
///
/// The frame is (t, n x t) with t along v; a combination x t + y (n x t) has coordinates in (v, w)
/// by the triangular matrix of Gram and Schmidt.
inline Side_curvature curvature_of(const Jet& jet, const Vector& normal)
{
  Side_curvature result;
  result.normal = normal;
  const double length = jet.v.norm();
  const Vector t = unit(jet.v), b = normal.cross(t);
  const double along = jet.w.dot(t), height = jet.w.dot(b);
  if (!(length > 0) || !(std::abs(height) > 1e-10 * jet.w.norm())) return result;
  // d/dt = v/length; d/db = (w - along d/dt)/height.
  const double vv = jet.vv.dot(normal), vw = jet.vw.dot(normal), ww = jet.ww.dot(normal);
  const double tt = vv / (length * length), tw = vw / length;
  const double tb = (tw - along * tt) / height;
  const double bb = (ww - 2 * along * tw + along * along * tt) / (height * height);
  Eigen::Matrix2d shape;
  shape << tt, tb, tb, bb;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(shape);
  const Eigen::Vector2d least = solver.eigenvectors().col(0);
  result.min_curvature = solver.eigenvalues()[0];
  result.max_curvature = solver.eigenvalues()[1];
  result.min_direction = unit(least[0] * t + least[1] * b);
  result.max_direction = normal.cross(result.min_direction);
  if (result.min_curvature == 0 && result.max_curvature == 0)
    result.type = Point_type::planar;
  else if (result.gaussian_curvature() == 0)
    result.type = Point_type::parabolic;
  else if (result.gaussian_curvature() > 0)
    result.type = Point_type::elliptic;
  else
    result.type = Point_type::hyperbolic;
  return result;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_CURVATURE_H
