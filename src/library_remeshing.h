// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole pipeline.
#ifndef SURETY_TOOL_LIBRARY_REMESHING_H
#define SURETY_TOOL_LIBRARY_REMESHING_H

#include "parameter_chains.h"

#include <surety/medit_sol.h>
#include <surety/remesh.h>

#include <utility>

namespace surety::tool {

/// The controls of `remesh`, lengths in mesh units.
struct Remesh_controls {
  Metric_kind kind = internal::defaults::remesh_metric_kind;
  Placement placement = internal::defaults::unit_mesh_placement;
  bool fewest_faces = internal::defaults::fewest_faces;
  bool limits_proximity = true; ///< unless few faces are preferred
  double gradation = 0;         ///< 0: the library's choice
  double minimum_size = 0, maximum_size = 0;
  double maximum_aspect_ratio = internal::defaults::maximum_aspect_ratio;
  unsigned iterations = internal::defaults::unit_mesh_iterations;
  bool allow_self_intersections = internal::defaults::allow_self_intersections;
};

/// \param sizes the user's, or ones that ask for nothing
inline auto remesh_parameters(
    const Remesh_controls& controls, const Medit_solution& sizes, const Visitor& visitor)
{
  return parameters::metric_kind(controls.kind)
      .placement(controls.placement)
      .fewest_faces(controls.fewest_faces)
      .proximity(controls.limits_proximity && !controls.fewest_faces)
      .gradation(controls.gradation)
      .minimum_size(controls.minimum_size)
      .maximum_size(controls.maximum_size)
      .maximum_aspect_ratio(controls.maximum_aspect_ratio)
      .size_field(sizes)
      .allow_self_intersections(controls.allow_self_intersections)
      .number_of_iterations(controls.iterations)
      .visitor(visitor);
}

using Remesh_parameters = decltype(remesh_parameters(
    std::declval<Remesh_controls>(), std::declval<Medit_solution>(), std::declval<Visitor>()));

} // namespace surety::tool

namespace surety {

extern template Remeshing remesh(tool::Mesh&, Features, double, const tool::Remesh_parameters&);

} // namespace surety

#endif // SURETY_TOOL_LIBRARY_REMESHING_H
