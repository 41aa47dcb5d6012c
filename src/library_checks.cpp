// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_checks.h"

namespace surety {

template Certificate_check check_certificate(
    const tool::Mesh&, const tool::Mesh&, const Certificate&, const tool::No_parameters&,
    const tool::No_parameters&);
template Distance_certificate certify_distance(
    const tool::Mesh&, const tool::Mesh&, double, const tool::No_parameters&,
    const tool::No_parameters&);
template Hausdorff_distance hausdorff_distance(
    const tool::Mesh&, const tool::Mesh&, double, const tool::No_parameters&,
    const tool::No_parameters&);
template std::optional<Covering> make_covering(const tool::Mesh&, const tool::Mesh&, double);
template Covering_check check_covering(const tool::Mesh&, const tool::Mesh&, const Covering&);

} // namespace surety
