// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far two meshes lie apart, certified: `certify_distance` answers whether two surfaces stay
// within a bound of each other, `hausdorff_distance` encloses their distance in an interval. Both
// look at every point of both surfaces, both ways, and round outwards; they know nothing of how the
// meshes came about, so they check the results of any program.
#ifndef SURETY_DISTANCE_H
#define SURETY_DISTANCE_H

#include <surety/errors.h>
#include <surety/parameters.h>
#include <surety/internal/distance/read_triangles.h>
#include <surety/internal/distance/search.h>
#include <surety/internal/validation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace surety {

/// A point of one of two meshes, and how far it is at least from the other one.
struct Witness {
  /// On the mesh up to the rounding of its coordinates, which the lower bound accounts for.
  std::array<double, 3> point;
  /// No point of the other mesh is closer.
  double distance_lower_bound;
  /// The face on which the point lies: its position in the iteration order of the mesh.
  std::size_t face;
  /// Whether the point lies on the first of the two meshes.
  bool is_on_first;
};

/// Certified bounds of the largest distance from a point of one mesh to the other mesh.
struct Distance_interval {
  double lower;    ///< attained by the witness
  double upper;    ///< infinite where it was not searched for
  Witness witness; ///< the point that is this far from the other mesh
};

/// \brief What `certify_distance()` found out: the bound holds, or is refuted, or neither.
///
/// Three answers, of which exactly one is true. A certificate that is undecided proves nothing but
/// its two bounds.
class Distance_certificate
{
public:
  /// For the functions that make certificates.
  Distance_certificate(
      double bound, const Distance_interval& forward, const Distance_interval& backward)
    : bound_(bound), forward_(forward), backward_(backward)
  {}

  /// The bound that was asked for.
  double bound() const { return bound_; }

  /// Every point of either mesh lies within the bound of the other mesh.
  bool holds() const { return upper_bound() <= bound_; }
  /// Some point lies farther from the other mesh than the bound: see `witness()`.
  bool refuted() const { return lower_bound() > bound_; }
  /// Rounding, or the limit of subdivisions, prevents an answer.
  bool undecided() const { return !holds() && !refuted(); }

  /// No larger than the Hausdorff distance of the meshes.
  double lower_bound() const { return (std::max)(forward_.lower, backward_.lower); }
  /// At least the Hausdorff distance of the meshes; infinite if the bound is refuted, since the
  /// search ends there.
  double upper_bound() const { return (std::max)(forward_.upper, backward_.upper); }

  /// From the points of the first mesh to the second mesh.
  const Distance_interval& forward() const { return forward_; }
  /// From the points of the second mesh to the first mesh.
  const Distance_interval& backward() const { return backward_; }

  /// A point that refutes the bound, if there is one.
  std::optional<Witness> witness() const
  {
    if (!refuted()) return std::nullopt;
    return forward_.lower > bound_ ? forward_.witness : backward_.witness;
  }

private:
  double bound_;
  Distance_interval forward_;
  Distance_interval backward_;
};

/// The Hausdorff distance of two meshes, enclosed in each direction.
struct Hausdorff_distance {
  double accuracy;            ///< the width that was asked for
  Distance_interval forward;  ///< from the points of the first mesh to the second mesh
  Distance_interval backward; ///< from the points of the second mesh to the first mesh

  /// The distance is at least this, in mesh units.
  double lower() const { return (std::max)(forward.lower, backward.lower); }
  /// It is at most this.
  double upper() const { return (std::max)(forward.upper, backward.upper); }

  /// Whether both intervals are as narrow as was asked for. If not, they hold nevertheless.
  bool is_accurate() const
  {
    return forward.upper - forward.lower <= accuracy && backward.upper - backward.lower <= accuracy;
  }
};

namespace internal {

inline Distance_interval to_interval(const hausdorff::Measured_distance& measured, bool is_on_first)
{
  return {
      measured.lower, measured.upper,
      Witness{measured.witness, measured.lower, measured.witness_face, is_on_first}};
}

/// Meshes that are close need a few subdivisions a face, even if their faces differ in size; the
/// default leaves room for much worse.
template <class NamedParameters>
std::size_t maximum_subdivisions_or_default(
    const NamedParameters& np, std::size_t number_of_faces, const char* function)
{
  const std::size_t result = CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(np, maximum_subdivisions), 100 * number_of_faces + 1000000);
  if (result == 0) throw Invalid_input(function, "maximum_subdivisions", "0 is not at least 1");
  return result;
}

} // namespace internal

