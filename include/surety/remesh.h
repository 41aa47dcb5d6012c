// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole pipeline in one call: features, curvature, metric, support, unit mesh, proof (P. J.
// Frey, About Surface Remeshing, 2000).
#ifndef SURETY_REMESH_H
#define SURETY_REMESH_H

#include <surety/curvature.h>
#include <surety/features.h>
#include <surety/features_by_need.h>
#include <surety/geometric_support.h>
#include <surety/gradation.h>
#include <surety/metric.h>
#include <surety/proximity.h>
#include <surety/unit_mesh.h>

#include <CGAL/Named_function_parameters.h>

#include <optional>
#include <utility>

namespace surety {

/// What each stage of `remesh()` made. All but the last refer to the original.
struct Remeshing {
  Features features;          ///< ridges, borders and corners
  Curvature_field curvature;  ///< by side
  Metric_field metric;        ///< as asked for, graded
  Geometric_support support;  ///< the smooth surface
  Unit_mesh_result unit_mesh; ///< the certificate, and how well the metric is met
};

namespace internal {

/// Gap over curvature times size squared. The triangle's own constant, 1/6 to 1/8, would have every
/// face within the tolerance of a smooth surface that its vertices lie on. Vertices that may leave
/// it have twice the room, and the bound decides in the end.
constexpr double remesh_gap_constant = 1. / 12;
/// Where the tolerance allows it, isotropic sizes may be much larger. Larger anisotropic ones take
/// few faces away, and leave fewer edges unit in the metric that was asked for.
inline double remesh_gap_constant_for_fewest(Metric_kind kind)
{
  return kind == Metric_kind::isotropic ? 1. / 45 : 1. / 20;
}
constexpr double remesh_gradation_for_fewest = 1.75;
constexpr double remesh_least_size = 6; ///< times the tolerance

/// What the user says, or, where that is 0, what we say.
inline double positive_or(double value, double otherwise, const char* name)
{
  if (value == 0) return otherwise;
  require_positive(value, "remesh", name);
  return value;
}

/// Infinity lets sizes jump, and what is below 1 is refused by who limits the gradation.
template <class NamedParameters>
double gradation_to_remesh(bool is_for_fewest, const NamedParameters& np)
{
  const double beta
      = CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, gradation), 0.);
  if (beta != 0) return beta;
  return is_for_fewest ? remesh_gradation_for_fewest : defaults::gradation;
}

template <class Mesh, class NamedParameters>
Features features_to_remesh(const Mesh& mesh, double length, const NamedParameters& np)
{
  if constexpr (CGAL::parameters::is_default_parameter<NamedParameters, feature_angle_t>::value) {
    return find_features_by_need(mesh, length, np);
  } else {
    return find_features(mesh, np);
  }
}

/// The metric that a tolerance asks for, intersected with the sizes that the user asks for.
template <class Mesh, class NamedParameters>
Metric_field metric_to_remesh(
    const Mesh& mesh, const Features& features, const Curvature_field& curvature, double length,
    bool is_for_fewest, double beta, const NamedParameters& np)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const Metric_kind kind
      = choose_parameter(get_parameter(np, metric_kind), defaults::remesh_metric_kind);
  const double constant = choose_parameter(
      get_parameter(np, gap_constant),
      is_for_fewest ? remesh_gap_constant_for_fewest(kind) : remesh_gap_constant);
  const auto box = CGAL::Polygon_mesh_processing::bbox(mesh, as_cgal(np));
  const double diagonal
      = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  const double largest = positive_or(
      choose_parameter(get_parameter(np, maximum_size), 0.), diagonal / 10, "maximum_size");
  const double least = positive_or(
      choose_parameter(get_parameter(np, minimum_size), 0.),
      (std::min)(remesh_least_size * length, largest), "minimum_size");
  const auto sizes
      = parameters::metric_tolerance(length)
            .metric_kind(kind)
            .gap_constant(constant)
            .minimum_size(least)
            .maximum_size(largest)
            .maximum_aspect_ratio(choose_parameter(
                get_parameter(np, maximum_aspect_ratio), defaults::maximum_aspect_ratio));
  const auto make = [&](const auto& all) {
    Metric_field metric
        = make_geometric_metric(mesh, curvature, all.vertex_point_map(vertex_points(mesh, np)));
    const bool wants_room = choose_parameter(get_parameter(np, proximity), !is_for_fewest);
    if (wants_room && metric.kind() == Metric_kind::isotropic)
      limit_proximity(
          mesh, metric, features,
          parameters::gradation(beta).minimum_size(least).vertex_point_map(
              vertex_points(mesh, np)));
    limit_gradation(
        mesh, metric, parameters::gradation(beta).vertex_point_map(vertex_points(mesh, np)));
    return metric;
  };
  if constexpr (CGAL::parameters::is_default_parameter<NamedParameters, size_field_t>::value) {
    return make(sizes);
  } else {
    return make(sizes.size_field(get_parameter(np, size_field)));
  }
}

} // namespace internal

