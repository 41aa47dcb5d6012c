// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_description.h"

namespace surety {

template Features find_features(const tool::Mesh&, const tool::Feature_parameters&);
template Features find_features_by_need(const tool::Mesh&, double, const tool::Need_parameters&);
template Mesh_statistics mesh_statistics(const tool::Mesh&, const tool::No_parameters&);

} // namespace surety
