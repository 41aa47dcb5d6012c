// SPDX-License-Identifier: GPL-3.0-or-later
//
// Borders, and invariant I5: ridges.
//
// Border rule: an edge of T on the border has no crossings, and its two ends lie in one closed
// border edge of M. Then phi maps the border of T into the border of M, as a 1-cycle, and the
// number of times that it covers an edge, with sign, is the same all along the edge. We ask that it
// is 1 for every border edge of M: then the two borders lie within the bound of each other as
// curves. (Where the faces have degree 1 this follows, as the boundary of the sum of all faces; it
// is checked on its own all the same.) As for faces, ends inside an edge may be moved to its
// midpoint, and the count is the sum of directed lengths, 2 for a whole edge.
//
// I5: a recorded ridge edge has no crossings, and its two ends lie in one closed edge of M; the
// edges of M that are used in this way are the ridge of M. Ridges have no direction, so we count
// modulo 2. A vertex of T strictly inside an edge of M must have exactly two ridge edges, which lie
// in that edge as well. Then the ridge edges that lie in one edge e of M are a cycle modulo 2
// relative to the ends of e, and the parity of the number of times that they cover a point of e is
// the same all along e: if it is odd, e is covered. With the inner ends moved to the midpoint, we
// ask that either half is covered exactly once. So T's ridge maps into M's ridge and onto it: as
// curves, ends and branches included, they lie within the bound of each other.
#ifndef SURETY_INTERNAL_CERTIFICATE_CURVES_H
#define SURETY_INTERNAL_CERTIFICATE_CURVES_H

#include <surety/internal/certificate/items.h>

namespace surety::internal::checker {

/// Where along an edge (a, b) of M an item of the edge lies: 0 at a, 1 inside, 2 at b; 3:
/// elsewhere.
inline unsigned position_in_edge(const Item& item, Index id, const Edge& edge)
{
  if (item.kind == Kind::edge) return item.id == id ? 1 : 3;
  if (item.kind == Kind::face) return 3;
  return item.id == edge.a ? 0 : item.id == edge.b ? 2 : 3;
}

/// An edge of M that holds both items, or none; `both_at` is set if they are at one vertex instead.
inline Index common_edge(const Items& items, Index i, Index j, Index& both_at)
{
  const Item &p = items[i], &q = items[j];
  both_at = p.kind == Kind::vertex && q.kind == Kind::vertex && p.id == q.id ? p.id : none;
  if (both_at != none) return none;
  Index id = none;
  if (p.kind == Kind::edge)
    id = p.id;
  else if (q.kind == Kind::edge)
    id = q.id;
  else if (p.kind == Kind::vertex && q.kind == Kind::vertex)
    id = items.output().find_edge(p.id, q.id);
  if (id == none) return none;
  const Edge& edge = items.output().edges()[id];
  const bool both = position_in_edge(p, id, edge) < 3 && position_in_edge(q, id, edge) < 3;
  return both ? id : none;
}

/// The border rule, for the items of the vertices of T: the first violation, or an empty string.
/// That borders have no crossings is seen where crossings are resolved.
class Border_check
{
public:
  Border_check(const Triangle_table& input, const Items& items)
    : input_(input),
      items_(items),
      covered_(items.output().edges().size(), 0),
      on_border_(items.output().number_of_vertices(), false)
  {
    for (const Edge& edge : items.output().edges()) {
      if (edge.is_border()) on_border_[edge.a] = on_border_[edge.b] = true;
    }
  }

  std::string defect()
  {
    for (const Edge& edge : input_.edges()) {
      if (edge.is_border() && !cover(edge)) {
        return "the ends of input border edge " + to_string(edge.name())
            + " do not lie in one border edge of the output";
      }
    }
    const auto& edges = items_.output().edges();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (!edges[e].is_border() || covered_[e] == (edges[e].faces[1] == none ? 2 : -2)) continue;
      return "output border edge " + to_string(edges[e].name()) + " is not covered once";
    }
    return "";
  }

private:
  /// Adds the directed length of the image, which runs as the face at the border does.
  bool cover(const Edge& edge)
  {
    const bool forward = edge.faces[1] == none;
    const Index from = forward ? edge.a : edge.b, to = forward ? edge.b : edge.a;
    Index vertex;
    const Index id = common_edge(items_, from, to, vertex);
    if (vertex != none) return on_border_[vertex];
    if (id == none || !items_.output().edges()[id].is_border()) return false;
    const Edge& target = items_.output().edges()[id];
    covered_[id] += std::int64_t(position_in_edge(items_[to], id, target))
        - std::int64_t(position_in_edge(items_[from], id, target));
    return true;
  }

  const Triangle_table& input_;
  const Items& items_;
  std::vector<std::int64_t> covered_;
  std::vector<bool> on_border_;
};

/// Invariant I5, but for the absence of crossings: the first violation, or an empty string.
class Ridge_check
{
public:
  Ridge_check(const Triangle_table& input, const Items& items)
    : input_(input),
      items_(items),
      lower_(items.output().edges().size(), unused),
      upper_(lower_),
      on_ridge_(items.output().number_of_vertices(), false)
  {}

  std::string defect(const std::vector<Vertex_pair>& ridges)
  {
    std::vector<Index> ridges_at(input_.number_of_vertices(), 0);
    std::vector<Index> points;
    for (const Vertex_pair& ridge : ridges) {
      Index vertex;
      const Index id = common_edge(items_, ridge[0], ridge[1], vertex);
      if (vertex != none)
        points.push_back(vertex);
      else if (id != none)
        cover(id, ridge);
      else
        return "the ends of input ridge " + to_string(ridge) + " lie in no edge of the output";
      for (const Index v : ridge) ++ridges_at[v];
    }
    for (Index v = 0; v < input_.number_of_vertices(); ++v) {
      if (ridges_at[v] == 0 || ridges_at[v] == 2 || items_[v].kind == Kind::vertex) continue;
      return "input vertex " + std::to_string(v) + ", where " + std::to_string(ridges_at[v])
          + " ridge edges meet, lies inside an edge of the output";
    }
    return edge_defect(points);
  }

private:
  static constexpr Index unused = none;

  void cover(Index id, const Vertex_pair& ridge)
  {
    const Edge& edge = items_.output().edges()[id];
    const auto [from, to] = std::minmax(
        {position_in_edge(items_[ridge[0]], id, edge),
         position_in_edge(items_[ridge[1]], id, edge)});
    if (lower_[id] == unused) lower_[id] = upper_[id] = 0;
    if (from == 0 && to >= 1) ++lower_[id];
    if (from <= 1 && to == 2) ++upper_[id];
    on_ridge_[edge.a] = on_ridge_[edge.b] = true;
  }

  std::string edge_defect(const std::vector<Index>& points) const
  {
    for (std::size_t e = 0; e < lower_.size(); ++e) {
      if (lower_[e] == unused || (lower_[e] == 1 && upper_[e] == 1)) continue;
      return "output edge " + to_string(items_.output().edges()[e].name())
          + " is not covered once by ridges of the input";
    }
    for (const Index v : points) {
      if (!on_ridge_[v]) {
        return "a ridge edge shrinks to output vertex " + std::to_string(v) + ", off the ridge";
      }
    }
    return "";
  }

  const Triangle_table& input_;
  const Items& items_;
  std::vector<Index> lower_, upper_; ///< times that the halves of an edge of M are covered
  std::vector<bool> on_ridge_;
};

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_CURVES_H
