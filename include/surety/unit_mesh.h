// SPDX-License-Identifier: GPL-3.0-or-later
//
// The unit mesh: all edges of length one in a metric, within the tolerance of the original (section
// 5 of P. J. Frey, About Surface Remeshing, 2000).
#ifndef SURETY_UNIT_MESH_H
#define SURETY_UNIT_MESH_H

#include <surety/certificate.h>
#include <surety/features.h>
#include <surety/geometric_support.h>
#include <surety/internal/unit_mesh/maker.h>
#include <surety/internal/validation.h>
#include <surety/metric_field.h>
#include <surety/metric_fit.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace surety {

/// The answer of `make_unit_mesh()`.
struct Unit_mesh_result {
  Certificate certificate; ///< of the distance to the original
  Metric_fit fit;          ///< to the metric as it was in the end
  Metric_fit fit_of_given; ///< to the metric that was asked for
  unsigned iterations = 0; ///< passes of splits, collapses, swaps and relocations
};

namespace internal {

template <class Mesh, class NamedParameters>
double unit_mesh_tolerance(const Mesh& mesh, const NamedParameters& np, const char* function)
{
  const auto box = CGAL::Polygon_mesh_processing::bbox(mesh, as_cgal(np));
  const double diagonal
      = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  const double result = CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(np, tolerance), diagonal / 1000);
  require_positive(result, function, "tolerance");
  return result;
}

template <class NamedParameters>
unit_mesh::Controls unit_mesh_controls(
    double tolerance_length, const NamedParameters& np, const char* function)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  unit_mesh::Controls controls;
  controls.tolerance = tolerance_length;
  controls.gradation = choose_parameter(get_parameter(np, gradation), defaults::gradation);
  require_in_range(
      controls.gradation, 1, std::numeric_limits<double>::infinity(), function, "gradation");
  controls.most_passes = static_cast<unsigned>(choose_parameter(
      get_parameter(np, CGAL::internal_np::number_of_iterations), defaults::unit_mesh_iterations));
  // Shorter edges are unit as well, but fewer of them are better.
  controls.collapse_below
      = choose_parameter(get_parameter(np, fewest_faces), defaults::fewest_faces) ? .9 : .8;
  controls.allow_self_intersections = choose_parameter(
      get_parameter(np, allow_self_intersections), defaults::allow_self_intersections);
  controls.places_freely
      = choose_parameter(get_parameter(np, placement), defaults::unit_mesh_placement)
      == Placement::free;
  controls.least_size = choose_parameter(get_parameter(np, minimum_size), 2 * tolerance_length);
  require_positive(controls.least_size, function, "minimum_size");
  controls.background = choose_parameter(
      get_parameter(np, background_metric), static_cast<const Background_metric*>(nullptr));
  return controls;
}

template <class NamedParameters>
std::function<bool(double, std::size_t)> unit_mesh_watcher(const NamedParameters& np)
{
  if constexpr (CGAL::parameters::is_default_parameter<
                    NamedParameters, CGAL::internal_np::visitor_t>::value) {
    return {};
  } else {
    auto visitor = CGAL::parameters::get_parameter(np, CGAL::internal_np::visitor);
    return [visitor](double fraction, std::size_t faces) mutable {
      return visitor.on_progress(Progress{"unit_mesh", fraction, faces});
    };
  }
}

template <class Mesh, class NamedParameters>
Geometric_support support_for_unit_mesh(
    const Mesh& mesh, const Features& features, double tolerance_length, const NamedParameters& np)
{
  if constexpr (CGAL::parameters::is_default_parameter<
                    NamedParameters, geometric_support_t>::value) {
    return make_geometric_support(mesh, tolerance_length, features, np);
  } else {
    return CGAL::parameters::get_parameter(np, geometric_support);
  }
}

/// The metric must have the sides that the features make, or curves would be lost.
template <class Mesh>
void require_metric_of(
    const Mesh& mesh, const Features& features, const Metric_field& metric, const char* function)
{
  if (metric.sides().of_corner.size() != num_halfedges(mesh)
      || metric.sides().of_corner != find_sides(mesh, features).of_corner)
    throw Invalid_input(
        function, "metric", "it does not belong to the mesh with these features",
        "make it with the features that are handed over");
}

} // namespace internal

