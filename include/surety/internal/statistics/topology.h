// SPDX-License-Identifier: GPL-3.0-or-later
//
// What of a mesh does not depend on where its vertices are: components, border loops, genus.
#ifndef SURETY_INTERNAL_STATISTICS_TOPOLOGY_H
#define SURETY_INTERNAL_STATISTICS_TOPOLOGY_H

#include <CGAL/boost/graph/helpers.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace surety {
namespace internal {

struct Topology {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t components = 0;
  std::size_t border_edges = 0;
  std::size_t border_loops = 0;

  long euler() const
  {
    return static_cast<long>(vertices) - static_cast<long>(edges) + static_cast<long>(faces);
  }

  /// Over all components, from 2 - 2 genus - loops = Euler characteristic of each.
  long genus_sum() const
  {
    return (2 * static_cast<long>(components) - static_cast<long>(border_loops) - euler()) / 2;
  }
};

/// The number of pieces that hang together by edges.
template <class Mesh>
std::size_t count_components(const Mesh& mesh)
{
  using Face = typename boost::graph_traits<Mesh>::face_descriptor;
  std::vector<bool> seen(num_faces(mesh), false);
  std::vector<Face> pending;
  std::size_t components = 0;
  for (const Face seed : faces(mesh)) {
    if (seen[seed]) continue;
    ++components;
    seen[seed] = true;
    pending.assign(1, seed);
    while (!pending.empty()) {
      const Face f = pending.back();
      pending.pop_back();
      for (const auto h : CGAL::halfedges_around_face(halfedge(f, mesh), mesh)) {
        const Face other = face(opposite(h, mesh), mesh);
        if (other == boost::graph_traits<Mesh>::null_face() || seen[other]) continue;
        seen[other] = true;
        pending.push_back(other);
      }
    }
  }
  return components;
}

template <class Mesh>
Topology topology(const Mesh& mesh)
{
  Topology result;
  result.vertices = vertices(mesh).size();
  result.edges = edges(mesh).size();
  result.faces = faces(mesh).size();
  result.components = count_components(mesh);

  std::vector<bool> seen(num_halfedges(mesh), false);
  for (const auto start : halfedges(mesh)) {
    if (!is_border(start, mesh) || seen[start]) continue;
    ++result.border_loops;
    for (auto h = start; !seen[h]; h = next(h, mesh)) {
      seen[h] = true;
      ++result.border_edges;
    }
  }
  return result;
}

} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_STATISTICS_TOPOLOGY_H
