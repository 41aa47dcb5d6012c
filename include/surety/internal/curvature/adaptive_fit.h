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
    for (int i = 0; i < number; ++i) {
      const double w = samples_.weight(i);
      weights += w * w;
      for (int j = 0; j < 16; ++j)
        system_.row(i)[std::size_t(j)] = w * samples_.row(i)[std::size_t(j)];
    }
    system_.factor(number);
    Jet jet;
    jet.terms = usable_terms(number, system_.rank());
    if (jet.terms == 0) return jet;
    solve(system_, jet);
    add_weighted_gains(jet);
    const int freedom = number - jet.terms;
    weighted_noise_square_
        = freedom > 0 ? 4 * system_.residual(jet.terms) * number / (freedom * weights) : 0;
    set_noise(weighted_noise_square_);
    return jet;
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
      set_noise((std::min)(moments_.residual(jet.terms) / freedom, weighted_noise_square_));
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
    Jet jet;
    jet.terms = usable_terms(neighbourhood.size(), moments_.factor());
    if (jet.terms > 0) moments_.solve(jet);
    return jet;
  }

  /// With weights the gain of sample j is w_j^2 (row j) . u, u = (R^T R)^-1 e.
  void add_weighted_gains(Jet& jet) const
  {
    std::array<std::array<double, 4>, Jet::quartic> u{};
    for (int i = 0; i < 3; ++i) {
      const auto x = system_.back_substituted(jet.terms, system_.row_of_inverse(jet.terms, 2 + i));
      for (int k = 0; k < jet.terms; ++k) u[std::size_t(k)][std::size_t(i)] = x[std::size_t(k)];
    }
    std::array<double, 4> square{};
    for (int j = 0; j < samples_.size(); ++j) {
      std::array<double, 4> gain{};
      for (std::size_t k = 0; k < Jet::quartic; ++k) {
        for (std::size_t i = 0; i < 4; ++i) gain[i] += samples_.row(j)[k] * u[k][i];
      }
      const double w2 = samples_.weight(j) * samples_.weight(j);
      for (std::size_t i = 0; i < 4; ++i) square[i] += w2 * w2 * gain[i] * gain[i];
    }
    for (std::size_t i = 0; i < 3; ++i) jet.variance[i] += square[i];
  }

  /// \brief The ladder, whose first level is `first`.
  ///
  /// On stretched meshes rings are long and thin, and noise hides the curvature across them: balls
  /// of as many samples take their place, from the first level on.
  Jet climb(const Jet& first, Neighbourhood& neighbourhood, const Frame& frame)
  {
    const bool is_stretched = samples_.elongation() > largest_elongation;
    levels_.assign(1, first);
    Jet result = simplest(first);
    if (is_stretched) {
      neighbourhood.grow_ball(samples_of_rings(4));
      const Jet jet = uniform_fit(neighbourhood, frame);
      if (jet.terms == 0) return result;
      levels_.assign(1, jet);
      result = simplest(jet);
    }
    for (const int rings : {5, 8}) {
      if (!widen(neighbourhood, rings, is_stretched)) break;
      const Jet jet = fit_moments(neighbourhood, frame);
      if (jet.terms == 0 || !is_admissible(jet)) break;
      levels_.push_back(jet);
      result = simplest(jet);
    }
    return result;
  }

  /// False if no sample was added.
  static bool widen(Neighbourhood& neighbourhood, int rings, bool is_stretched)
  {
    const int before = neighbourhood.size();
    if (is_stretched) {
      neighbourhood.grow_ball(samples_of_rings(rings));
    } else {
      while (neighbourhood.rings() < rings && neighbourhood.add_ring()) {}
    }
    return neighbourhood.size() > before;
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

  /// The least order of a level that agrees with its highest.
  Jet simplest(const Jet& highest) const
  {
    Jet result = highest;
    for (const int terms : {Jet::cubic, Jet::quadratic}) {
      if (terms >= highest.terms) continue;
      Jet jet;
      jet.terms = terms;
      moments_.solve(jet);
      if (!agrees(jet, highest, agreement_of_orders)) break;
      if (jet.total_variance() < result.total_variance()) result = jet;
    }
    return result;
  }

  static constexpr int enough_samples = 24;
  static constexpr double certainty = 0.005;
  static constexpr double agreement_of_levels = 4;
  static constexpr double agreement_of_orders = 1.5;
  static constexpr double largest_elongation = 9; ///< of moments: three to one in length

  const Side_graph& graph_;
  Samples samples_;
  Quartic_system system_;
  Moments moments_;
  std::size_t added_ = 0;   ///< number of samples in the moments
  std::vector<Jet> levels_; ///< admissible ones
  double floor_ = 0, noise_square_ = 0, weighted_noise_square_ = 0;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_ADAPTIVE_FIT_H
