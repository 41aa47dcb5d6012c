// SPDX-License-Identifier: GPL-3.0-or-later
//
// T, the input triangulation: points and adjacency in flat arrays, never changed.
#ifndef SURETY_INTERNAL_DEVIATION_REFERENCE_H
#define SURETY_INTERNAL_DEVIATION_REFERENCE_H

#include <surety/internal/linear.h>

#include <algorithm>
#include <array>
#include <vector>

namespace surety::internal {

class Reference
{
public:
  /// Half-edges 2e and 2e + 1 are edge e; a border half-edge has face `none`. `input_position` is
  /// the order of the vertices in the user's mesh, which directs the edges.
  Reference(
      std::vector<Vector> points, const std::vector<Index>& next, const std::vector<Index>& target,
      const std::vector<Index>& face, Index faces, const std::vector<Index>& input_position)
    : points_(std::move(points)),
      face_edges_(faces),
      edge_vertices_(next.size() / 2),
      edge_faces_(next.size() / 2),
      first_edge_(points_.size() + 1, 0),
      incident_edges_(next.size())
  {
    for (Index e = 0; e < number_of_edges(); ++e) {
      const Index a = target[2 * e + 1], b = target[2 * e];
      edge_vertices_[e] = input_position[a] < input_position[b] ? std::array<Index, 2>{a, b}
                                                                : std::array<Index, 2>{b, a};
      edge_faces_[e] = {face[2 * e], face[2 * e + 1]};
    }
    for (Index h = 0; h < next.size(); ++h)
      if (face[h] != none) face_edges_[face[h]] = {h >> 1, next[h] >> 1, next[next[h]] >> 1};
    index_edges();
    for (const Vector& p : points_)
      largest_coordinate_ = std::max(largest_coordinate_, p.cwiseAbs().maxCoeff());
  }

  Index number_of_vertices() const { return static_cast<Index>(points_.size()); }
  Index number_of_edges() const { return static_cast<Index>(edge_vertices_.size()); }
  Index number_of_faces() const { return static_cast<Index>(face_edges_.size()); }
  double largest_coordinate() const { return largest_coordinate_; }

  const Vector& point(Index v) const { return points_[v]; }
  /// The ends of an edge, which runs from the one that comes first in the user's mesh.
  const std::array<Index, 2>& vertices_of_edge(Index e) const { return edge_vertices_[e]; }
  /// The faces on both sides of an edge, `none` beyond the border.
  const std::array<Index, 2>& faces_of_edge(Index e) const { return edge_faces_[e]; }
  const std::array<Index, 3>& edges_of_face(Index f) const { return face_edges_[f]; }

  /// The edges at vertex v, as a range for loops.
  auto edges_at(Index v) const
  {
    struct Range {
      const Index *first, *last;
      const Index* begin() const { return first; }
      const Index* end() const { return last; }
    };
    return Range{
        incident_edges_.data() + first_edge_[v], incident_edges_.data() + first_edge_[v + 1]};
  }
  Index other_end(Index e, Index v) const
  {
    return edge_vertices_[e][0] == v ? edge_vertices_[e][1] : edge_vertices_[e][0];
  }

  /// The vertices of a face in its own orientation: corner i lies between edges i - 1 and i.
  std::array<Index, 3> vertices_of_face(Index f) const
  {
    const auto& e = face_edges_[f];
    std::array<Index, 3> corner;
    for (int i = 0; i < 3; ++i) {
      const auto &before = edge_vertices_[e[(i + 2) % 3]], &after = edge_vertices_[e[i]];
      corner[i] = before[0] == after[0] || before[1] == after[0] ? after[0] : after[1];
    }
    return corner;
  }
  /// The vertices of a face in the order of the user's mesh.
  std::array<Index, 3> sorted_vertices_of_face(Index f) const
  {
    // Of the three directed edges one leads from the first to the last, past the second.
    const auto& e = face_edges_[f];
    for (int i = 0; i < 3; ++i) {
      const auto &ends = edge_vertices_[e[i]], &other = edge_vertices_[e[(i + 1) % 3]],
                 &third = edge_vertices_[e[(i + 2) % 3]];
      if (other[0] == ends[0] && third[1] == other[1]) return {ends[0], ends[1], other[1]};
      if (third[0] == ends[0] && other[1] == third[1]) return {ends[0], ends[1], third[1]};
    }
    return {none, none, none};
  }
  Vector normal_of_face(Index f) const
  {
    const auto v = vertices_of_face(f);
    return unit((points_[v[1]] - points_[v[0]]).cross(points_[v[2]] - points_[v[0]]));
  }

private:
  void index_edges()
  {
    for (const auto& ends : edge_vertices_)
      for (const Index v : ends) ++first_edge_[v + 1];
    for (std::size_t v = 1; v < first_edge_.size(); ++v) first_edge_[v] += first_edge_[v - 1];
    std::vector<Index> cursor(first_edge_.begin(), first_edge_.end() - 1);
    for (Index e = 0; e < number_of_edges(); ++e)
      for (const Index v : edge_vertices_[e]) incident_edges_[cursor[v]++] = e;
  }

  std::vector<Vector> points_;
  std::vector<std::array<Index, 3>> face_edges_;
  std::vector<std::array<Index, 2>> edge_vertices_, edge_faces_;
  std::vector<Index> first_edge_, incident_edges_;
  double largest_coordinate_ = 0;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_REFERENCE_H
