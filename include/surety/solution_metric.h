// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metric that a field asks for: the sizes and directions with which a mesh interpolates it best
// for the number of its vertices.
#ifndef SURETY_SOLUTION_METRIC_H
#define SURETY_SOLUTION_METRIC_H

#include <surety/features.h>
#include <surety/internal/metric/input.h>
#include <surety/internal/solution_metric/complexity.h>
#include <surety/internal/solution_metric/hessian.h>
#include <surety/internal/solution_metric/optimal.h>
#include <surety/internal/validation.h>
#include <surety/metric_field.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surety {
namespace internal::solution_metric {

/// What is wanted of a metric.
struct Target {
  std::optional<double> vertices, error;
  double p;
};

template <class NamedParameters>
Target read_target(const NamedParameters& np, const char* function)
{
  Target target{
      metric::optional_parameter(np, target_vertices), metric::optional_parameter(np, target_error),
      CGAL::parameters::choose_parameter(
          CGAL::parameters::get_parameter(np, norm_exponent), defaults::norm_exponent)};
  require_in_range(target.p, 1, std::numeric_limits<double>::infinity(), function, "norm_exponent");
  if (!target.vertices == !target.error)
    throw Invalid_input(
        function, "np",
        target.error ? "it has two targets" : "nothing says how fine the metric is to be",
        "give either target_vertices or target_error");
  if (target.vertices) require_positive(*target.vertices, function, "target_vertices");
  if (target.error) require_positive(*target.error, function, "target_error");
  return target;
}

/// The values at the vertices in units of 2^exponent, so that all sizes are at most 1.
struct Values {
  std::vector<double> at;
  int exponent = 0;
};

template <class Mesh, class Solution>
Values read_values(const Mesh& mesh, const Solution& solution, const char* function)
{
  Values values{std::vector<double>(num_vertices(mesh), 0), 0};
  double largest = 0;
  std::size_t position = 0;
  for (const auto v : vertices(mesh)) {
    const auto value = static_cast<double>(get(solution, v));
    if (!std::isfinite(value))
      throw Invalid_input(
          function, "solution",
          "the value at vertex " + std::to_string(position) + " is not finite");
    values.at[v] = value;
    largest = (std::max)(largest, std::abs(value));
    ++position;
  }
  if (largest > 0) values.exponent = std::ilogb(largest) + 1;
  for (double& value : values.at) value = std::ldexp(value, -values.exponent);
  return values;
}

inline std::vector<Frame_hessian> recover_hessians(
    const Side_graph& graph, const Metric_field& metric, const std::vector<double>& values)
{
  std::vector<Frame_hessian> hessians;
  Hessian_recovery recovery(graph, values);
  for (Index s = 0; s < graph.size(); ++s)
    hessians.push_back({metric.normal(s), recovery.at(s, metric.normal(s))});
  return hessians;
}

/// That of the L^p norm: of a value, times an area to the power 1/p.
inline double unit_of_error(const Values& values, const Side_graph& graph, double p)
{
  return std::exp2(values.exponent + (std::isfinite(p) ? 2 * graph.exponent / p : 0));
}

inline double factor_for(
    const Target& target, const Optimal_metric& optimal, const Complexity& complexity,
    double unit_of_error)
{
  if (target.vertices)
    return optimal.factor_for(*target.vertices / vertices_per_complexity, [&](double d) {
      return complexity(optimal.size_tensors(d));
    });
  return optimal.factor_for(
      *target.error / unit_of_error, [&](double d) { return optimal.error(d); });
}

} // namespace internal::solution_metric

/// \brief The complexity of a metric, the integral of sqrt(det M) over the surface.
///
/// A unit mesh has about 2/sqrt(3) times as many vertices. Inside faces sizes are linear.
///
/// \throws Invalid_input when the metric does not belong to the mesh.
/// Reads `vertex_point_map`. Linear in the size of the mesh.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
double metric_complexity(
    const Mesh& mesh, const Metric_field& metric,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  if (metric.sides().of_corner.size() != num_halfedges(mesh))
    throw Invalid_input("metric_complexity", "metric", "it does not belong to the mesh");
  std::vector<Eigen::Matrix3d> sizes;
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s)
    sizes.push_back(internal::metric::size_tensor(metric.tensor(s)));
  const auto points = internal::vertex_points(mesh, np);
  return internal::solution_metric::Complexity(mesh, points, metric.sides(), 1)(sizes);
}

