// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric mesh: as few faces as the tolerance allows, with the proof (section 2 of P. J.
// Frey, About Surface Remeshing, 2000).
#ifndef SURETY_GEOMETRIC_MESH_H
#define SURETY_GEOMETRIC_MESH_H

#include <surety/certificate.h>
#include <surety/features.h>
#include <surety/internal/deviation/accumulated_bound.h>
#include <surety/internal/deviation/direct_bound.h>
#include <surety/internal/geometric_mesh/exchange.h>
#include <surety/internal/geometric_mesh/record.h>
#include <surety/internal/geometric_mesh/simplifier.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <type_traits>

namespace surety {

namespace internal {

template <class NamedParameters, class Tag, class Value>
Value parameter_or(const NamedParameters& np, Tag tag, Value otherwise)
{
  return CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, tag), otherwise);
}

template <class NamedParameters, class Tag>
constexpr bool is_absent = CGAL::parameters::is_default_parameter<NamedParameters, Tag>::value;

template <class NamedParameters>
Simplification_controls simplification_controls(const NamedParameters& np, const char* function)
{
  Simplification_controls controls;
  controls.shape_ratio = parameter_or(np, shape_ratio, defaults::shape_ratio);
  controls.shape_floor = parameter_or(np, shape_floor, defaults::shape_floor);
  const double angle = parameter_or(np, roughness_angle, defaults::roughness_angle);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  require_in_range(controls.shape_ratio, 1, infinity, function, "shape_ratio");
  require_in_range(controls.shape_floor, 1, infinity, function, "shape_floor");
  require_positive(angle, function, "roughness_angle");
  require_in_range(angle, 0, 180, function, "roughness_angle");
  controls.roughness_cosine = angle < 180 ? std::cos(angle * radians_per_degree) : -2;
  controls.allow_self_intersections
      = parameter_or(np, allow_self_intersections, defaults::allow_self_intersections);
  controls.single_precision = parameter_or(np, single_precision, false);
  return controls;
}

template <class NamedParameters>
Simplification_plan simplification_plan(const NamedParameters& np, const char* function)
{
  Simplification_plan plan;
  plan.flip_rounds = parameter_or(np, flip_rounds, defaults::flip_rounds);
  plan.places_freely = parameter_or(np, placement, defaults::placement) == Placement::free;
  plan.fewest_faces = parameter_or(np, target_faces, defaults::target_faces);
  const Effort effort_spent = parameter_or(np, effort, defaults::effort);
  if (effort_spent == Effort::standard) plan.overshoots = {1.4};
  if (plan.places_freely
      && parameter_or(np, deviation_bound, defaults::deviation_bound)
          == Deviation_bound::accumulated)
    throw Invalid_input(
        function, "placement", "the accumulated bound has no operation that places vertices freely",
        "use Placement::on_surface or Deviation_bound::direct");
  if (effort_spent == Effort::best) plan.overshoots = {1.25, 1.4, 1.6, 1.8, 2, 2};
  return plan;
}

/// The visitor as a function; absent when the user gave none.
template <class NamedParameters>
std::function<bool(const Progress&)> progress_reporter(const NamedParameters& np)
{
  if constexpr (is_absent<NamedParameters, CGAL::internal_np::visitor_t>) {
    return {};
  } else {
    auto visitor = CGAL::parameters::get_parameter(np, CGAL::internal_np::visitor);
    return [visitor](const Progress& progress) mutable { return visitor.on_progress(progress); };
  }
}

/// Writes b(K) to the user's map, or to the property map "f:deviation".
template <class Mesh, class NamedParameters>
void write_deviation(
    const std::vector<double>& bounds, const Compaction& compaction, const NamedParameters& np,
    Mesh& mesh)
{
  std::vector<double> bound_at(mesh.number_of_faces());
  for (Index f = 0; f < bounds.size(); ++f)
    if (compaction.face[f] != none) bound_at[compaction.face[f]] = bounds[f];
  const auto write = [&](auto map) {
    std::size_t position = 0;
    for (const auto f : mesh.faces()) put(map, f, bound_at[position++]);
  };
  if constexpr (is_absent<NamedParameters, deviation_map_t>)
    write(mesh.template add_property_map<typename Mesh::Face_index, double>("f:deviation").first);
  else
    write(CGAL::parameters::get_parameter(np, deviation_map));
}

} // namespace internal

