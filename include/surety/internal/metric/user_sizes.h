// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes from the user, in any of the forms that `size_field` takes, and what they do to a field.
#ifndef SURETY_INTERNAL_METRIC_USER_SIZES_H
#define SURETY_INTERNAL_METRIC_USER_SIZES_H

#include <surety/medit_sol.h>
#include <surety/metric_field.h>

#include <CGAL/Surface_mesh/Properties.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>

namespace surety::internal::metric {

[[noreturn]] inline void refuse_size(std::size_t vertex, const std::string& function, double size)
{
  throw Invalid_input(
      function, "size_field",
      "the size at vertex " + std::to_string(vertex) + " is " + to_text(size)
          + ", not a finite positive number");
}

/// \brief A metric at a vertex, as a size or as a tensor.
///
/// `vertex` is its position in the order of iteration, which messages name.
struct Wanted {
  Wanted(double value, std::size_t vertex, const char* function) : size(value)
  {
    if (!(value > 0) || !std::isfinite(value)) refuse_size(vertex, function, value);
  }
  Wanted(const Tensor& value, std::size_t vertex, const char* function)
    : is_tensor(true), tensor(value)
  {
    require_metric(value, function, "size_field at vertex " + std::to_string(vertex));
  }

  bool is_tensor = false;
  double size = 0;
  Tensor tensor;
};

/// What a function from points or a property map from vertices wants at a vertex.
template <class Field, class Vertex, class Point>
Wanted wanted_at(
    const Field& field, Vertex v, const Point& p, std::size_t position, const char* function)
{
  if constexpr (std::is_invocable_v<const Field&, const Point&>) {
    return {field(p), position, function};
  } else {
    return {get(field, v), position, function};
  }
}

template <class Vertex, class Point>
Wanted wanted_at(
    const Medit_solution& solution, Vertex, const Point&, std::size_t position,
    const char* function)
{
  if (solution.is_anisotropic()) return {solution.tensors[position], position, function};
  return {solution.sizes[position], position, function};
}

template <class Mesh, class Field>
void require_suitable(const Mesh&, const Field&, const char*)
{}

template <class Mesh>
void require_suitable(const Mesh& mesh, const Medit_solution& solution, const char* function)
{
  std::size_t number = 0;
  for ([[maybe_unused]] const auto v : vertices(mesh)) ++number;
  if (solution.number_of_vertices() == number) return;
  throw Invalid_input(
      function, "size_field",
      "it has " + std::to_string(solution.number_of_vertices()) + " vertices, the mesh "
          + std::to_string(number),
      "use the solution that was written for this mesh");
}

/// Applies f(side, wanted) to all sides.
template <class Mesh, class Points, class Field, class Function>
void for_each_wanted(
    const Mesh& mesh, const Points& points, const Sides& sides, const Field& field,
    const char* function, const Function& f)
{
  require_suitable(mesh, field, function);
  std::size_t position = 0;
  for (const auto v : vertices(mesh)) {
    const Wanted wanted = wanted_at(field, v, get(points, v), position++, function);
    for (auto s = sides.first[v]; s < sides.first[v + 1]; ++s) f(s, wanted);
  }
}

inline void assign(Metric_field& metric, std::uint32_t side, const Wanted& wanted)
{
  if (wanted.is_tensor) {
    metric.set_tensor(side, wanted.tensor);
  } else {
    metric.set_size(side, wanted.size);
  }
}

/// Clamps the sizes along the eigenvectors, and then their ratio.
template <class Range>
void clamp_side(Metric_field& metric, std::uint32_t side, const Range& range)
{
  if (metric.kind() == Metric_kind::isotropic) {
    metric.set_size(side, range.clamp(metric.size(side)));
    return;
  }
  const Tensor m = metric.tensor(side);
  const double least = range.clamp(least_size(m));
  metric.set_tensor(side, with_eigenvalues(m, [&](double lambda) {
                      double size = range.clamp(1 / std::sqrt(lambda));
                      size = std::min(size, range.aspect_ratio * least);
                      return 1 / (size * size);
                    }));
}

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_USER_SIZES_H
