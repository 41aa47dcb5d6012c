// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric support: a G1 surface through the vertices of a mesh, to ask for points, normals,
// curvatures and closest points (section 4 of P. J. Frey, About Surface Remeshing, 2000).
#ifndef SURETY_GEOMETRIC_SUPPORT_H
#define SURETY_GEOMETRIC_SUPPORT_H

#include <surety/curvature_field.h>
#include <surety/features.h>
#include <surety/internal/support/closest.h>
#include <surety/internal/support/curvature.h>
#include <surety/internal/support/fitting.h>
#include <surety/internal/support/input.h>
#include <surety/internal/support/location.h>
#include <surety/internal/support/report.h>
#include <surety/internal/support/surface.h>
#include <surety/internal/support/tree.h>
#include <surety/internal/support/walk.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace surety {

/// A point of a curve of features.
struct Support_curve_point {
  Eigen::Vector3d point;   ///< on the curve
  Eigen::Vector3d tangent; ///< of unit length, in the direction of the edge
};

/// \brief A smooth surface through the vertices of a mesh.
///
/// One patch a face: quartic with Gregory points, in the manner of Walton and Meek. Two patches
/// that are both tangent to their normals (`Patch_state::is_tangent`) and not saturated have the
/// same tangent plane all along their common edge, unless that is a feature. The surface is
/// continuous everywhere. Vertices are interpolated, and normals where patches are tangent.
///
/// Faces, edges and vertices are numbered as in the mesh that the support was made of, which it
/// does not refer to. Copies share their data. All members are const and may be called from any
/// number of threads at once.
class Geometric_support
{
public:
  /// The largest change of direction, in degrees, between a normal and the normals of faces that a
  /// search considers.
  struct Facing {
    Eigen::Vector3d normal; ///< of unit length
    double largest_angle;   ///< in degrees
  };

  /// For the functions that make supports.
  Geometric_support(
      internal::Support_surface surface, const internal::Support_shape& shape,
      Support_report report)
    : data_(std::make_shared<const Data>(std::move(surface), shape, std::move(report)))
  {}

  /// How much of the surface is smooth, and what was refused.
  const Support_report& report() const { return data_->report; }
  /// Of one patch.
  const Patch_state& patch_state(std::uint32_t face) const { return data_->states[face]; }
  /// Of the mesh; each has a patch.
  std::size_t number_of_faces() const { return data_->surface.mesh().faces(); }

  /// \name At a location
  /// @{
  /// The point of the surface.
  Eigen::Vector3d position(const Support_location& at) const
  {
    return data_->surface.point(at.face, at.barycentric);
  }
  /// The point and its derivatives along coordinates 1 and 2 of the face.
  internal::Jet derivatives(const Support_location& at) const
  {
    return data_->surface.second_order(at.face, at.barycentric);
  }
  /// Of unit length, on the side that the face's orientation says.
  Eigen::Vector3d normal(const Support_location& at) const
  {
    return data_->surface.normal(at.face, data_->surface.first_order(at.face, at.barycentric));
  }
  /// \brief Principal curvatures and directions of the patch.
  ///
  /// Positive where the surface bends towards its normal. They jump from patch to patch, and have
  /// no limit at a vertex. The derivatives of the curvatures are not set.
  Side_curvature curvature(const Support_location& at) const
  {
    const internal::Jet jet = derivatives(at);
    return internal::curvature_of(jet, data_->surface.normal(at.face, jet));
  }
  /// @}

