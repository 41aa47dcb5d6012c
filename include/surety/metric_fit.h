// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well a mesh fits a metric.
#ifndef SURETY_METRIC_FIT_H
#define SURETY_METRIC_FIT_H

#include <array>
#include <cstddef>

namespace surety {

/// \brief What a metric thinks of a mesh.
///
/// An edge is unit when its length in the metric is from 1/sqrt(2) to sqrt(2). The efficiency index
/// is tau = 1 - (1/n) sum e_i^2 over the n edges, e = 1 - l for l < 1 and 1 - 1/l else (equation
/// (24) of P. J. Frey, About Surface Remeshing, 2000): 1 where all edges have length 1.
struct Metric_fit {
  double unit_edges = 100;     ///< in per cent
  double efficiency_index = 1; ///< tau, from 0 to 1
  double Q_avg = 1;            ///< mean quality of the faces, measured in the metric
  double Q_max = 1;            ///< the worst one

  /// Upper limits of the bins of the histograms; the last bin has what is above them all.
  static constexpr std::array<double, 8> length_limits{
      .3, .6, .7071067811865476, .9, 1.3, 1.4142135623730951, 2, 5};
  /// Those of the qualities.
  static constexpr std::array<double, 7> quality_limits{1.1, 1.2, 1.5, 2, 3, 5, 10};
  std::array<std::size_t, 9> length_histogram{};  ///< number of edges, by metric length
  std::array<std::size_t, 8> quality_histogram{}; ///< number of faces, by quality
};

} // namespace surety

#endif // SURETY_METRIC_FIT_H
