// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polynomial fits over wide neighbourhoods that grow, by the moments of the samples.
#ifndef SURETY_INTERNAL_CURVATURE_MOMENTS_H
#define SURETY_INTERNAL_CURVATURE_MOMENTS_H

#include <surety/internal/curvature/jet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace surety::internal::curvature {

/// \brief The normal equations of a quartic with a constant term, A^T A x = A^T f, and Cholesky's
/// factorisation of them.
///
/// With the constant term the centre is a sample like the others: its noise is not forced upon the
/// fit. Entries of A^T A are sums of x^i y^j with i + j <= 8: there are 45 of them, while a
/// Householder factorisation of many samples costs several times as much. The condition of A is
/// squared, which noisy meshes do not feel; clean ones do not come here. In the coordinates of the
/// frame, divided by half the radius of eight rings.
class Moments
{
public:
  void clear()
  {
    moment_ = {};
    heights_ = {};
    square_ = 0;
  }

  void add(double x, double y, double z)
  {
    std::array<double, size> px, py;
    px[0] = py[0] = 1;
    for (std::size_t i = 1; i < size; ++i) {
      px[i] = px[i - 1] * (x / scale);
      py[i] = i < 9 ? py[i - 1] * (y / scale) : 0;
    }
#pragma GCC unroll 9
    for (std::size_t i = 0; i < 9; ++i) {
      for (std::size_t j = 0; j < ((10 - i) & ~std::size_t(1)); ++j) moment_[i][j] += px[i] * py[j];
    }
    for (std::size_t k = 0; k < unknowns; ++k)
      heights_[k] += z * (px[power_of_x[k]] * py[power_of_y[k]]);
    square_ += z * z;
  }

  /// Factors as many leading equations as are independent; tells for how many terms of a jet they
  /// serve. The leading parts of the factor are those of fewer terms.
  int factor()
  {
    std::size_t j = 0;
    for (; j < unknowns; ++j) {
      const double diagonal = entry(j, j);
      const double pivot = reduced(j, j);
      if (!(pivot > dependence * diagonal)) break;
      lower_[j][j] = std::sqrt(pivot);
      inverse_[j] = 1 / lower_[j][j];
      for (std::size_t i = j + 1; i < unknowns; ++i) lower_[i][j] = reduced(i, j) * inverse_[j];
    }
    return int(j) - 1;
  }

  /// Coefficients and variances of the jet with `jet.terms` terms.
  void solve(Jet& jet) const
  {
    const auto n = static_cast<std::size_t>(jet.terms) + 1;
    Column x = forward(heights_, 0, n);
    for (std::size_t i = n; i-- > 1;) {
      for (std::size_t j = i + 1; j < n; ++j) x[i] -= lower_[j][i] * x[j];
      x[i] *= inverse_[i];
    }
    for (std::size_t i = 1; i < n; ++i) jet.coefficient[i - 1] = unscaled(x[i], i);
    for (std::size_t k = 0; k < 3; ++k) {
      Column y{};
      y[3 + k] = unscaled(1, 3 + k);
      y = forward(y, 3 + k, n);
      jet.variance[k] = 0;
      for (std::size_t i = 3 + k; i < n; ++i) jet.variance[k] += y[i] * y[i];
    }
  }

  /// The sum of the squared residuals, as far as it stands out from the rounding of the heights.
  double residual(int terms) const
  {
    const auto n = static_cast<std::size_t>(terms) + 1;
    const Column y = forward(heights_, 0, n);
    double sum = square_;
    for (std::size_t i = 0; i < n; ++i) sum -= y[i] * y[i];
    return (std::max)(sum, 1e-14 * square_);
  }

private:
  static constexpr std::size_t unknowns = Jet::quartic + 1, size = 10;
  using Column = std::array<double, unknowns>;

  double entry(std::size_t i, std::size_t j) const
  {
    return moment_[power_of_x[i] + power_of_x[j]][power_of_y[i] + power_of_y[j]];
  }

  double reduced(std::size_t i, std::size_t j) const
  {
    double sum = entry(i, j);
    for (std::size_t k = 0; k < j; ++k) sum -= lower_[i][k] * lower_[j][k];
    return sum;
  }

  /// L^-1 y, whose entries before `first` are zero.
  Column forward(Column y, std::size_t first, std::size_t n) const
  {
    for (std::size_t i = first; i < n; ++i) {
      for (std::size_t j = first; j < i; ++j) y[i] -= lower_[i][j] * y[j];
      y[i] *= inverse_[i];
    }
    return y;
  }

  static double unscaled(double x, std::size_t term)
  {
    for (std::size_t k = power_of_x[term] + power_of_y[term]; k > 0; --k) x /= scale;
    return x;
  }

  static constexpr double scale = 4;
  static constexpr double dependence = 1e-9;
  static constexpr std::array<std::size_t, unknowns> power_of_x
      = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0, 4, 3, 2, 1, 0};
  static constexpr std::array<std::size_t, unknowns> power_of_y
      = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 3, 4};

  std::array<std::array<double, size>, 9> moment_{};
  Column heights_{}, inverse_{};
  std::array<Column, unknowns> lower_{};
  double square_ = 0;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_MOMENTS_H
