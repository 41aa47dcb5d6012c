// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric support where P. J. Frey's paper has it: on the geometric mesh, without the
// original.
#ifndef SURETY_SUPPORT_ON_GEOMETRIC_MESH_H
#define SURETY_SUPPORT_ON_GEOMETRIC_MESH_H

#include <surety/geometric_support.h>
#include <surety/internal/support/fitting.h>
#include <surety/internal/support/input.h>

#include <CGAL/Named_function_parameters.h>

#include <Eigen/Core>

#include <limits>
#include <utility>
#include <vector>

namespace surety {

namespace internal {

/// The bounds b(K) of a geometric mesh, by face.
template <class Mesh, class Deviation_map>
std::vector<double> read_deviation(
    const Mesh& mesh, const Deviation_map& deviation, const char* function)
{
  std::vector<double> result(num_faces(mesh), 0);
  for (const auto f : faces(mesh)) {
    result[f] = get(deviation, f);
    if (result[f] >= 0) continue;
    throw Invalid_input(
        function, "deviation", "the bound of a face is " + to_text(result[f]) + ", not a distance");
  }
  return result;
}

template <class Mesh, class Deviation_map, class NamedParameters>
Geometric_support support_on_geometric_mesh(
    const Mesh& mesh, const Deviation_map& deviation, double tolerance, const Features& features,
    const std::vector<Eigen::Vector3d>* normals, const NamedParameters& np)
{
  const char* const function = "make_support_on_geometric_mesh";
  require_positive(tolerance, function, "tolerance");
  const double corner_angle = angle_parameter(
      np, internal::corner_angle, defaults::corner_angle, function, "corner_angle");
  Support_input input = support_input(mesh, features, normals, function, np);
  const std::vector<double> bounds = read_deviation(mesh, deviation, function);
  const Fitting fitting(input.mesh, std::move(input.normals), bounds, tolerance, corner_angle);
  Support_surface surface(
      std::move(input.mesh), fitting.shape(), std::numeric_limits<double>::infinity());
  Support_report report;
  report.tolerance = tolerance;
  report.deviation = proven_deviation(surface, bounds);
  report.promoted_edges = fitting.promoted_edges();
  report.faces_to_refine = fitting.faces_to_refine();
  return Geometric_support(std::move(surface), fitting.shape(), std::move(report));
}

} // namespace internal

/// \brief Makes a support of a geometric mesh, as in the paper, and says how far it is from the
/// original.
///
/// The mesh has spent a part b(K) of the tolerance at each face already; the rest is what the patch
/// of the face may be displaced by. Where it would be more, `report().faces_to_refine` names the
/// face, since a finer geometric mesh would serve best. What is left to do is done: the
/// displacements of the patch are scaled down where that leaves less than 5 degrees of a crease,
/// else its creases become ridges. `report().deviation` bounds the two-sided distance to the
/// original: it is at most the tolerance if no b(K) exceeds that, up to 2^-20 of it.
///
/// A support of the original (`make_geometric_support()`) is nearer to it and smoother; take this
/// one where the original is not at hand.
///
/// \param deviation a readable property map from faces to `double`: how far the face and the part
///   of the original that corresponds to it are from each other at most, as
///   `make_geometric_mesh()` writes to "f:deviation".
/// \param tolerance in mesh units, positive.
/// \throws Invalid_input when the mesh is not valid, a number not in its range, or features
///   belong to another mesh.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{corner_angle}
///     \cgalParamDescription{where a curve of features with new ridges turns by more there is a
///       corner}
///     \cgalParamType{`double`, in degrees, from 0 to 180}
///     \cgalParamDefault{60}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <
    class Mesh, class Deviation_map,
    class NamedParameters = CGAL::parameters::Default_named_parameters>
Geometric_support make_support_on_geometric_mesh(
    const Mesh& mesh, const Deviation_map& deviation, double tolerance, const Features& features,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  return internal::support_on_geometric_mesh(mesh, deviation, tolerance, features, nullptr, np);
}

/// With the normals of a curvature field. Sides that new ridges cut take Max's normals.
template <
    class Mesh, class Deviation_map,
    class NamedParameters = CGAL::parameters::Default_named_parameters>
Geometric_support make_support_on_geometric_mesh(
    const Mesh& mesh, const Deviation_map& deviation, double tolerance, const Features& features,
    const Curvature_field& curvature,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const auto normals = internal::normals_of(curvature);
  return internal::support_on_geometric_mesh(mesh, deviation, tolerance, features, &normals, np);
}

} // namespace surety

#endif // SURETY_SUPPORT_ON_GEOMETRIC_MESH_H
