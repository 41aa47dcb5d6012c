// SPDX-License-Identifier: GPL-3.0-or-later
//
// How near the curves of features are to each other: across the strips of surface between them, and
// between the corners of each. Where sizes are larger than that, no mesh can be unit.
#ifndef SURETY_INTERNAL_METRIC_PROXIMITY_H
#define SURETY_INTERNAL_METRIC_PROXIMITY_H

#include <surety/features.h>
#include <surety/internal/linear.h>
#include <surety/metric_field.h>

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace surety::internal::metric {

/// \brief Walks straight over the faces from a curve, at right angles to it, to the next one.
///
/// The faces are unfolded into the plane one by one, which is what a straightest path on a
/// polyhedral surface is (Polthier, Schmies 1998).
template <class Mesh, class Points>
class Strip_walk
{
  using Halfedge = typename boost::graph_traits<Mesh>::halfedge_descriptor;

public:
  Strip_walk(const Mesh& mesh, const Points& points, const std::vector<bool>& is_feature)
    : mesh_(mesh), points_(points), is_feature_(is_feature)
  {}

  /// The width of the strip beside a halfedge of a curve, from a share of its length; nothing where
  /// no curve comes within reach, or the one that does is far from parallel.
  std::optional<double> width(Halfedge h, double share, double reach) const
  {
    // Curves that meet at a sharper angle make sizes shrink towards their corner no faster than
    // the default gradation does by itself.
    constexpr double parallel = .25;
    double along = share * length(h), cosine = 0, sine = 1, walked = 0;
    while (true) {
      // In the plane: h from the origin along x, the apex above it, the walk from (along, 0).
      const Vector base = point(target(h, mesh_)) - point(source(h, mesh_));
      const Vector side = point(target(next(h, mesh_), mesh_)) - point(source(h, mesh_));
      const double l = base.norm(), x = side.dot(base) / l, y = side.cross(base).norm() / l;
      if (!(l > 0) || !(y > 0)) return std::nullopt;
      const bool is_left = cosine * y - sine * (x - along) < 0;
      const Halfedge exit = is_left ? prev(h, mesh_) : next(h, mesh_);
      // The exit edge from its source at (sx, sy), in the direction (ex, ey) of its length.
      const double sx = is_left ? x : l, sy = is_left ? y : 0;
      const double whole = is_left ? std::hypot(x, y) : std::hypot(x - l, y);
      const double ex = (is_left ? -x : x - l) / whole, ey = (is_left ? -y : y) / whole;
      const double across = cosine * ey - sine * ex;
      if (!(across > 0)) return std::nullopt;
      const double step = ((sx - along) * ey - sy * ex) / across;
      const double hit
          = std::clamp((along + step * cosine - sx) * ex + (step * sine - sy) * ey, 0., whole);
      walked += std::max(0., step);
      if (walked > reach) return std::nullopt;
      const double cosine_there = cosine * ex + sine * ey;
      if (is_feature_[edge(exit, mesh_)]) {
        if (std::abs(cosine_there) > parallel * across) return std::nullopt;
        return walked;
      }
      h = opposite(exit, mesh_);
      along = whole - hit;
      cosine = -cosine_there;
      sine = across;
    }
  }

  double length(Halfedge h) const
  {
    return (point(target(h, mesh_)) - point(source(h, mesh_))).norm();
  }

private:
  template <class Vertex>
  Vector point(Vertex v) const
  {
    const auto& p = get(points_, v);
    return Vector(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }

  const Mesh& mesh_;
  Points points_;
  const std::vector<bool>& is_feature_;
};

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_PROXIMITY_H
