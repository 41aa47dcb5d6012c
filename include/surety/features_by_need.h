// SPDX-License-Identifier: GPL-3.0-or-later
//
// Features that a tolerance needs: the creases that a smooth surface could not follow.
#ifndef SURETY_FEATURES_BY_NEED_H
#define SURETY_FEATURES_BY_NEED_H

#include <surety/features.h>
#include <surety/internal/features_by_need/crease.h>
#include <surety/internal/features_by_need/curves.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <vector>

namespace surety {

namespace internal {

inline std::vector<bool> creases_by_need(
    const Flat_mesh& mesh, double tolerance, const std::vector<bool>& is_feature)
{
  std::vector<bool> is_anchor(mesh.point.size(), false);
  for (Index e = 0; e < mesh.edges(); ++e) {
    if (!is_feature[e]) continue;
    for (const Index v : mesh.ends[e]) is_anchor[v] = true;
  }
  Crease_finder finder(mesh, tolerance);
  std::vector<Crease> creases(mesh.edges());
  for (Index e = 0; e < mesh.edges(); ++e) {
    if (mesh.places[e][1] != none && !is_feature[e]) creases[e] = finder.examine(e);
  }
  return Curve_filter(mesh, creases, is_anchor).kept();
}

} // namespace internal

/// \brief Finds the feature edges that a tolerance needs, and the corners.
///
/// Ridges are the edges where a smooth surface would leave the tolerance: one that goes over a turn
/// of angle t within a width w leaves it by w t/8, so the angle that matters is 8 tolerance/w. What
/// the turn is, is not read off one edge: it must persist at the distance at which it matters, on
/// both sides, against the roughness of the surface there, and along a curve that is long against
/// tolerance and roughness. So the edges of a part are found however finely it is meshed, and a
/// scan is not cut by what its noise makes. Borders and constrained edges are features in any case.
///
/// \param tolerance in mesh units, positive.
/// \throws Invalid_input when the mesh is not valid or a number not in its range.
///
/// Time is linear in the size of the mesh plus that of the surroundings of all edges that turn by
/// more than 20 degrees, within 8 tolerance/turn of them.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{corner_angle}
///     \cgalParamDescription{where a curve of feature edges turns by more there is a corner}
///     \cgalParamType{`double`, in degrees, from 0 to 180}
///     \cgalParamDefault{60}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{edges that are features in any case}
///     \cgalParamType{a readable property map from edges to `bool`}
///     \cgalParamDefault{no edge}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_is_constrained_map}
///     \cgalParamDescription{vertices that are corners in any case, on a feature edge or not}
///     \cgalParamType{a readable property map from vertices to `bool`}
///     \cgalParamDefault{no vertex}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Features find_features_by_need(
    const Mesh& mesh, double tolerance,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const char* const function = "find_features_by_need";
  internal::require_valid_mesh(mesh, function, "mesh", np);
  internal::require_positive(tolerance, function, "tolerance");
  constexpr double no_angle = 180 * internal::radians_per_degree;
  return internal::features_of(mesh, np, function, no_angle, [&](Features& features) {
    const std::vector<bool> creases = internal::creases_by_need(
        internal::flatten(mesh, internal::vertex_points(mesh, np)), tolerance, features.edge);
    for (const auto e : edges(mesh)) {
      if (!creases[e]) continue;
      features.edge[e] = true;
      ++features.ridges;
    }
  });
}

} // namespace surety

#endif // SURETY_FEATURES_BY_NEED_H