  /// \name Closest points
  /// @{
  /// \brief The closest point, found fast: nearest triangle, then Newton's method.
  ///
  /// A local minimum of the distance. Far from the surface, or where sheets are near each other
  /// against the length of edges, there may be a closer point.
  Support_point closest_point(const Eigen::Vector3d& p) const
  {
    return internal::fast_closest(data_->surface, data_->tree, p, internal::Any_face());
  }
  /// \brief The closest point, by branch and bound.
  ///
  /// No point of the support is closer by more than 2^-24 of the longest edge of the face that the
  /// search was in.
  Support_point guaranteed_closest_point(const Eigen::Vector3d& p) const
  {
    return internal::guaranteed_closest(data_->surface, data_->tree, p, internal::Any_face());
  }
  /// The same on the patches of those faces that look the given way; not found if there is none.
  Support_point closest_point(const Eigen::Vector3d& p, const Facing& facing) const
  {
    return internal::fast_closest(data_->surface, data_->tree, p, filter(facing));
  }
  /// By branch and bound, on the patches of those faces that look the given way.
  Support_point guaranteed_closest_point(const Eigen::Vector3d& p, const Facing& facing) const
  {
    return internal::guaranteed_closest(data_->surface, data_->tree, p, filter(facing));
  }
  /// @}

  /// \name Edges and curves
  /// @{
  /// The location of a point of an edge, from 0 at its source to 1 at its target.
  Support_location location_on_edge(std::uint32_t edge, double parameter) const
  {
    return internal::on_edge(data_->surface.mesh(), edge, parameter);
  }
  /// The point and the tangent of the curve of an edge: of a ridge or border, if it is one.
  Support_curve_point curve_point(std::uint32_t edge, double parameter) const
  {
    return point_of_curve(edge, parameter);
  }
  /// Whether an edge is a ridge or border.
  bool is_feature(std::uint32_t edge) const { return data_->surface.mesh().is_feature[edge]; }
  /// @}

  /// \name From face to face
  /// @{
  /// The same point in the face across edge i, which goes from corner i to the next; its face is
  /// `no_face` on a border. Coordinate i + 2 of the location is taken as 0.
  Support_location across(const Support_location& from, int i) const
  {
    if (data_->surface.mesh().neighbour[from.face][i] == internal::none) return {};
    return internal::across(data_->surface.mesh(), from, i);
  }
  /// \brief Walks a tangent step over the surface, straight in the coordinates of each face and
  /// turning about the tangent of each edge.
  ///
  /// Stops at borders, and at features unless they may be crossed.
  Support_walk walk(
      const Support_location& from, const Eigen::Vector3d& step,
      bool may_cross_features = true) const
  {
    return internal::Walk(data_->surface, may_cross_features).from(from, step);
  }
  /// @}

  /// \brief Bounds how far points of a face's patch are from the points of the flat face that they
  /// belong to.
  double displacement_bound(std::uint32_t face) const { return data_->surface.reach(face); }
  /// The vertices of a face, by corner.
  std::array<std::uint32_t, 3> corners(std::uint32_t face) const
  {
    return data_->surface.mesh().corner[face];
  }

private:
  struct Data {
    Data(internal::Support_surface s, const internal::Support_shape& shape, Support_report r)
      : surface(std::move(s)), states(surface.mesh().faces()), report(std::move(r))
    {
      const internal::Flat_mesh& mesh = surface.mesh();
      std::vector<internal::Patch_primitive> primitives;
      primitives.reserve(mesh.faces());
      for (internal::Index f = 0; f < mesh.faces(); ++f) {
        if (!mesh.is_face(f)) continue;
        primitives.emplace_back(surface, f);
        states[f]
            = {surface.may_saturate(f), bool(shape.is_refused[f]), shape.scale[f] < 1,
               shape.is_tangent(mesh, f)};
      }
      for (const bool is_aligned : shape.is_aligned) report.misaligned_sides += !is_aligned;
      for (const auto& primitive : primitives) tree.insert(primitive);
      tree.build();
      internal::measure(surface, states, report);
    }

    internal::Support_surface surface;
    internal::Patch_tree tree;
    std::vector<Patch_state> states;
    Support_report report;
  };

  internal::Facing filter(const Facing& facing) const
  {
    return {
        data_->surface.mesh(), facing.normal,
        std::cos(facing.largest_angle * internal::radians_per_degree)};
  }

