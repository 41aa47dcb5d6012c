// SPDX-License-Identifier: GPL-3.0-or-later
//
// The adaptive estimator: no order of polynomial and no size of neighbourhood is best for clean and
// for noisy meshes, so the residuals choose (O. V. Lepski's selection).
#ifndef SURETY_INTERNAL_CURVATURE_ADAPTIVE_FIT_H
#define SURETY_INTERNAL_CURVATURE_ADAPTIVE_FIT_H

#include <surety/internal/curvature/quadric.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace surety::internal::curvature {

/// \brief Chooses among polynomial fits of one frame.
///
/// 1. A fit of the highest order to three rings, weighted by 1/d^2: best on clean meshes. It is
///    taken if its curvatures are certain to 1 %.
/// 2. The same without weights, which is less sensitive to noise.
/// 3. Else a ladder from flexible fits to rigid ones: orders four, three, two on three rings, then
///    order two on wider neighbourhoods. A fit is admissible if it agrees with all that are more
///    flexible, up to their noise; the one of least variance is taken. The first that is not
///    admissible ends the search: from there on it is shape, not noise, that rigid fits lose.
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
    const Jet uniform = uniform_fit(weighted.terms);
    if (uniform.terms == 0) return std::nullopt;
    if (uniform.terms == weighted.terms && is_certain(weighted))
      return Estimate{weighted, std::sqrt(noise_square_)};
    if (is_certain(uniform)) return Estimate{uniform, std::sqrt(noise_square_)};
    return Estimate{climb(uniform, neighbourhood, frame), std::sqrt(noise_square_)};
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

  Jet uniform_fit(int terms)
  {
    const int number = samples_.size();
    for (int i = 0; i < number; ++i) system_.row(i) = samples_.row(i);
    system_.factor(number);
    Jet jet;
    jet.terms = (std::min)(terms, usable_terms(number, system_.rank()));
    if (jet.terms == 0) return jet;
    solve_uniform(system_, jet);
    const int freedom = number - jet.terms;
    if (freedom > 0) {
      const double square = system_.residual(jet.terms) / freedom;
      set_noise((std::min)(square, weighted_noise_square_));
    }
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

  /// The ladder. Its first rung is `flexible`, whose factorisation still is in the system.
  Jet climb(const Jet& flexible, Neighbourhood& neighbourhood, const Frame& frame)
  {
    rungs_[0] = flexible;
    number_of_rungs_ = 1;
    best_ = 0;
    for (const int terms : {Jet::cubic, Jet::quadratic}) {
      if (terms >= flexible.terms) continue;
      Jet jet;
      jet.terms = terms;
      solve_uniform(system_, jet);
      if (!add_rung(jet)) return rungs_[best_];
    }
    const bool is_stretched = samples_.elongation() > largest_elongation;
    for (const int rings : {5, 8}) {
      const int before = samples_.size();
      if (is_stretched) {
        neighbourhood.gather_ball(samples_of_rings(rings));
      } else {
        while (neighbourhood.rings() < rings && neighbourhood.add_ring()) {}
      }
      samples_.read(graph_, neighbourhood.sides(), frame);
      if (samples_.size() <= before || !add_rung(fit_quadric(samples_, quadratic_system_))) break;
    }
    return rungs_[best_];
  }

  /// As many as that many rings have on a regular mesh.
  static int samples_of_rings(int rings) { return 3 * rings * (rings + 1); }

  /// False if the jet disagrees with a more flexible one by more than that one's noise explains.
  bool add_rung(const Jet& jet)
  {
    if (jet.terms == 0) return false;
    for (std::size_t r = 0; r < number_of_rungs_; ++r) {
      for (int i = 0; i < 3; ++i) {
        const double difference = jet.second_order(i) - rungs_[r].second_order(i);
        const double deviation = std::sqrt(noise_square_ * rungs_[r].variance[std::size_t(i)]);
        if (std::abs(difference) > agreement * deviation) return false;
      }
    }
    rungs_[number_of_rungs_] = jet;
    if (jet.total_variance() < rungs_[best_].total_variance()) best_ = number_of_rungs_;
    ++number_of_rungs_;
    return true;
  }

  static constexpr int enough_samples = 24;
  static constexpr double certainty = 0.01;
  static constexpr double agreement = 2.5;
  static constexpr double largest_elongation = 9; ///< of moments: three to one in length

  const Side_graph& graph_;
  Samples samples_;
  Quartic_system system_;
  Quadratic_system quadratic_system_;
  std::array<Jet, 5> rungs_;
  std::size_t number_of_rungs_ = 0, best_ = 0;
  double floor_ = 0, noise_square_ = 0, weighted_noise_square_ = 0;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_ADAPTIVE_FIT_H
