// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is an edge a crease at the scale that the tolerance asks for? A surface that goes smoothly over a
// turn of angle theta within a width w leaves it by w theta/8. So the turn matters if it persists
// at the distance R = 8 tolerance/theta on both sides: if it is much more than what the surface
// turns elsewhere within R (its roughness), and no smaller than between the mean normals there.
#ifndef SURETY_INTERNAL_FEATURES_BY_NEED_CREASE_H
#define SURETY_INTERNAL_FEATURES_BY_NEED_CREASE_H

#include <surety/internal/features/normals.h>
#include <surety/internal/support/flat_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace surety::internal {

/// What the surroundings say of an edge.
struct Crease {
  bool is_candidate = false;
  double reach = 0;     ///< R: the distance at which the turn leaves the tolerance
  double length = 0;    ///< of the edge
  double roughness = 1; ///< turn of the surroundings over that of the edge; 0: flat on both sides
};

/// Normals, areas and turns of a mesh: what creases are found from.
class Crease_finder
{
public:
  static constexpr double least_turn = 20 * 3.14159265358979323846 / 180;

  Crease_finder(const Flat_mesh& mesh, double tolerance)
    : mesh_(mesh),
      tolerance_(tolerance),
      normal_(mesh.faces(), Vector::Zero()),
      area_(mesh.faces(), 0),
      turn_(mesh.edges(), 0),
      stamp_(mesh.faces(), 0)
  {
    for (Index f = 0; f < mesh.faces(); ++f) {
      if (!mesh.is_face(f)) continue;
      normal_[f] = unit_normal(mesh.position(f, 0), mesh.position(f, 1), mesh.position(f, 2));
      area_[f] = mesh.chord(f, 0).cross(mesh.chord(f, 2)).norm() / 2;
    }
    for (Index e = 0; e < mesh.edges(); ++e) {
      const auto [one, other] = mesh.places[e];
      if (other != none) turn_[e] = angle_between(normal_[one / 3], normal_[other / 3]);
    }
  }

  double turn(Index edge) const { return turn_[edge]; }

  Crease examine(Index edge)
  {
    Crease crease;
    const double turn = turn_[edge];
    if (turn < least_turn) return crease;
    const Vector a = mesh_.point[mesh_.ends[edge][0]], b = mesh_.point[mesh_.ends[edge][1]];
    crease.length = (b - a).norm();
    crease.reach = 8 * tolerance_ / turn;
    const auto [one, other] = mesh_.places[edge];
    const Vector mean = unit(normal_[one / 3] + normal_[other / 3]);
    if (mean == Vector::Zero()) return crease;
    if (turn >= plain_turn && is_plain(one / 3, edge, crease)
        && is_plain(other / 3, edge, crease)) {
      crease.roughness = plain_roughness;
      crease.is_candidate = true;
      return crease;
    }
    const double radius = (std::max)(crease.reach, 2 * crease.length);
    const Frame frame{(a + b) / 2, unit(b - a), Vector::Zero(), radius, turn};
    crease.roughness = roughness(one / 3, other / 3, edge, frame);
    crease.is_candidate = crease.roughness <= largest_roughness;
    return crease;
  }

private:
  static constexpr double least_persistence = 0.6;
  static constexpr double largest_roughness = 0.35;
  static constexpr double barrier = 0.7; // of the turn: what ends a side
  static constexpr double plain_turn = 40 * 3.14159265358979323846 / 180;
  static constexpr double plain_width = 2; // times the reach
  static constexpr double plain_roughness = 0.05;

  /// Whether a face is a flat side by itself, as those of coarse parts are: it reaches far enough,
  /// and goes on flatly in some direction, or ends in edges as sharp. Those of a coarse scan reach
  /// as far but go on flatly by chance only.
  bool is_plain(Index face, Index edge, const Crease& crease) const
  {
    if (2 * area_[face] < plain_width * crease.reach * crease.length) return false;
    bool is_flat = false, is_sharp = true;
    for (const Index e : mesh_.edge[face]) {
      if (e == edge) continue;
      is_flat = is_flat || turn_[e] <= plain_roughness * turn_[edge];
      is_sharp = is_sharp && turn_[e] >= barrier * turn_[edge];
    }
    return is_flat || is_sharp;
  }

  struct Frame {
    Vector middle, along, across;
    double radius, turn;
  };

  /// What lies on one side: mean normal, root mean square angle to it, largest distance.
  struct Side {
    Vector normal;
    double spread, width;
  };

  /// Of the surroundings of an edge, over the turn that persists in them; 1 where none does.
  double roughness(Index one, Index other, Index edge, const Frame& frame)
  {
    const Side left = side(one, edge, frame), right = side(other, edge, frame);
    if ((std::min)(left.width, right.width) < 8 * tolerance_ / frame.turn) return 1;
    const double persistent = angle_between(left.normal, right.normal);
    if (persistent < least_persistence * frame.turn) return 1;
    return (std::max)(left.spread, right.spread) / persistent;
  }

  Side side(Index face, Index edge, const Frame& frame)
  {
    // Into the face, in its plane.
    Vector into = Vector::Zero();
    for (int i = 0; i < 3; ++i)
      if (mesh_.edge[face][i] == edge) into = unit(normal_[face].cross(mesh_.chord(face, i)));
    gather(face, into, frame);
    Vector sum = Vector::Zero();
    double width = 0, area = 0;
    for (const Index f : found_) {
      sum += area_[f] * normal_[f];
      area += area_[f];
      for (int i = 0; i < 3; ++i)
        width = (std::max)(width, distance_to_line(mesh_.position(f, i), frame));
    }
    const Vector mean = unit(sum);
    double squares = 0;
    for (const Index f : found_) {
      const double angle = angle_between(normal_[f], mean);
      squares += area_[f] * angle * angle;
    }
    // One face alone is no evidence of a flat side.
    const double spread = found_.size() > 1 ? std::sqrt(squares / area) : frame.turn / 3;
    return {mean, spread, width};
  }

  static double distance_to_line(const Vector& p, const Frame& frame)
  {
    return (p - frame.middle).cross(frame.along).norm();
  }

  /// The faces about the middle, not beyond edges that turn nearly as much.
  void gather(Index start, const Vector& into, const Frame& frame)
  {
    ++time_;
    found_.assign(1, start);
    stamp_[start] = time_;
    for (std::size_t k = 0; k < found_.size(); ++k) {
      const Index f = found_[k];
      for (int i = 0; i < 3; ++i) {
        const Index place = mesh_.neighbour[f][i];
        if (place == none || stamp_[place / 3] == time_) continue;
        if (turn_[mesh_.edge[f][i]] >= barrier * frame.turn) continue;
        const Index g = place / 3;
        const Vector offset = centre(g) - frame.middle;
        if (offset.norm() > frame.radius || offset.dot(into) < 0) continue;
        stamp_[g] = time_;
        found_.push_back(g);
      }
    }
  }

  Vector centre(Index f) const
  {
    return (mesh_.position(f, 0) + mesh_.position(f, 1) + mesh_.position(f, 2)) / 3;
  }

  const Flat_mesh& mesh_;
  double tolerance_;
  std::vector<Vector> normal_; // by face
  std::vector<double> area_;   // by face
  std::vector<double> turn_;   // by edge, 0 on borders
  std::vector<Index> stamp_;   // by face: when it was found
  std::vector<Index> found_;
  Index time_ = 0;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_FEATURES_BY_NEED_CREASE_H