/// \brief Remeshes a mesh, in place, so that its edges have length one in a metric, within a proven
/// distance.
///
/// Long edges are split, short ones collapsed, edges are swapped and vertices relocated until the
/// lengths of all edges are from 1/sqrt(2) to sqrt(2), or nothing more can be done: first with
/// coarse limits, which is where most operations fall, then with these. New vertices lie on the
/// geometric support of the mesh, and with free placement off it, where that leaves room. Every
/// operation is checked before it is made: the two-sided Hausdorff distance to the input stays
/// within the tolerance, so the result cannot fail to comply. Where the tolerance forbids the size
/// that the metric asks for, the metric is made smaller at the vertices there by factors of 0.8,
/// and around them so that it grows by `gradation`; `fit` and `fit_of_given` tell how far that
/// went.
///
/// Ridges, borders and constrained edges stay curves, with vertices on the support's curves; the
/// proof is about the surfaces, not about these. Corners and constrained vertices stay where they
/// are, and so do edges of `features.whole`. Genus, components and border loops are kept. No face
/// that intersects another one is made; where the input has some, they are left alone.
///
/// The mesh is replaced: descriptors and property maps of the input are void. The property map
/// "e:is_feature" (`bool`) tells the curves, "f:deviation" (`double`) a bound of the distance at
/// each face. When an exception is thrown the mesh is unchanged.
///
/// Ends after at most `number_of_iterations` passes, each of which tries each edge and vertex a
/// bounded number of times.
///
/// \param mesh a `CGAL::Surface_mesh` with coordinates convertible to `double`; may have borders,
///   several components and any genus.
/// \param features of the mesh.
/// \param metric of the mesh, made with these features.
/// \throws Invalid_input when the mesh is not valid, the metric does not belong to it, or a
/// parameter
///   is out of its range.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{tolerance}
///     \cgalParamDescription{largest two-sided Hausdorff distance to the input}
///     \cgalParamType{`double`, a length in mesh units, positive}
///     \cgalParamDefault{a thousandth of the diagonal of the bounding box}
///   \cgalParamNEnd
///   \cgalParamNBegin{geometric_support}
///     \cgalParamDescription{the smooth surface that vertices are placed on}
///     \cgalParamType{`Geometric_support`, of the same mesh}
///     \cgalParamDefault{one with the normals of the faces' means}
///   \cgalParamNEnd
///   \cgalParamNBegin{background_metric}
///     \cgalParamDescription{a metric on another mesh of the same surface, near to this one, to be
///       respected as well. It is read at each point that is asked for, on the face that is nearest
///       and looks the same way; its gradation must be limited already, since a front between the
///       ends of an edge is seen from there only. The fits are those of both metrics together}
///     \cgalParamType{`Background_metric`, which must outlive the call}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{placement}
///     \cgalParamDescription{`Placement::on_surface`, vertices lie on the support, or
///       `Placement::free`, anywhere within the tolerance: fewer and better faces}
///     \cgalParamDefault{`Placement::free`}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradation}
///     \cgalParamDescription{by which factor sizes may grow along an edge of unit length, where the
///       metric has been made smaller}
///     \cgalParamType{`double`, at least 1}
///     \cgalParamDefault{1.3}
///   \cgalParamNEnd
///   \cgalParamNBegin{fewest_faces}
///     \cgalParamDescription{take edges away that are shorter than .9 already, not .8}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`false`}
///   \cgalParamNEnd
///   \cgalParamNBegin{minimum_size}
///     \cgalParamDescription{the metric is not made smaller than this}
///     \cgalParamType{`double`, a length in mesh units, positive}
///     \cgalParamDefault{twice the tolerance}
///   \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations}
///     \cgalParamDescription{largest number of passes}
///     \cgalParamType{`unsigned int`}
///     \cgalParamDefault{16}
///   \cgalParamNEnd
///   \cgalParamNBegin{allow_self_intersections}
///     \cgalParamDescription{do not test for new self-intersections}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`false`}
///   \cgalParamNEnd
///   \cgalParamNBegin{visitor}
///     \cgalParamDescription{`bool on_progress(const Progress&)`; returning `false` stops with the
///       valid, certified mesh reached so far}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are; the result has its own points}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Unit_mesh_result make_unit_mesh(
    Mesh& mesh, const Features& features, const Metric_field& metric,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const char* const function = "make_unit_mesh";
  internal::require_valid_mesh(mesh, function, "mesh", np);
  internal::require_features_of(mesh, features, function);
  internal::require_metric_of(mesh, features, metric, function);
  const double length = internal::unit_mesh_tolerance(mesh, np, function);
  const auto controls = internal::unit_mesh_controls(length, np, function);
  const Geometric_support support = internal::support_for_unit_mesh(mesh, features, length, np);
  if (support.number_of_faces() != num_faces(mesh))
    throw Invalid_input(function, "geometric_support", "it does not belong to the mesh");
  const auto points = internal::vertex_points(mesh, np);

  internal::unit_mesh::Maker<Mesh> maker(
      mesh, points, features, metric, support, controls, internal::unit_mesh_watcher(np));
  maker.run();
  std::vector<double> bounds;
  Mesh result = maker.result(points, bounds);
  const double bound = bounds.empty() ? 0 : *std::max_element(bounds.begin(), bounds.end());
  auto deviation
      = result.template add_property_map<typename Mesh::Face_index, double>("f:deviation").first;
  std::size_t position = 0;
  for (const auto f : result.faces()) deviation[f] = bounds[position++];
  Unit_mesh_result answer{
      Certificate(length, bound, std::nullopt, maker.operations(), maker.is_cancelled()),
      maker.fitness(),
      {},
      maker.passes()};
  answer.fit_of_given = maker.fitness_of_given();
  mesh = std::move(result);
  return answer;
}

/// \brief The same, with the features that `find_features()` finds with these named parameters.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Unit_mesh_result make_unit_mesh(
    Mesh& mesh, const Metric_field& metric,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  return make_unit_mesh(mesh, find_features(mesh, np), metric, np);
}

} // namespace surety

#endif // SURETY_UNIT_MESH_H
