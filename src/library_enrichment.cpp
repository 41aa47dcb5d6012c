// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_enrichment.h"

namespace surety {

template Enrichment enrich(
    tool::Mesh&, const Features&, double, const tool::Enrichment_parameters&);

} // namespace surety
