// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_fields.h"

namespace surety {

template Curvature_field estimate_curvatures<tool::Concurrency>(
    const tool::Mesh&, const Features&, const tool::Curvature_parameters&);
template Metric_field make_geometric_metric(
    const tool::Mesh&, const Curvature_field&, const tool::Metric_parameters&);
template std::size_t limit_gradation(
    const tool::Mesh&, Metric_field&, const tool::Gradation_parameters&);
template Geometric_support make_geometric_support(
    const tool::Mesh&, double, const Features&, const Curvature_field&, const tool::No_parameters&);

} // namespace surety
