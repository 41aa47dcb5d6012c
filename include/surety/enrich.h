// SPDX-License-Identifier: GPL-3.0-or-later
//
// Enrichment: a coarse faceted model of a curved part, refined towards the smooth surface through
// its vertices (figures 9 and 10 of P. J. Frey, About Surface Remeshing, 2000).
#ifndef SURETY_ENRICH_H
#define SURETY_ENRICH_H

#include <surety/curvature.h>
#include <surety/features.h>
#include <surety/geometric_support.h>
#include <surety/internal/enrich/enricher.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace surety {

/// What `enrich()` answers for, and whether it got there.
struct Enrichment_goals {
  bool is_fine = false; ///< no edge is too long, and none was found too far from the support
  std::size_t folded_faces = 0;  ///< new faces outside the cone of normals
  std::size_t intersections = 0; ///< pairs of new faces that meet, of faces that did not
  /// All of them were reached.
  bool hold() const { return is_fine && folded_faces == 0 && intersections == 0; }
};

/// The answer of `enrich()`.
struct Enrichment {
  Enrichment_goals enforced; ///< what was asked for
  /// Not enforced: a proven bound of the two-sided Hausdorff distance to the input.
  double deviation = 0;
  std::size_t damped_faces = 0; ///< faces of the input that went a part of the way only
  unsigned rounds = 0;          ///< in which edges were halved
};

namespace internal {

template <class Mesh, class Points, class NamedParameters>
Geometric_support support_to_enrich(
    const Mesh& mesh, const Points& points, const Features& features, const NamedParameters& np)
{
  if constexpr (CGAL::parameters::is_default_parameter<
                    NamedParameters, geometric_support_t>::value) {
    const auto with_points = CGAL::parameters::vertex_point_map(points);
    return make_geometric_support(
        mesh, std::numeric_limits<double>::infinity(), features,
        estimate_curvatures(mesh, features, with_points), with_points);
  } else {
    return CGAL::parameters::get_parameter(np, geometric_support);
  }
}

template <class NamedParameters>
enrichment::Enrichment_controls enrichment_controls(double tolerance, const NamedParameters& np)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const double largest
      = choose_parameter(get_parameter(np, maximum_size), std::numeric_limits<double>::infinity());
  if (!(largest > 0))
    throw Invalid_input("enrich", "maximum_size", to_text(largest) + " is not positive");
  return {
      tolerance, largest,
      static_cast<unsigned>(choose_parameter(
          get_parameter(np, CGAL::internal_np::number_of_iterations), defaults::enrichment_rounds)),
      choose_parameter(
          get_parameter(np, allow_self_intersections), defaults::allow_self_intersections)};
}

} // namespace internal

/// \brief Refines a mesh towards its geometric support, in place.
///
/// For a coarse model of a curved part, whose faces stand for the smooth surface through its
/// vertices. The result leaves the input on purpose, so the distance between the two is reported
/// and not enforced: what is small is the gap between the result and the support.
///
/// Edges are halved, longest first where shapes ask for it, until none is longer than
/// `maximum_size` and the support is within the tolerance of edges at their quarters, and of faces
/// at their centroids. That is measured there, not proven in between.
///
/// Enforced, and told by `Enrichment::enforced`:
/// - the vertices of the input stay, to the last bit, and so does what its faces and edges are cut
///   into: ridges, borders and corners are where they were, ridges along the support's curves;
/// - the new vertices lie on the support, unless:
/// - a face would turn by more than 45 degrees from both the support's normal and that of the face
///   of the input it is a part of, or meet a face that its own did not meet. There the vertices go
///   half of the way, a quarter, and in the end none of it, evenly over the faces around, of which
///   `Enrichment::damped_faces` is the number.
///
/// Reported: `Enrichment::deviation`, a proven upper bound of the two-sided Hausdorff distance to
/// the input. The points of a face correspond to those of its pieces, and are nowhere farther from
/// them than at a vertex.
///
/// The result is no unit mesh: hand it to `remesh()`, whose tolerance is then about the smooth
/// surface. The mesh is replaced; the vertices of the input come first, in their order. The
/// property map "f:deviation" (`double`) has the bound of each face, "e:is_feature" (`bool`) the
/// ridges and borders. When an exception is thrown the mesh is unchanged.
///
/// Linear in the size of the result, and n log n for intersections.
///
/// \param mesh a `CGAL::Surface_mesh` with coordinates convertible to `double`; may have borders.
/// \param features of the mesh; the result is smooth across all other edges.
/// \param tolerance largest gap to the support: in mesh units, positive.
/// \throws Invalid_input when the mesh is not valid, features or support belong to another mesh, or
///   a parameter is out of its range.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{geometric_support}
///     \cgalParamDescription{the smooth surface}
///     \cgalParamType{`Geometric_support`, of the same mesh with the same features}
///     \cgalParamDefault{one that nothing bounds, with the normals of `estimate_curvatures()`}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_size}
///     \cgalParamDescription{longer edges are halved}
///     \cgalParamType{`double`, a length in mesh units, positive}
///     \cgalParamDefault{infinity}
///   \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations}
///     \cgalParamDescription{largest number of rounds, each of which halves edges once}
///     \cgalParamType{`unsigned int`}
///     \cgalParamDefault{12}
///   \cgalParamNEnd
///   \cgalParamNBegin{allow_self_intersections}
///     \cgalParamDescription{do not look for new ones}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`false`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are; the result has its own points}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Enrichment enrich(
    Mesh& mesh, const Features& features, double tolerance,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const char* const function = "enrich";
  internal::require_valid_mesh(mesh, function, "mesh", np);
  internal::require_positive(tolerance, function, "tolerance");
  internal::require_features_of(mesh, features, function);
  const auto controls = internal::enrichment_controls(tolerance, np);
  const auto points = internal::vertex_points(mesh, np);
  const Geometric_support support = internal::support_to_enrich(mesh, points, features, np);
  if (support.number_of_faces() != num_faces(mesh))
    throw Invalid_input(function, "geometric_support", "it does not belong to the mesh");

  internal::enrichment::Enricher<Mesh, std::decay_t<decltype(points)>> enricher(
      mesh, points, features, support, controls);
  enricher.run();
  Mesh result = enricher.result();
  Enrichment answer;
  answer.enforced = {enricher.is_fine(), enricher.folded_faces(), enricher.intersections()};
  const auto bound
      = result.template property_map<typename Mesh::Face_index, double>("f:deviation").first;
  for (const auto f : result.faces()) answer.deviation = (std::max)(answer.deviation, bound[f]);
  answer.damped_faces = enricher.damped_faces();
  answer.rounds = enricher.rounds();
  mesh = std::move(result);
  return answer;
}

} // namespace surety

#endif // SURETY_ENRICH_H
