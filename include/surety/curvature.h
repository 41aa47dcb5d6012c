// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curvature of a triangulated surface, sections 3.1 and 3.2 of the paper: at each side of each
// vertex, and along the curves of features.
#ifndef SURETY_CURVATURE_H
#define SURETY_CURVATURE_H

#include <surety/curvature_field.h>
#include <surety/features.h>
#include <surety/internal/curvature/curve.h>
#include <surety/internal/curvature/estimator.h>
#include <surety/internal/curvature/side_graph.h>
#include <surety/internal/curvature/value.h>
#include <surety/internal/parallel.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace surety {

/// \brief What `principal_curvatures()` writes: the members of CGAL 6's type of this name, and
/// more.
///
/// Curvatures are in 1/length and positive where the surface bends towards its normal: negative on
/// a sphere whose faces are oriented outwards.
template <class Kernel>
struct Principal_curvatures_and_directions {
  using FT = typename Kernel::FT;             ///< number type
  using Vector_3 = typename Kernel::Vector_3; ///< direction

  FT min_curvature = 0;                       ///< the smaller one, with its sign
  FT max_curvature = 0;                       ///< the larger one, with its sign
  Vector_3 min_direction = Vector_3(0, 0, 0); ///< of unit length
  Vector_3 max_direction = Vector_3(0, 0, 0); ///< of unit length
  Vector_3 normal = Vector_3(0, 0, 0);        ///< of unit length
  FT mean_curvature = 0;                      ///< half the sum of both
  FT gaussian_curvature = 0;                  ///< their product
  Point_type type = Point_type::planar;       ///< what the surface is like there
};

namespace internal {

/// Curvature exists at degenerate faces and isolated vertices as well; what is refused is what
/// has no meaning.
template <class Mesh, class Points>
void require_finite_triangles(const Mesh& mesh, const Points& points, const char* function)
{
  if (!CGAL::is_triangle_mesh(mesh)) {
    throw Invalid_input(
        function, "mesh", "the mesh has a face that is not a triangle",
        "triangulate with CGAL::Polygon_mesh_processing::triangulate_faces");
  }
  std::size_t position = 0;
  for (const auto v : vertices(mesh)) {
    if (!to_vector(get(points, v)).allFinite()) {
      throw Invalid_input(
          function, "mesh",
          "vertex " + std::to_string(position)
              + " has a coordinate that is "
                "not finite",
          "give it a point or remove its faces");
    }
    ++position;
  }
}

struct Curvature_controls {
  Curvature_method method;
  double noise_floor;
};

template <class NamedParameters>
Curvature_controls curvature_controls(const NamedParameters& np, const char* function)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const Curvature_controls controls{
      choose_parameter(get_parameter(np, curvature_method), defaults::curvature_method),
      choose_parameter(get_parameter(np, noise_floor), defaults::noise_floor)};
  require_in_range(
      controls.noise_floor, 0, std::numeric_limits<double>::max(), function, "noise_floor");
  return controls;
}

/// The buffers of an estimator, which grow with the mesh, serve a block of sides: there are not
/// more than 64 of them.
template <class ConcurrencyTag>
void estimate_sides(
    const curvature::Side_graph& graph, const Curvature_controls& controls, Curvature_field& field)
{
  const Index block = (std::max)(Index(512), graph.size() / 64 + 1);
  const Index blocks = (graph.size() + block - 1) / block;
  std::vector<std::size_t> fallbacks(blocks, 0);
  field.side.resize(graph.size());
  for_each_index<ConcurrencyTag>(blocks, [&](Index b) {
    curvature::Side_estimator estimator(graph, controls.method, controls.noise_floor);
    const Index end = (std::min)((b + 1) * block, graph.size());
    for (Index s = b * block; s < end; ++s) {
      field.side[s] = estimator(s);
      if (estimator.is_fallback(field.side[s].fit)) ++fallbacks[b];
    }
  });
  for (const std::size_t number : fallbacks) field.fallbacks += number;
}

template <class ConcurrencyTag, class Mesh>
void estimate_curves(
    const Mesh& mesh, const Features& features, const curvature::Side_graph& graph,
    Curvature_field& field)
{
  field.curve.resize(num_vertices(mesh));
  const curvature::Feature_curves curves(mesh, features);
  for_each_index<ConcurrencyTag>(static_cast<Index>(field.curve.size()), [&](Index v) {
    if (curves.has(v)) field.curve[v] = curvature::fit_curve(graph, curves, v);
  });
}

} // namespace internal

