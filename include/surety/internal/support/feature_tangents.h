// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tangents of the curves of features at the ends of their edges, and normals of the sides made
// perpendicular to the curves that bound them: what a patch needs to be tangent to the normal of
// its side along every edge, ridges and borders included.
#ifndef SURETY_INTERNAL_SUPPORT_FEATURE_TANGENTS_H
#define SURETY_INTERNAL_SUPPORT_FEATURE_TANGENTS_H

#include <surety/internal/support/flat_mesh.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace surety::internal {

class Feature_tangents
{
public:
  explicit Feature_tangents(const Flat_mesh& mesh)
    : mesh_(mesh),
      tangent_(mesh.edges(), {Vector::Zero(), Vector::Zero()}),
      bounding_(mesh.side_vertex.size(), {none, none}),
      is_joined_(mesh.edges(), {false, false})
  {
    find_bounding_edges();
    set_smooth_vertices();
    set_corners();
    join_straight_pairs();
  }

  /// At end 0 or 1 of a feature edge, in the direction of the edge; of unit length.
  const Vector& at(Index edge, int end) const { return tangent_[edge][end]; }

  /// Makes the normal of a side perpendicular to the curves that bound it. False where that is not
  /// possible: the normal is zero, or the curves ask for quite another one.
  bool straighten(Index side, Vector& normal) const
  {
    const auto [one, other] = bounding_[side];
    if (one == none) return normal.squaredNorm() > 0;
    const Vector s = outgoing(one, side), t = outgoing(other, side);
    const Vector cross = s.cross(t);
    const bool is_bent = cross.squaredNorm() > least_sine * least_sine;
    if (!is_bent && (s + t).squaredNorm() > 0x1p-80 && (s - t).squaredNorm() > 0x1p-80)
      return false;
    Vector wanted = is_bent ? cross : Vector(normal - normal.dot(s) * s);
    if (is_bent && wanted.dot(normal) < 0) wanted = -wanted;
    wanted = unit(wanted);
    if (!(wanted.dot(normal) > least_agreement)) return false;
    normal = wanted;
    return true;
  }

private:
  static constexpr double least_sine = 0.17;     // 10 degrees: below, the cross product is noise
  static constexpr double least_agreement = 0.7; // 45 degrees

  int end_at(Index edge, Index vertex) const { return mesh_.ends[edge][0] == vertex ? 0 : 1; }
  Vector chord(Index edge) const
  {
    return mesh_.point[mesh_.ends[edge][1]] - mesh_.point[mesh_.ends[edge][0]];
  }

  /// The tangent of a curve as it leaves the vertex of a side.
  Vector outgoing(Index edge, Index side) const
  {
    const int end = end_at(edge, mesh_.side_vertex[side]);
    return end == 0 ? tangent_[edge][0] : Vector(-tangent_[edge][1]);
  }

  void set_outgoing(Index edge, int end, const Vector& t)
  {
    tangent_[edge][end] = end == 0 ? t : Vector(-t);
  }

  void find_bounding_edges()
  {
    for (Index f = 0; f < mesh_.faces(); ++f) {
      if (!mesh_.is_face(f)) continue;
      for (int i = 0; i < 3; ++i) {
        const Index leaving = mesh_.edge[f][i], arriving = mesh_.edge[f][previous_corner(i)];
        auto& bounding = bounding_[mesh_.side[f][i]];
        if (mesh_.is_feature[leaving]) bounding[0] = leaving;
        if (mesh_.is_feature[arriving]) bounding[1] = arriving;
      }
    }
  }

  /// Where a curve goes on, its tangent is that of the circle through three points.
  void set_smooth_vertices()
  {
    std::vector<std::array<Index, 2>> two(mesh_.point.size(), {none, none});
    std::vector<int> number(mesh_.point.size(), 0);
    for (Index e = 0; e < mesh_.edges(); ++e) {
      if (!mesh_.is_feature[e]) continue;
      for (const Index v : mesh_.ends[e]) {
        if (number[v] < 2) two[v][number[v]] = e;
        ++number[v];
      }
    }
    for (Index v = 0; v < mesh_.point.size(); ++v) {
      if (number[v] != 2 || mesh_.is_corner[v]) continue;
      std::array<Vector, 2> way;
      for (int k = 0; k < 2; ++k) {
        const Vector c = chord(two[v][k]);
        way[k] = (end_at(two[v][k], v) == 0 ? c : Vector(-c)) / c.squaredNorm();
      }
      const Vector t = unit(way[0] - way[1]);
      for (int k = 0; k < 2; ++k) {
        const int end = end_at(two[v][k], v);
        set_outgoing(two[v][k], end, k == 0 ? t : Vector(-t));
        is_joined_[two[v][k]][end] = true;
      }
    }
  }

  /// Where it ends or branches, that of the circle with the tangent at the other end, if that has
  /// one; else the chord.
  void set_corners()
  {
    for (Index e = 0; e < mesh_.edges(); ++e) {
      if (!mesh_.is_feature[e]) continue;
      const Vector g = unit(chord(e));
      for (int end = 0; end < 2; ++end) {
        if (is_joined_[e][end]) continue;
        const Vector& t = tangent_[e][1 - end];
        tangent_[e][end] = is_joined_[e][1 - end] ? unit(2 * g.dot(t) * g - t) : g;
      }
    }
  }

  /// Two curves that meet at a corner almost straight get one tangent, or no normal could be
  /// perpendicular to both.
  void join_straight_pairs()
  {
    for (Index s = 0; s < bounding_.size(); ++s) {
      const auto [one, other] = bounding_[s];
      if (one == none || one == other) continue;
      const Index v = mesh_.side_vertex[s];
      const int at_one = end_at(one, v), at_other = end_at(other, v);
      if (is_joined_[one][at_one] || is_joined_[other][at_other]) continue;
      const Vector a = outgoing(one, s), b = outgoing(other, s);
      if (a.dot(b) > 0 || a.cross(b).squaredNorm() > least_sine * least_sine) continue;
      const Vector t = unit(a - b);
      set_outgoing(one, at_one, t);
      set_outgoing(other, at_other, -t);
      is_joined_[one][at_one] = is_joined_[other][at_other] = true;
    }
  }

  const Flat_mesh& mesh_;
  std::vector<std::array<Vector, 2>> tangent_; // by edge and end
  std::vector<std::array<Index, 2>> bounding_; // by side
  std::vector<std::array<bool, 2>> is_joined_; // by edge and end: shares a tangent
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_FEATURE_TANGENTS_H
