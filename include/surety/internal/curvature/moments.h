// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polynomial fits over neighbourhoods that grow, by the moments of the samples.
#ifndef SURETY_INTERNAL_CURVATURE_MOMENTS_H
#define SURETY_INTERNAL_CURVATURE_MOMENTS_H

#include <surety/internal/curvature/jet.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace surety::internal::curvature {

/// \brief A Cholesky factor U of normal equations, A^T A = U^T U, next to it U^-T A^T f for the
/// heights f, and U^-T e for the unit vectors e of the second-order terms.
///
/// The leading parts are those of fewer terms, so that one factor serves jets of every order.
class Moment_factor
{
public:
  static constexpr std::size_t unknowns = Jet::quartic + 1;
  /// Half the radius of eight rings: coordinates are divided by it, so that powers stay near one.
  static constexpr double scale = 4;

  /// For how many terms of a jet the independent leading equations serve.
  int terms() const { return int(rank_) - 1; }

  /// Coefficients and variances of the jet with `jet.terms` terms.
  void solve(Jet& jet) const
  {
    const std::size_t n = std::size_t(jet.terms) + 1;
    const Column x = back_substituted(heights, n);
    jet.coefficient.fill(0);
    for (std::size_t i = 1; i < n; ++i) jet.coefficient[i - 1] = x[i] * inverse_scale[i];
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0;
      for (std::size_t i = 3; i < n; ++i) sum += row_[i][unit + k] * row_[i][unit + k];
      jet.variance[k] = sum * (inverse_scale[3 + k] * inverse_scale[3 + k]);
    }
  }

  /// The k-th column of (A^T A)^-1 that belongs to a second-order term: a sample with the row r and
  /// the weight w contributes w r . column to it a unit of height.
  std::array<double, Jet::quartic> influence(int terms, std::size_t k) const
  {
    const std::size_t n = std::size_t(terms) + 1;
    const Column x = back_substituted(unit + k, n);
    std::array<double, Jet::quartic> result{};
    for (std::size_t i = 1; i < n; ++i)
      result[i - 1] = x[i] * (inverse_scale[i] * inverse_scale[3 + k]);
    return result;
  }

  /// The sum of the squared residuals, as far as it stands out from the rounding of the heights.
  double residual(int terms) const
  {
    double sum = square_;
    for (std::size_t i = first_; i < std::size_t(terms) + 1; ++i)
      sum -= row_[i][heights] * row_[i][heights];
    return (std::max)(sum, 1e-14 * square_);
  }

private:
  friend class Moments;

  static constexpr std::size_t heights = unknowns, unit = unknowns + 1, width = 20;
  using Column = std::array<double, unknowns>;

  /// Each step subtracts a multiple of its row from all later ones: no sum waits for another.
  void factor()
  {
    std::array<double, unknowns> diagonal;
    for (std::size_t i = 0; i < unknowns; ++i) diagonal[i] = row_[i][i];
    for (rank_ = first_; rank_ < unknowns; ++rank_) {
      auto& pivot = row_[rank_];
      if (!(pivot[rank_] > dependence * diagonal[rank_])) return;
      const double inverse = 1 / std::sqrt(pivot[rank_]);
      inverse_[rank_] = inverse;
      const std::size_t even = rank_ & ~std::size_t(1);
      for (std::size_t j = even; j < width; ++j) pivot[j] *= inverse;
      for (std::size_t i = rank_ + 1; i < unknowns; ++i) {
        const double multiple = pivot[i];
        for (std::size_t j = i & ~std::size_t(1); j < width; ++j) row_[i][j] -= multiple * pivot[j];
      }
    }
  }

  /// U^-1 of the first n entries of a column.
  Column back_substituted(std::size_t column, std::size_t n) const
  {
    Column x{};
    for (std::size_t i = first_; i < n; ++i) x[i] = row_[i][column];
    for (std::size_t i = n; i-- > first_;) {
      x[i] *= inverse_[i];
      for (std::size_t j = first_; j < i; ++j) x[j] -= row_[j][i] * x[i];
    }
    return x;
  }

  static constexpr double dependence = 1e-9;
  static constexpr Column inverse_scale
      = {1,
         1 / scale,
         1 / scale,
         1 / (scale * scale),
         1 / (scale * scale),
         1 / (scale * scale),
         1 / (scale * scale * scale),
         1 / (scale * scale * scale),
         1 / (scale * scale * scale),
         1 / (scale * scale * scale),
         1 / (scale * scale * scale * scale),
         1 / (scale * scale * scale * scale),
         1 / (scale * scale * scale * scale),
         1 / (scale * scale * scale * scale),
         1 / (scale * scale * scale * scale)};

  alignas(32) std::array<std::array<double, width>, unknowns> row_{};
  Column inverse_{};
  std::size_t first_ = 0, rank_ = 0;
  double square_ = 0;
};

