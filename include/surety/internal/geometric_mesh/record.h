// SPDX-License-Identifier: GPL-3.0-or-later
//
// The record of the map phi for the certificate: from the engine's indices to positions in the
// input and the output mesh.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_RECORD_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_RECORD_H

#include <surety/correspondence.h>
#include <surety/internal/deviation/direct_bound.h>
#include <surety/internal/deviation/reference.h>
#include <surety/internal/geometric_mesh/exchange.h>

#include <algorithm>
#include <vector>

namespace surety::internal {

class Recorder
{
public:
  /// `input_position` tells where each vertex of T stands in the user's mesh.
  Recorder(
      const Reference& reference, const Working_mesh& mesh, const Map& map,
      const std::vector<Index>& input_position, const Compaction& compaction)
    : reference_(reference),
      mesh_(mesh),
      map_(map),
      input_position_(input_position),
      compaction_(compaction)
  {}

  /// `is_ridge` tells the edges of T whose curve is certified; borders go without saying.
  /// `face_position` tells where each face of T stands in the user's mesh.
  Correspondence record(
      const std::vector<bool>& is_ridge, const std::vector<Inner_item>& inner_items,
      const std::vector<Index>& face_position) const
  {
    Correspondence result;
    result.images.resize(reference_.number_of_vertices());
    for (Index v = 0; v < reference_.number_of_vertices(); ++v)
      result.images[input_position_[v]] = image_of(map_.image(v));

    for (const Inner_item& inner : inner_items)
      result.inner.push_back(
          {face_position[inner.face], compaction_.vertex[inner.m_vertex], inner.weights.v,
           inner.weights.w});
    std::sort(result.inner.begin(), result.inner.end(), [](const auto& a, const auto& b) {
      return a.face < b.face;
    });

    std::vector<Index> order;
    for (Index e = 0; e < reference_.number_of_edges(); ++e) {
      if (map_.first_node_of_t(e) != none) order.push_back(e);
      const auto faces = reference_.faces_of_edge(e);
      if (is_ridge[e] && faces[0] != none && faces[1] != none) result.ridges.push_back(ends_of(e));
    }
    std::sort(
        order.begin(), order.end(), [&](Index a, Index b) { return ends_of(a) < ends_of(b); });
    std::sort(result.ridges.begin(), result.ridges.end());

    result.offsets.push_back(0);
    for (const Index e : order) {
      result.edges.push_back(ends_of(e));
      append_crossings(e, result.crossings);
      result.offsets.push_back(static_cast<Index>(result.crossings.size()));
    }
    return result;
  }

private:
  std::array<Index, 2> ends_of(Index t_edge) const
  {
    const auto [s, t] = reference_.vertices_of_edge(t_edge);
    return {input_position_[s], input_position_[t]};
  }
  std::array<Index, 2> ends_in_output(Index m_edge) const
  {
    const Index h = mesh_.halfedge(m_edge);
    const Index a = compaction_.vertex[mesh_.source(h)], b = compaction_.vertex[mesh_.target(h)];
    return {std::min(a, b), std::max(a, b)};
  }
  Correspondence::Image image_of(Element element) const
  {
    if (element.kind() == Element::Kind::vertex)
      return {Correspondence::Kind::vertex, compaction_.vertex[element.id()], 0};
    if (element.kind() == Element::Kind::face)
      return {Correspondence::Kind::face, compaction_.face[element.id()], 0};
    const auto [a, b] = ends_in_output(element.id());
    return {Correspondence::Kind::edge, a, b};
  }

  void append_crossings(Index e, std::vector<Correspondence::Crossing>& crossings) const
  {
    for (Index n = map_.first_node_of_t(e); n != none; n = map_.node(n).next_on_t) {
      const auto [a, b] = ends_in_output(map_.node(n).m_edge);
      crossings.push_back({a, b, map_.node(n).lambda});
    }
  }

  const Reference& reference_;
  const Working_mesh& mesh_;
  const Map& map_;
  const std::vector<Index>& input_position_;
  const Compaction& compaction_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_RECORD_H
