// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simplification and levels of detail.
#ifndef SURETY_TOOL_LIBRARY_SIMPLIFICATION_H
#define SURETY_TOOL_LIBRARY_SIMPLIFICATION_H

#include "parameter_chains.h"

#include <surety/geometric_mesh.h>
#include <surety/hierarchy.h>

namespace surety {

extern template Certificate make_geometric_mesh<tool::Concurrency>(
    tool::Mesh&, double, const tool::Simplify_parameters&);
extern template Hierarchy<tool::Mesh> make_hierarchy(
    const tool::Mesh&, const std::vector<double>&, const tool::Hierarchy_parameters&);

} // namespace surety

#endif // SURETY_TOOL_LIBRARY_SIMPLIFICATION_H
