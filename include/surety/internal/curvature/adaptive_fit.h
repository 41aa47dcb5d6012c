// SPDX-License-Identifier: GPL-3.0-or-later
//
// The adaptive estimator: no order of polynomial and no size of neighbourhood is best for clean and
// for noisy meshes, so the residuals choose (O. V. Lepski's selection).
#ifndef SURETY_INTERNAL_CURVATURE_ADAPTIVE_FIT_H
#define SURETY_INTERNAL_CURVATURE_ADAPTIVE_FIT_H

#include <surety/internal/curvature/moments.h>
#include <surety/internal/curvature/quadric.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace surety::internal::curvature {

/// \brief Chooses among polynomial fits of one frame.
///
/// 1. A fit of the highest order to three rings, weighted by 1/d^2: best on clean meshes. It is
///    taken if its curvatures are certain to 1 %.
/// 2. The same without weights, which is less sensitive to noise.
/// 3. Else a ladder of neighbourhoods: three, five and eight rings. A level is admissible if its
///    fit of the highest order agrees with those of all levels before it, up to their noise; the
///    first that is not ends the search: from there on it is shape, not noise, that wide fits lose.
///    On the last admissible level a lower order is taken if it differs from the highest by no more
///    than one and a half times that one's own noise.
class Adaptive_fit
{
public:
  explicit Adaptive_fit(const Side_graph& graph) : graph_(graph) {}

  /// Nothing if the samples do not determine a quadric with linear terms. `noise_floor` is in the
  /// unit of the frame.
  std::optional<Estimate> operator()(
      Neighbourhood& neighbourhood, const Frame& frame, double noise_floor)
  {
    while (neighbourhood.add_ring()
           && (neighbourhood.rings() < 3 || neighbourhood.size() < enough_samples)
           && neighbourhood.rings() < 8) {}
    samples_.read(graph_, neighbourhood.sides(), frame);
    const double precision = rounding(frame);
    floor_ = (std::max)(noise_floor, precision);
    if (samples_.largest_height() <= 8 * precision) return flat();

    Jet weighted = weighted_fit();
    if (weighted.terms == 0) return std::nullopt;
    if (is_certain(weighted)) return Estimate{weighted, std::sqrt(noise_square_)};
    if (const Jet uniform = uniform_fit(neighbourhood, frame); uniform.terms > 0) {
      if (is_certain(weighted)) return Estimate{weighted, std::sqrt(noise_square_)};
      if (is_certain(uniform)) return Estimate{uniform, std::sqrt(noise_square_)};
      weighted = climb(uniform, neighbourhood, frame);
    }
    return Estimate{weighted, std::sqrt(noise_square_)};
  }

private:
  /// A quadric needs five samples; higher orders need some more, for their residuals to tell noise.
  static int usable_terms(int samples, int rank)
  {
    if (samples >= 18 && rank >= Jet::quartic) return Jet::quartic;
    if (samples >= 12 && rank >= Jet::cubic) return Jet::cubic;
    if (samples >= 5 && rank >= Jet::quadratic) return Jet::quadratic;
    return 0;
  }

  std::optional<Estimate> flat() const
  {
    Estimate estimate{{}, floor_};
    estimate.jet.terms = usable_terms(samples_.size(), Jet::quartic);
    if (estimate.jet.terms == 0) return std::nullopt;
    return estimate;
  }

  bool is_certain(const Jet& jet) const
  {
    const double deviation = std::sqrt(noise_square_ * jet.largest_variance());
    return 2 * deviation <= certainty * jet.largest_curvature();
  }

  void set_noise(double square) { noise_square_ = (std::max)(square, floor_ * floor_); }

  /// The fit with weights 1/d^2. From its residuals comes a first, pessimistic estimate of the
  /// noise: with weights w they have the mean square noise^2 sum w^2 / number.
  Jet weighted_fit()
  {
    const int number = samples_.size();
    double weights = 0;
    moments_.clear();
    for (int i = 0; i < number; ++i) {
      const double square = samples_.weight(i) * samples_.weight(i);
      weights += square;
      moments_.add(samples_.row(i)[0], samples_.row(i)[1], samples_.height(i), square);
    }
    moments_.factor(factor_, true);
    Jet jet;
    jet.terms = usable_terms(number, factor_.terms());
    double residual = 0;
    if (jet.terms == Jet::quartic) {
      factor_.solve(jet);
      jet.variance.fill(0);
      for (std::size_t i = 0; i < 3; ++i) influence_[i] = factor_.influence(jet.terms, i);
      residual = factor_.residual(jet.terms);
    } else if (!factor_weighted_rows(jet)) {
      return jet;
    } else {
      residual = system_.residual(jet.terms);
    }
    add_weighted_gains(jet);
    const int freedom = number - jet.terms;
    weighted_noise_square_ = freedom > 0 ? 4 * residual * number / (freedom * weights) : 0;
    set_noise(weighted_noise_square_);
    return jet;
  }

