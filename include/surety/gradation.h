// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradation: limits how fast the sizes of a metric may grow, so that a mesh of that metric can have
// well-shaped triangles (section 3.3 of the paper, "shock" of an edge).
#ifndef SURETY_GRADATION_H
#define SURETY_GRADATION_H

#include <surety/internal/gradation/anisotropic.h>
#include <surety/internal/gradation/isotropic.h>
#include <surety/internal/gradation/side_graph.h>
#include <surety/internal/gradation/smoothing.h>
#include <surety/internal/validation.h>
#include <surety/metric_field.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace surety {
namespace internal::grading {

template <class Mesh, class Points>
std::size_t limit_sizes(const Mesh& mesh, const Points& points, Metric_field& metric, double slope)
{
  const Sides& sides = metric.sides();
  std::vector<double> size(num_vertices(mesh), std::numeric_limits<double>::infinity());
  for (std::uint32_t s = 0; s < sides.size(); ++s) {
    size[sides.vertex[s]] = std::min(size[sides.vertex[s]], metric.size(s));
  }
  Isotropic_gradation<Mesh, Points>(mesh, points, slope).limit(size);
  std::size_t changed = 0;
  for (std::uint32_t s = 0; s < sides.size(); ++s) {
    const double limited = size[sides.vertex[s]];
    if (limited == metric.size(s)) continue;
    metric.set_size(s, limited);
    ++changed;
  }
  return changed;
}

inline Plane_tensor plane_tensor(const Node& node, const Eigen::Matrix3d& m)
{
  const Vector mu = m * node.basis[0], mv = m * node.basis[1];
  return {node.basis[0].dot(mu), node.basis[0].dot(mv), node.basis[1].dot(mv)};
}

inline Eigen::Matrix3d space_tensor(const Node& node, const Plane_tensor& m)
{
  const auto& [u, v] = node.basis;
  return metric::symmetrized(
      m.a * u * u.transpose() + m.b * (u * v.transpose() + v * u.transpose())
      + m.c * v * v.transpose() + Plane_axes(m).smaller * node.normal * node.normal.transpose());
}

/// Sides at vertices that no curve of features passes.
inline std::vector<bool> smooth_sides(const Metric_field& metric)
{
  const Sides& sides = metric.sides();
  std::vector<bool> result(sides.size());
  for (std::uint32_t s = 0; s < sides.size(); ++s) {
    const std::uint32_t v = sides.vertex[s];
    result[s] = sides.first[v + 1] - sides.first[v] == 1 && metric.tangent(v).isZero(0);
  }
  return result;
}

template <class Mesh, class Points>
std::size_t limit_tensors(
    const Mesh& mesh, const Points& points, Metric_field& metric, double slope, unsigned rounds)
{
  const Side_graph graph(mesh, points, metric);
  std::vector<Plane_tensor> given;
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    given.push_back(plane_tensor(graph.node(s), metric.tensor(s)));
  }
  std::vector<Plane_tensor> limited = given;
  Tensor_smoothing(graph, smooth_sides(metric)).smooth(limited, rounds);
  if (std::isfinite(slope)) Anisotropic_gradation(graph, slope).limit(limited);
  std::size_t changed = 0;
  for (std::uint32_t s = 0; s < graph.size(); ++s) {
    const Plane_tensor &a = given[s], &b = limited[s];
    if (a.a == b.a && a.b == b.b && a.c == b.c) continue;
    metric.set_tensor(s, space_tensor(graph.node(s), b));
    ++changed;
  }
  return changed;
}

} // namespace internal::grading

/// \brief Lowers the sizes of a metric until no size grows too fast along an edge of the mesh.
///
/// *Isotropic* metrics obey h_Q <= h_P + ln(gradation) |PQ| along every edge PQ afterwards: along
/// an edge of unit length, of which there may be several on PQ, the size grows at most by the
/// factor `gradation`. The result is the largest such field that is nowhere above the given one, to
/// the last bit. All sides of a vertex get the same size, the least of theirs: they share the edges
/// of the curve between them.
///
/// *Anisotropic* metrics hand their sizes on with their directions, so that thin layers stay
/// anisotropic; across a curve of features only the size along its tangent is handed on, and at a
/// corner the one along each edge. No size falls below the least one of the given metric. A tensor
/// changes where it asks for half a per cent less than its neighbours in some direction. The result
/// does not depend on the numbering of the mesh.
///
/// O(n log n) in the number of vertices.
///
/// \param metric of `mesh`; changed.
/// \return the number of sides whose metric has changed.
/// \throws Invalid_input when the metric does not belong to the mesh, or `gradation` is below 1.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{gradation}
///     \cgalParamDescription{by which factor sizes may grow along an edge of unit length}
///     \cgalParamType{`double`, at least 1; infinity lets sizes jump}
///     \cgalParamDefault{1.3}
///   \cgalParamNEnd
///   \cgalParamNBegin{smoothing_rounds}
///     \cgalParamDescription{how often the tensors of an anisotropic metric are averaged with their
///       neighbours first, except on curves of features; averages may be larger than what was
///       given}
///     \cgalParamType{`unsigned`}
///     \cgalParamDefault{0}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::size_t limit_gradation(
    const Mesh& mesh, Metric_field& metric,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;

  const char* const function = "limit_gradation";
  const double beta
      = choose_parameter(get_parameter(np, internal::gradation), internal::defaults::gradation);
  internal::require_in_range(
      beta, 1, std::numeric_limits<double>::infinity(), function, "gradation");
  const unsigned rounds = choose_parameter(
      get_parameter(np, internal::smoothing_rounds), internal::defaults::smoothing_rounds);
  if (metric.sides().of_corner.size() != num_halfedges(mesh)
      || metric.sides().first.size() != num_vertices(mesh) + 1) {
    throw Invalid_input(function, "metric", "it does not belong to the mesh");
  }

  const auto points = internal::vertex_points(mesh, np);
  const double slope = std::log(beta);
  if (metric.kind() == Metric_kind::anisotropic) {
    return internal::grading::limit_tensors(mesh, points, metric, slope, rounds);
  }
  return std::isfinite(slope) ? internal::grading::limit_sizes(mesh, points, metric, slope) : 0;
}

} // namespace surety

#endif // SURETY_GRADATION_H
