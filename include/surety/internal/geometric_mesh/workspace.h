// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a simplification works on: T, M, the bound between them and the way back to the user's mesh;
// and the parameters that say how.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_WORKSPACE_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_WORKSPACE_H

#include <surety/features.h>
#include <surety/internal/deviation/accumulated_bound.h>
#include <surety/internal/deviation/covering_bound.h>
#include <surety/internal/deviation/direct_bound.h>
#include <surety/internal/geometric_mesh/concurrency.h>
#include <surety/internal/geometric_mesh/exchange.h>
#include <surety/internal/geometric_mesh/patch.h>
#include <surety/internal/geometric_mesh/record.h>
#include <surety/internal/geometric_mesh/simplifier.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <type_traits>

namespace surety::internal {

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

/// The paper's stages, in equal steps.
template <class NamedParameters>
std::vector<double> stage_shares(const NamedParameters& np, const char* function)
{
  const unsigned number = parameter_or(np, stages, defaults::stages);
  require_in_range(number, 1, 1e6, function, "stages");
  std::vector<double> shares;
  for (unsigned k = 1; k <= number; ++k) shares.push_back(double(k) / number);
  return shares;
}

template <class NamedParameters>
Simplification_plan simplification_plan(const NamedParameters& np, const char* function)
{
  Simplification_plan plan;
  plan.flip_rounds = parameter_or(np, flip_rounds, defaults::flip_rounds);
  plan.places_freely = parameter_or(np, placement, defaults::placement) == Placement::free;
  plan.fewest_faces = parameter_or(np, target_faces, defaults::target_faces);
  plan.smoothing_sweeps = parameter_or(np, smoothing_sweeps, defaults::smoothing_sweeps);
  plan.stages = stage_shares(np, function);
  // The accumulated bound adds up over the steps, and would miss the goal.
  const bool is_direct
      = parameter_or(np, deviation_bound, defaults::deviation_bound) == Deviation_bound::direct;
  plan.seeks_goal = plan.fewest_faces > 0 && plan.stages.size() == 1 && is_direct;
  const Effort effort_spent = parameter_or(np, effort, defaults::effort);
  if (effort_spent == Effort::standard) plan.overshoots = {1.4};
  if (!is_direct && plan.smoothing_sweeps > 0)
    throw Invalid_input(
        function, "smoothing_sweeps",
        "only the direct bound serves operations that move vertices here",
        "use Deviation_bound::direct");
  if (plan.places_freely && !is_direct)
    throw Invalid_input(
        function, "placement", "only the direct bound serves free placement here",
        "use Placement::on_surface or Deviation_bound::direct");
  // It starts like the standard effort, so that it never leaves more faces.
  if (effort_spent == Effort::best) plan.overshoots = {1.4, 1.4, 1.6, 1.8, 2, 2};
  return plan;
}

/// Of the angle that bounds normals, with a reserve for those who round in another way; -1 where
/// none does.
template <class NamedParameters>
double read_normal_cosine(const NamedParameters& np, const char* function)
{
  constexpr double reserve = 1e-6;
  const double angle = parameter_or(np, normal_tolerance, defaults::normal_tolerance);
  require_positive(angle, function, "normal_tolerance");
  require_in_range(angle, 0, 180, function, "normal_tolerance");
  return angle < 180 ? std::cos(angle * radians_per_degree * (1 - reserve)) : -1;
}

/// A length; infinite where curves have the tolerance of the surface.
template <class NamedParameters>
double read_ridge_tolerance(const NamedParameters& np, const char* function)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if constexpr (is_absent<NamedParameters, ridge_tolerance_t>) {
    return infinity;
  } else {
    const double length = CGAL::parameters::get_parameter(np, ridge_tolerance);
    require_positive(length, function, "ridge_tolerance");
    return length;
  }
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

/// The tolerance at each vertex by position, where the user's maps make it vary; else empty.
template <class Mesh, class NamedParameters>
std::vector<double> varying_tolerance(
    const Mesh& mesh, const Elements<Mesh>& elements, double tolerance, const NamedParameters& np,
    const char* function)
{
  std::vector<double> result;
  const auto lower = [&](auto v, double value, const char* name) {
    require_positive(value, function, name);
    result[v] = std::min(result[v], value);
  };
  if constexpr (!is_absent<NamedParameters, vertex_tolerance_map_t>) {
    result.resize(mesh.num_vertices(), tolerance);
    const auto map = CGAL::parameters::get_parameter(np, vertex_tolerance_map);
    for (const auto v : mesh.vertices()) lower(v, get(map, v), "vertex_tolerance_map");
  }
  if constexpr (!is_absent<NamedParameters, face_tolerance_map_t>) {
    result.resize(mesh.num_vertices(), tolerance);
    const auto map = CGAL::parameters::get_parameter(np, face_tolerance_map);
    for (const auto f : mesh.faces())
      for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
        lower(v, get(map, f), "face_tolerance_map");
  }
  const bool varies = std::any_of(mesh.vertices().begin(), mesh.vertices().end(), [&](auto v) {
    return !result.empty() && result[v] < tolerance;
  });
  if (!varies) return {};
  std::vector<double> in_order;
  for (const auto v : elements.vertices) in_order.push_back(result[v]);
  return in_order;
}

/// Faces that are to stay: their edges are features and their vertices corners, and no operation
/// can touch them.
template <class Mesh, class NamedParameters>
void keep_constrained_faces(const Mesh& mesh, const NamedParameters& np, Features& features)
{
  if constexpr (!is_absent<NamedParameters, face_is_constrained_map_t>) {
    const auto map = CGAL::parameters::get_parameter(np, face_is_constrained_map);
    for (const auto f : mesh.faces()) {
      if (!get(map, f)) continue;
      for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        features.edge[mesh.edge(h)] = true;
        features.corner[mesh.target(h)] = true;
      }
    }
  }
}

