// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adaptation to a field.
#ifndef SURETY_TOOL_LIBRARY_ADAPTATION_H
#define SURETY_TOOL_LIBRARY_ADAPTATION_H

#include "library_remeshing.h"

#include <optional>
#include <vector>

namespace surety::tool {

/// The controls of `adapt`: those of `remesh`, and what is wanted of the field.
struct Adaptation_controls {
  Remesh_controls remeshing;
  std::optional<double> target_vertices, target_error;
  double norm_exponent = internal::defaults::norm_exponent;
};

/// A field, by vertex of the mesh where it is known.
struct Carried_field {
  const Mesh& mesh;
  const Features& features;
  std::vector<double> values;
};

/// What is made, and the number of vertices that the field alone asks for.
struct Adaptation {
  Unit_mesh_result unit_mesh;
  double vertices_for_field;        ///< by the complexity of its metric
  double vertices_for_graded_field; ///< after its gradation was limited
};

/// Remeshes a mesh in the metric of its surface, intersected with that of a field.
Adaptation adapt(
    Mesh& mesh, const Features& features, double tolerance, const Carried_field& field,
    const Adaptation_controls& controls, const Visitor& visitor);

} // namespace surety::tool

#endif // SURETY_TOOL_LIBRARY_ADAPTATION_H
