// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradation of isotropic sizes. With sizes that are linear along edges, the shock of an edge PQ is
// (h_Q / h_P)^(1/l) = exp((h_Q - h_P) / |PQ|), so that shocks of at most beta mean
// h_Q <= h_P + ln(beta) |PQ|. The largest sizes that satisfy this, and are nowhere larger than
// given, are the shortest paths from all vertices at once, each starting with its own size.
#ifndef SURETY_INTERNAL_GRADATION_ISOTROPIC_H
#define SURETY_INTERNAL_GRADATION_ISOTROPIC_H

#include <surety/internal/linear.h>

#include <CGAL/boost/graph/iterator.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace surety::internal::grading {

/// \brief Dijkstra's algorithm from the vertices that are too small for a neighbour.
///
/// Sums of floating-point numbers along a path grow monotonously, and are formed from the start of
/// the path in any case: the result is to the last bit what sweeps over all edges converge to.
template <class Mesh, class Points>
class Isotropic_gradation
{
  using Vertex = typename boost::graph_traits<Mesh>::vertex_descriptor;
  using Entry = std::pair<double, std::uint32_t>;

public:
  /// \param slope by how much the size may grow a unit of length: ln(beta)
  Isotropic_gradation(const Mesh& mesh, const Points& points, double slope)
    : mesh_(mesh), points_(points), slope_(slope)
  {}

  /// Lowers the sizes, given by vertex.
  void limit(std::vector<double>& size) const
  {
    auto queue = sources(size);
    // A vertex is pushed anew when its size falls: it has its final size when it comes first.
    std::vector<char> done(size.size(), false);
    while (!queue.empty()) {
      const auto [least, index] = queue.top();
      queue.pop();
      const Vertex p(index);
      if (least > size[p] || done[p]) continue;
      done[p] = true;
      for (const auto h : CGAL::halfedges_around_target(p, mesh_)) {
        const Vertex q = source(h, mesh_);
        if (done[q]) continue;
        const double limit = least + growth(p, q);
        if (!(size[q] > limit)) continue;
        size[q] = limit;
        queue.emplace(limit, static_cast<std::uint32_t>(q));
      }
    }
  }

private:
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>>;

  /// The vertices that are too small for a neighbour, once each: a heap of all at once is made in
  /// linear time.
  Queue sources(const std::vector<double>& size) const
  {
    std::vector<char> is_source(size.size(), false);
    for (const auto e : edges(mesh_)) {
      const auto h = halfedge(e, mesh_);
      const Vertex p = source(h, mesh_), q = target(h, mesh_);
      // Only the smaller one can be too small for the other.
      const bool is_first = size[p] < size[q];
      const Vertex small = is_first ? p : q, large = is_first ? q : p;
      if (size[large] > size[small] + growth(small, large)) is_source[small] = true;
    }
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < size.size(); ++i) {
      if (is_source[i]) entries.emplace_back(size[i], static_cast<std::uint32_t>(i));
    }
    return Queue(std::greater<Entry>(), std::move(entries));
  }

  double growth(Vertex p, Vertex q) const
  {
    return slope_ * (to_vector(get(points_, q)) - to_vector(get(points_, p))).norm();
  }

  const Mesh& mesh_;
  const Points& points_;
  double slope_;
};

} // namespace surety::internal::grading

#endif // SURETY_INTERNAL_GRADATION_ISOTROPIC_H
