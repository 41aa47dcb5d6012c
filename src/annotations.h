// SPDX-License-Identifier: GPL-3.0-or-later
//
// What formats of mesh generators say beside points and polygons: the references (numbers that mean
// something to the user) of all elements, curves that are to stay curves, and elements that are to
// stay as they are.
#ifndef SURETY_TOOL_ANNOTATIONS_H
#define SURETY_TOOL_ANNOTATIONS_H

#include <cstddef>
#include <vector>

namespace surety::tool {

/// All indices count from 0.
struct Annotations {
  struct Edge {
    std::size_t from, to;
    int reference;
  };

  std::vector<int> point_references, polygon_references; ///< one an element
  std::vector<Edge> edges;
  std::vector<std::size_t> ridges, required_edges; ///< indices of `edges`
  std::vector<std::size_t> corners, required_points, required_polygons;
};

} // namespace surety::tool

#endif // SURETY_TOOL_ANNOTATIONS_H
