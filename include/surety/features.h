// SPDX-License-Identifier: GPL-3.0-or-later
//
// Features of a surface: the curves that remeshing must not round off (ridges, borders, edges that
// the user constrains), the points where they end, branch or turn, and one normal a side of them.
#ifndef SURETY_FEATURES_H
#define SURETY_FEATURES_H

#include <surety/internal/features/corners.h>
#include <surety/internal/features/normals.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/property_map.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace surety {

/// The features of a mesh, by the index of its edges and vertices.
struct Features {
  std::vector<bool> edge;      ///< `edge[e]`: a border, constrained or a ridge
  std::vector<bool> corner;    ///< `corner[v]`: must stay where it is
  std::size_t borders = 0;     ///< edges with one face
  std::size_t constrained = 0; ///< other edges that the user's map constrains
  std::size_t ridges = 0;      ///< other edges where the surface turns by more than `feature_angle`
  std::size_t corners = 0;     ///< vertices that are corners
  std::vector<bool> whole;     ///< `whole[e]`: must not be split, its ends being corners; or empty
};

namespace internal {

template <class Mesh>
void require_features_of(const Mesh& mesh, const Features& features, const char* function)
{
  if (features.edge.size() == num_edges(mesh) && features.corner.size() == num_vertices(mesh)
      && (features.whole.empty() || features.whole.size() == num_edges(mesh)))
    return;
  throw Invalid_input(
      function, "features", "they do not belong to the mesh", "find them in this mesh");
}

constexpr double radians_per_degree = 3.14159265358979323846 / 180;

template <class Mesh, class NamedParameters>
auto vertex_points(const Mesh& mesh, const NamedParameters& np)
{
  return CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_point),
      get(CGAL::vertex_point, mesh));
}

/// Reads a parameter that is an angle in degrees, and returns it in radians.
template <class NamedParameters, class Tag>
double angle_parameter(
    const NamedParameters& np, Tag tag, double otherwise, const char* function, const char* name)
{
  const double degrees
      = CGAL::parameters::choose_parameter(CGAL::parameters::get_parameter(np, tag), otherwise);
  require_in_range(degrees, 0, 180, function, name);
  return degrees * radians_per_degree;
}

template <class Mesh, class Points, class Constrained_edges>
void mark_feature_edges(
    const Mesh& mesh, const Points& points, const Constrained_edges& is_constrained,
    double feature_angle, Features& features)
{
  const std::vector<Vector> normals = face_normals(mesh, points);
  features.edge.assign(num_edges(mesh), false);
  for (const auto e : edges(mesh)) {
    const auto h = halfedge(e, mesh);
    std::size_t* kind = nullptr;
    if (CGAL::is_border_edge(h, mesh)) {
      kind = &features.borders;
    } else if (get(is_constrained, e)) {
      kind = &features.constrained;
    } else {
      const double angle
          = angle_between(normals[face(h, mesh)], normals[face(opposite(h, mesh), mesh)]);
      if (angle > feature_angle) kind = &features.ridges;
    }
    if (kind == nullptr) continue;
    ++*kind;
    features.edge[e] = true;
  }
}

template <class Mesh, class Points, class Constrained_vertices>
void mark_corners(
    const Mesh& mesh, const Points& points, const Constrained_vertices& is_constrained,
    double corner_angle, Features& features)
{
  features.corner.assign(num_vertices(mesh), false);
  for (const auto v : vertices(mesh)) {
    if (!get(is_constrained, v) && !is_corner(mesh, points, features.edge, v, corner_angle)) {
      continue;
    }
    features.corner[v] = true;
    ++features.corners;
  }
}

/// Borders, what the user constrains, edges that turn by more than an angle (in radians), and what
/// `mark_more(features)` adds; then the corners of all these.
template <class Mesh, class NamedParameters, class Mark_more>
Features features_of(
    const Mesh& mesh, const NamedParameters& np, const char* function, double feature_angle,
    const Mark_more& mark_more)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using Edge = typename boost::graph_traits<Mesh>::edge_descriptor;
  using Vertex = typename boost::graph_traits<Mesh>::vertex_descriptor;

  const double corner_angle = angle_parameter(
      np, internal::corner_angle, defaults::corner_angle, function, "corner_angle");
  const auto points = vertex_points(mesh, np);
  Features features;
  mark_feature_edges(
      mesh, points,
      choose_parameter(
          get_parameter(np, CGAL::internal_np::edge_is_constrained),
          CGAL::Static_boolean_property_map<Edge, false>()),
      feature_angle, features);
  mark_more(features);
  mark_corners(
      mesh, points,
      choose_parameter(
          get_parameter(np, CGAL::internal_np::vertex_is_constrained),
          CGAL::Static_boolean_property_map<Vertex, false>()),
      corner_angle, features);
  return features;
}

} // namespace internal

