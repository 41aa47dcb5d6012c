// SPDX-License-Identifier: GPL-3.0-or-later
//
// Both directions of the Hausdorff distance, from arrays of triangles to intervals in mesh units.
#ifndef SURETY_INTERNAL_DISTANCE_SEARCH_H
#define SURETY_INTERNAL_DISTANCE_SEARCH_H

#include <surety/internal/distance/directed_search.h>
#include <surety/internal/distance/face_tree.h>
#include <surety/internal/distance/triangle_set.h>

#include <array>
#include <cstddef>
#include <limits>

namespace surety {
namespace internal {
namespace hausdorff {

/// A directed distance in mesh units.
struct Measured_distance {
  double lower = 0;
  double upper = std::numeric_limits<double>::infinity();
  Coordinates witness = {0, 0, 0};
  std::size_t witness_face = 0;
};

/// What to find out, in mesh units.
struct Request {
  double bound = std::numeric_limits<double>::infinity();
  /// Width of the interval that is good enough; for the larger of the two directions if there is a
  /// bound, else for each.
  double slack = 0;
  std::size_t maximum_cuts = 0;

  bool is_decision() const { return bound < std::numeric_limits<double>::infinity(); }
};

/// The steps of a search, the cheap ones first; ends as soon as the bound is refuted.
inline void search(Directed_search& forward, Directed_search& backward, const Request& request)
{
  const std::array<Directed_search*, 2> both = {&forward, &backward};
  const auto is_refuted = [&] { return forward.is_refuted() || backward.is_refuted(); };
  const auto cuts_left
      = [&] { return request.maximum_cuts - forward.result().cuts - backward.result().cuts; };
  for (Directed_search* direction : both) {
    if (!is_refuted()) direction->locate_vertices();
  }
  for (Directed_search* direction : both) {
    if (!is_refuted() && request.is_decision()) direction->prove(cuts_left());
  }
  for (Directed_search* direction : both) {
    const Directed_search& other = direction == &forward ? backward : forward;
    const double known = request.is_decision() ? other.result().lower : 0;
    if (!is_refuted()) direction->measure(known, cuts_left());
  }
}

/// Searches both directions. Where a bound is refuted, upper bounds may stay infinite.
inline std::array<Measured_distance, 2> search(
    const Soup& first, const Soup& second, const Request& request)
{
  const Frame frame(first, second);
  const std::array<Triangle_set, 2> triangles
      = {Triangle_set(first, frame), Triangle_set(second, frame)};
  const Face_tree first_tree(triangles[0]), second_tree(triangles[1]);
  const double bound = frame.to_local(request.bound);
  const double slack = frame.to_local(request.slack);
  Directed_search forward(triangles[0], second_tree, bound, slack, frame.rounding());
  Directed_search backward(triangles[1], first_tree, bound, slack, frame.rounding());
  search(forward, backward, request);
  const auto measured = [&](const Search_result& result) {
    return Measured_distance{
        frame.lower_to_mesh(result.lower), frame.upper_to_mesh(result.upper),
        frame.to_mesh(result.witness), result.witness_face};
  };
  return {measured(forward.result()), measured(backward.result())};
}

} // namespace hausdorff
} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_DISTANCE_SEARCH_H