  /// The same by Householder's factorisation, which tells what few samples determine from what
  /// rounding makes of them. False if that is not even a quadric.
  bool factor_weighted_rows(Jet& jet)
  {
    const int number = samples_.size();
    for (int i = 0; i < number; ++i) {
      for (std::size_t j = 0; j < 16; ++j)
        system_.row(i)[j] = samples_.weight(i) * samples_.row(i)[j];
    }
    system_.factor(number);
    jet.terms = usable_terms(number, system_.rank());
    if (jet.terms == 0) return false;
    const auto x = system_.solve(jet.terms, Quartic_system::heights);
    std::copy_n(x.begin(), jet.terms, jet.coefficient.begin());
    for (int i = 0; i < 3; ++i) {
      influence_[std::size_t(i)]
          = system_.back_substituted(jet.terms, system_.row_of_inverse(jet.terms, 2 + i));
    }
    return true;
  }

  /// The fit without weights, the centre not forced upon it. Its residuals tell the noise.
  Jet uniform_fit(const Neighbourhood& neighbourhood, const Frame& frame)
  {
    moments_.clear();
    moments_.add(0, 0, 0);
    added_ = 0;
    Jet jet = fit_moments(neighbourhood, frame);
    if (jet.terms == 0) return jet;
    const int freedom = neighbourhood.size() - jet.terms;
    if (freedom > 0)
      set_noise((std::min)(factor_.residual(jet.terms) / freedom, weighted_noise_square_));
    return jet;
  }

  /// The highest order that the samples allow; no terms if that is none.
  Jet fit_moments(const Neighbourhood& neighbourhood, const Frame& frame)
  {
    const auto& sides = neighbourhood.sides();
    for (; added_ < sides.size(); ++added_) {
      const Vector local = frame.to_local(graph_.point_of(sides[added_]));
      moments_.add(local.x(), local.y(), local.z());
    }
    moments_.factor(factor_, false);
    Jet jet;
    jet.terms = usable_terms(neighbourhood.size(), factor_.terms());
    if (jet.terms > 0) factor_.solve(jet);
    return jet;
  }

  /// What noise of the samples, and of the centre, makes of the fit: with weights w the gain of
  /// sample j is w_j^2 (row j) . u, where u is a column of (A^T W^2 A)^-1. The centre moves all
  /// heights alike.
  void add_weighted_gains(Jet& jet) const
  {
    std::array<std::array<double, 4>, Jet::quartic> u{};
    for (std::size_t k = 0; k < Jet::quartic; ++k) {
      for (std::size_t i = 0; i < 3; ++i) u[k][i] = influence_[i][k];
    }
    std::array<double, 4> square{}, sum{};
    for (int j = 0; j < samples_.size(); ++j) {
      std::array<double, 4> gain{};
      for (std::size_t k = 0; k < Jet::quartic; ++k) {
        for (std::size_t i = 0; i < 4; ++i) gain[i] += samples_.row(j)[k] * u[k][i];
      }
      const double w2 = samples_.weight(j) * samples_.weight(j);
      for (std::size_t i = 0; i < 4; ++i) {
        sum[i] += w2 * gain[i];
        square[i] += w2 * w2 * gain[i] * gain[i];
      }
    }
    for (std::size_t i = 0; i < 3; ++i) jet.variance[i] = square[i] + sum[i] * sum[i];
  }