/// \brief Finds the feature edges and the corners of a mesh.
///
/// Feature edges are the borders, the edges that the user constrains, and the ridges: edges where
/// the normals of the two faces make more than `feature_angle`. Corners are the vertices that the
/// user constrains, those where one, three or more feature edges meet, and those where two meet
/// that turn by more than `corner_angle`.
///
/// \pre The mesh has only triangles, none of them degenerate.
/// \throws Invalid_input when an angle is not in its range.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{feature_angle}
///     \cgalParamDescription{edges where the surface turns by more are ridges}
///     \cgalParamType{`double`, in degrees, from 0 to 180}
///     \cgalParamDefault{180, no ridges}
///   \cgalParamNEnd
///   \cgalParamNBegin{corner_angle}
///     \cgalParamDescription{where a curve of feature edges turns by more there is a corner}
///     \cgalParamType{`double`, in degrees, from 0 to 180}
///     \cgalParamDefault{60}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{edges that are features whatever their angle}
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
Features find_features(
    const Mesh& mesh, const NamedParameters& np = CGAL::parameters::default_values())
{
  const char* const function = "find_features";
  const double feature_angle = internal::angle_parameter(
      np, internal::feature_angle, internal::defaults::feature_angle, function, "feature_angle");
  return internal::features_of(mesh, np, function, feature_angle, [](Features&) {});
}

/// \brief The sides of a surface: what feature edges leave of the faces round each vertex.
///
/// A vertex that no feature passes has one side, all the faces round it; on a ridge it has two, on
/// a border one, at a corner as many as curves meet there. What is smooth on a side only (normal,
/// curvature, metric) is stored once a side.
struct Sides {
  /// The side of a halfedge without a face.
  static constexpr std::uint32_t no_side = 0xffffffff;

  std::vector<std::uint32_t> of_corner; ///< by halfedge h: the side at its target that has face(h)
  std::vector<std::uint32_t> vertex;    ///< by side: the vertex that it belongs to
  std::vector<std::uint32_t> first;     ///< by vertex: its first side; the others follow

  /// The number of sides.
  std::size_t size() const { return vertex.size(); }
};

/// \brief Numbers the sides of a mesh; those of a vertex are consecutive.
///
/// Linear in the size of the mesh. Isolated vertices have no side.
template <class Mesh>
Sides find_sides(const Mesh& mesh, const Features& features)
{
  Sides sides;
  sides.of_corner.assign(num_halfedges(mesh), Sides::no_side);
  sides.first.assign(num_vertices(mesh) + 1, 0);
  for (const auto v : vertices(mesh)) {
    sides.first[v] = static_cast<std::uint32_t>(sides.size());
    const auto any = halfedge(v, mesh);
    if (any == boost::graph_traits<Mesh>::null_halfedge()) continue;
    for (const auto h : CGAL::halfedges_around_target(any, mesh)) {
      if (CGAL::is_border(h, mesh) || sides.of_corner[h] != Sides::no_side) continue;
      for (const auto corner : internal::sector(mesh, features.edge, h))
        sides.of_corner[corner] = static_cast<std::uint32_t>(sides.size());
      sides.vertex.push_back(static_cast<std::uint32_t>(v));
    }
  }
  sides.first.back() = static_cast<std::uint32_t>(sides.size());
  return sides;
}

/// \brief The normal of the surface at each corner of each face, one a side of every feature.
///
/// Feature edges cut the faces round a vertex into sectors; all corners of a sector share the mean
/// of its face normals, weighted by the angles of the faces. The result is indexed by halfedges:
/// the entry of `h` is the normal at the target of `h`, on the side of `face(h)`; it is zero where
/// `h` has no face, or where the normals of the sector cancel.
///
/// Reads `vertex_point_map`.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
auto corner_normals(
    const Mesh& mesh, const Features& features,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const auto points = internal::vertex_points(mesh, np);
  using Point = typename boost::property_traits<std::decay_t<decltype(points)>>::value_type;
  using Vector_3 = typename CGAL::Kernel_traits<Point>::Kernel::Vector_3;

  const std::vector<internal::Vector> normals = internal::face_normals(mesh, points);
  std::vector<Vector_3> result(num_halfedges(mesh), Vector_3(0, 0, 0));
  std::vector<bool> done(num_halfedges(mesh), false);
  for (const auto h : halfedges(mesh)) {
    if (done[h] || CGAL::is_border(h, mesh)) continue;
    const auto corners = internal::sector(mesh, features.edge, h);
    const internal::Vector n = internal::sector_normal(mesh, points, normals, corners);
    for (const auto corner : corners) {
      done[corner] = true;
      result[corner] = Vector_3(n.x(), n.y(), n.z());
    }
  }
  return result;
}

} // namespace surety

#endif // SURETY_FEATURES_H
