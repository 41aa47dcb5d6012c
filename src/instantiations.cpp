// SPDX-License-Identifier: GPL-3.0-or-later
//
// Instantiates every public template of the library, so that the compiler sees all of it at least
// once, and the command line just once.
#include "instantiations.h"

namespace surety {

template Certificate make_geometric_mesh<tool::Concurrency>(
    tool::Mesh&, double, const tool::Simplify_parameters&);
template Hierarchy<tool::Mesh> make_hierarchy(
    const tool::Mesh&, const std::vector<double>&, const tool::Hierarchy_parameters&);
template Certificate_check check_certificate(
    const tool::Mesh&, const tool::Mesh&, const Certificate&, const tool::No_parameters&,
    const tool::No_parameters&);
template Distance_certificate certify_distance(
    const tool::Mesh&, const tool::Mesh&, double, const tool::No_parameters&,
    const tool::No_parameters&);
template Hausdorff_distance hausdorff_distance(
    const tool::Mesh&, const tool::Mesh&, double, const tool::No_parameters&,
    const tool::No_parameters&);
template Features find_features(const tool::Mesh&, const tool::Feature_parameters&);
template Mesh_statistics mesh_statistics(const tool::Mesh&, const tool::No_parameters&);
template Curvature_field estimate_curvatures<tool::Concurrency>(
    const tool::Mesh&, const Features&, const tool::Curvature_parameters&);
template Metric_field make_geometric_metric(
    const tool::Mesh&, const Curvature_field&, const tool::Metric_parameters&);
template Features find_features_by_need(const tool::Mesh&, double, const tool::Need_parameters&);
template std::size_t limit_gradation(
    const tool::Mesh&, Metric_field&, const tool::Gradation_parameters&);
template Geometric_support make_geometric_support(
    const tool::Mesh&, double, const Features&, const Curvature_field&, const tool::No_parameters&);

} // namespace surety
