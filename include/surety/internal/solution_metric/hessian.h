// SPDX-License-Identifier: GPL-3.0-or-later
//
// The second derivatives of a field that is known at the vertices of a surface, once a side: a
// quadratic polynomial in the tangent plane, fitted to the values round it.
#ifndef SURETY_INTERNAL_SOLUTION_METRIC_HESSIAN_H
#define SURETY_INTERNAL_SOLUTION_METRIC_HESSIAN_H

#include <surety/internal/curvature/neighbourhood.h>
#include <surety/internal/curvature/side_graph.h>
#include <surety/internal/linear.h>
#include <surety/internal/metric/tensor.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace surety::internal::solution_metric {

using curvature::Side_graph;

/// The eigenvalues of |H| in the tangent plane of a side, the larger one first, and the direction
/// of that one, in space.
struct Absolute_hessian {
  double larger = 0, smaller = 0;
  Vector direction = Vector::Zero();
};

/// \brief Fits u(x, y) = u_0 + g.(x, y) + (x, y) H (x, y)^T / 2 through the value at a side.
///
/// x and y are coordinates in the tangent plane. On a curved surface H is the covariant Hessian:
/// the Christoffel symbols of a height field vanish where its gradient does.
class Hessian_recovery
{
public:
  /// \param values by vertex, at most about 1 in size, so that their rounding is known
  Hessian_recovery(const Side_graph& graph, const std::vector<double>& values)
    : graph_(graph), values_(values), neighbourhood_(graph)
  {}

  /// \param normal of unit length
  Absolute_hessian at(Index side, const Vector& normal)
  {
    const auto basis = metric::tangent_basis(normal);
    neighbourhood_.start(side, normal);
    Absolute_hessian result;
    while (neighbourhood_.add_ring()) {
      if (neighbourhood_.size() < fewest_samples) continue;
      if (fit(side, basis, result)) break;
    }
    return result;
  }

private:
  /// One more than there are unknowns, as in Z. Zhang and A. Naga, A New Finite Element Gradient
  /// Recovery Method, 2005.
  static constexpr int fewest_samples = 6;

  /// False where the samples do not determine a quadric: they lie on a conic, nearly.
  bool fit(Index side, const std::array<Vector, 2>& basis, Absolute_hessian& result) const
  {
    const auto& sides = neighbourhood_.sides();
    const auto number = static_cast<Eigen::Index>(sides.size());
    Eigen::Matrix<double, Eigen::Dynamic, 2> at(number, 2);
    Eigen::VectorXd rise(number);
    for (Eigen::Index i = 0; i < number; ++i) {
      const Vector e = graph_.point_of(sides[i]) - graph_.point_of(side);
      at.row(i) << e.dot(basis[0]), e.dot(basis[1]);
      rise[i] = values_[graph_.vertex[sides[i]]] - values_[graph_.vertex[side]];
    }
    // In coordinates in which the samples are as far spread in all directions: a mesh that is
    // adapted to the field has neighbours at one tenth of the distance in one of them.
    const Eigen::Matrix2d moments = at.transpose() * at / double(number);
    const Eigen::LLT<Eigen::Matrix2d> factor(moments);
    if (factor.info() != Eigen::Success) return false;
    const Eigen::Matrix2d inverse
        = factor.matrixL().solve(Eigen::Matrix2d(Eigen::Matrix2d::Identity()));
    const Eigen::Matrix<double, Eigen::Dynamic, 2> spread = at * inverse.transpose();
    Eigen::Matrix<double, Eigen::Dynamic, 5> terms(number, 5);
    terms << spread, spread.col(0).cwiseAbs2() / 2, spread.col(0).cwiseProduct(spread.col(1)),
        spread.col(1).cwiseAbs2() / 2;
    const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 5>> solver(terms);
    const auto diagonal = solver.matrixR().diagonal().cwiseAbs().eval();
    if (!(diagonal[4] > worst_condition * diagonal[0])) return false;
    const Eigen::Matrix<double, 5, 1> q = solver.solve(rise);
    Eigen::Matrix2d hessian;
    hessian << q[2], q[3], q[3], q[4];
    hessian = inverse.transpose() * hessian * inverse;
    set(hessian, rounding_of(inverse), basis, result);
    return true;
  }

  /// What rounding of the values makes of a Hessian that vanishes.
  static double rounding_of(const Eigen::Matrix2d& inverse)
  {
    return 16 * std::numeric_limits<double>::epsilon() * inverse.squaredNorm();
  }

  static void set(
      const Eigen::Matrix2d& hessian, double rounding, const std::array<Vector, 2>& basis,
      Absolute_hessian& result)
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(
        (hessian + hessian.transpose()) / 2);
    const Eigen::Vector2d size = solver.eigenvalues().cwiseAbs();
    const int first = size[0] > size[1] ? 0 : 1;
    const Eigen::Vector2d way = solver.eigenvectors().col(first);
    const auto without_rounding = [&](double value) { return value > rounding ? value : 0; };
    result.larger = without_rounding(size[first]);
    result.smaller = without_rounding(size[1 - first]);
    result.direction = unit(way[0] * basis[0] + way[1] * basis[1]);
  }

  static constexpr double worst_condition = .01;

  const Side_graph& graph_;
  const std::vector<double>& values_;
  curvature::Neighbourhood neighbourhood_;
};

} // namespace surety::internal::solution_metric

#endif // SURETY_INTERNAL_SOLUTION_METRIC_HESSIAN_H
