// SPDX-License-Identifier: GPL-3.0-or-later
//
// The two independent checks.
#ifndef SURETY_TOOL_LIBRARY_CHECKS_H
#define SURETY_TOOL_LIBRARY_CHECKS_H

#include "parameter_chains.h"

#include <surety/certificate.h>
#include <surety/covering_certificate.h>
#include <surety/distance.h>

#include <optional>

namespace surety {

extern template Certificate_check check_certificate(
    const tool::Mesh&, const tool::Mesh&, const Certificate&, const tool::No_parameters&,
    const tool::No_parameters&);
extern template Distance_certificate certify_distance(
    const tool::Mesh&, const tool::Mesh&, double, const tool::No_parameters&,
    const tool::No_parameters&);
extern template Hausdorff_distance hausdorff_distance(
    const tool::Mesh&, const tool::Mesh&, double, const tool::No_parameters&,
    const tool::No_parameters&);
extern template std::optional<Covering> make_covering(const tool::Mesh&, const tool::Mesh&, double);
extern template Covering_check check_covering(
    const tool::Mesh&, const tool::Mesh&, const Covering&);

} // namespace surety

#endif // SURETY_TOOL_LIBRARY_CHECKS_H
