// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_remeshing.h"

namespace surety {

template Remeshing remesh(tool::Mesh&, Features, double, const tool::Remesh_parameters&);

} // namespace surety
