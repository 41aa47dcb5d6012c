// SPDX-License-Identifier: GPL-3.0-or-later
//
// The unit mesh, apart from the rest, so that both compile at the same time.
#include "remeshing.h"

namespace surety {

template Remeshing remesh(tool::Mesh&, Features, double, const tool::Remesh_parameters&);

} // namespace surety