/// \brief The metric in which a mesh interpolates a field best.
///
/// The Hessian H of the field is recovered on the surface, at each side of each vertex, by a
/// quadratic polynomial in the tangent plane. Where |H| has the eigenvalues of H without their
/// signs, the metric is D det|H|^(-1/(2p+2)) |H|: among the meshes with as many vertices, unit
/// meshes in this metric have the least interpolation error in the L^p norm (A. Loseille and F.
/// Alauzet, *Continuous Mesh Framework*, 2011, in two dimensions). D is such that the metric has
/// the complexity of the vertices that are asked for, or predicts the error that is asked for,
/// within 0.1 per cent, where `minimum_size` and `maximum_size` leave room for that;
/// `metric_complexity()` tells what it has got. Where the field is linear, up to rounding, sizes
/// are the largest.
///
/// The metric knows nothing of the surface. `intersect()` it with a geometric metric, and limit its
/// gradation; both add vertices.
///
/// The result does not depend on the unit of length when that changes by a power of two.
/// O(n) fits of a few samples.
///
/// \param features of the mesh: derivatives are not taken across them.
/// \param solution a readable property map from vertices to `double`.
/// \throws Invalid_input when the mesh is not valid, the features do not belong to it, a value is
///   not finite, not exactly one target is given, or a parameter is out of its range.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{target_vertices}
///     \cgalParamDescription{number of vertices of a unit mesh}
///     \cgalParamType{`double`, positive}
///     \cgalParamDefault{none; exactly one of this and the next must be given}
///   \cgalParamNEnd
///   \cgalParamNBegin{target_error}
///     \cgalParamDescription{L^p norm of the interpolation error}
///     \cgalParamType{`double`, positive, in units of the field times length^(2/p)}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{norm_exponent}
///     \cgalParamDescription{p}
///     \cgalParamType{`double`, at least 1; may be infinite}
///     \cgalParamDefault{2}
///   \cgalParamNEnd
///   \cgalParamNBegin{metric_kind}
///     \cgalParamDescription{whether sizes depend on direction}
///     \cgalParamType{`Metric_kind`}
///     \cgalParamDefault{`Metric_kind::anisotropic`}
///   \cgalParamNEnd
///   \cgalParamNBegin{minimum_size}
///     \cgalParamDescription{the least size}
///     \cgalParamType{`double`, a length in mesh units, positive}
///     \cgalParamDefault{a thousandth of the diagonal of the bounding box}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_size}
///     \cgalParamDescription{the largest size}
///     \cgalParamType{`double`, a length in mesh units, at least the minimum}
///     \cgalParamDefault{a tenth of the diagonal}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_aspect_ratio}
///     \cgalParamDescription{largest ratio of the two sizes at one place}
///     \cgalParamType{`double`, at least 1}
///     \cgalParamDefault{10}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <
    class Mesh, class Solution, class NamedParameters = CGAL::parameters::Default_named_parameters>
Metric_field make_solution_metric(
    const Mesh& mesh, const Features& features, const Solution& solution,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  namespace own = internal::solution_metric;
  const char* const function = "make_solution_metric";
  internal::require_valid_mesh(mesh, function, "mesh", np);
  internal::require_features_of(mesh, features, function);
  const own::Target target = own::read_target(np, function);
  const auto points = internal::vertex_points(mesh, np);
  own::Size_range range = internal::metric::size_range(
      np, internal::metric::Size_law{}, internal::metric::bounding_box_diagonal(mesh, points),
      function);
  const auto kind = CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(np, internal::metric_kind), internal::defaults::metric_kind);
  const own::Values values = own::read_values(mesh, solution, function);

  Metric_field metric = internal::metric::uniform_metric(
      mesh, find_sides(mesh, features), points, kind, range.maximum);
  const own::Side_graph graph
      = internal::curvature::Side_graph_maker(mesh, points, features, metric.sides())
            .template make<CGAL::Sequential_tag>();
  const double length = std::ldexp(1., graph.exponent);
  range.minimum /= length;
  range.maximum /= length;
  const own::Optimal_metric optimal(
      own::recover_hessians(graph, metric, values.at), graph, range, target.p, kind);
  const own::Complexity complexity(mesh, points, metric.sides(), 1 / length);
  const double d
      = own::factor_for(target, optimal, complexity, own::unit_of_error(values, graph, target.p));
  for (internal::Index s = 0; s < graph.size(); ++s)
    if (kind == Metric_kind::isotropic)
      metric.set_size(s, length * optimal.sizes(s, d).first);
    else
      metric.set_tensor(s, internal::metric::metric_of_sizes(length * optimal.size_tensor(s, d)));
  return metric;
}

} // namespace surety

#endif // SURETY_SOLUTION_METRIC_H
