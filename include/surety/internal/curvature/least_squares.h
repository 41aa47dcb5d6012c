// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small least-squares problems, one a vertex: a Householder factorisation in place, without
// allocation, whose leading columns solve the smaller problems as well.
#ifndef SURETY_INTERNAL_CURVATURE_LEAST_SQUARES_H
#define SURETY_INTERNAL_CURVATURE_LEAST_SQUARES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace surety::internal::curvature {

/// More samples than the widest neighbourhood of a regular mesh has: 216 in eight rings.
constexpr int maximum_samples = 256;

/// \brief Minimises |A x - f| for two right-hand sides f, the heights and a column of ones.
///
/// A row holds `Unknowns` entries of A, then the two of f. A is stored by rows: the inner loops run
/// along them, with a length that the compiler knows.
template <int Unknowns, int Stride>
class Least_squares
{
  static_assert(Unknowns + 2 <= Stride && Stride % 4 == 0);

public:
  static constexpr int heights = Unknowns;
  static constexpr int ones = Unknowns + 1;
  using Row = std::array<double, Stride>;
  using Solution = std::array<double, Unknowns>;

  Row& row(int i) { return rows_[std::size_t(i)]; }

  /// Replaces the first `number` rows by R and Q^T f.
  void factor(int number)
  {
    squares_.fill(0);
    for (int i = 0; i < number; ++i) {
      for (int j = 0; j < Stride; ++j) squares_[j] += rows_[i][j] * rows_[i][j];
    }
    number_ = number;
    rank_ = 0;
    const int last = (std::min)(number, Unknowns);
    while (rank_ < last && (rank_ < 4 ? reflect<0>() : rank_ < 8 ? reflect<4>() : reflect<8>()))
      ++rank_;
    tail_ = 0;
    for (int i = rank_; i < number; ++i) tail_ += rows_[i][heights] * rows_[i][heights];
  }

  /// Number of leading columns that are independent of those before them.
  int rank() const { return rank_; }

  /// The sum of the squared residuals of the heights for the first `terms` columns alone.
  double residual(int terms) const
  {
    double sum = tail_;
    for (int i = terms; i < rank_; ++i) sum += rows_[i][heights] * rows_[i][heights];
    return sum;
  }

  /// The solution for the first `terms` columns alone; `terms` is at most the rank.
  Solution solve(int terms, int right_hand_side) const
  {
    Solution x{};
    for (int i = terms - 1; i >= 0; --i) {
      double sum = rows_[i][right_hand_side];
      for (int j = i + 1; j < terms; ++j) sum -= rows_[i][j] * x[j];
      x[i] = sum / rows_[i][i];
    }
    return x;
  }

  /// R^-T e, the rows of R^-1: its squared length is the variance of an unknown for noise of
  /// variance one.
  Solution row_of_inverse(int terms, int unknown) const
  {
    Solution y{};
    y[unknown] = 1 / rows_[unknown][unknown];
    for (int i = unknown + 1; i < terms; ++i) {
      double sum = 0;
      for (int j = unknown; j < i; ++j) sum -= rows_[j][i] * y[j];
      y[i] = sum / rows_[i][i];
    }
    return y;
  }

  /// R^-1 y.
  Solution back_substituted(int terms, Solution y) const
  {
    for (int i = terms - 1; i >= 0; --i) {
      for (int j = i + 1; j < terms; ++j) y[i] -= rows_[i][j] * y[j];
      y[i] /= rows_[i][i];
    }
    return y;
  }

private:
  /// One Householder step at the diagonal entry `rank_`. Columns before `First` are done and left
  /// alone. False if the column depends on those before it: what is left of it is rounding.
  template <int First>
  bool reflect()
  {
    const int k = rank_;
    std::array<double, Stride - First> product{};
    for (int i = k; i < number_; ++i) {
      const double factor = rows_[i][k];
      for (int j = First; j < Stride; ++j) product[j - First] += factor * rows_[i][j];
    }
    const double square = product[k - First];
    if (!(square > dependence * squares_[k])) return false;

    // v = column + sign |column| e_k; v^T v = 2 |column| (|column| + |first entry|).
    const double length = std::sqrt(square), entry = rows_[k][k];
    const double shift = entry < 0 ? -length : length;
    const double scale = 1 / (shift * (shift + entry));
    for (int j = First; j < Stride; ++j) {
      product[j - First] = (product[j - First] + shift * rows_[k][j]) * scale;
    }
    for (int i = k + 1; i < number_; ++i) {
      const double factor = rows_[i][k];
      for (int j = First; j < Stride; ++j) rows_[i][j] -= factor * product[j - First];
    }
    const double factor = entry + shift;
    for (int j = First; j < Stride; ++j) rows_[k][j] -= factor * product[j - First];
    return true;
  }

  /// The square of 10^-7: columns that are so close to dependent say nothing.
  static constexpr double dependence = 1e-14;

  alignas(32) std::array<Row, maximum_samples> rows_;
  Row squares_{};
  int number_ = 0, rank_ = 0;
  double tail_ = 0;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_LEAST_SQUARES_H
