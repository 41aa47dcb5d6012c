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
  double slack = 0;
  /// Whether one interval for both directions is enough.
  bool is_joint = false;
  std::size_t maximum_cuts = 0;
};

/// \brief Searches both directions, the vertices of both first: most bounds fail there.
///
/// A direction that is not searched, because the other one has refuted the bound, keeps an infinite
/// upper bound.
inline std::array<Measured_distance, 2> search(
    const Soup& first, const Soup& second, const Request& request)
{
  const Frame frame(first, second);
  const std::array<Triangle_set, 2> triangles
      = {Triangle_set(first, frame), Triangle_set(second, frame)};
  const Face_tree first_tree(triangles[0]), second_tree(triangles[1]);
  Search_options options;
  options.bound = frame.to_local(request.bound);
  options.slack = frame.to_local(request.slack);
  options.rounding = frame.rounding();

  Directed_search forward(triangles[0], second_tree, options);
  Directed_search backward(triangles[1], first_tree, options);
  forward.locate_vertices();
  if (!forward.is_refuted()) backward.locate_vertices();
  const auto is_refuted = [&] { return forward.is_refuted() || backward.is_refuted(); };
  if (!is_refuted()) {
    forward.search_interior(request.is_joint ? backward.result().lower : 0, request.maximum_cuts);
  }
  if (!is_refuted()) {
    backward.search_interior(
        request.is_joint ? forward.result().lower : 0,
        request.maximum_cuts - forward.result().cuts);
  }
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
