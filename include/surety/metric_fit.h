// SPDX-License-Identifier: GPL-3.0-or-later
//
// How well a mesh fits a metric.
#ifndef SURETY_METRIC_FIT_H
#define SURETY_METRIC_FIT_H

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
};

} // namespace surety

#endif // SURETY_METRIC_FIT_H
