// SPDX-License-Identifier: GPL-3.0-or-later
//
// The face nearest to a point among those that look the same way, with CGAL's AABB tree. In
// floating point: a metric that is read from a neighbouring face is as good.
#ifndef SURETY_INTERNAL_METRIC_FACE_LOCATOR_H
#define SURETY_INTERNAL_METRIC_FACE_LOCATOR_H

#include <surety/internal/features/normals.h>
#include <surety/internal/linear.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#if __has_include(<CGAL/AABB_traits_3.h>) // CGAL 6
#include <CGAL/AABB_traits_3.h>
#else
#include <CGAL/AABB_traits.h>
#endif

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace surety::internal::metric {

struct Located_face {
  std::array<Vector, 3> corner;
  Vector normal = Vector::Zero(); ///< of unit length; the locator computes it
  std::uint32_t id = 0;
};

/// The point of a face nearest to another one, by the weights of the corners.
struct Located_point {
  std::uint32_t face = 0;
  Vector weights = Vector(1, 0, 0);
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// The point of the segment from corner i to corner j of a face that is nearest to p.
inline Located_point nearest_on_edge(const Located_face& face, int i, int j, const Vector& p)
{
  const Vector e = face.corner[j] - face.corner[i];
  const double t = std::clamp((p - face.corner[i]).dot(e) / e.squaredNorm(), 0., 1.);
  Located_point result{face.id, Vector::Zero(), (face.corner[i] + t * e - p).squaredNorm()};
  result.weights[i] = 1 - t;
  result.weights[j] = t;
  return result;
}

/// The point of a face that is nearest to p: its projection, or a point of an edge.
inline Located_point nearest_on_face(const Located_face& face, const Vector& p)
{
  const auto& [a, b, c] = face.corner;
  const Vector n = (b - a).cross(c - a);
  const double area = n.squaredNorm();
  const Vector weights(
      (b - p).cross(c - p).dot(n) / area, (c - p).cross(a - p).dot(n) / area,
      (a - p).cross(b - p).dot(n) / area);
  if (weights.minCoeff() >= 0) {
    const double height = (p - a).dot(face.normal);
    return {face.id, weights / weights.sum(), height * height};
  }
  Located_point best = nearest_on_edge(face, 0, 1, p);
  for (const auto& [i, j] : {std::pair(1, 2), std::pair(2, 0)}) {
    const Located_point other = nearest_on_edge(face, i, j, p);
    if (other.squared_distance < best.squared_distance) best = other;
  }
  return best;
}

class Face_locator
{
  using Kernel = CGAL::Simple_cartesian<double>;
  using Point = Kernel::Point_3;

  static Point cgal_point(const Vector& p) { return {p.x(), p.y(), p.z()}; }

  /// A model of CGAL's concept `AABBPrimitive`.
  class Primitive
  {
  public:
    using Id = const Located_face*;
    using Point = Face_locator::Point;
    using Datum = Kernel::Triangle_3;

    Primitive() = default;
    explicit Primitive(Id face) : face_(face) {}

    Id id() const { return face_; }
    Datum datum() const
    {
      return {
          cgal_point(face_->corner[0]), cgal_point(face_->corner[1]), cgal_point(face_->corner[2])};
    }
    Point reference_point() const { return cgal_point(face_->corner[0]); }

  private:
    Id face_ = nullptr;
  };

  /// Visits the faces that may be nearer than the best so far. Ties go to the lower index, whatever
  /// the order of the traversal.
  class Search
  {
  public:
    using Priority = double;

    Search(const Vector& point, const Vector& normal) : point_(point), normal_(normal) {}

    bool go_further() const { return true; }

    void intersection(const Point&, const Primitive& primitive)
    {
      const Located_face& face = *primitive.id();
      if (!normal_.isZero(0) && !(face.normal.dot(normal_) > 0)) return;
      const Located_point found = nearest_on_face(face, point_);
      if (found.squared_distance > best.squared_distance) return;
      if (found.squared_distance == best.squared_distance && found.face >= best.face) return;
      best = found;
    }

    template <class Node>
    bool do_intersect(const Point&, const Node& node) const
    {
      return squared_distance(node) <= best.squared_distance;
    }

    /// Nearer boxes first.
    template <class Node>
    std::pair<bool, Priority> do_intersect_with_priority(const Point&, const Node& node) const
    {
      const double squared = squared_distance(node);
      return {squared <= best.squared_distance, -squared};
    }

    Located_point best;

  private:
    /// Rounding must not hide a face that is as near as the best.
    template <class Node>
    double squared_distance(const Node& node) const
    {
      const CGAL::Bbox_3 box = node.bbox();
      const Vector low(box.xmin(), box.ymin(), box.zmin()),
          high(box.xmax(), box.ymax(), box.zmax());
      return 0.999999 * (low - point_).cwiseMax(point_ - high).cwiseMax(0).squaredNorm();
    }

    Vector point_, normal_;
  };

#if __has_include(<CGAL/AABB_traits_3.h>)
  using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
  using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif
  using Tree = CGAL::AABB_tree<Traits>;

public:
  explicit Face_locator(std::vector<Located_face> faces)
    : faces_(std::move(faces)), tree_(std::make_unique<Tree>())
  {
    for (Located_face& face : faces_) {
      face.normal = unit_normal(face.corner[0], face.corner[1], face.corner[2]);
      tree_->insert(Primitive(&face));
    }
    tree_->build();
  }

  Located_point nearest(const Vector& point, const Vector& normal) const
  {
    Search search(point, normal);
    tree_->traversal_with_priority(cgal_point(point), search);
    const bool is_found = search.best.squared_distance < std::numeric_limits<double>::infinity();
    return is_found || normal.isZero(0) ? search.best : nearest(point, Vector::Zero());
  }

private:
  std::vector<Located_face> faces_;
  std::unique_ptr<Tree> tree_;
};

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_FACE_LOCATOR_H