/// \brief Estimates the curvature of a surface at each side of each vertex, and along the curves of
/// features.
///
/// The surface is taken for smooth on each side of its features; what lies across a feature edge
/// has no influence. The default method fits polynomials and lets their residuals choose order and
/// neighbourhood: on smooth surfaces with vertices on them its error falls with the fourth power
/// of the edge length, and noise is averaged over as many samples as the shape allows.
///
/// Every mesh gives finite values. Where samples are too few for the method, a poorer fit serves;
/// `Side_curvature::fit` tells which, `Curvature_field::fallbacks` how often.
///
/// Linear in the size of the mesh. With `CGAL::Parallel_tag` all threads of TBB work; the result is
/// the same to the last bit.
///
/// \tparam ConcurrencyTag `CGAL::Sequential_tag`, or `CGAL::Parallel_tag`, which needs TBB.
///
/// \param features ridges and corners, of this mesh.
/// \pre All faces are triangles, all coordinates are finite. Degenerate faces are allowed.
/// \throws Invalid_input when a precondition fails or a parameter is out of range.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{curvature_method}
///     \cgalParamDescription{how curvature is estimated from the samples round a vertex}
///     \cgalParamType{`Curvature_method`}
///     \cgalParamDefault{`Curvature_method::adaptive`}
///   \cgalParamNEnd
///   \cgalParamNBegin{noise_floor}
///     \cgalParamDescription{standard deviation of the noise that the points have at least; read by
///        the adaptive method. A third of a tolerance keeps curvature from being resolved below
///        it.}
///     \cgalParamType{`double`, in mesh units, not negative}
///     \cgalParamDefault{0}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <
    class ConcurrencyTag = CGAL::Sequential_tag, class Mesh,
    class NamedParameters = CGAL::parameters::Default_named_parameters>
Curvature_field estimate_curvatures(
    const Mesh& mesh, const Features& features,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const char* const function = "estimate_curvatures";
  const auto points = internal::vertex_points(mesh, np);
  const auto controls = internal::curvature_controls(np, function);
  internal::require_finite_triangles(mesh, points, function);

  Curvature_field field;
  field.sides = find_sides(mesh, features);
  const auto graph = internal::curvature::Side_graph_maker(mesh, points, features, field.sides)
                         .template make<ConcurrencyTag>();
  internal::estimate_sides<ConcurrencyTag>(graph, controls, field);
  internal::estimate_curves<ConcurrencyTag>(mesh, features, graph, field);
  return field;
}

/// \brief The same, with the features that `find_features()` finds with these named parameters.
template <
    class ConcurrencyTag = CGAL::Sequential_tag, class Mesh,
    class NamedParameters = CGAL::parameters::Default_named_parameters,
    class = std::enable_if_t<!std::is_same_v<NamedParameters, Features>>>
Curvature_field estimate_curvatures(
    const Mesh& mesh, const NamedParameters& np = CGAL::parameters::default_values())
{
  return estimate_curvatures<ConcurrencyTag>(mesh, find_features(mesh, np), np);
}

/// \brief Writes one curvature a vertex into a property map.
///
/// A vertex that features pass has several sides; the map gets the one whose curvature is largest
/// in absolute value, of equal ones the first. `estimate_curvatures()` returns them all. An
/// isolated vertex gets zeros.
///
/// \param curvature_map a writable property map from vertices to
/// `Principal_curvatures_and_directions<Kernel>`, or to any type with its members
/// `min_curvature`, `max_curvature`, `min_direction` and `max_direction`.
///
/// Named parameters, preconditions and exceptions are those of `estimate_curvatures()` and
/// `find_features()`.
template <
    class ConcurrencyTag = CGAL::Sequential_tag, class Mesh, class Curvature_map,
    class NamedParameters = CGAL::parameters::Default_named_parameters>
void principal_curvatures(
    const Mesh& mesh, Curvature_map curvature_map,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  using Value = typename boost::property_traits<Curvature_map>::value_type;

  const Curvature_field field = estimate_curvatures<ConcurrencyTag>(mesh, np);
  for (const auto v : vertices(mesh))
    put(curvature_map, v, internal::curvature::value_at<Value>(field, v));
}

} // namespace surety

#endif // SURETY_CURVATURE_H
