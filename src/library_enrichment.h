// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef SURETY_TOOL_LIBRARY_ENRICHMENT_H
#define SURETY_TOOL_LIBRARY_ENRICHMENT_H

#include "library_fields.h"

#include <surety/enrich.h>

#include <utility>

namespace surety::tool {

/// The controls of `enrich`, lengths in mesh units.
struct Enrichment_controls {
  double maximum_size = 0;
  unsigned rounds = internal::defaults::enrichment_rounds;
  bool allow_self_intersections = internal::defaults::allow_self_intersections;
};

inline auto enrichment_parameters(
    const Enrichment_controls& controls, const Geometric_support& support)
{
  return parameters::geometric_support(support)
      .maximum_size(controls.maximum_size)
      .allow_self_intersections(controls.allow_self_intersections)
      .number_of_iterations(controls.rounds);
}

using Enrichment_parameters = decltype(enrichment_parameters(
    std::declval<Enrichment_controls>(), std::declval<Geometric_support>()));

} // namespace surety::tool

namespace surety {

extern template Enrichment enrich(
    tool::Mesh&, const Features&, double, const tool::Enrichment_parameters&);

} // namespace surety

#endif // SURETY_TOOL_LIBRARY_ENRICHMENT_H
