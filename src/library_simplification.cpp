// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_simplification.h"

namespace surety {

template Certificate make_geometric_mesh<tool::Concurrency>(
    tool::Mesh&, double, const tool::Simplify_parameters&);
template Hierarchy<tool::Mesh> make_hierarchy(
    const tool::Mesh&, const std::vector<double>&, const tool::Hierarchy_parameters&);

} // namespace surety
