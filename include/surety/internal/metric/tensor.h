// SPDX-License-Identifier: GPL-3.0-or-later
//
// Symmetric positive definite 3x3 tensors: a metric at a point. The unit ball {x: x^T M x <= 1} is
// an ellipsoid; its half axes are the sizes along the eigenvectors, 1 / sqrt(eigenvalue).
#ifndef SURETY_INTERNAL_METRIC_TENSOR_H
#define SURETY_INTERNAL_METRIC_TENSOR_H

#include <surety/internal/linear.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>

namespace surety::internal::metric {

using Tensor = Eigen::Matrix3d;

/// A symmetric tensor without the rounding that made it otherwise.
inline Tensor symmetrized(const Tensor& m) { return (m + m.transpose()) / 2; }

/// The tensor of the same size in all directions.
inline Tensor isotropic_tensor(double size) { return Tensor::Identity() / (size * size); }

/// The least size of all directions.
inline double least_size(const Tensor& m)
{
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(m, Eigen::EigenvaluesOnly);
  return 1 / std::sqrt(solver.eigenvalues()[2]);
}

/// Maps the eigenvalues of a symmetric tensor.
template <class Function>
Tensor with_eigenvalues(const Tensor& m, const Function& f)
{
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(m);
  const Eigen::Vector3d mapped = solver.eigenvalues().unaryExpr(f);
  return symmetrized(
      solver.eigenvectors() * mapped.asDiagonal() * solver.eigenvectors().transpose());
}

/// The tensor whose eigenvalues are sizes. It is what is interpolated linearly.
inline Tensor size_tensor(const Tensor& m)
{
  return with_eigenvalues(m, [](double lambda) { return 1 / std::sqrt(lambda); });
}

/// The metric of a tensor of sizes.
inline Tensor metric_of_sizes(const Tensor& h)
{
  return with_eigenvalues(h, [](double size) { return 1 / (size * size); });
}

/// Length of a vector in a metric that is the same all along it.
inline double length_in(const Tensor& m, const Vector& e)
{
  return std::sqrt((std::max)(0., e.dot(m * e)));
}

/// A strict order of tensors, so that the order of two arguments does not matter to the last bit.
inline bool comes_first(const Tensor& a, const Tensor& b)
{
  return std::lexicographical_compare(a.data(), a.data() + 9, b.data(), b.data() + 9);
}

/// \brief A tensor whose unit ball lies in the unit balls of both.
///
/// Simultaneous reduction: with A = L L^T, the eigenvectors of L^-1 B L^-T diagonalise both; each
/// common axis takes the smaller of its two sizes.
inline Tensor intersection(const Tensor& a, const Tensor& b)
{
  if (comes_first(b, a)) return intersection(b, a);
  const Tensor l = a.llt().matrixL();
  const auto lower = l.triangularView<Eigen::Lower>();
  const Tensor half = lower.solve(b);
  const Tensor c = lower.solve(Tensor(half.transpose()));
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(symmetrized(c));
  if (solver.eigenvalues()[2] <= 1) return a;
  if (solver.eigenvalues()[0] >= 1) return b;
  const Tensor axes = l * solver.eigenvectors();
  return symmetrized(axes * solver.eigenvalues().cwiseMax(1).asDiagonal() * axes.transpose());
}

/// Two unit vectors that span the plane normal to a unit vector; continuous but for one normal.
inline std::array<Vector, 2> tangent_basis(const Vector& n)
{
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
  return {
      Vector(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
      Vector(b, sign + n.y() * n.y() * a, -n.y())};
}

/// The eigenvalues of [a b; b c], the larger one first.
inline std::array<double, 2> eigenvalues(double a, double b, double c)
{
  const double mean = (a + c) / 2;
  const double half_difference = std::hypot((a - c) / 2, b);
  const double larger = mean + half_difference;
  // The product of both is the determinant; their difference would cancel.
  return {larger, larger > 0 ? (a / larger) * c - (b / larger) * b : 0};
}

/// \brief The part of a tensor in the plane normal to n; along n its larger size in the plane.
///
/// What a metric says about the direction normal to a surface means nothing for a mesh on it, but
/// edges leave the tangent planes a little, and should not be punished for that.
inline Tensor tangential(const Tensor& m, const Vector& n)
{
  const auto [u, v] = tangent_basis(n);
  const Vector mu = m * u, mv = m * v;
  const double a = u.dot(mu), b = (u.dot(mv) + v.dot(mu)) / 2, c = v.dot(mv);
  const double along_normal = eigenvalues(a, b, c)[1];
  const Tensor uv = u * v.transpose();
  return symmetrized(
      a * u * u.transpose() + b * (uv + uv.transpose()) + c * v * v.transpose()
      + along_normal * n * n.transpose());
}

/// The tensor with two sizes in the plane normal to n, one along a direction and one across it.
inline Tensor tangential(const Vector& n, const Vector& direction, double along, double across)
{
  const Vector other = n.cross(direction);
  const double larger = (std::max)(along, across);
  return symmetrized(
      direction * direction.transpose() / (along * along)
      + other * other.transpose() / (across * across) + n * n.transpose() / (larger * larger));
}

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_TENSOR_H