template <class Mesh>
class Workspace
{
public:
  /// The mesh must stay as it is until write_back().
  template <class NamedParameters>
  Workspace(const Mesh& mesh, double tolerance, const NamedParameters& np, const char* function)
    : source_(mesh),
      features_(validated_features(mesh, np, function)),
      scale_(normalising_scale(mesh, vertex_points(mesh, np))),
      elements_(mesh, vertex_points(mesh, np)),
      reference_(make_reference(
          elements_, points_in_order(elements_, vertex_points(mesh, np), scale_),
          read_connectivity(mesh, elements_))),
      is_feature_(features_in_order(elements_, features_)),
      face_position_(face_positions(elements_, mesh)),
      tolerance_(scale_ * tolerance),
      varying_tolerance_(varying_tolerance(mesh, elements_, tolerance, np, function)),
      kind_(parameter_or(np, deviation_bound, defaults::deviation_bound)),
      normal_cosine_(read_normal_cosine(np, function)),
      ridge_tolerance_(scale_ * read_ridge_tolerance(np, function))
  {
    if (kind_ != Deviation_bound::direct && !varying_tolerance_.empty())
      throw Invalid_input(
          function, "tolerance maps", "only the direct bound knows more than one tolerance",
          "use Deviation_bound::direct");
    if (kind_ != Deviation_bound::direct && normal_cosine_ > -1)
      throw Invalid_input(
          function, "normal_tolerance", "only the direct bound knows normals",
          "use Deviation_bound::direct");
    if (kind_ != Deviation_bound::direct && ridge_tolerance_ < tolerance_)
      throw Invalid_input(
          function, "ridge_tolerance", "only the direct bound knows more than one tolerance",
          "use Deviation_bound::direct");
    using Coordinate
        = std::decay_t<decltype(get(vertex_points(mesh, np), *mesh.vertices().begin()).x())>;
    has_float_points_ = std::is_same_v<Coordinate, float>;
    for (double& value : varying_tolerance_) value *= scale_;
    start(read_connectivity(mesh, elements_));
  }

  /// With a parallel tag patches are simplified on many threads; the result does not depend on it.
  template <class ConcurrencyTag>
  std::pair<Operations, bool> simplify(
      Simplification_controls controls, const Simplification_plan& plan,
      const std::function<bool(const Progress&)>& visitor)
  {
    controls.single_precision = controls.single_precision || has_float_points_;
    for (Guarding guarding : {Guarding::late, Guarding::always}) {
      if (controls.allow_self_intersections) guarding = Guarding::never;
      Operations operations;
      bool is_complete = true;
      std::vector<Patch> patches;
      if (guarding != Guarding::always && is_worth_patches(plan)) {
        is_complete = simplify_patches<ConcurrencyTag>(patches, controls, plan, visitor);
        for (const Patch& patch : patches) operations += patch.operations();
      }
      Simplifier simplifier(
          reference_, *working_, *deviation_, direct_, controls, plan, guarding, journal_,
          reference_.point(0), visitor);
      for (const Patch& patch : patches) patch.merge_into(simplifier.greedy());
      patches.clear();
      const Outcome outcome = is_complete ? simplifier.run() : simplifier.cancel();
      operations += simplifier.operations();
      if (outcome == Outcome::complete || outcome == Outcome::cancelled)
        return {operations, outcome == Outcome::complete};
      start(read_connectivity(source_, elements_));
      if (outcome == Outcome::unusable) return {Operations(), false};
    }
    return {};
  }

  const Working_mesh& mesh() const { return *working_; }
  const Elements<Mesh>& elements() const { return elements_; }
  const Reference& reference() const { return reference_; }
  double scale() const { return scale_; }

  /// b(K) of each face of M by position, in the user's units.
  std::vector<double> face_bounds()
  {
    std::vector<double> bounds = deviation_->face_bounds();
    for (double& bound : bounds) bound /= scale_;
    return bounds;
  }

  /// Gives the mesh that was read the faces and points of M.
  template <class NamedParameters>
  Compaction write_back(Mesh& mesh, const NamedParameters& np) const
  {
    write_connectivity(*working_, elements_, mesh);
    write_points(*working_, reference_, elements_, scale_, vertex_points(mesh, np));
    return compact(elements_, mesh);
  }