  /// \brief The ladder, whose first level is `first`.
  ///
  /// On stretched meshes rings are long and thin, and noise hides the curvature across them: balls
  /// of as many samples take their place, from the first level on.
  Jet climb(const Jet& first, Neighbourhood& neighbourhood, const Frame& frame)
  {
    const bool is_stretched = samples_.elongation() > largest_elongation;
    levels_.assign(1, first);
    accepted_ = factor_;
    if (is_stretched) {
      square_of_sample_ = mean_area(neighbourhood.sides()) / pi;
      neighbourhood.grow_ball(square_of_sample_ * samples_of_rings(4));
      const Jet jet = uniform_fit(neighbourhood, frame);
      if (jet.terms == 0) return simplest(first);
      levels_.assign(1, jet);
      accepted_ = factor_;
    }
    for (const int rings : {5, 8}) {
      if (!widen(neighbourhood, rings, is_stretched)) break;
      const Jet jet = fit_moments(neighbourhood, frame);
      if (jet.terms == 0 || !is_admissible(jet)) break;
      levels_.push_back(jet);
      accepted_ = factor_;
    }
    return simplest(levels_.back());
  }

  /// False if no sample was added, or there is no room for all.
  bool widen(Neighbourhood& neighbourhood, int rings, bool is_stretched) const
  {
    const int before = neighbourhood.size();
    if (is_stretched) {
      if (!neighbourhood.grow_ball(square_of_sample_ * samples_of_rings(rings))) return false;
    } else {
      while (neighbourhood.rings() < rings && neighbourhood.add_ring()) {}
    }
    return neighbourhood.size() > before;
  }

  double mean_area(const std::vector<Index>& sides) const
  {
    double sum = 0;
    for (const Index side : sides) sum += graph_.area[side];
    return sum / double(sides.size());
  }

  /// As many as that many rings have on a regular mesh.
  static int samples_of_rings(int rings) { return 3 * rings * (rings + 1); }

  /// Whether a jet lies within so many standard deviations of another.
  bool agrees(const Jet& jet, const Jet& other, double deviations) const
  {
    for (int i = 0; i < 3; ++i) {
      const double variance = noise_square_ * other.variance[std::size_t(i)];
      const double difference = jet.second_order(i) - other.second_order(i);
      if (std::abs(difference) > deviations * std::sqrt(variance)) return false;
    }
    return true;
  }

  bool is_admissible(const Jet& jet) const
  {
    return std::all_of(levels_.begin(), levels_.end(), [&](const Jet& level) {
      return agrees(jet, level, agreement_of_levels);
    });
  }

  /// \brief The least order of the last level that agrees with its highest; where one does not, a
  /// step towards it.
  Jet simplest(const Jet& highest) const
  {
    Jet result = highest;
    for (const int terms : {Jet::cubic, Jet::quadratic}) {
      if (terms >= highest.terms) continue;
      Jet jet;
      jet.terms = terms;
      accepted_.solve(jet);
      if (!agrees(jet, highest, agreement_of_orders)) {
        shrink(result, jet);
        break;
      }
      if (jet.total_variance() < result.total_variance()) result = jet;
    }
    return result;
  }

  /// \brief Draws a jet towards a simpler one by the share of their difference that noise explains.
  ///
  /// By James and Stein: with d the difference of three numbers in units of its noise, the factor
  /// 1 - 1 / |d|^2 on d lessens the mean square of the error, whatever the truth.
  void shrink(Jet& jet, const Jet& simpler) const
  {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
      const double variance
          = noise_square_ * (jet.variance[std::size_t(i)] - simpler.variance[std::size_t(i)]);
      const double difference = jet.second_order(i) - simpler.second_order(i);
      if (variance > 0) square += difference * difference / variance;
    }
    if (!(square > 1)) return;
    for (std::size_t i = 0; i < jet.coefficient.size(); ++i)
      jet.coefficient[i] += (simpler.coefficient[i] - jet.coefficient[i]) / square;
  }

  static constexpr int enough_samples = 24;
  static constexpr double certainty = 0.005;
  static constexpr double agreement_of_levels = 4;
  static constexpr double agreement_of_orders = 1.5;
  static constexpr double pi = 3.14159265358979323846;
  static constexpr double largest_elongation = 9; ///< of moments: three to one in length

  const Side_graph& graph_;
  Samples samples_;
  Quartic_system system_;
  Moments moments_;
  Moment_factor factor_, accepted_; ///< of the moments; of the last admissible level
  std::array<std::array<double, Jet::quartic>, 3> influence_{}; ///< of the fit with weights
  std::size_t added_ = 0;       ///< number of samples in the moments
  std::vector<Jet> levels_;     ///< admissible ones
  double square_of_sample_ = 0; ///< of the radius of a disc with the area of a sample
  double floor_ = 0, noise_square_ = 0, weighted_noise_square_ = 0;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_ADAPTIVE_FIT_H
