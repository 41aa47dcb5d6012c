// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closest point of T to a point that is near a known face of T, by walking from face to face
// while that comes closer: a local minimum of the distance, which is what placement wants (another
// sheet that happens to be nearer is none of its business).
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_SURFACE_WALK_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_SURFACE_WALK_H

#include <surety/internal/deviation/closest_point.h>
#include <surety/internal/deviation/reference.h>

namespace surety::internal {

struct Foot {
  Index face = none;
  Vector point;           ///< in the face up to rounding
  Index nearest;          ///< the corner of the face with the largest weight
  bool is_inside = false; ///< neither on an edge nor at a vertex of the face
  Index opposite = none;  ///< of a point on an edge: the corner that has no weight
  double squared_distance = std::numeric_limits<double>::infinity();
};

class Surface_walk
{
public:
  explicit Surface_walk(const Reference& reference) : reference_(reference) {}

  /// Ways that are all open.
  struct Open {
    bool over(Index /*edge*/) const { return true; }
    bool around(Index /*vertex*/, Index /*from*/, Index /*to*/) const { return true; }
  };

  Foot closest(const Vector& p, Index start) const
  {
    return closest_around(p, foot_on(p, start), Open());
  }
  /// The same for points that may be many faces away, where the way from a face to the next leads
  /// `over` an edge or `around` a vertex that lets it pass.
  template <class Ways>
  Foot closest(const Vector& p, Index start, const Ways& ways) const
  {
    return closest_around(p, straight_walk(p, start, ways), ways);
  }

  /// Any face at a vertex.
  Index face_at(Index v) const
  {
    const auto faces = reference_.faces_of_edge(*reference_.edges_at(v).begin());
    return faces[0] != none ? faces[0] : faces[1];
  }

private:
  /// From a foot on to that on any face around, as long as that comes closer.
  template <class Ways>
  Foot closest_around(const Vector& p, Foot best, const Ways& ways) const
  {
    for (bool closer = true; closer && !best.is_inside;) {
      closer = false;
      const Index from = best.face;
      for (const Index v : reference_.vertices_of_face(from)) {
        // Past an edge or a vertex: the faces at the vertices that bear the closest point.
        if (v == best.opposite) continue;
        for (const Index e : reference_.edges_at(v))
          for (const Index f : reference_.faces_of_edge(e)) {
            if (f == none || f == from || f == best.face || !ways.around(v, from, f)) continue;
            const Foot foot = foot_on(p, f);
            if (foot.squared_distance < best.squared_distance) best = foot, closer = true;
          }
        if (closer) break;
      }
    }
    return best;
  }

  /// Over the edge that bears the closest point, as long as that comes closer: most of the way, at
  /// one face a step.
  template <class Ways>
  Foot straight_walk(const Vector& p, Index start, const Ways& ways) const
  {
    Foot best = foot_on(p, start);
    while (!best.is_inside) {
      const Index e = bearing_edge(best);
      const auto& faces = reference_.faces_of_edge(e);
      const Index next = faces[0] == best.face ? faces[1] : faces[0];
      if (next == none || !ways.over(e)) break;
      const Foot foot = foot_on(p, next);
      if (!(foot.squared_distance < best.squared_distance)) break;
      best = foot;
    }
    return best;
  }

  /// The edge that bears the closest point, or one of two where that is a vertex.
  Index bearing_edge(const Foot& foot) const
  {
    const auto corner = reference_.vertices_of_face(foot.face);
    const auto& edge = reference_.edges_of_face(foot.face);
    // Edge i leads from corner i to the next.
    for (int i = 0; i < 3; ++i)
      if (foot.opposite == none ? corner[i] == foot.nearest : corner[(i + 2) % 3] == foot.opposite)
        return edge[i];
    return edge[0];
  }

  Foot foot_on(const Vector& p, Index f) const
  {
    const auto corner = reference_.vertices_of_face(f);
    const Vector& a = reference_.point(corner[0]);
    const Vector ab = reference_.point(corner[1]) - a, ac = reference_.point(corner[2]) - a;
    const auto [v, w] = closest_weights(p, a, ab, ac);
    Foot foot;
    foot.face = f;
    // A vertex is met exactly.
    foot.point = v == 1 ? reference_.point(corner[1])
        : w == 1        ? reference_.point(corner[2])
                        : Vector(a + v * ab + w * ac);
    const double u = 1 - v - w;
    foot.nearest = u >= v && u >= w ? corner[0] : v >= w ? corner[1] : corner[2];
    foot.is_inside = u > 0 && v > 0 && w > 0;
    foot.opposite = u <= 0 ? corner[0] : v == 0 ? corner[1] : w == 0 ? corner[2] : none;
    foot.squared_distance = (p - foot.point).squaredNorm();
    return foot;
  }

  const Reference& reference_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_SURFACE_WALK_H
