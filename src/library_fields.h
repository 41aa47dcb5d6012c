// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature, metric and support.
#ifndef SURETY_TOOL_LIBRARY_FIELDS_H
#define SURETY_TOOL_LIBRARY_FIELDS_H

#include "parameter_chains.h"

#include <surety/curvature.h>
#include <surety/geometric_support.h>
#include <surety/gradation.h>
#include <surety/metric.h>

namespace surety {

extern template Curvature_field estimate_curvatures<tool::Concurrency>(
    const tool::Mesh&, const Features&, const tool::Curvature_parameters&);
extern template Metric_field make_geometric_metric(
    const tool::Mesh&, const Curvature_field&, const tool::Metric_parameters&);
extern template std::size_t limit_gradation(
    const tool::Mesh&, Metric_field&, const tool::Gradation_parameters&);
extern template Geometric_support make_geometric_support(
    const tool::Mesh&, double, const Features&, const Curvature_field&, const tool::No_parameters&);

} // namespace surety

#endif // SURETY_TOOL_LIBRARY_FIELDS_H