/// \brief turns a mesh, in place, into one with far fewer faces within a proven distance.
///
/// Vertices are removed by collapses in the order of their quadric error, edges are flipped and
/// vertices relocated where that makes room for more, as long as the two-sided Hausdorff distance
/// to the input stays within the tolerance: every operation is checked before it is made, so the
/// result cannot fail to comply. The vertices of the result lie on the input, or, with free
/// placement, anywhere within the tolerance.
///
/// Genus, components and border loops are kept. Borders stay within the tolerance of the input's
/// borders, and so do ridges and constrained edges, as curves. No face that intersects another one
/// is made. The result depends on the mesh and the parameters only.
///
/// On return the mesh is compacted: descriptors are renumbered, property maps stay valid and keep
/// the values of what survives. When an exception is thrown the mesh is unchanged.
///
/// \param mesh a `CGAL::Surface_mesh` with coordinates convertible to `double`; may have borders,
///   several components and any genus.
/// \param tolerance largest two-sided Hausdorff distance to the input, in mesh units.
/// \return the certificate, with the map that proves it (for the direct bound) and the counts of
///   operations and refusals.
/// \throws Invalid_input when the mesh is empty, not triangulated, not manifold, has non-finite
///   coordinates, degenerate or duplicate faces or isolated vertices, or when a parameter is out of
///   range; names the element and the remedy.
///
/// Complexity: O(n log n) in the number of faces, with about 250 bytes a face beside the mesh.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{feature_angle}
///     \cgalParamDescription{edges where the surface turns by more are ridges, kept as curves. With
///       none, creases are bounded by the tolerance like everything else}
///     \cgalParamType{`double`, in degrees, from 0 to 180}
///     \cgalParamDefault{180, no ridges}
///   \cgalParamNEnd
///   \cgalParamNBegin{corner_angle}
///     \cgalParamDescription{where a ridge or border turns by more, its vertex stays}
///     \cgalParamType{`double`, in degrees, from 0 to 180}
///     \cgalParamDefault{60}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{edges that are ridges whatever their angle}
///     \cgalParamType{a readable property map from edges to `bool`}
///     \cgalParamDefault{no edge}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_is_constrained_map}
///     \cgalParamDescription{vertices that stay}
///     \cgalParamType{a readable property map from vertices to `bool`}
///     \cgalParamDefault{no vertex}
///   \cgalParamNEnd
///   \cgalParamNBegin{deviation_bound}
///     \cgalParamDescription{`Deviation_bound::direct`, by a map from the input to the mesh, or
///       `Deviation_bound::accumulated`, the paper's, which adds up from operation to operation}
///     \cgalParamDefault{`Deviation_bound::direct`}
///   \cgalParamNEnd
///   \cgalParamNBegin{shape_ratio}
///     \cgalParamDescription{omega: Q(new) <= max(omega max Q(old), shape_floor)}
///     \cgalParamType{`double`, at least 1}
///     \cgalParamDefault{1}
///   \cgalParamNEnd
///   \cgalParamNBegin{shape_floor}
///     \cgalParamDescription{the quality Q up to which every face is admitted}
///     \cgalParamType{`double`, at least 1; infinity: no control}
///     \cgalParamDefault{10}
///   \cgalParamNEnd
///   \cgalParamNBegin{roughness_angle}
///     \cgalParamDescription{largest angle between a face and the input's normals at its vertices,
///       unless the faces that it replaces are as rough}
///     \cgalParamType{`double`, in degrees, in (0, 180]; 180: no control}
///     \cgalParamDefault{45}
///   \cgalParamNEnd
///   \cgalParamNBegin{allow_self_intersections}
///     \cgalParamDescription{do not test for new self-intersections}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`false`}
///   \cgalParamNEnd
///   \cgalParamNBegin{placement}
///     \cgalParamDescription{`Placement::on_surface`, vertices of the result lie on the input, or
///       `Placement::free`, anywhere within the tolerance, which takes fewer faces}
///     \cgalParamDefault{`Placement::on_surface`}
///   \cgalParamNEnd
///   \cgalParamNBegin{effort}
///     \cgalParamDescription{`Effort::fast`, collapses and flips, with vertices of the input only
///       unless placement is free; `Effort::standard`, a pass of transactions too, which exceed the
///       tolerance for a while and come back; `Effort::best`, six of them}
///     \cgalParamDefault{`Effort::standard`}
///   \cgalParamNEnd
///   \cgalParamNBegin{target_faces}
///     \cgalParamDescription{a number of faces at which to stop}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{0, as few as the tolerance allows}
///   \cgalParamNEnd
///   \cgalParamNBegin{single_precision}
///     \cgalParamDescription{vertices that move go to points with single-precision coordinates}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`false`; `true` where the mesh's points have `float` coordinates}
///   \cgalParamNEnd
///   \cgalParamNBegin{flip_rounds}
///     \cgalParamDescription{largest number of rounds of flips, each followed by collapses}
///     \cgalParamType{`unsigned int`}
///     \cgalParamDefault{3}
///   \cgalParamNEnd
///   \cgalParamNBegin{deviation_map}
///     \cgalParamDescription{receives b(K), a bound of the two-sided distance at each face}
///     \cgalParamType{a writable property map from faces to `double`}
///     \cgalParamDefault{the property map "f:deviation", which is added to the mesh}
///   \cgalParamNEnd
///   \cgalParamNBegin{visitor}
///     \cgalParamDescription{`bool on_progress(const Progress&)`; returning `false` stops with the
///       valid, certified mesh reached so far}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Certificate make_geometric_mesh(
    Mesh& mesh, double tolerance, const NamedParameters& np = CGAL::parameters::default_values())
{
  const char* const function = "make_geometric_mesh";
  internal::require_valid_mesh(mesh, function, "mesh", np);
  internal::require_positive(tolerance, function, "tolerance");
  auto controls = internal::simplification_controls(np, function);
  const auto plan = internal::simplification_plan(np, function);
  const Features features = find_features(mesh, np);

  const auto points = internal::vertex_points(mesh, np);
  using Coordinate = std::decay_t<decltype(get(points, *mesh.vertices().begin()).x())>;
  controls.single_precision = controls.single_precision || std::is_same_v<Coordinate, float>;
  const double scale = internal::normalising_scale(mesh, points);
  const internal::Elements<Mesh> elements(mesh, points);
  auto connectivity = internal::read_connectivity(mesh, elements);
  auto coordinates = internal::points_in_order(elements, points, scale);
  const internal::Reference reference
      = internal::make_reference(elements, coordinates, connectivity);
  internal::Journal journal;
  internal::Working_mesh working = internal::make_working_mesh(
      elements, features, std::move(connectivity), std::move(coordinates), journal);

  std::unique_ptr<internal::Deviation_policy> deviation;
  internal::Direct_bound* direct = nullptr;
  if (internal::parameter_or(np, internal::deviation_bound, internal::defaults::deviation_bound)
      == Deviation_bound::direct) {
    // Vertices may lie outside T by the tolerance, and by a few times that for a while.
    const internal::Rounding rounding(reference.largest_coordinate() + 4 * scale * tolerance);
    auto bound = std::make_unique<internal::Direct_bound>(
        reference, working, internal::Tolerance(rounding, scale * tolerance), journal);
    direct = bound.get();
    deviation = std::move(bound);
  } else {
    deviation
        = std::make_unique<internal::Accumulated_bound>(reference, working, scale * tolerance);
  }

  const auto [operations, is_complete] = internal::simplify(
      reference, working, *deviation, direct, controls, plan, journal,
      internal::progress_reporter(np));

  std::vector<double> bounds = deviation->face_bounds();
  for (double& bound : bounds) bound /= scale;
  const std::vector<bool> is_feature = internal::features_in_order(elements, features);
  const std::vector<internal::Index> face_position = internal::face_positions(elements, mesh);
  internal::write_connectivity(working, elements, mesh);
  internal::write_points(working, reference, elements, scale, points);
  const internal::Compaction compaction = internal::compact(elements, mesh);
  internal::write_deviation(bounds, compaction, np, mesh);
  std::optional<Correspondence> record;
  if (direct != nullptr)
    record
        = internal::Recorder(reference, working, direct->map(), elements.input_position, compaction)
              .record(is_feature, direct->inner_items(), face_position);
  const double bound = bounds.empty() ? 0 : *std::max_element(bounds.begin(), bounds.end());
  return Certificate(tolerance, bound, std::move(record), operations, !is_complete);
}

} // namespace surety

#endif // SURETY_GEOMETRIC_MESH_H