/// \brief The normal equations of a quartic with a constant term, A^T A x = A^T f.
///
/// With the constant term the centre is a sample like the others: its noise is not forced upon the
/// fit. Entries of A^T A are sums of x^i y^j with i + j <= 8: there are 45 of them, while a
/// Householder factorisation of many samples costs several times as much. The condition of A is
/// squared: what is left of the digits is far more than a polynomial leaves of a surface.
class Moments
{
public:
  void clear()
  {
    moment_ = {};
    height_ = {};
    square_ = 0;
    pending_ = 0;
  }

  /// `weight` is that of the square of a residual.
  void add(double x, double y, double z, double weight = 1)
  {
    if (pending_ == batch) flush();
    write_powers(x / Moment_factor::scale, weight, power_of_x_[pending_]);
    write_powers(y / Moment_factor::scale, 1, power_of_y_[pending_]);
    z_[pending_] = z;
    ++pending_;
    square_ += weight * (z * z);
  }

  /// With `through_centre` the constant term is zero.
  void factor(Moment_factor& result, bool through_centre)
  {
    flush();
    for (std::size_t i = 0; i < unknowns; ++i) {
      auto& row = result.row_[i];
      for (std::size_t j = i; j < unknowns; ++j)
        row[j] = moment_[x_of[i] + x_of[j]][y_of[i] + y_of[j]];
      row[Moment_factor::heights] = height_[x_of[i]][y_of[i]];
      for (std::size_t k = 0; k < 3; ++k) row[Moment_factor::unit + k] = i == 3 + k ? 1 : 0;
    }
    result.first_ = through_centre ? 1 : 0;
    result.square_ = square_;
    result.factor();
  }

private:
  static constexpr std::size_t unknowns = Moment_factor::unknowns, size = 10, batch = 32;

  using Powers = std::array<double, size>;

  /// factor * u^i: products of few, so that none waits for a long chain.
  static void write_powers(double u, double factor, Powers& power)
  {
    const double u2 = u * u, u3 = u2 * u, u4 = u2 * u2, f4 = factor * u4;
    power
        = {factor, factor * u, factor * u2, factor * u3, f4, f4 * u, f4 * u2, f4 * u3, f4 * u4, 0};
  }

  /// Sums over all samples of x^I y^j, j < Number, stay in registers.
  template <std::size_t I, std::size_t Number>
  void sum_moments()
  {
    std::array<double, Number> sum{};
    for (std::size_t s = 0; s < pending_; ++s) {
      const double factor = power_of_x_[s][I];
      for (std::size_t j = 0; j < Number; ++j) sum[j] += factor * power_of_y_[s][j];
    }
    for (std::size_t j = 0; j < Number; ++j) moment_[I][j] += sum[j];
  }

  template <std::size_t I, std::size_t Number>
  void sum_heights()
  {
    std::array<double, Number> sum{};
    for (std::size_t s = 0; s < pending_; ++s) {
      const double factor = power_of_x_[s][I] * z_[s];
      for (std::size_t j = 0; j < Number; ++j) sum[j] += factor * power_of_y_[s][j];
    }
    for (std::size_t j = 0; j < Number; ++j) height_[I][j] += sum[j];
  }

  void flush()
  {
    sum_moments<0, 10>();
    sum_moments<1, 8>();
    sum_moments<2, 8>();
    sum_moments<3, 6>();
    sum_moments<4, 6>();
    sum_moments<5, 4>();
    sum_moments<6, 4>();
    sum_moments<7, 2>();
    sum_moments<8, 2>();
    sum_heights<0, 6>();
    sum_heights<1, 4>();
    sum_heights<2, 4>();
    sum_heights<3, 2>();
    sum_heights<4, 2>();
    pending_ = 0;
  }

  static constexpr std::array<std::size_t, unknowns> x_of
      = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0, 4, 3, 2, 1, 0};
  static constexpr std::array<std::size_t, unknowns> y_of
      = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 3, 4};

  alignas(32) std::array<Powers, 9> moment_{};
  alignas(32) std::array<std::array<double, 6>, 5> height_{};
  alignas(32) std::array<Powers, batch> power_of_x_{}, power_of_y_{};
  std::array<double, batch> z_{};
  std::size_t pending_ = 0;
  double square_ = 0;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_MOMENTS_H
