// SPDX-License-Identifier: GPL-3.0-or-later
//
// The face of a mesh nearest to a point, with a certified interval for the distance: CGAL's AABB
// tree, traversed with our own pruning because CGAL's closest point comes without error bounds.
#ifndef SURETY_INTERNAL_DISTANCE_FACE_TREE_H
#define SURETY_INTERNAL_DISTANCE_FACE_TREE_H

#include <surety/internal/distance/triangle_set.h>

#include <CGAL/AABB_tree.h>
#if __has_include(<CGAL/AABB_traits_3.h>) // CGAL 6
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace surety {
namespace internal {
namespace hausdorff {

/// A triangle of a `Triangle_set`, as a model of CGAL's concept `AABBPrimitive`.
class Face_primitive
{
public:
  using Id = std::uint32_t;
  using Point = hausdorff::Point;
  using Datum = Kernel::Triangle_3;

  Face_primitive() = default;
  Face_primitive(Id face, const Triangle& triangle) : face_(face), triangle_(&triangle) {}

  Id id() const { return face_; }
  Datum datum() const { return Datum((*triangle_)[0], (*triangle_)[1], (*triangle_)[2]); }
  Point reference_point() const { return (*triangle_)[0]; }
  const Triangle& triangle() const { return *triangle_; }

private:
  Id face_ = 0;
  const Triangle* triangle_ = nullptr;
};

/// A face close to a point; no face of the mesh is closer than `lower`, this one is within `upper`.
struct Nearest_face {
  std::uint32_t face;
  double lower;
  double upper;
};

/// \brief Visits the faces that may be closer to a point than the best one so far, nearest first.
///
/// A node or a face is left out only if its box is certainly farther than the upper bound of the
/// best face; each face that is measured lowers the lower bound. So the interval is certified
/// whatever order the traversal takes.
class Nearest_traversal
{
public:
  using Priority = double;

  Nearest_traversal(const Point& p, std::uint32_t hint, const Triangle& triangle)
  {
    const Bounds bounds = distance_bounds(p, triangle);
    best_ = {hint, bounds.lower, bounds.upper};
    set_reach();
  }

  bool go_further() const { return true; }

  void intersection(const Point& p, const Face_primitive& primitive)
  {
    const Triangle& triangle = primitive.triangle();
    if (squared_box_distance(p, box(triangle)) > squared_reach_) return;
    const Bounds bounds = distance_bounds(p, triangle);
    best_.lower = (std::min)(best_.lower, bounds.lower);
    if (bounds.upper >= best_.upper) return;
    best_.upper = bounds.upper;
    best_.face = primitive.id();
    set_reach();
  }

  template <class Node>
  bool do_intersect(const Point& p, const Node& node) const
  {
    return squared_box_distance(p, node.bbox()) <= squared_reach_;
  }

  template <class Node>
  std::pair<bool, Priority> do_intersect_with_priority(const Point& p, const Node& node) const
  {
    const double squared = squared_box_distance(p, node.bbox());
    return {squared <= squared_reach_, -squared};
  }

  const Nearest_face& result() const { return best_; }

private:
  static CGAL::Bbox_3 box(const Triangle& t)
  {
    const auto [xmin, xmax] = std::minmax({t[0].x(), t[1].x(), t[2].x()});
    const auto [ymin, ymax] = std::minmax({t[0].y(), t[1].y(), t[2].y()});
    const auto [zmin, zmax] = std::minmax({t[0].z(), t[1].z(), t[2].z()});
    return CGAL::Bbox_3(xmin, ymin, zmin, xmax, ymax, zmax);
  }

  static double squared_box_distance(const Point& p, const CGAL::Bbox_3& box)
  {
    const double x = (std::max)({0., box.xmin() - p.x(), p.x() - box.xmax()});
    const double y = (std::max)({0., box.ymin() - p.y(), p.y() - box.ymax()});
    const double z = (std::max)({0., box.zmin() - p.z(), p.z() - box.zmax()});
    return x * x + y * y + z * z;
  }

  /// The squared distance to a box has a relative error below 6 u: two of each difference, one of
  /// the square, two of the sums. The squared reach itself has two roundings.
  void set_reach() { squared_reach_ = best_.upper * best_.upper * (1 + 16 * unit_roundoff); }

  Nearest_face best_;
  double squared_reach_;
};

/// The faces of a mesh, ready for queries.
class Face_tree
{
#if __has_include(<CGAL/AABB_traits_3.h>)
  using Traits = CGAL::AABB_traits_3<Kernel, Face_primitive>;
#else
  using Traits = CGAL::AABB_traits<Kernel, Face_primitive>;
#endif
  using Tree = CGAL::AABB_tree<Traits>;

public:
  explicit Face_tree(const Triangle_set& triangles) : triangles_(triangles)
  {
    for (std::uint32_t f = 0; f < triangles.size(); ++f) {
      tree_.insert(Face_primitive(f, triangles.triangle(f)));
    }
    tree_.build();
  }

  const Triangle& triangle(std::uint32_t f) const { return triangles_.triangle(f); }
  std::size_t size() const { return triangles_.size(); }

  /// The hint is any face; a close one makes the query fast.
  Nearest_face nearest(const Point& p, std::uint32_t hint) const
  {
    Nearest_traversal traversal(p, hint, triangle(hint));
    tree_.traversal_with_priority(p, traversal);
    return traversal.result();
  }

private:
  const Triangle_set& triangles_;
  Tree tree_;
};

} // namespace hausdorff
} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_DISTANCE_FACE_TREE_H
