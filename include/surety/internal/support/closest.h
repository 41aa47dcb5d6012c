// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closest point of a support. Fast: the nearest triangle, then downhill. Guaranteed: branch and
// bound, over the boxes of the patches and then over parts of each patch, down to an accuracy.
//
// A part of a patch is a triangle of its coordinates, scaled by c = 2^-k. Taylor's formula from a
// point x to the corners c_i, x = sum m_i c_i, gives |s(x) - sum m_i s(c_i)| <= c^2/2 times a bound
// of the second derivatives: so the part lies within that of the flat triangle on its corners. With
// displacements d of derivatives at most B1 and B2, those of F(d) are |DF| B2 + |D2 F| B1^2, where
// |d| differs by at most c B1 from its values at the corners.
#ifndef SURETY_INTERNAL_SUPPORT_CLOSEST_H
#define SURETY_INTERNAL_SUPPORT_CLOSEST_H

#include <surety/internal/support/descent.h>
#include <surety/internal/support/tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace surety::internal {

/// Admits all faces.
struct Any_face {
  bool operator()(Index) const { return true; }
  bool admits(const Patch_primitive&) const { return true; }
};

/// Admits faces whose normal makes an angle with a given one that has at least a given cosine.
class Facing
{
public:
  Facing(const Flat_mesh& mesh, const Vector& normal, double least_cosine)
    : mesh_(mesh), normal_(normal), least_cosine_(least_cosine)
  {}

  bool operator()(Index f) const
  {
    return is_near(unit(mesh_.chord(f, 0).cross(-mesh_.chord(f, 2))));
  }
  bool admits(const Patch_primitive& p) const { return is_near(p.normal()); }

private:
  bool is_near(const Vector& n) const { return n.dot(normal_) >= least_cosine_; }

  const Flat_mesh& mesh_;
  Vector normal_;
  double least_cosine_;
};

/// Finds the closest point of the flat triangles.
template <class Filter>
class Nearest_triangle
{
public:
  Nearest_triangle(const Vector& target, const Filter& filter) : target_(target), filter_(filter) {}

  double squared_reach() const { return squared_; }
  void visit(const Patch_primitive& primitive)
  {
    const auto [barycentric, squared] = primitive.closest(target_);
    const bool is_closer
        = squared < squared_ || (squared == squared_ && primitive.id() < best_.face);
    if (!is_closer || !filter_.admits(primitive)) return;
    squared_ = squared;
    best_ = {primitive.id(), barycentric};
  }
  const Support_location& best() const { return best_; }

private:
  Vector target_;
  const Filter& filter_;
  double squared_ = std::numeric_limits<double>::infinity();
  Support_location best_;
};

template <class Filter>
Support_point fast_closest(
    const Support_surface& surface, const Patch_tree& tree, const Vector& target,
    const Filter& filter)
{
  Nearest_triangle<Filter> nearest(target, filter);
  visit_nearest_first(tree, target, nearest);
  if (nearest.best().face == none) return {};
  return Descent<Filter>(surface, filter, target).from(nearest.best());
}

/// Branch and bound. What it returns is at most `accuracy()` of the face that it is on farther than
/// the closest point.
template <class Filter>
class Closest_patch
{
public:
  /// As a share of the longest edge of a face.
  static constexpr double relative_accuracy = 0x1p-24;

  Closest_patch(
      const Support_surface& surface, const Vector& target, const Filter& filter,
      const Support_point& start)
    : surface_(surface), target_(target), filter_(filter), best_(start)
  {
    set_reach();
  }

  double squared_reach() const { return squared_reach_; }

  void visit(const Patch_primitive& primitive)
  {
    if (!filter_.admits(primitive)) return;
    const double flat = std::sqrt(primitive.closest(target_).second);
    if (flat - primitive.reach() >= distance_) return;
    search(primitive.id());
  }

  const Support_point& best() const { return best_; }

private:
  struct Node {
    Vector barycentric, point;
    double displacement; // its length before saturation
  };
  struct Part {
    std::array<Node, 3> corner;
    double lower, scale, error;
    bool operator<(const Part& other) const { return lower > other.lower; } // for a heap
  };