  /// The map phi, for an output in which the elements of M stand where `compaction` says; absent
  /// with other bounds than the direct one.
  std::optional<Correspondence> record(const Compaction& compaction)
  {
    if (direct_ == nullptr) return std::nullopt;
    return Recorder(reference_, *working_, direct_->map(), elements_.input_position, compaction)
        .record(is_feature_, direct_->inner_items(), face_position_);
  }

private:
  template <class NamedParameters>
  static Features validated_features(
      const Mesh& mesh, const NamedParameters& np, const char* function)
  {
    require_valid_mesh(mesh, function, "mesh", np);
    Features features = find_features(mesh, np);
    keep_constrained_faces(mesh, np, features);
    return features;
  }

  static constexpr Index faces_a_patch = 1 << 16;

  bool is_worth_patches(const Simplification_plan& plan) const
  {
    return kind_ == Deviation_bound::direct && plan.stages.size() == 1 && !plan.seeks_goal
        && plan.fewest_faces == 0 && plan.log == nullptr && !plan.on_stage
        && reference_.number_of_faces() >= 2 * faces_a_patch;
  }

  /// Simplifies the patches and puts M and phi together from them.
  template <class ConcurrencyTag>
  bool simplify_patches(
      std::vector<Patch>& patches, const Simplification_controls& controls,
      const Simplification_plan& plan, const std::function<bool(const Progress&)>& visitor)
  {
    const Tolerance tolerance = direct_->tolerance();
    deviation_.reset(); // M and phi are put together anew from the patches
    working_.reset();
    auto connectivity = read_connectivity(source_, elements_);
    std::vector<bool> is_fixed(elements_.vertices.size());
    for (Index v = 0; v < is_fixed.size(); ++v)
      is_fixed[v] = features_.corner[elements_.vertices[v]];
    const Whole whole{reference_, connectivity,  is_feature_, is_fixed, elements_.input_position,
                      tolerance,  normal_cosine_};
    const Index faces = reference_.number_of_faces();
    const Index number = faces / faces_a_patch;
    std::vector<std::optional<Patch>> made(number);
    Shared_progress progress(visitor, number, faces);
    for_each_index<ConcurrencyTag>(number, [&](Index i) {
      if (progress.is_cancelled()) return;
      const auto bound_of
          = [&](Index k) { return static_cast<Index>(std::uint64_t(faces) * k / number); };
      made[i].emplace(whole, bound_of(i), bound_of(i + 1));
      const bool is_complete = made[i]->simplify(whole, controls, plan, progress.of_patch());
      progress.finish(is_complete);
    });
    for (auto& patch : made)
      if (patch) patches.push_back(std::move(*patch));
    made.clear();
    for (const Patch& patch : patches) patch.merge_into(connectivity);
    start(std::move(connectivity));
    for (const Patch& patch : patches) {
      patch.merge_into(*working_);
      patch.merge_into(direct_->map());
    }
    return !progress.is_cancelled();
  }

  std::vector<Vector> original_points() const
  {
    std::vector<Vector> points(reference_.number_of_vertices());
    for (Index v = 0; v < points.size(); ++v) points[v] = reference_.point(v);
    return points;
  }

  /// Makes M, with phi the identity.
  void start(Working_mesh::Connectivity connectivity)
  {
    deviation_.reset();
    working_.emplace(make_working_mesh(
        elements_, features_, std::move(connectivity), original_points(), journal_));
    direct_ = nullptr;
    if (kind_ == Deviation_bound::accumulated) {
      deviation_ = std::make_unique<Accumulated_bound>(reference_, *working_, tolerance_);
      return;
    }
    if (kind_ == Deviation_bound::covering) {
      deviation_ = std::make_unique<Covering_bound>(reference_, *working_, tolerance_);
      return;
    }
    const Rounding rounding(Direct_bound::largest_coordinate(reference_, tolerance_));
    auto tolerance = varying_tolerance_.empty() ? Tolerance(rounding, tolerance_)
                                                : Tolerance(rounding, varying_tolerance_);
    tolerance.limit_curves(ridge_tolerance_);
    auto bound = std::make_unique<Direct_bound>(
        reference_, *working_, std::move(tolerance), journal_, normal_cosine_);
    direct_ = bound.get();
    deviation_ = std::move(bound);
  }

  const Mesh& source_;
  Features features_;
  double scale_;
  Elements<Mesh> elements_;
  Reference reference_;
  Journal journal_;
  std::optional<Working_mesh> working_;
  std::vector<bool> is_feature_;
  std::vector<Index> face_position_;
  double tolerance_;
  std::vector<double> varying_tolerance_;
  Deviation_bound kind_;
  double normal_cosine_, ridge_tolerance_;
  bool has_float_points_ = false;
  std::unique_ptr<Deviation_policy> deviation_;
  Direct_bound* direct_ = nullptr;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_WORKSPACE_H