/// \brief proves or refutes that two triangle meshes lie within a bound of each other.
///
/// If the certificate `holds()`, then every point of either surface, not only the vertices, is
/// within the bound of the other surface: the Hausdorff distance is at most `upper_bound()`, which
/// is at most the bound. If it is `refuted()`, then its `witness()` is a point of one surface that
/// is farther than the bound from the other. All comparisons are rounded outwards, wherever the
/// meshes lie and whatever their size.
///
/// The answer may also be that the bound is undecided: if the distance equals the bound up to
/// rounding, which is some 10^-13 of the extent of the meshes, or if `maximum_subdivisions` is
/// reached.
///
/// The search is a branch and bound over convex pieces of the faces with CGAL's AABB tree. It
/// takes time in proportion to the number of faces of the overlay of the two surfaces; a refutation
/// usually takes much less.
///
/// \tparam Mesh1,Mesh2 models of `FaceListGraph` whose points have coordinates of type `double`.
///
/// \param first,second compared in both directions, never modified. Degenerate faces, holes,
/// self-intersections and several components are allowed.
/// \param bound distance to certify, in mesh units.
/// \param np1,np2 named parameters, for the first and for the second mesh.
///
/// \pre Both meshes are non-empty and triangulated, their coordinates are finite; `bound` is finite
/// and positive.
/// \throws Invalid_input when a precondition fails.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices of a mesh, in `np1` and in `np2`}
///     \cgalParamType{a readable property map from vertex descriptors to points}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{relative_slack}
///     \cgalParamDescription{how far `upper_bound()` may lie above the Hausdorff distance, as a
///        fraction of `bound`, if the bound holds. From 1 on, only the answer is sought, and found
///        in less time. In `np1`.}
///     \cgalParamType{double}
///     \cgalParamDefault{`0.01`}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_subdivisions}
///     \cgalParamDescription{number of subdivisions after which the search gives up. In `np1`.}
///     \cgalParamType{std::size_t}
///     \cgalParamDefault{10^6, and 100 for each face}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <
    class Mesh1, class Mesh2, class NamedParameters1 = CGAL::parameters::Default_named_parameters,
    class NamedParameters2 = CGAL::parameters::Default_named_parameters>
Distance_certificate certify_distance(
    const Mesh1& first, const Mesh2& second, double bound,
    const NamedParameters1& np1 = CGAL::parameters::default_values(),
    const NamedParameters2& np2 = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  static constexpr const char* function = "certify_distance";

  internal::require_positive(bound, function, "bound");
  const double slack = choose_parameter(
      get_parameter(np1, internal::relative_slack), internal::defaults::relative_slack);
  internal::require_positive(slack, function, "relative_slack");
  const auto a = internal::hausdorff::read_triangles(first, np1, function, "first");
  const auto b = internal::hausdorff::read_triangles(second, np2, function, "second");

  internal::hausdorff::Request request;
  request.bound = bound;
  request.slack = slack * bound;
  request.maximum_cuts
      = internal::maximum_subdivisions_or_default(np1, a.faces.size() + b.faces.size(), function);
  const auto [forward, backward] = internal::hausdorff::search(a, b, request);
  return Distance_certificate(
      bound, internal::to_interval(forward, true), internal::to_interval(backward, false));
}

/// \brief encloses the Hausdorff distance of two triangle meshes.
///
/// In each direction, the largest distance from a point of one surface to the other surface lies in
/// the interval that is returned, and its lower end is attained by the witness. The intervals are
/// rounded outwards. They are no wider than `accuracy`, unless that is less than rounding permits,
/// which is 10^-12 of the extent of the meshes, or eight units in the last place of a coordinate if
/// they lie far from the origin, or `maximum_subdivisions` is reached: see
/// `Hausdorff_distance::is_accurate()`.
///
/// \tparam Mesh1,Mesh2 models of `FaceListGraph` whose points have coordinates of type `double`.
///
/// \param first,second compared in both directions, never modified. Degenerate faces, holes,
/// self-intersections and several components are allowed.
/// \param accuracy largest width of each interval, in mesh units.
/// \param np1,np2 named parameters, for the first and for the second mesh.
///
/// \pre Both meshes are non-empty and triangulated, their coordinates are finite; `accuracy` is
/// finite and positive.
/// \throws Invalid_input when a precondition fails.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices of a mesh, in `np1` and in `np2`}
///     \cgalParamType{a readable property map from vertex descriptors to points}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_subdivisions}
///     \cgalParamDescription{number of subdivisions after which the search gives up. In `np1`.}
///     \cgalParamType{std::size_t}
///     \cgalParamDefault{10^6, and 100 for each face}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <
    class Mesh1, class Mesh2, class NamedParameters1 = CGAL::parameters::Default_named_parameters,
    class NamedParameters2 = CGAL::parameters::Default_named_parameters>
Hausdorff_distance hausdorff_distance(
    const Mesh1& first, const Mesh2& second, double accuracy,
    const NamedParameters1& np1 = CGAL::parameters::default_values(),
    const NamedParameters2& np2 = CGAL::parameters::default_values())
{
  static constexpr const char* function = "hausdorff_distance";

  internal::require_positive(accuracy, function, "accuracy");
  const auto a = internal::hausdorff::read_triangles(first, np1, function, "first");
  const auto b = internal::hausdorff::read_triangles(second, np2, function, "second");

  internal::hausdorff::Request request;
  request.slack = accuracy;
  request.maximum_cuts
      = internal::maximum_subdivisions_or_default(np1, a.faces.size() + b.faces.size(), function);
  const auto [forward, backward] = internal::hausdorff::search(a, b, request);
  return {accuracy, internal::to_interval(forward, true), internal::to_interval(backward, false)};
}

} // namespace surety

#endif // SURETY_DISTANCE_H
