// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quadrics of one neighbourhood: the paper's, the one with linear terms, and what remains when the
// samples do not determine that one.
#ifndef SURETY_INTERNAL_CURVATURE_FIXED_FITS_H
#define SURETY_INTERNAL_CURVATURE_FIXED_FITS_H

#include <surety/internal/curvature/quadric.h>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace surety::internal::curvature {

template <class System>
double noise_of(const System& system, int samples, int terms)
{
  return samples > terms ? std::sqrt(system.residual(terms) / (samples - terms)) : 0;
}

/// The quadric with linear terms.
inline std::optional<Estimate> five_coefficients(const Samples& samples, Quadratic_system& system)
{
  const Jet jet = fit_quadric(samples, system);
  if (jet.terms == 0) return std::nullopt;
  return Estimate{jet, noise_of(system, samples.size(), jet.terms)};
}

/// \brief The quadric with linear terms, from a disc whose samples count by their share of the
/// area.
///
/// Third derivatives spoil the second ones as far as the samples miss the symmetry of the disc.
/// Areas make sums near integrals, which are symmetric; a weight that falls smoothly to zero at the
/// rim of three edges leaves it open whether a sample there counts; and 1/d^2 keeps the fit local.
/// Nothing if a disc holds too few samples.
inline std::optional<Estimate> centred_quadric(
    const Samples& samples, const std::vector<double>& area, Quadratic_system& system)
{
  constexpr double square_radius = 9;
  constexpr double square_softening = 0.1; // as if no sample were nearer than a third of an edge
  const double largest = area.empty() ? 0 : *std::max_element(area.begin(), area.end());
  if (!(largest > 0)) return std::nullopt;
  std::array<double, maximum_samples> weight;
  int inside = 0;
  for (int i = 0; i < samples.size(); ++i) {
    const auto& row = samples.row(i);
    const double square = row[2] + row[4], height = (std::max)(0., 1 - square / square_radius);
    weight[std::size_t(i)] = std::sqrt(
        height * height * height * (area[std::size_t(i)] / largest) / (square + square_softening));
    if (weight[std::size_t(i)] > 0) ++inside;
  }
  if (inside < Jet::quadratic + 1) return std::nullopt;
  const Jet jet = fit_quadric(samples, system, weight.data());
  if (jet.terms == 0) return std::nullopt;
  return Estimate{jet, noise_of(system, inside, jet.terms)};
}

/// The paper's z = a x^2 + b x y + c y^2 (section 3.2), which trusts the normal.
inline std::optional<Estimate> three_coefficients(const Samples& samples)
{
  using System = Least_squares<3, 8>;
  System system;
  for (int i = 0; i < samples.size(); ++i) {
    const auto& sample = samples.row(i);
    system.row(i) = {sample[2], sample[3], sample[4], samples.height(i), 1, 0, 0, 0};
  }
  system.factor(samples.size());
  if (system.rank() < 3) return std::nullopt;
  Estimate estimate;
  const auto x = system.solve(3, System::heights);
  const auto sum = system.solve(3, System::ones);
  for (std::size_t i = 0; i < 3; ++i) {
    estimate.jet.coefficient[2 + i] = x[i];
    estimate.jet.variance[i] = sum[i] * sum[i];
    for (const double y : system.row_of_inverse(3, int(i))) estimate.jet.variance[i] += y * y;
  }
  estimate.jet.terms = 3;
  estimate.noise = noise_of(system, samples.size(), 3);
  return estimate;
}

/// \brief The quadric with linear terms of least curvature among those that fit equally well.
///
/// The plane comes first: only what it leaves is explained by curvature. Least is meant in the
/// Frobenius norm of the second derivatives, which does not depend on the axes. A bending of which
/// the samples tell less than `certainty` of what they tell of another counts as not told.
inline Estimate underdetermined_quadric(const Samples& samples, double certainty = 1e-7)
{
  const int number = samples.size();
  using Linear = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, maximum_samples, 2>;
  using Second = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, maximum_samples, 3>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, maximum_samples, 1>;
  const double root = std::sqrt(2.0);
  Linear linear(number, 2);
  Second second(number, 3);
  Column height(number);
  for (int i = 0; i < number; ++i) {
    const auto& row = samples.row(i);
    linear.row(i) << row[0], row[1];
    second.row(i) << row[2], root * row[3], row[4];
    height[i] = samples.height(i);
  }
  Eigen::CompleteOrthogonalDecomposition<Linear> plane;
  plane.setThreshold(1e-7);
  plane.compute(linear);
  const Second bent = second - linear * plane.solve(second);
  const Column rest = height - linear * plane.solve(height);
  Eigen::Vector3d curvature = Eigen::Vector3d::Zero();
  // Columns that the plane explains entirely leave rounding only.
  if (bent.norm() > 1e-7 * second.norm()) {
    Eigen::CompleteOrthogonalDecomposition<Second> quadric;
    quadric.setThreshold(certainty);
    quadric.compute(bent);
    curvature = quadric.solve(rest);
  }
  const Eigen::Vector2d slope = plane.solve(Column(height - second * curvature));
  Estimate estimate;
  estimate.jet.terms = Jet::quadratic;
  estimate.jet.coefficient[0] = slope[0];
  estimate.jet.coefficient[1] = slope[1];
  estimate.jet.coefficient[2] = curvature[0];
  estimate.jet.coefficient[3] = root * curvature[1];
  estimate.jet.coefficient[4] = curvature[2];
  return estimate;
}

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_FIXED_FITS_H
