// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edges that become ridges after the features were found: which sides they cut, and what normals
// the new sides have.
#ifndef SURETY_INTERNAL_SUPPORT_PROMOTION_H
#define SURETY_INTERNAL_SUPPORT_PROMOTION_H

#include <surety/internal/features/corners.h>
#include <surety/internal/support/flat_mesh.h>
#include <surety/internal/support/max_normals.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

namespace surety::internal {

/// Numbers the sides again after features were added; sides that nothing cut keep their normals.
class Side_cutter
{
public:
  explicit Side_cutter(Flat_mesh& mesh) : mesh_(mesh), parent_(3 * mesh.faces())
  {
    std::iota(parent_.begin(), parent_.end(), Index(0));
    for (Index e = 0; e < mesh.edges(); ++e) {
      const auto [one, other] = mesh.places[e];
      if (mesh.is_feature[e] || other == none) continue;
      // The start of the edge in one face is its end in the other.
      join(one, after(other));
      join(after(one), other);
    }
  }

  std::vector<Vector> cut(const std::vector<Vector>& normals)
  {
    std::vector<Index> number(parent_.size(), none), old_side, pieces(normals.size(), 0);
    for (Index place = 0; place < parent_.size(); ++place) {
      if (!mesh_.is_face(place / 3)) continue;
      Index& side = mesh_.side[place / 3][place % 3];
      Index& next = number[root(place)];
      if (next == none) {
        next = Index(old_side.size());
        old_side.push_back(side);
        ++pieces[side];
      }
      side = next;
    }
    std::vector<Index> vertex(old_side.size());
    for (Index s = 0; s < old_side.size(); ++s) vertex[s] = mesh_.side_vertex[old_side[s]];
    mesh_.side_vertex = std::move(vertex);
    std::vector<Vector> result = max_normals(mesh_);
    for (Index s = 0; s < old_side.size(); ++s)
      if (pieces[old_side[s]] == 1) result[s] = normals[old_side[s]];
    return result;
  }

private:
  static Index after(Index place) { return place % 3 == 2 ? place - 2 : place + 1; }

  Index root(Index place)
  {
    while (parent_[place] != place) place = parent_[place] = parent_[parent_[place]];
    return place;
  }
  void join(Index a, Index b)
  {
    a = root(a), b = root(b);
    if (a != b) parent_[(std::max)(a, b)] = (std::min)(a, b);
  }

  Flat_mesh& mesh_;
  std::vector<Index> parent_; // by place, of corners
};

/// Corners where the added features end, branch or turn by more than an angle, in radians.
inline void add_corners(Flat_mesh& mesh, double corner_angle)
{
  std::vector<std::array<Index, 2>> neighbour(mesh.point.size(), {none, none});
  std::vector<int> number(mesh.point.size(), 0);
  for (Index e = 0; e < mesh.edges(); ++e) {
    if (!mesh.is_feature[e]) continue;
    for (int end = 0; end < 2; ++end) {
      const Index v = mesh.ends[e][end];
      if (number[v] < 2) neighbour[v][number[v]] = mesh.ends[e][1 - end];
      ++number[v];
    }
  }
  for (Index v = 0; v < mesh.point.size(); ++v) {
    if (number[v] == 0) continue;
    const bool turns = number[v] == 2
        && turn(mesh.point[neighbour[v][0]], mesh.point[v], mesh.point[neighbour[v][1]])
            > corner_angle;
    if (number[v] != 2 || turns) mesh.is_corner[v] = true;
  }
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_PROMOTION_H
