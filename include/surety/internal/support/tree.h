// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's AABB tree over the faces of a support. The box of a face is inflated by the reach of its
// patch, so that it holds the triangle and the patch: one tree serves searches for either.
#ifndef SURETY_INTERNAL_SUPPORT_TREE_H
#define SURETY_INTERNAL_SUPPORT_TREE_H

#include <surety/internal/deviation/closest_point.h>
#include <surety/internal/support/surface.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#if __has_include(<CGAL/AABB_traits_3.h>) // CGAL 6
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

#include <algorithm>
#include <utility>

namespace surety::internal {

using Box_kernel = CGAL::Simple_cartesian<double>;

/// A face, as a model of CGAL's concept `AABBPrimitive`, with its triangle at hand.
class Patch_primitive
{
public:
  using Id = Index;
  using Point = Box_kernel::Point_3;
  using Datum = Box_kernel::Iso_cuboid_3;

  Patch_primitive() = default;
  Patch_primitive(const Support_surface& surface, Index face)
    : face_(face),
      reach_(surface.reach(face)),
      corner_(surface.mesh().position(face, 0)),
      ab_(surface.mesh().chord(face, 0)),
      ac_(-surface.mesh().chord(face, 2))
  {}

  Id id() const { return face_; }
  /// Outwards by more than the roundings of these few operations.
  Datum datum() const
  {
    Vector low = corner_, high = corner_;
    for (const Vector& p : {Vector(corner_ + ab_), Vector(corner_ + ac_)}) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double size = (std::max)(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    const double margin = reach_ * (1 + 0x1p-40) + 0x1p-50 * size;
    return Datum(
        Point(low.x() - margin, low.y() - margin, low.z() - margin),
        Point(high.x() + margin, high.y() + margin, high.z() + margin));
  }
  Point reference_point() const { return Point(corner_.x(), corner_.y(), corner_.z()); }

  double reach() const { return reach_; }
  Vector normal() const { return unit(ab_.cross(ac_)); }

  /// The closest point of the flat triangle: barycentric coordinates and squared distance.
  std::pair<Vector, double> closest(const Vector& p) const
  {
    const auto [v, w] = closest_weights(p, corner_, ab_, ac_);
    return {
        Vector((std::max)(0., 1 - v - w), v, w), (p - corner_ - v * ab_ - w * ac_).squaredNorm()};
  }

private:
  Index face_ = none;
  double reach_ = 0;
  Vector corner_, ab_, ac_;
};

#if __has_include(<CGAL/AABB_traits_3.h>)
using Patch_tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Box_kernel, Patch_primitive>>;
#else
using Patch_tree = CGAL::AABB_tree<CGAL::AABB_traits<Box_kernel, Patch_primitive>>;
#endif

inline double squared_distance_to_box(const Vector& p, const CGAL::Bbox_3& box)
{
  const double x = (std::max)({0., box.xmin() - p.x(), p.x() - box.xmax()});
  const double y = (std::max)({0., box.ymin() - p.y(), p.y() - box.ymax()});
  const double z = (std::max)({0., box.zmin() - p.z(), p.z() - box.zmax()});
  return x * x + y * y + z * z;
}

/// \brief Visits the boxes nearer than what the visitor still looks for, nearest first.
///
/// A visitor has `squared_reach()` and `visit(primitive)`.
template <class Visitor>
class Nearest_first
{
public:
  using Priority = double;

  explicit Nearest_first(Visitor& visitor) : visitor_(visitor) {}

  bool go_further() const { return true; }
  void intersection(const Vector&, const Patch_primitive& primitive) { visitor_.visit(primitive); }

  template <class Node>
  bool do_intersect(const Vector& p, const Node& node) const
  {
    return squared_distance_to_box(p, node.bbox()) <= visitor_.squared_reach();
  }

  template <class Node>
  std::pair<bool, Priority> do_intersect_with_priority(const Vector& p, const Node& node) const
  {
    const double squared = squared_distance_to_box(p, node.bbox());
    return {squared <= visitor_.squared_reach(), -squared};
  }

private:
  Visitor& visitor_;
};

template <class Visitor>
void visit_nearest_first(const Patch_tree& tree, const Vector& p, Visitor& visitor)
{
  Nearest_first<Visitor> traversal(visitor);
  tree.traversal_with_priority(p, traversal);
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_TREE_H
