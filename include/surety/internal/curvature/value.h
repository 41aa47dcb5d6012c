// SPDX-License-Identifier: GPL-3.0-or-later
//
// One curvature a vertex, in the types of a user's kernel.
#ifndef SURETY_INTERNAL_CURVATURE_VALUE_H
#define SURETY_INTERNAL_CURVATURE_VALUE_H

#include <surety/curvature_field.h>
#include <surety/internal/linear.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace surety::internal::curvature {

/// The side of a vertex whose curvature is largest in absolute value, the first of equal ones;
/// null for an isolated vertex.
inline const Side_curvature* greatest_side(const Curvature_field& field, Index v)
{
  const auto size = [](const Side_curvature& s) {
    return (std::max)(std::abs(s.min_curvature), std::abs(s.max_curvature));
  };
  const Side_curvature* result = nullptr;
  for (Index s = field.sides.first[v]; s < field.sides.first[v + 1]; ++s) {
    if (result == nullptr || size(field.side[s]) > size(*result)) result = &field.side[s];
  }
  return result;
}

template <class Value, class = void>
struct Has_normal : std::false_type {};
template <class Value>
struct Has_normal<Value, std::void_t<decltype(Value::normal), decltype(Value::type)>>
  : std::true_type {};

/// The value of a property map at a vertex; a type of CGAL's gets the members that it has.
template <class Value>
Value value_at(const Curvature_field& field, Index v)
{
  using Vector_3 = std::decay_t<decltype(Value::min_direction)>;
  const auto to_kernel = [](const Vector& d) { return Vector_3(d.x(), d.y(), d.z()); };
  const Side_curvature* const found = greatest_side(field, v);
  const Side_curvature side = found == nullptr ? Side_curvature() : *found;
  Value value{};
  value.min_curvature = side.min_curvature;
  value.max_curvature = side.max_curvature;
  value.min_direction = to_kernel(side.min_direction);
  value.max_direction = to_kernel(side.max_direction);
  if constexpr (Has_normal<Value>::value) {
    value.normal = to_kernel(side.normal);
    value.mean_curvature = side.mean_curvature();
    value.gaussian_curvature = side.gaussian_curvature();
    value.type = side.type;
  }
  return value;
}

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_VALUE_H
