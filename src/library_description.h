// SPDX-License-Identifier: GPL-3.0-or-later
//
// Features and statistics.
#ifndef SURETY_TOOL_LIBRARY_DESCRIPTION_H
#define SURETY_TOOL_LIBRARY_DESCRIPTION_H

#include "parameter_chains.h"

#include <surety/features.h>
#include <surety/features_by_need.h>
#include <surety/statistics.h>

namespace surety {

extern template Features find_features(const tool::Mesh&, const tool::Feature_parameters&);
extern template Features find_features_by_need(
    const tool::Mesh&, double, const tool::Need_parameters&);
extern template Mesh_statistics mesh_statistics(const tool::Mesh&, const tool::No_parameters&);

} // namespace surety

#endif // SURETY_TOOL_LIBRARY_DESCRIPTION_H