  Support_curve_point point_of_curve(std::uint32_t edge, double parameter) const
  {
    const internal::Flat_mesh& mesh = data_->surface.mesh();
    const Support_location at = location_on_edge(edge, parameter);
    const int i = int(mesh.places[edge][0] % 3);
    const internal::Jet jet = data_->surface.first_order(at.face, at.barycentric);
    const internal::Vector along = i == 0 ? jet.v
        : i == 1                          ? internal::Vector(jet.w - jet.v)
                                          : internal::Vector(-jet.w);
    const double sign = mesh.is_along(at.face, i) ? 1 : -1;
    const Eigen::Vector3d chord = mesh.point[mesh.ends[edge][1]] - mesh.point[mesh.ends[edge][0]];
    const bool has_tangent = along.squaredNorm() > 1e-20 * chord.squaredNorm();
    return {jet.point, internal::unit(has_tangent ? internal::Vector(sign * along) : chord)};
  }

  std::shared_ptr<const Data> data_;
};

namespace internal {

/// Infinity is a tolerance: the patches are taken as they are.
inline void require_support_tolerance(double tolerance, const char* function)
{
  if (tolerance > 0) return;
  throw Invalid_input(function, "tolerance", to_text(tolerance) + " is not positive");
}

template <class Mesh, class NamedParameters>
Geometric_support support_within(
    const Mesh& mesh, double tolerance, const Features& features,
    const std::vector<Eigen::Vector3d>* normals, const NamedParameters& np)
{
  const char* const function = "make_geometric_support";
  require_support_tolerance(tolerance, function);
  Support_input input = support_input(mesh, features, normals, function, np);
  const Support_shape shape(input.mesh, std::move(input.normals));
  // The share below one half leaves room for the rounding of computed points.
  Support_surface surface(std::move(input.mesh), shape, tolerance / 2 * (1 - 0x1p-20));
  Support_report report;
  report.tolerance = tolerance;
  report.deviation = proven_deviation(surface);
  return Geometric_support(std::move(surface), shape, std::move(report));
}

} // namespace internal

/// \brief Makes a support that stays within a tolerance of the mesh that it is made of.
///
/// The support point of a point x of the mesh is x plus the displacement to the patch. The
/// displacement is left alone up to three eighths of the tolerance and saturates, with continuous
/// second derivatives, before half of it. So every point of the support is within half of the
/// tolerance of the mesh, every point of the mesh is that near to the support, by construction, and
/// `report().deviation` is the proven bound. Where nothing saturates the surface is G1;
/// `report()` has the shares.
///
/// Normals are interpolated, so their quality is that of the support: fitted ones (a
/// `Curvature_field`) give order 4 on smooth surfaces. They are made perpendicular to the curves
/// of features first. Without normals Max's are taken, which are exact on spheres only.
///
/// A patch that might fold is refused: its face is flat, with straight edges for its neighbours
/// too. Tolerance infinity: the patches as they are.
///
/// \param mesh a valid triangle mesh; may have borders.
/// \param tolerance in mesh units, positive.
/// \param features of the same mesh; across ridges the support is continuous only.
/// \throws Invalid_input when the mesh is not valid, the tolerance not positive, or features or
///   normals belong to another mesh.
///
/// Linear in the size of the mesh, and n log n for the search tree; some 700 bytes a face.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Geometric_support make_geometric_support(
    const Mesh& mesh, double tolerance, const Features& features,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  return internal::support_within(mesh, tolerance, features, nullptr, np);
}

/// With one normal a side, in the order of `find_sides()`.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Geometric_support make_geometric_support(
    const Mesh& mesh, double tolerance, const Features& features,
    const std::vector<Eigen::Vector3d>& normals,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  return internal::support_within(mesh, tolerance, features, &normals, np);
}

/// With the normals of a curvature field.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Geometric_support make_geometric_support(
    const Mesh& mesh, double tolerance, const Features& features, const Curvature_field& curvature,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const auto normals = internal::normals_of(curvature);
  return internal::support_within(mesh, tolerance, features, &normals, np);
}

} // namespace surety

#endif // SURETY_GEOMETRIC_SUPPORT_H
