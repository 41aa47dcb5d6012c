// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which sides hand their metric to which: those that share a face, and, through a curve of
// features, those of one vertex on both sides of it.
#ifndef SURETY_INTERNAL_GRADATION_SIDE_GRAPH_H
#define SURETY_INTERNAL_GRADATION_SIDE_GRAPH_H

#include <surety/features.h>
#include <surety/internal/linear.h>
#include <surety/internal/metric/frames.h>
#include <surety/internal/metric/tensor.h>
#include <surety/metric_field.h>

#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace surety::internal::grading {

/// A point with a tangent plane.
struct Node {
  Vector position;
  Vector normal;
  std::array<Vector, 2> basis; ///< of the plane
};

/// A way from one side of a vertex to another, along which only the size in a direction passes.
struct Crossing {
  std::uint32_t to;
  Vector tangent;
};

class Side_graph
{
public:
  template <class Mesh, class Points>
  Side_graph(const Mesh& mesh, const Points& points, const Metric_field& metric)
  {
    const Sides& sides = metric.sides();
    nodes_.reserve(sides.size());
    first_.reserve(sides.size() + 1);
    first_crossing_.reserve(sides.size() + 1);
    for (const auto v : vertices(mesh)) {
      for (auto s = sides.first[v]; s < sides.first[v + 1]; ++s) {
        const Vector& n = metric.normal(s);
        nodes_.push_back({to_vector(get(points, v)), n, metric::tangent_basis(n)});
        add_neighbours(mesh, sides, v, s);
        if (sides.first[v + 1] - sides.first[v] > 1) add_crossings(mesh, points, metric, v, s);
        first_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
        first_crossing_.push_back(static_cast<std::uint32_t>(crossings_.size()));
      }
    }
  }

  std::size_t size() const { return nodes_.size(); }
  const Node& node(std::uint32_t s) const { return nodes_[s]; }

  template <class Function>
  void for_each_neighbour(std::uint32_t s, const Function& f) const
  {
    for (auto i = first_[s]; i < first_[s + 1]; ++i) f(neighbours_[i]);
  }

  template <class Function>
  void for_each_crossing(std::uint32_t s, const Function& f) const
  {
    for (auto i = first_crossing_[s]; i < first_crossing_[s + 1]; ++i) f(crossings_[i]);
  }

  /// An order of the nodes that does not depend on how they are numbered.
  bool comes_first(std::uint32_t s, std::uint32_t t) const
  {
    const auto less = [](const Vector& a, const Vector& b) {
      return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
    };
    const Node &a = nodes_[s], &b = nodes_[t];
    if (a.position != b.position) return less(a.position, b.position);
    if (a.normal != b.normal) return less(a.normal, b.normal);
    return s < t;
  }

private:
  template <class Mesh, class Vertex>
  void add_neighbours(const Mesh& mesh, const Sides& sides, Vertex v, std::uint32_t s)
  {
    const std::size_t begin = neighbours_.size();
    for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
      if (sides.of_corner[h] != s) continue;
      for (const auto corner : {prev(h, mesh), next(h, mesh)}) {
        const std::uint32_t other = sides.of_corner[corner];
        const auto from = neighbours_.begin() + static_cast<std::ptrdiff_t>(begin);
        if (std::find(from, neighbours_.end(), other) == neighbours_.end()) {
          neighbours_.push_back(other);
        }
      }
    }
  }

  /// The curve's tangent where it passes; at a corner, the direction of the edge between the sides.
  template <class Mesh, class Points, class Vertex>
  void add_crossings(
      const Mesh& mesh, const Points& points, const Metric_field& metric, Vertex v, std::uint32_t s)
  {
    const Sides& sides = metric.sides();
    const auto add = [&](auto edge, std::uint32_t other) {
      if (other == s || other == Sides::no_side) return;
      const Vector& tangent = metric.tangent(v);
      const Vector along
          = to_vector(get(points, target(edge, mesh))) - to_vector(get(points, source(edge, mesh)));
      crossings_.push_back({other, tangent.isZero(0) ? unit(along) : tangent});
    };
    for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
      if (sides.of_corner[h] != s) continue;
      // The corner of h lies between the edges of h and of next(h).
      add(h, sides.of_corner[prev(opposite(h, mesh), mesh)]);
      add(next(h, mesh), sides.of_corner[opposite(next(h, mesh), mesh)]);
    }
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> neighbours_, first_ = {0};
  std::vector<Crossing> crossings_;
  std::vector<std::uint32_t> first_crossing_ = {0};
};

} // namespace surety::internal::grading

#endif // SURETY_INTERNAL_GRADATION_SIDE_GRAPH_H