  void set_reach()
  {
    distance_ = std::sqrt(best_.squared_distance);
    squared_reach_ = best_.squared_distance * (1 + 0x1p-40);
  }

  void search(Index f)
  {
    const Flat_mesh& mesh = surface_.mesh();
    const double longest = std::sqrt((std::max)(
        {mesh.chord(f, 0).squaredNorm(), mesh.chord(f, 1).squaredNorm(),
         mesh.chord(f, 2).squaredNorm()}));
    face_ = f;
    accuracy_ = relative_accuracy * longest;
    parts_.clear();
    add({{{Vector::UnitX(), mesh.position(f, 0), 0},
          {Vector::UnitY(), mesh.position(f, 1), 0},
          {Vector::UnitZ(), mesh.position(f, 2), 0}}},
        1);
    while (!parts_.empty()) {
      std::pop_heap(parts_.begin(), parts_.end());
      const Part part = parts_.back();
      parts_.pop_back();
      if (is_hopeless(part.lower)) return; // so are all others
      divide(part);
    }
  }

  bool is_hopeless(double lower) const { return lower >= distance_ - accuracy_; }

  double error_of(const std::array<Node, 3>& corner, double scale) const
  {
    const auto [first, second] = surface_.derivative_bounds(face_);
    const auto [least, largest]
        = std::minmax({corner[0].displacement, corner[1].displacement, corner[2].displacement});
    const Saturation::Bounds bounds
        = surface_.saturation().bounds(largest - scale * first, least + scale * first);
    return scale * scale / 2 * (bounds.first * second + bounds.second * first * first);
  }

  void add(const std::array<Node, 3>& corner, double scale)
  {
    const Vector &a = corner[0].point, &b = corner[1].point, &c = corner[2].point;
    const auto [v, w] = closest_weights(target_, a, b - a, c - a);
    const double u = 1 - v - w, error = error_of(corner, scale);
    const double lower = (u * a + v * b + w * c - target_).norm() - error;
    if (is_hopeless(lower)) return;
    // Go down from there where that is better: nothing prunes like the minimum itself.
    const Vector at
        = (u * corner[0].barycentric + v * corner[1].barycentric + w * corner[2].barycentric)
              .cwiseMax(0.0);
    improve({face_, at / at.sum()});
    if (error <= accuracy_ / 2 || is_hopeless(lower)) return;
    parts_.push_back({corner, lower, scale, error});
    std::push_heap(parts_.begin(), parts_.end());
  }

  void improve(const Support_location& from)
  {
    const double squared = (surface_.point(from.face, from.barycentric) - target_).squaredNorm();
    if (squared >= best_.squared_distance) return;
    best_ = Descent<Filter>(surface_, filter_, target_).from(from);
    set_reach();
  }

  void divide(const Part& part)
  {
    const auto& c = part.corner;
    std::array<Node, 3> m; // opposite to each corner
    for (int k = 0; k < 3; ++k) {
      m[k].barycentric = (c[next_corner(k)].barycentric + c[previous_corner(k)].barycentric) / 2;
      const Vector d = surface_.displacement(face_, m[k].barycentric);
      m[k].point = surface_.flat_point(face_, m[k].barycentric) + surface_.saturation()(d);
      m[k].displacement = d.norm();
    }
    const double scale = part.scale / 2;
    add({c[0], m[2], m[1]}, scale);
    add({m[2], c[1], m[0]}, scale);
    add({m[1], m[0], c[2]}, scale);
    add(m, scale);
  }

  const Support_surface& surface_;
  Vector target_;
  const Filter& filter_;
  Support_point best_;
  double distance_, squared_reach_;
  Index face_ = none; // that is searched
  double accuracy_ = 0;
  std::vector<Part> parts_;
};

template <class Filter>
Support_point guaranteed_closest(
    const Support_surface& surface, const Patch_tree& tree, const Vector& target,
    const Filter& filter)
{
  const Support_point start = fast_closest(surface, tree, target, filter);
  if (!start.is_found()) return start;
  Closest_patch<Filter> search(surface, target, filter, start);
  visit_nearest_first(tree, target, search);
  return search.best();
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_CLOSEST_H