/// \brief Remeshes a mesh, in place, for simulation: sizes that follow the curvature, well-shaped
/// faces, and a proven distance to the original.
///
/// Finds features, estimates curvature, makes the geometric metric and the geometric support that
/// the tolerance asks for, and makes the mesh unit in that metric. Each of the stages can be called
/// on its own; the result has what each of them made.
///
/// The mesh is replaced as `make_unit_mesh()` describes, with the same guarantees. When an
/// exception is thrown the mesh is unchanged.
///
/// \param features of the mesh; without them they are found, see `feature_angle`.
/// \param tolerance largest two-sided Hausdorff distance to the input, in mesh units.
/// \throws Invalid_input when the mesh is not valid, or a parameter is out of its range.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{feature_angle}
///     \cgalParamDescription{edges where the surface turns by more are ridges}
///     \cgalParamType{`double`, in degrees, from 0 to 180; 180: none}
///     \cgalParamDefault{ridges are found where a smooth surface would leave the tolerance, as
///       `find_features_by_need()` does}
///   \cgalParamNEnd
///   \cgalParamNBegin{metric_kind}
///     \cgalParamDescription{whether sizes depend on direction}
///     \cgalParamDefault{`Metric_kind::isotropic`}
///   \cgalParamNEnd
///   \cgalParamNBegin{gap_constant}
///     \cgalParamDescription{gap over curvature times size squared}
///     \cgalParamType{`double`, positive}
///     \cgalParamDefault{1/12; 1/45 for fewest faces, 1/20 if they are anisotropic}
///   \cgalParamNEnd
///   \cgalParamNBegin{fewest_faces}
///     \cgalParamDescription{prefer few faces to a mesh that follows the curvature closely}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`false`}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradation}
///     \cgalParamDescription{by which factor sizes may grow along an edge of unit length}
///     \cgalParamType{`double`, at least 1; infinity lets sizes jump}
///     \cgalParamDefault{0: 1.3; 1.75 for fewest faces}
///   \cgalParamNEnd
///   \cgalParamNBegin{proximity}
///     \cgalParamDescription{whether isotropic sizes are lowered where features are near to each
///       other, as `limit_proximity()` does; anisotropic ones never are}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`true`; `false` for fewest faces}
///   \cgalParamNEnd
///   \cgalParamNBegin{minimum_size}
///     \cgalParamDescription{the least size that curvature or proximity asks for}
///     \cgalParamType{`double`, a length in mesh units, positive}
///     \cgalParamDefault{0: six times the tolerance; where the tolerance asks for less, down to a
///       third of that}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_size}
///     \cgalParamDescription{the largest size}
///     \cgalParamType{`double`, a length in mesh units}
///     \cgalParamDefault{0: a tenth of the diagonal of the bounding box}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_aspect_ratio}
///     \cgalParamDescription{largest ratio of the two sizes at one place}
///     \cgalParamType{`double`, at least 1}
///     \cgalParamDefault{10}
///   \cgalParamNEnd
///   \cgalParamNBegin{size_field}
///     \cgalParamDescription{sizes of the user, intersected with those of the curvature}
///     \cgalParamType{as for `make_geometric_metric()`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// Also reads `corner_angle`, `edge_is_constrained_map`, `vertex_is_constrained_map`, and what
/// `make_unit_mesh()` reads.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Remeshing remesh(
    Mesh& mesh, Features features, double tolerance,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;

  const char* const function = "remesh";
  internal::require_valid_mesh(mesh, function, "mesh", np);
  internal::require_positive(tolerance, function, "tolerance");
  internal::require_features_of(mesh, features, function);
  const bool is_for_fewest = choose_parameter(
      get_parameter(np, internal::fewest_faces), internal::defaults::fewest_faces);
  const double beta = internal::gradation_to_remesh(is_for_fewest, np);

  const auto points = internal::vertex_points(mesh, np);
  Curvature_field curvature = estimate_curvatures(
      mesh, features, parameters::noise_floor(tolerance / 3).vertex_point_map(points));
  Metric_field metric
      = internal::metric_to_remesh(mesh, features, curvature, tolerance, is_for_fewest, beta, np);
  Geometric_support support = make_geometric_support(
      mesh, tolerance, features, curvature, CGAL::parameters::vertex_point_map(points));
  const double least = internal::positive_or(
      choose_parameter(get_parameter(np, internal::minimum_size), 0.), 2 * tolerance,
      "minimum_size");
  const auto controls
      = parameters::tolerance(tolerance)
            .geometric_support(support)
            .gradation(beta)
            .fewest_faces(is_for_fewest)
            .minimum_size(least)
            .background_metric(choose_parameter(
                get_parameter(np, internal::background_metric),
                static_cast<const Background_metric*>(nullptr)))
            .placement(choose_parameter(
                get_parameter(np, internal::placement), internal::defaults::unit_mesh_placement))
            .allow_self_intersections(choose_parameter(
                get_parameter(np, internal::allow_self_intersections),
                internal::defaults::allow_self_intersections))
            .number_of_iterations(choose_parameter(
                get_parameter(np, CGAL::internal_np::number_of_iterations),
                internal::defaults::unit_mesh_iterations))
            .vertex_point_map(points);
  const auto make = [&](const auto& all) { return make_unit_mesh(mesh, features, metric, all); };
  if constexpr (CGAL::parameters::is_default_parameter<
                    NamedParameters, CGAL::internal_np::visitor_t>::value) {
    Unit_mesh_result unit = make(controls);
    return {
        std::move(features), std::move(curvature), std::move(metric), std::move(support),
        std::move(unit)};
  } else {
    Unit_mesh_result unit = make(controls.visitor(get_parameter(np, CGAL::internal_np::visitor)));
    return {
        std::move(features), std::move(curvature), std::move(metric), std::move(support),
        std::move(unit)};
  }
}

/// \brief The same, with the features that `feature_angle` tells, or that are found by need.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Remeshing remesh(
    Mesh& mesh, double tolerance, const NamedParameters& np = CGAL::parameters::default_values())
{
  internal::require_positive(tolerance, "remesh", "tolerance");
  return remesh(mesh, internal::features_to_remesh(mesh, tolerance, np), tolerance, np);
}

} // namespace surety

#endif // SURETY_REMESH_H
