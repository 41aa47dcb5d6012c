// SPDX-License-Identifier: GPL-3.0-or-later
//
// All named parameters of the library in one list, with type, default, unit and range. Each is a
// free function that starts a chain, and a member that continues one; CGAL's own parameters are
// members of the same chain:
//
//   surety::parameters::feature_angle(40).roughness_angle(60).edge_is_constrained_map(constrained)
//
// A chain is a CGAL::Named_function_parameters, so CGAL's functions accept it as well.
#ifndef SURETY_PARAMETERS_H
#define SURETY_PARAMETERS_H

#include <CGAL/Named_function_parameters.h>

#include <cstddef>

namespace surety {

class Background_metric;

/// How the distance between the mesh and its original is bounded.
enum class Deviation_bound {
  direct,      ///< by a continuous map from the original to the mesh; never accumulates
  accumulated, ///< by the sum of the distances between successive meshes; cheap, pessimistic
  covering ///< by convex cells of both meshes, each near to a face of the other; the most general
};

/// Where the vertices of a geometric mesh may lie.
enum class Placement {
  on_surface, ///< on the original, as the definition of a geometric mesh demands
  free        ///< anywhere within the tolerance; takes fewer faces
};

/// How much work is spent on having few faces.
enum class Effort {
  fast,     ///< collapses in the order of their cost, and flips
  standard, ///< and one pass of transactions that overshoot the tolerance and come back
  best      ///< and six of them
};

/// How curvature is estimated from the samples round a vertex.
enum class Curvature_method {
  adaptive,          ///< polynomials up to order four over as many rings as the noise asks for
  five_coefficients, ///< a quadric with linear terms over the first ring
  three_coefficients ///< the paper's: a quadric without linear terms; does not converge
};

/// What the size of a metric depends on.
enum class Metric_kind {
  isotropic,  ///< the place: one size for all directions
  anisotropic ///< place and direction: one size along each principal direction of the surface
};

/// How the length of an edge in a metric follows from what is known at its ends.
enum class Length_rule {
  linear_size,      ///< the size along the edge is linear; in closed form
  simpson,          ///< Simpson's rule with the inverse square root of the tensor linear
  trapezoid,        ///< mean of the lengths in the metrics of both ends
  end_only,         ///< the metric of the first end, equation (21) of the paper
  logarithmic_mean, ///< the size is in geometric progression, equation (22), in closed form
};

/// \brief What a visitor is told.
///
/// A visitor has a member function `bool on_progress(const Progress&)`; returning `false` cancels
/// the stage, which then leaves a valid mesh with a certificate that still holds.
struct Progress {
  const char* stage; ///< name of the running stage
  double fraction;   ///< of the stage's work that is done, an estimate in [0, 1]
  std::size_t faces; ///< of the current mesh
};

namespace internal {

// Tags. Only their types matter: CGAL's get_parameter looks a value up by the type of its tag.
struct feature_angle_t {};
struct corner_angle_t {};
struct deviation_bound_t {};
struct shape_ratio_t {};
struct shape_floor_t {};
struct roughness_angle_t {};
struct flip_rounds_t {};
struct placement_t {};
struct effort_t {};
struct target_faces_t {};
struct smoothing_sweeps_t {};
struct single_precision_t {};
struct stages_t {};
struct normal_tolerance_t {};
struct ridge_tolerance_t {};
struct vertex_tolerance_map_t {};
struct face_tolerance_map_t {};
struct face_is_constrained_map_t {};
struct relative_slack_t {};
struct maximum_subdivisions_t {};
struct deviation_map_t {};
struct curvature_method_t {};
struct noise_floor_t {};
struct metric_kind_t {};
struct metric_tolerance_t {};
struct relative_gap_t {};
struct turning_angle_t {};
struct gap_constant_t {};
struct minimum_size_t {};
struct maximum_size_t {};
struct maximum_aspect_ratio_t {};
struct size_field_t {};
struct length_rule_t {};
struct gradation_t {};
struct smoothing_rounds_t {};
struct tolerance_t {};
struct geometric_support_t {};
struct fewest_faces_t {};
struct proximity_t {};
struct background_metric_t {};
struct target_vertices_t {};
struct target_error_t {};
struct norm_exponent_t {};
struct conserves_t {};

inline constexpr feature_angle_t feature_angle{};
inline constexpr corner_angle_t corner_angle{};
inline constexpr deviation_bound_t deviation_bound{};
inline constexpr shape_ratio_t shape_ratio{};
inline constexpr shape_floor_t shape_floor{};
inline constexpr roughness_angle_t roughness_angle{};
inline constexpr flip_rounds_t flip_rounds{};
inline constexpr placement_t placement{};
inline constexpr effort_t effort{};
inline constexpr target_faces_t target_faces{};
inline constexpr smoothing_sweeps_t smoothing_sweeps{};
inline constexpr single_precision_t single_precision{};
inline constexpr stages_t stages{};
inline constexpr normal_tolerance_t normal_tolerance{};
inline constexpr ridge_tolerance_t ridge_tolerance{};
inline constexpr vertex_tolerance_map_t vertex_tolerance_map{};
inline constexpr face_tolerance_map_t face_tolerance_map{};
inline constexpr face_is_constrained_map_t face_is_constrained_map{};
inline constexpr relative_slack_t relative_slack{};
inline constexpr maximum_subdivisions_t maximum_subdivisions{};
inline constexpr deviation_map_t deviation_map{};
inline constexpr curvature_method_t curvature_method{};
inline constexpr noise_floor_t noise_floor{};
inline constexpr metric_kind_t metric_kind{};
inline constexpr metric_tolerance_t metric_tolerance{};
inline constexpr relative_gap_t relative_gap{};
inline constexpr turning_angle_t turning_angle{};
inline constexpr gap_constant_t gap_constant{};
inline constexpr minimum_size_t minimum_size{};
inline constexpr maximum_size_t maximum_size{};
inline constexpr maximum_aspect_ratio_t maximum_aspect_ratio{};
inline constexpr size_field_t size_field{};
inline constexpr length_rule_t length_rule{};
inline constexpr gradation_t gradation{};
inline constexpr smoothing_rounds_t smoothing_rounds{};
inline constexpr tolerance_t tolerance{};
inline constexpr geometric_support_t geometric_support{};
inline constexpr fewest_faces_t fewest_faces{};
inline constexpr proximity_t proximity{};
inline constexpr background_metric_t background_metric{};
inline constexpr target_vertices_t target_vertices{};
inline constexpr target_error_t target_error{};
inline constexpr norm_exponent_t norm_exponent{};
inline constexpr conserves_t conserves{};

// CGAL has a parameter of this name already: the same tag, or the two spellings would set
// different values.
using CGAL::internal_np::allow_self_intersections;
using CGAL::internal_np::allow_self_intersections_t;

/// The values that absent parameters take, for every function that reads them.
namespace defaults {
constexpr double feature_angle = 180;
constexpr double corner_angle = 60;
constexpr Deviation_bound deviation_bound = Deviation_bound::direct;
constexpr double shape_ratio = 1;
constexpr double shape_floor = 10;
constexpr double roughness_angle = 45;
constexpr bool allow_self_intersections = false;
constexpr unsigned flip_rounds = 3;
constexpr Placement placement = Placement::on_surface;
constexpr Effort effort = Effort::standard;
constexpr std::size_t target_faces = 0;
constexpr unsigned smoothing_sweeps = 0;
constexpr unsigned stages = 1;
constexpr double normal_tolerance = 180;
constexpr double relative_slack = 0.01;
constexpr Curvature_method curvature_method = Curvature_method::adaptive;
constexpr double noise_floor = 0;
constexpr Metric_kind metric_kind = Metric_kind::anisotropic;
constexpr double maximum_aspect_ratio = 10;
constexpr Length_rule length_rule = Length_rule::linear_size;
constexpr double gradation = 1.3;
constexpr unsigned smoothing_rounds = 0;
constexpr bool fewest_faces = false;
// Of unit meshes.
constexpr unsigned unit_mesh_iterations = 16;
constexpr Placement unit_mesh_placement = Placement::free;
constexpr Metric_kind remesh_metric_kind = Metric_kind::isotropic;
// Of enrichment.
constexpr unsigned enrichment_rounds = 12;
// Of adaptation.
constexpr double norm_exponent = 2;
constexpr bool conserves = false;
} // namespace defaults

} // namespace internal

/// \brief A chain of named parameters; starts at a function of `surety::parameters`.
///
/// Members that the class does not list are those of CGAL's own chain. After one of those only
/// CGAL's members can follow, so put the listed ones first.
template <class Value, class Tag, class Base = CGAL::internal_np::No_property>
class Named_parameters : public CGAL::Named_function_parameters<Value, Tag, Base>
{
  using Chain = CGAL::Named_function_parameters<Value, Tag, Base>;

