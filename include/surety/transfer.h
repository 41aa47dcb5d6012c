// SPDX-License-Identifier: GPL-3.0-or-later
//
// Carries a field from one mesh of a surface to another.
#ifndef SURETY_TRANSFER_H
#define SURETY_TRANSFER_H

#include <surety/internal/transfer/carried.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace surety {

/// \brief What became of a field on the way to another mesh.
struct Transfer_report {
  double area_before = 0;     ///< of the first mesh
  double area_after = 0;      ///< of the second one
  double integral_before = 0; ///< of the field over the first mesh
  double integral_after = 0;  ///< over the second one
  /// Of the field as it was.
  double mean_before() const { return integral_before / area_before; }
  /// Of the field as it was carried.
  double mean_after() const { return integral_after / area_after; }
  /// What of the mean has been gained or lost.
  double residual() const { return mean_after() - mean_before(); }
};

/// \brief Carries a field that is linear in the faces of a mesh to the vertices of another mesh of
/// the same surface.
///
/// Each vertex takes the value at the nearest point of the first mesh, among the faces that look
/// the same way: where two sheets are close to each other, they are not mixed up. The error is of
/// second order in the size of the faces. No value is outside the range of those at the corners of
/// the face where the point lies (the maximum principle).
///
/// With `conserves` all values are moved, by the same share of what is left, towards the largest or
/// the smallest value that the field has in the faces round them, on the old or the new mesh, until
/// the mean is what it was. The mean and not the integral: two meshes of a surface differ in area a
/// little, and a constant field is to stay constant. No value leaves the range that the field has
/// nearby; where that does not suffice, the report has a residual.
///
/// O((n + m) log n), and as much again to conserve.
///
/// \param values a readable property map from the vertices of `from` to `double`.
/// \param result a writable property map from the vertices of `to` to `double`.
/// \throws Invalid_input when a mesh is not valid, or a value is not finite.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{conserves}
///     \cgalParamDescription{whether the mean of the field is kept}
///     \cgalParamType{`bool`}
///     \cgalParamDefault{`false`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <
    class From, class Values, class To, class Result,
    class NamedParameters = CGAL::parameters::Default_named_parameters>
Transfer_report transfer_solution(
    const From& from, const Values& values, const To& to, const Result& result,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const char* const function = "transfer_solution";
  internal::require_valid_mesh(from, function, "from");
  internal::require_valid_mesh(to, function, "to");
  const internal::transfer::Surface before(from), after(to);
  std::vector<double> given(num_vertices(from), 0);
  std::size_t position = 0;
  for (const auto v : vertices(from)) {
    given[v] = static_cast<double>(get(values, v));
    if (!std::isfinite(given[v]))
      throw Invalid_input(
          function, "values", "the value at vertex " + std::to_string(position) + " is not finite");
    ++position;
  }

  std::vector<internal::transfer::Range> ranges;
  std::vector<double> carried = internal::transfer::interpolated(before, given, after, ranges);
  Transfer_report report{before.area(), after.area(), before.integral(given), 0};
  if (CGAL::parameters::choose_parameter(
          CGAL::parameters::get_parameter(np, internal::conserves),
          internal::defaults::conserves)) {
    internal::transfer::admit_values_between(before, given, after, ranges);
    internal::transfer::correct(after, report.mean_before() * report.area_after, ranges, carried);
  }
  report.integral_after = after.integral(carried);
  for (const auto v : vertices(to)) put(result, v, carried[v]);
  return report;
}

} // namespace surety

#endif // SURETY_TRANSFER_H
