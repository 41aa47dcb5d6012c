// SPDX-License-Identifier: GPL-3.0-or-later
//
// Relocations and flips for the shape of the faces (section 2 of the paper): a vertex goes towards
// the place where the faces of its ball would be equilateral, on the local quadric or on T; on a
// ridge or border, to another vertex of that curve. Everything passes the editor, so that the
// tolerance is kept, and nothing is done that does not make the ball better.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_SMOOTHER_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_SMOOTHER_H

#include <surety/internal/deviation/direct_bound.h>
#include <surety/internal/geometric_mesh/editor.h>
#include <surety/internal/geometric_mesh/local_quadric.h>
#include <surety/internal/geometric_mesh/surface_walk.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surety::internal {

class Smoother
{
public:
  Smoother(const Reference& reference, Editor& editor, const Direct_bound& bound, bool on_surface)
    : reference_(reference),
      editor_(editor),
      mesh_(editor.mesh()),
      bound_(bound),
      walk_(reference),
      on_surface_(on_surface)
  {}

  /// Moves a vertex if that makes the faces around it better, and none worse than the worst.
  bool relocate(Index v)
  {
    if (!mesh_.is_live_vertex(v) || mesh_.is_fixed(v)) return false;
    make_relocation_disc(mesh_, v, disc_);
    return mesh_.is_on_feature(v) ? slide() : move_to_ideal_place();
  }

  /// Flips an edge if that makes the worse of its two faces better, and their mean no worse.
  bool flip(Index e)
  {
    constexpr double rounder = 0.98;
    if (!mesh_.is_live_edge(e) || mesh_.is_border(e) || mesh_.is_feature(e)) return false;
    make_flip_disc(mesh_, mesh_.halfedge(e), disc_);
    const Vector &c = mesh_.point(disc_.ring[0]), &a = mesh_.point(disc_.ring[1]),
                 &d = mesh_.point(disc_.ring[2]), &b = mesh_.point(disc_.ring[3]);
    const double left = shape_quality(a, b, c), right = shape_quality(b, a, d);
    const double at_a = shape_quality(c, a, d), at_b = shape_quality(c, d, b);
    return std::max(at_a, at_b) < rounder * std::max(left, right) && at_a + at_b <= left + right
        && editor_.try_to(disc_);
  }

private:
  struct Shape {
    double worst = 0, sum = 0;
    bool is_better_than(const Shape& other) const
    {
      constexpr double least_gain = 0.01;
      return worst <= other.worst && sum < (1 - least_gain) * other.sum;
    }
  };

  /// Of the ball, with its centre at a place.
  Shape shape_at(const Vector& place) const
  {
    Shape shape;
    for_each_face([&](const Vector& a, const Vector& b) {
      const double quality = shape_quality(place, a, b);
      shape.worst = std::max(shape.worst, quality);
      shape.sum += quality;
    });
    return shape;
  }

  template <class Visit>
  void for_each_face(Visit visit) const
  {
    for (Index i = 0; i < disc_.size(); ++i)
      if (!mesh_.is_ghost_face(disc_.face[i]))
        visit(mesh_.point(disc_.ring[i]), mesh_.point(disc_.ring[disc_.after(i)]));
  }

  /// The mean of the places that make each face of the ball equilateral, the worst of them with the
  /// largest weight.
  Vector ideal_place() const
  {
    constexpr double half_sqrt3 = 0.8660254037844386, largest_weight = 100;
    const Vector& p = mesh_.point(disc_.apex);
    Vector sum = Vector::Zero();
    double weights = 0;
    for_each_face([&](const Vector& a, const Vector& b) {
      const Vector ab = b - a, along = unit(ab);
      const Vector height = unit((p - a) - (p - a).dot(along) * along);
      const double weight = std::min(shape_quality(p, a, b), largest_weight);
      sum += weight * ((a + b) / 2 - p + half_sqrt3 * ab.norm() * height);
      weights += weight;
    });
    return weights > 0 ? Vector(p + sum / weights) : p;
  }

  bool move_to_ideal_place()
  {
    const Vector from = mesh_.point(disc_.apex), way = ideal_place() - from;
    const Shape before = shape_at(from);
    const Local_quadric quadric(mesh_, disc_);
    const Index start = walk_.face_at(mesh_.anchor(disc_.apex));
    for (const double share : {1.0, 0.5, 0.25}) {
      const Vector place = from + share * way;
      disc_.apex_point = on_surface_ ? place : quadric.project(place);
      const Foot foot = walk_.closest(disc_.apex_point, start);
      if (on_surface_) disc_.apex_point = foot.point;
      disc_.anchor = foot.nearest;
      if (shape_at(disc_.apex_point).is_better_than(before) && editor_.try_to(disc_)) return true;
    }
    return false;
  }

  /// Along the ridge or border, to a vertex of T on it: the nearest to the ideal place, or to a
  /// place half-way.
  bool slide()
  {
    const Index pin = bound_.map().pin(disc_.apex);
    if (pin == none || disc_.ridge[1] == none) return false;
    const Vector from = mesh_.point(disc_.apex), way = ideal_place() - from;
    const Shape before = shape_at(from);
    Index last = none;
    for (const double share : {1.0, 0.5, 0.25}) {
      if (!find_pin(pin, from + share * way) || disc_.new_pin == last) continue;
      last = disc_.new_pin;
      disc_.apex_point = reference_.point(last);
      disc_.anchor = last;
      if (shape_at(disc_.apex_point).is_better_than(before) && editor_.try_to(disc_)) return true;
    }
    return false;
  }

  /// Sets the pin of the disc to the vertex of the curve that is nearest to a place, and notes what
  /// lies between. False where it is the one that it has.
  bool find_pin(Index pin, const Vector& place)
  {
    disc_.new_pin = none;
    disc_.passed.clear();
    double least = (reference_.point(pin) - place).squaredNorm();
    for (Index side = 0; side < 2; ++side) {
      path_.assign(1, pin);
      for (Index next = next_on_path(side); next != none; next = next_on_path(side)) {
        const double squared = (reference_.point(next) - place).squaredNorm();
        if (squared < least) {
          least = squared;
          disc_.new_pin = next;
          disc_.new_pin_side = side;
          disc_.passed = path_;
        }
        path_.push_back(next);
      }
    }
    return disc_.new_pin != none;
  }

  /// The vertex of T after the last one of the path that goes to a ridge spoke, or none.
  Index next_on_path(Index side) const
  {
    const Element spoke(Element::Kind::edge, disc_.spoke[disc_.ridge[side]]);
    const Index at = path_.back(), before = path_.size() > 1 ? path_[path_.size() - 2] : none;
    for (const Index e : reference_.edges_at(at)) {
      // Edges that are features of T are known by the same index in M.
      const Index other = reference_.other_end(e, at);
      if (mesh_.is_feature(e) && other != before && bound_.map().image(other) == spoke)
        return other;
    }
    return none;
  }

  const Reference& reference_;
  Editor& editor_;
  const Working_mesh& mesh_;
  const Direct_bound& bound_;
  Surface_walk walk_;
  bool on_surface_;
  Disc disc_;
  std::vector<Index> path_; ///< of T, from the pin along one of the curve's two ways
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_SMOOTHER_H