  template <class Next_tag, class Next>
  Named_parameters<Next, Next_tag, Chain> then(const Next& value) const
  {
    return Named_parameters<Next, Next_tag, Chain>(value, *this);
  }

public:
  /// A chain of one parameter.
  explicit Named_parameters(const Value& value) : Chain(value) {}
  /// A chain that goes on with one more.
  Named_parameters(const Value& value, const Base& base) : Chain(value, base) {}

  /// \name Parameters of this library; see the functions of `surety::parameters`
  /// @{

  /// Adds the parameter of this name.
  auto feature_angle(double degrees) const { return then<internal::feature_angle_t>(degrees); }
  auto corner_angle(double degrees) const { return then<internal::corner_angle_t>(degrees); }
  auto deviation_bound(Deviation_bound b) const { return then<internal::deviation_bound_t>(b); }
  auto shape_ratio(double omega) const { return then<internal::shape_ratio_t>(omega); }
  auto shape_floor(double quality) const { return then<internal::shape_floor_t>(quality); }
  auto roughness_angle(double degrees) const { return then<internal::roughness_angle_t>(degrees); }
  auto allow_self_intersections(bool allow) const
  {
    return then<internal::allow_self_intersections_t>(allow);
  }
  auto flip_rounds(unsigned rounds) const { return then<internal::flip_rounds_t>(rounds); }
  auto placement(Placement where) const { return then<internal::placement_t>(where); }
  auto effort(Effort how_much) const { return then<internal::effort_t>(how_much); }
  auto target_faces(std::size_t number) const { return then<internal::target_faces_t>(number); }
  auto smoothing_sweeps(unsigned number) const
  {
    return then<internal::smoothing_sweeps_t>(number);
  }
  auto single_precision(bool single) const { return then<internal::single_precision_t>(single); }
  auto stages(unsigned number) const { return then<internal::stages_t>(number); }
  auto normal_tolerance(double degrees) const
  {
    return then<internal::normal_tolerance_t>(degrees);
  }
  auto ridge_tolerance(double length) const { return then<internal::ridge_tolerance_t>(length); }
  template <class Map>
  auto vertex_tolerance_map(const Map& map) const
  {
    return then<internal::vertex_tolerance_map_t>(map);
  }
  template <class Map>
  auto face_tolerance_map(const Map& map) const
  {
    return then<internal::face_tolerance_map_t>(map);
  }
  template <class Map>
  auto face_is_constrained_map(const Map& map) const
  {
    return then<internal::face_is_constrained_map_t>(map);
  }
  auto relative_slack(double slack) const { return then<internal::relative_slack_t>(slack); }
  auto maximum_subdivisions(std::size_t number) const
  {
    return then<internal::maximum_subdivisions_t>(number);
  }
  template <class Map>
  auto deviation_map(const Map& map) const
  {
    return then<internal::deviation_map_t>(map);
  }
  auto curvature_method(Curvature_method m) const { return then<internal::curvature_method_t>(m); }
  auto noise_floor(double length) const { return then<internal::noise_floor_t>(length); }
  auto metric_kind(Metric_kind kind) const { return then<internal::metric_kind_t>(kind); }
  auto metric_tolerance(double length) const { return then<internal::metric_tolerance_t>(length); }
  auto relative_gap(double fraction) const { return then<internal::relative_gap_t>(fraction); }
  auto turning_angle(double degrees) const { return then<internal::turning_angle_t>(degrees); }
  auto gap_constant(double constant) const { return then<internal::gap_constant_t>(constant); }
  auto minimum_size(double size) const { return then<internal::minimum_size_t>(size); }
  auto maximum_size(double size) const { return then<internal::maximum_size_t>(size); }
  auto maximum_aspect_ratio(double ratio) const
  {
    return then<internal::maximum_aspect_ratio_t>(ratio);
  }
  template <class Field>
  auto size_field(const Field& field) const
  {
    return then<internal::size_field_t>(field);
  }
  auto length_rule(Length_rule rule) const { return then<internal::length_rule_t>(rule); }
  auto gradation(double beta) const { return then<internal::gradation_t>(beta); }
  auto smoothing_rounds(unsigned rounds) const
  {
    return then<internal::smoothing_rounds_t>(rounds);
  }
  auto tolerance(double length) const { return then<internal::tolerance_t>(length); }
  template <class Support>
  auto geometric_support(const Support& support) const
  {
    return then<internal::geometric_support_t>(support);
  }
  auto fewest_faces(bool fewest) const { return then<internal::fewest_faces_t>(fewest); }
  auto proximity(bool limits) const { return then<internal::proximity_t>(limits); }
  auto background_metric(const Background_metric& metric) const
  {
    return then<internal::background_metric_t>(&metric);
  }
  auto background_metric(const Background_metric* metric_or_null) const
  {
    return then<internal::background_metric_t>(metric_or_null);
  }
  auto target_vertices(double number) const { return then<internal::target_vertices_t>(number); }
  auto target_error(double error) const { return then<internal::target_error_t>(error); }
  auto norm_exponent(double p) const { return then<internal::norm_exponent_t>(p); }
  auto conserves(bool does) const { return then<internal::conserves_t>(does); }
  /// @}

