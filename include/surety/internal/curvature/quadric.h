// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a factorised system of equations to a jet with its variances, and the quadric with linear
// terms.
#ifndef SURETY_INTERNAL_CURVATURE_QUADRIC_H
#define SURETY_INTERNAL_CURVATURE_QUADRIC_H

#include <surety/internal/curvature/samples.h>

#include <algorithm>
#include <cstddef>

namespace surety::internal::curvature {

/// A jet, and the standard deviation of the noise in the heights.
struct Estimate {
  Jet jet;
  double noise = 0;
};

/// The coefficients; and in the variances the square of the sum of their gains, since noise of the
/// centre moves all heights alike.
template <class System>
void solve(const System& system, Jet& jet)
{
  const auto x = system.solve(jet.terms, System::heights);
  const auto sum = system.solve(jet.terms, System::ones);
  std::copy_n(x.begin(), jet.terms, jet.coefficient.begin());
  for (std::size_t i = 0; i < 3; ++i) jet.variance[i] = sum[2 + i] * sum[2 + i];
}

/// The same, and what noise of the samples themselves makes of a fit without weights.
template <class System>
void solve_uniform(const System& system, Jet& jet)
{
  solve(system, jet);
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double y : system.row_of_inverse(jet.terms, int(2 + i))) jet.variance[i] += y * y;
  }
}

/// z = p x + q y + a x^2 + b x y + c y^2; without terms if the samples do not determine it.
///
/// Equations are multiplied by `weight`, if there is one; variances are then those for noise that
/// the weights undo.
inline Jet fit_quadric(
    const Samples& samples, Quadratic_system& system, const double* weight = nullptr)
{
  for (int i = 0; i < samples.size(); ++i) {
    const double w = weight == nullptr ? 1 : weight[i];
    auto& row = system.row(i);
    for (std::size_t j = 0; j < Jet::quadratic; ++j) row[j] = w * samples.row(i)[j];
    row[Quadratic_system::heights] = w * samples.height(i);
    row[Quadratic_system::ones] = w;
    row[7] = 0;
  }
  system.factor(samples.size());
  Jet jet;
  jet.terms = system.rank() == Jet::quadratic ? Jet::quadratic : 0;
  if (jet.terms > 0) solve_uniform(system, jet);
  return jet;
}

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_QUADRIC_H
