// SPDX-License-Identifier: GPL-3.0-or-later
//
// The patches of all faces: from normals to edge curves to control nets, with the guards that
// straighten an edge where its curve cannot be trusted. An edge is straight for both of its faces,
// so that the surface stays continuous whatever is refused.
#ifndef SURETY_INTERNAL_SUPPORT_SHAPE_H
#define SURETY_INTERNAL_SUPPORT_SHAPE_H

#include <surety/internal/support/bound.h>
#include <surety/internal/support/control_net.h>
#include <surety/internal/support/feature_tangents.h>
#include <surety/internal/support/flat_mesh.h>
#include <surety/internal/support/fold_guard.h>
#include <surety/internal/support/middle_normal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace surety::internal {

class Support_shape
{
public:
  /// `normals` by side, of unit length or zero.
  Support_shape(const Flat_mesh& mesh, std::vector<Vector> normals)
    : normal(std::move(normals)),
      is_aligned(normal.size(), false),
      curve(mesh.edges()),
      net(mesh.faces()),
      is_refused(mesh.faces(), false),
      scale(mesh.faces(), 1.0)
  {
    const Feature_tangents tangents(mesh);
    for (Index s = 0; s < normal.size(); ++s) is_aligned[s] = tangents.straighten(s, normal[s]);
    for (Index e = 0; e < mesh.edges(); ++e) curve[e] = edge_curve(mesh, tangents, e);
    refuse_folds(mesh);
  }

  std::vector<Vector> normal;    ///< by side
  std::vector<bool> is_aligned;  ///< by side: the normal is perpendicular to the side's curves
  std::vector<Edge_curve> curve; ///< by edge, in its direction
  std::vector<Control_net> net;  ///< by face
  std::vector<bool> is_refused;  ///< by face: the patch would fold, and is flat instead
  std::vector<double> scale;     ///< by face: by which displacements were multiplied

  Patch_data patch_data(const Flat_mesh& mesh, Index f) const
  {
    Patch_data data;
    for (int i = 0; i < 3; ++i) {
      const Edge_curve& c = curve[mesh.edge[f][i]];
      data.chord[i] = mesh.chord(f, i);
      data.normal[i] = normal[mesh.side[f][i]];
      data.curve[i] = mesh.is_along(f, i) ? c : c.reversed();
    }
    return data;
  }

  /// Whether tangent planes along the edges of a face are those of its normals.
  bool is_tangent(const Flat_mesh& mesh, Index f) const
  {
    if (is_refused[f] || scale[f] < 1) return false;
    for (int i = 0; i < 3; ++i) {
      const Index place = mesh.neighbour[f][i];
      if (curve[mesh.edge[f][i]].is_straight || !is_aligned[mesh.side[f][i]]) return false;
      if (place != none && scale[place / 3] < 1) return false;
    }
    return true;
  }

private:
  Edge_curve edge_curve(const Flat_mesh& mesh, const Feature_tangents& tangents, Index e) const
  {
    const Index place = mesh.places[e][0];
    if (place == none) return {};
    const Index f = place / 3;
    const int i = int(place % 3);
    const bool is_along = mesh.is_along(f, i);
    const Vector& n0 = normal[mesh.side[f][is_along ? i : next_corner(i)]];
    const Vector& n1 = normal[mesh.side[f][is_along ? next_corner(i) : i]];
    const Vector chord = is_along ? mesh.chord(f, i) : Vector(-mesh.chord(f, i));
    const double length = chord.norm();
    const Vector direction = unit(chord);
    const bool is_feature = mesh.is_feature[e];
    const Vector t0 = is_feature ? tangents.at(e, 0) : projected_direction(direction, n0);
    const Vector t1 = is_feature ? tangents.at(e, 1) : projected_direction(direction, n1);
    // Normals that oppose each other, or a tangent across the chord: no curve is right.
    if (!is_feature && !(n0.dot(n1) > 0)) return {};
    if (!(t0.dot(direction) > least_advance) || !(t1.dot(direction) > least_advance)) return {};
    Edge_curve result = curve_between(length, t0, t1);
    if (!is_feature) result.middle_normal = middle_normal(mesh, e);
    return result;
  }

  /// Of an edge with two faces on one side of all features.
  Vector middle_normal(const Flat_mesh& mesh, Index e) const
  {
    const auto [one, other] = mesh.places[e];
    const Index f = one / 3, g = other / 3;
    const int i = int(one % 3), j = int(other % 3);
    const Vector middle = (mesh.position(f, i) + mesh.position(f, next_corner(i))) / 2;
    const auto seen = [&](Index face, int k) {
      return Seen_vertex{mesh.position(face, k) - middle, normal[mesh.side[face][k]]};
    };
    return Middle_normal(seen(f, i), seen(f, next_corner(i)))
        .with(seen(f, previous_corner(i)), seen(g, previous_corner(j)));
  }

  /// In rounds, so that the outcome does not depend on the order of the faces.
  void refuse_folds(const Flat_mesh& mesh)
  {
    std::vector<Index> pending, folded;
    for (Index f = 0; f < mesh.faces(); ++f)
      if (mesh.is_face(f)) pending.push_back(f);
    while (!pending.empty()) {
      folded.clear();
      for (const Index f : pending) {
        const Patch_data data = patch_data(mesh, f);
        net[f] = make_net(data);
        if (may_fold(net[f], data)) folded.push_back(f);
      }
      pending.clear();
      for (const Index f : folded) {
        is_refused[f] = true;
        net[f] = Control_net();
        for (int i = 0; i < 3; ++i) {
          const Index place = mesh.neighbour[f][i];
          const bool was_straight = std::exchange(curve[mesh.edge[f][i]].is_straight, true);
          if (!was_straight && place != none) pending.push_back(place / 3);
        }
      }
      const auto is_settled = [this](Index f) { return bool(is_refused[f]); };
      pending.erase(std::remove_if(pending.begin(), pending.end(), is_settled), pending.end());
    }
  }

  static constexpr double least_advance = 0.05; // as for projected chords
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_SHAPE_H