  /// \name CGAL's parameters that this library reads, with their meaning in CGAL
  /// @{

  /// Adds CGAL's parameter of this name.
  template <class Map>
  auto vertex_point_map(const Map& map) const
  {
    return then<CGAL::internal_np::vertex_point_t>(map);
  }
  template <class Traits>
  auto geom_traits(const Traits& traits) const
  {
    return then<CGAL::internal_np::geom_traits_t>(traits);
  }
  template <class Map>
  auto edge_is_constrained_map(const Map& map) const
  {
    return then<CGAL::internal_np::edge_is_constrained_t>(map);
  }
  template <class Map>
  auto vertex_is_constrained_map(const Map& map) const
  {
    return then<CGAL::internal_np::vertex_is_constrained_t>(map);
  }
  template <class Visitor>
  auto visitor(const Visitor& visitor) const
  {
    return then<CGAL::internal_np::visitor_t>(visitor);
  }
  template <class Number>
  auto number_of_iterations(const Number& number) const
  {
    return then<CGAL::internal_np::number_of_iterations_t>(number);
  }
  template <class Seed>
  auto random_seed(const Seed& seed) const
  {
    return then<CGAL::internal_np::random_seed_t>(seed);
  }
  /// @}
};

namespace parameters {

/// \brief Edges are ridges where the normals of their two faces make more than this angle.
///
/// In degrees, from 0 to 180 (`double`). Default: 180, no ridges. Borders and the edges of
/// `edge_is_constrained_map` are features in any case.
inline auto feature_angle(double degrees)
{
  return Named_parameters<double, internal::feature_angle_t>(degrees);
}

/// \brief A feature vertex with two feature edges is a corner if they turn by more than this angle.
///
/// In degrees, from 0 (every kink) to 180 (none), `double`. Default: 60. Vertices where another
/// number of feature edges meet are corners in any case.
inline auto corner_angle(double degrees)
{
  return Named_parameters<double, internal::corner_angle_t>(degrees);
}

/// \brief Which bound guards the tolerance (`Deviation_bound`). Default: `Deviation_bound::direct`.
inline auto deviation_bound(Deviation_bound bound)
{
  return Named_parameters<Deviation_bound, internal::deviation_bound_t>(bound);
}

/// \brief Limit of the shape Q of a new face, relative to the worst of the faces that it replaces.
///
/// A ratio, at least 1 (`double`). Default: 1, never worse. A new face is admitted if its Q is at
/// most max(`shape_ratio` * worst old Q, `shape_floor`).
inline auto shape_ratio(double omega)
{
  return Named_parameters<double, internal::shape_ratio_t>(omega);
}

/// \brief The shape Q up to which a new face is admitted whatever it replaces.
///
/// A value of `quality()`, at least 1 (`double`); infinity turns the control of shapes off.
/// Default: 10.
inline auto shape_floor(double quality)
{
  return Named_parameters<double, internal::shape_floor_t>(quality);
}

/// \brief Largest angle between a new face and the normals of the original surface at its vertices.
///
/// In degrees, greater than 0, at most 180, which turns the control off (`double`). Default: 45.
/// A face that is no worse than the ones that it replaces is always admitted.
inline auto roughness_angle(double degrees)
{
  return Named_parameters<double, internal::roughness_angle_t>(degrees);
}

/// \brief Whether an operation may make the surface intersect itself (`bool`). Default: `false`.
///
/// Intersections that the input has already may stay in any case.
inline auto allow_self_intersections(bool allow)
{
  return Named_parameters<bool, internal::allow_self_intersections_t>(allow);
}

/// \brief How many rounds of edge flips a simplification makes, each followed by more collapses.
///
/// A number of rounds (`unsigned`); 0 turns flips off. Default: 3.
inline auto flip_rounds(unsigned rounds)
{
  return Named_parameters<unsigned, internal::flip_rounds_t>(rounds);
}

/// \brief Where vertices may lie (`Placement`). Default: `Placement::on_surface`.
///
/// Ridge and border vertices of the result are vertices of the input with `Placement::on_surface`.
inline auto placement(Placement where)
{
  return Named_parameters<Placement, internal::placement_t>(where);
}

/// \brief How much work to spend on having few faces (`Effort`). Default: `Effort::standard`.
inline auto effort(Effort how_much)
{
  return Named_parameters<Effort, internal::effort_t>(how_much);
}

/// \brief Number of faces at which a simplification stops, if the tolerance lets it come so far.
///
/// A number of faces (`std::size_t`). Default: 0, as few as the tolerance allows. The tolerance
/// grows in steps towards the one that is given, so that the certified bound is small for that
/// number.
inline auto target_faces(std::size_t number)
{
  return Named_parameters<std::size_t, internal::target_faces_t>(number);
}

/// \brief How many sweeps of relocations and flips a simplification makes at its end, for the shape
/// of the faces.
///
/// A number of sweeps (`unsigned`). Default: 0, none, because the fewest faces need not be round.
/// The work ends earlier where a sweep finds nothing to do. The number of faces stays.
inline auto smoothing_sweeps(unsigned number)
{
  return Named_parameters<unsigned, internal::smoothing_sweeps_t>(number);
}

/// \brief Whether vertices that move go to points whose coordinates are single-precision numbers
/// (`bool`), for results that will be stored so. Default: `false`.
///
/// A mesh whose points have `float` coordinates is treated so in any case.
inline auto single_precision(bool single)
{
  return Named_parameters<bool, internal::single_precision_t>(single);
}

/// \brief In how many stages, equal steps, the tolerance grows to what it is (section 2.3 of the
/// paper).
///
/// A number of stages (`unsigned`), at least 1. Default: 1.
inline auto stages(unsigned number)
{
  return Named_parameters<unsigned, internal::stages_t>(number);
}

/// \brief Largest angle between the normal of a face and those of the faces of the original that
/// correspond to it.
///
/// In degrees, greater than 0, at most 180, which lets normals turn as they like (`double`).
/// Default: 180. The map of the direct bound tells which faces correspond; `check_certificate()`
/// proves the angles that were reached.
inline auto normal_tolerance(double degrees)
{
  return Named_parameters<double, internal::normal_tolerance_t>(degrees);
}

/// \brief How far ridges and borders may be, as curves, from those of the original: the radius of
/// the cylinder about a ridge (section 2 of the paper).
///
/// A length in mesh units, greater than 0 (`double`). Default: the tolerance of the surface, which
/// bounds curves as well: more than that makes no difference. `check_certificate()` proves the
/// distance that was reached.
inline auto ridge_tolerance(double length)
{
  return Named_parameters<double, internal::ridge_tolerance_t>(length);
}

/// \brief A tolerance at each vertex of the input, where it is less than the one for the whole
/// mesh.
///
/// A readable property map from vertex descriptors to `double`, in mesh units, positive. Between
/// the vertices of a face the tolerance is linear. Default: the same tolerance everywhere.
template <class Map>
auto vertex_tolerance_map(const Map& map)
{
  return Named_parameters<Map, internal::vertex_tolerance_map_t>(map);
}

/// \brief A tolerance at each face of the input, where it is less than the one for the whole mesh.
///
/// A readable property map from face descriptors to `double`, in mesh units, positive. A vertex
/// takes the least of its faces. Default: the same tolerance everywhere.
template <class Map>
auto face_tolerance_map(const Map& map)
{
  return Named_parameters<Map, internal::face_tolerance_map_t>(map);
}

/// \brief Which faces stay as they are.
///
/// A readable property map from face descriptors to `bool`. Default: none.
template <class Map>
auto face_is_constrained_map(const Map& map)
{
  return Named_parameters<Map, internal::face_is_constrained_map_t>(map);
}

/// \brief Largest gap that a verifier of distances leaves between the truth and what it proves.
///
/// A fraction of the bound that it is asked for, greater than 0 (`double`). Default: 0.01.
inline auto relative_slack(double slack)
{
  return Named_parameters<double, internal::relative_slack_t>(slack);
}

/// \brief Number of subdivisions after which a verifier of distances gives up, undecided.
///
/// A number of cells, at least 1 (`std::size_t`). Default: set by the function that reads it, in
/// proportion to the number of faces.
inline auto maximum_subdivisions(std::size_t number)
{
  return Named_parameters<std::size_t, internal::maximum_subdivisions_t>(number);
}

/// \brief Where to write the bound of each face on its distance to the original.
///
/// A writable property map from face descriptors to `double`, in mesh units. Default: the property
/// map "f:deviation", which is added to the mesh.
template <class Map>
auto deviation_map(const Map& map)
{
  return Named_parameters<Map, internal::deviation_map_t>(map);
}

/// \brief How curvature is estimated (`Curvature_method`). Default: `Curvature_method::adaptive`.
inline auto curvature_method(Curvature_method method)
{
  return Named_parameters<Curvature_method, internal::curvature_method_t>(method);
}

/// \brief Noise that the points have at least: the standard deviation of their distance to the
/// surface that is meant.
///
/// A length in mesh units, not negative (`double`). Default: 0, what the residuals of the fits
/// tell. A third of the tolerance of a remeshing keeps curvature from being resolved below it.
inline auto noise_floor(double length)
{
  return Named_parameters<double, internal::noise_floor_t>(length);
}

/// \brief Whether the sizes of a metric depend on direction (`Metric_kind`). Default:
/// `Metric_kind::anisotropic`.
inline auto metric_kind(Metric_kind kind)
{
  return Named_parameters<Metric_kind, internal::metric_kind_t>(kind);
}

/// \brief How far a face of the size that a metric asks for may lie from the surface.
///
/// A length in mesh units, greater than 0 (`double`). Default: none; see `relative_gap` and
/// `turning_angle`.
inline auto metric_tolerance(double length)
{
  return Named_parameters<double, internal::metric_tolerance_t>(length);
}

/// \brief How far a face of the size that a metric asks for may lie from the surface, relative to
/// the radius of curvature.
///
/// A fraction, greater than 0, at most 1 (`double`): eps of section 3.3 of the paper. Default:
/// none.
inline auto relative_gap(double fraction)
{
  return Named_parameters<double, internal::relative_gap_t>(fraction);
}

/// \brief By how much the normal of the surface may turn along an edge of the size that a metric
/// asks for.
///
/// In degrees, greater than 0, at most 180 (`double`). Default: none.
inline auto turning_angle(double degrees)
{
  return Named_parameters<double, internal::turning_angle_t>(degrees);
}

/// \brief The gap of a face of size h on a surface of curvature k, as a multiple of k h^2.
///
/// A number greater than 0 (`double`). Default: what holds for every equilateral triangle, from 1/8
/// where the surface is curved one way or like a saddle to 1/6 where it is like a sphere. The
/// chord's constant, which the paper uses, is 1/8; less lets faces be larger than the tolerance
/// alone would.
inline auto gap_constant(double constant)
{
  return Named_parameters<double, internal::gap_constant_t>(constant);
}

/// \brief The size that a metric does not go below, whatever the curvature.
///
/// A length in mesh units, greater than 0 (`double`). Default: set by the function that reads it.
inline auto minimum_size(double size)
{
  return Named_parameters<double, internal::minimum_size_t>(size);
}

/// \brief The size that a metric does not exceed, however flat the surface.
///
/// A length in mesh units, greater than 0 (`double`). Default: a tenth of the diagonal of the
/// bounding box.
inline auto maximum_size(double size)
{
  return Named_parameters<double, internal::maximum_size_t>(size);
}

/// \brief Largest ratio of the two sizes of an anisotropic metric at one place.
///
/// A ratio, at least 1 (`double`); infinity turns the limit off. Default: 10.
inline auto maximum_aspect_ratio(double ratio)
{
  return Named_parameters<double, internal::maximum_aspect_ratio_t>(ratio);
}

/// \brief Sizes that the user asks for.
///
/// A function from points, or a readable property map from vertex descriptors, to a size (`double`,
/// in mesh units) or to a tensor (`Eigen::Matrix3d`); or a `Medit_solution`. Default: none.
template <class Field>
auto size_field(const Field& field)
{
  return Named_parameters<Field, internal::size_field_t>(field);
}

/// \brief How the metric between the ends of an edge is interpolated (`Length_rule`). Default:
/// `Length_rule::linear_size`.
inline auto length_rule(Length_rule rule)
{
  return Named_parameters<Length_rule, internal::length_rule_t>(rule);
}

/// \brief By which factor sizes may grow along an edge of unit length.
///
/// A ratio, at least 1, which makes sizes uniform; infinity lets them jump (`double`).
/// Default: 1.3.
inline auto gradation(double beta) { return Named_parameters<double, internal::gradation_t>(beta); }

/// \brief How often the tensors of a metric are averaged with their neighbours before its gradation
/// is limited.
///
/// A number of rounds (`unsigned`). Default: 0, because an average may be larger than what was
/// asked for. Two to four rounds save the anisotropy of noisy tensors. Isotropic metrics ignore it.
inline auto smoothing_rounds(unsigned rounds)
{
  return Named_parameters<unsigned, internal::smoothing_rounds_t>(rounds);
}

/// \brief The largest two-sided Hausdorff distance of a unit mesh to its original.
///
/// A length in mesh units, positive (`double`). Default: a thousandth of the diagonal of the
/// bounding box.
inline auto tolerance(double length)
{
  return Named_parameters<double, internal::tolerance_t>(length);
}

/// \brief The smooth surface that vertices are placed on (`Geometric_support` of the same mesh).
///
/// Default: one with Max's normals, made on the fly.
template <class Support>
auto geometric_support(const Support& support)
{
  return Named_parameters<Support, internal::geometric_support_t>(support);
}

/// \brief Whether `remesh()` prefers few faces to a mesh that follows the curvature closely.
///
/// Sizes are larger then, by a factor of 1.9 or of 1.3 if they depend on the direction, and grow
/// faster: the tolerance decides where they are too large. Default: `false`.
inline auto fewest_faces(bool fewest)
{
  return Named_parameters<bool, internal::fewest_faces_t>(fewest);
}

/// \brief Whether `remesh()` lowers isotropic sizes where features are near to each other.
///
/// As `limit_proximity()` does. Default: `true`; `false` with `fewest_faces`.
inline auto proximity(bool limits) { return Named_parameters<bool, internal::proximity_t>(limits); }

/// \brief A metric on another mesh of the same surface, which a unit mesh respects as well
/// (`Background_metric`). It is not copied, and must outlive the call. Default: none.
inline auto background_metric(const Background_metric& metric)
{
  return Named_parameters<const Background_metric*, internal::background_metric_t>(&metric);
}

/// \brief The number of vertices that a mesh adapted to a field is to have.
///
/// Positive (`double`). No default: one of this and `target_error` must be given.
inline auto target_vertices(double number)
{
  return Named_parameters<double, internal::target_vertices_t>(number);
}

/// \brief The interpolation error that a mesh adapted to a field is to have.
///
/// In the L^p norm of `norm_exponent`: in units of the field times length^(2/p). Positive
/// (`double`). No default: one of this and `target_vertices` must be given.
inline auto target_error(double error)
{
  return Named_parameters<double, internal::target_error_t>(error);
}

/// \brief The p of the L^p norm in which the interpolation error is made small.
///
/// At least 1; infinity makes the error equal everywhere, small p resolve weak features beside
/// strong ones (`double`). Default: 2.
inline auto norm_exponent(double p)
{
  return Named_parameters<double, internal::norm_exponent_t>(p);
}

/// \brief Whether the integral of a field is kept when it is carried to another mesh (`bool`).
/// Default: `false`.
inline auto conserves(bool does) { return Named_parameters<bool, internal::conserves_t>(does); }

} // namespace parameters

namespace internal {

/// The same chain as CGAL knows it. Some functions of CGAL are overloaded on the class of the
/// chain, and would take a derived class for another of their arguments.
template <class Value, class Tag, class Base>
const CGAL::Named_function_parameters<Value, Tag, Base>& as_cgal(
    const CGAL::Named_function_parameters<Value, Tag, Base>& np)
{
  return np;
}

} // namespace internal

} // namespace surety

#endif // SURETY_PARAMETERS_H
