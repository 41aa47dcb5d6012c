// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface as its samples see it: every side of every vertex, and the sides that lie round it
// without a feature edge between.
#ifndef SURETY_INTERNAL_CURVATURE_SIDE_GRAPH_H
#define SURETY_INTERNAL_CURVATURE_SIDE_GRAPH_H

#include <surety/features.h>
#include <surety/internal/features/normals.h>
#include <surety/internal/linear.h>
#include <surety/internal/parallel.h>

#include <CGAL/boost/graph/iterator.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surety::internal::curvature {

/// \brief Points and neighbours of sides, in arrays.
///
/// Coordinates are divided by a power of two, which is exact, so that no product of them can
/// overflow.
struct Side_graph {
  std::vector<Vector> point; ///< by vertex, in units of 2^`exponent`
  int exponent = 0;
  std::vector<Index> vertex;    ///< by side
  std::vector<Index> first;     ///< by side: where its neighbours begin
  std::vector<Index> neighbour; ///< sides, in their order round the vertex
  std::vector<char> is_closed;  ///< by side: whether the last neighbour and the first share a face
  std::vector<char> is_ridge_end; ///< by side: whether its one sector has a feature edge in it
  std::vector<Vector> normal;     ///< by side: of Max, unit, zero where the faces have none
  std::vector<double> area;       ///< by side: a third of its faces

  Index size() const { return static_cast<Index>(vertex.size()); }
  const Vector& point_of(Index side) const { return point[vertex[side]]; }
  Index degree(Index side) const { return first[side + 1] - first[side]; }
};

/// How the normals of the faces round a vertex are weighted.
enum class Normal_weights {
  max, ///< by N. Max, "Weights for computing vertex normals": exact on spheres
  area ///< by the area of the face
};

/// The unit normal of a side, zero if its faces are all degenerate.
inline Vector side_normal(const Side_graph& graph, Index side, Normal_weights weights)
{
  const Vector& p = graph.point_of(side);
  const Index* const neighbour = graph.neighbour.data() + graph.first[side];
  const Index degree = graph.degree(side);
  const Index faces = graph.is_closed[side] ? degree : degree - 1;
  // Lengths are relative to the longest edge: their fourth powers must not underflow.
  double size = 0;
  for (Index i = 0; i < degree; ++i)
    size = (std::max)(size, (graph.point_of(neighbour[i]) - p).cwiseAbs().maxCoeff());
  if (!(size > 0)) return Vector::Zero();
  const auto spoke = [&](Index i) { return Vector((graph.point_of(neighbour[i]) - p) / size); };
  Vector sum = Vector::Zero(), u = spoke(0);
  for (Index i = 0; i < faces; ++i) {
    const Vector v = spoke(i + 1 == degree ? 0 : i + 1);
    const double square = weights == Normal_weights::max ? u.squaredNorm() * v.squaredNorm() : 1;
    if (square > 0) sum += v.cross(u) / square; // neighbours are in clockwise order
    u = v;
  }
  return sum.allFinite() ? unit(sum) : Vector(Vector::Zero());
}

/// A third of the area of the faces of a side: its share of the surface.
inline double side_area(const Side_graph& graph, Index side)
{
  const Vector& p = graph.point_of(side);
  const Index* const neighbour = graph.neighbour.data() + graph.first[side];
  const Index degree = graph.degree(side);
  double twice = 0;
  for (Index i = graph.is_closed[side] ? 0 : 1; i < degree; ++i) {
    const Vector u = graph.point_of(neighbour[i == 0 ? degree - 1 : i - 1]) - p;
    twice += u.cross(graph.point_of(neighbour[i]) - p).norm();
  }
  return twice / 6;
}

template <class Mesh, class Points>
class Side_graph_maker
{
public:
  Side_graph_maker(
      const Mesh& mesh, const Points& points, const Features& features, const Sides& sides)
    : mesh_(mesh), points_(points), features_(features), sides_(sides)
  {}

  template <class ConcurrencyTag>
  Side_graph make()
  {
    copy_points();
    graph_.vertex = sides_.vertex;
    link_sides();
    graph_.normal.resize(graph_.size());
    graph_.area.resize(graph_.size());
    for_each_index<ConcurrencyTag>(graph_.size(), [this](Index s) {
      graph_.normal[s] = side_normal(graph_, s, Normal_weights::max);
      graph_.area[s] = side_area(graph_, s);
    });
    return std::move(graph_);
  }

private:
  void copy_points()
  {
    graph_.point.assign(num_vertices(mesh_), Vector::Zero());
    double largest = 0;
    for (const auto v : vertices(mesh_)) {
      graph_.point[v] = to_vector(get(points_, v));
      largest = (std::max)(largest, graph_.point[v].cwiseAbs().maxCoeff());
    }
    if (largest > 0) graph_.exponent = std::ilogb(largest);
    for (Vector& p : graph_.point)
      p = p.unaryExpr([this](double x) { return std::ldexp(x, -graph_.exponent); });
  }

  void link_sides()
  {
    graph_.first.reserve(graph_.size() + 1);
    graph_.first.push_back(0);
    graph_.neighbour.reserve(num_halfedges(mesh_));
    graph_.is_closed.assign(graph_.size(), false);
    graph_.is_ridge_end.assign(graph_.size(), false);
    // Sides of a vertex have the order in which a turn round it meets them.
    for (const auto v : vertices(mesh_)) {
      if (sides_.first[v] == sides_.first[v + 1]) continue;
      Index side = sides_.first[v];
      for (const auto h : CGAL::halfedges_around_target(halfedge(v, mesh_), mesh_)) {
        if (CGAL::is_border(h, mesh_) || sides_.of_corner[h] != side) continue;
        link(side, sector(mesh_, features_.edge, h));
        if (++side == sides_.first[v + 1]) break;
      }
    }
  }

  template <class Corners>
  void link(Index side, const Corners& corners)
  {
    const auto ends = [this](auto h) {
      return CGAL::is_border_edge(h, mesh_) || features_.edge[edge(h, mesh_)];
    };
    const bool is_bounded = ends(corners.front());
    graph_.is_closed[side] = !is_bounded || corners.size() == full_turn(corners.front());
    graph_.is_ridge_end[side] = is_bounded && graph_.is_closed[side];
    if (!graph_.is_closed[side]) push(prev(corners.front(), mesh_));
    for (const auto h : corners) push(next(h, mesh_));
    graph_.first.push_back(static_cast<Index>(graph_.neighbour.size()));
  }

  void push(typename boost::graph_traits<Mesh>::halfedge_descriptor corner)
  {
    graph_.neighbour.push_back(sides_.of_corner[corner]);
  }

  std::size_t full_turn(typename boost::graph_traits<Mesh>::halfedge_descriptor h) const
  {
    return degree(target(h, mesh_), mesh_);
  }

  const Mesh& mesh_;
  const Points& points_;
  const Features& features_;
  const Sides& sides_;
  Side_graph graph_;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_SIDE_GRAPH_H
