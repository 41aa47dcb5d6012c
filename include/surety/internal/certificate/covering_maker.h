// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the record of a covering of any two meshes: finds, face by face, triangles of the other
// mesh that it lies near to, part by part. Nothing here has to be sound, for the checker proves the
// record anew; it shares no code with it, nor with the bound that meshes are made under.
#ifndef SURETY_INTERNAL_CERTIFICATE_COVERING_MAKER_H
#define SURETY_INTERNAL_CERTIFICATE_COVERING_MAKER_H

#include <surety/covering.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace surety::internal::coverings {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Triangles = std::vector<Kernel::Triangle_3>;

/// In the order of the faces, with all coordinates multiplied by a power of two.
template <class Mesh, class Points>
Triangles triangles_of(const Mesh& mesh, const Points& points, double scale)
{
  Triangles result;
  result.reserve(num_faces(mesh));
  const auto point = [&](const auto v) {
    const auto& p = get(points, v);
    return Point(scale * p.x(), scale * p.y(), scale * p.z());
  };
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    result.emplace_back(
        point(source(h, mesh)), point(target(h, mesh)), point(target(next(h, mesh), mesh)));
  }
  return result;
}

/// A power of two that brings the coordinates of a mesh near to 1, so that products of lengths
/// neither vanish nor overflow.
template <class Mesh, class Points>
double scale_of(const Mesh& mesh, const Points& points)
{
  double largest = 0;
  for (const auto v : vertices(mesh)) {
    const auto& p = get(points, v);
    for (const double c : {double(p.x()), double(p.y()), double(p.z())})
      largest = (std::max)(largest, std::abs(c));
  }
  return largest > 0 && std::isfinite(largest) ? std::ldexp(1., -std::ilogb(largest)) : 1;
}

/// One direction: the faces of a mesh, covered by triangles of another one.
class Maker
{
public:
  Maker(const Triangles& faces, const Triangles& others, double limit)
    : faces_(faces), others_(others), limit_(limit)
  {
    find_candidates();
  }

  /// How far the faces are at most, and the record; nothing where a face is too far away, or cannot
  /// be decided.
  std::optional<double> make(Covering::Faces& record)
  {
    double worst = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (!cover(f)) return std::nullopt;
      worst = (std::max)(worst, worst_);
      std::sort(used_.begin(), used_.end());
      record.witnesses.insert(record.witnesses.end(), used_.begin(), used_.end());
      record.first.push_back(static_cast<std::uint32_t>(record.witnesses.size()));
    }
    return std::sqrt(worst);
  }

private:
  using Part = std::array<Point, 3>;
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Kernel::Triangle_3*>;

  static constexpr unsigned deepest = 20;
  static constexpr std::size_t most_parts = 2'000'000; ///< of one face

  /// The triangles whose boxes are within the limit of the box of a face.
  void find_candidates()
  {
    std::vector<Box> mine, theirs;
    for (const auto& t : faces_) {
      const CGAL::Bbox_3 b = t.bbox();
      mine.emplace_back(
          CGAL::Bbox_3(
              b.xmin() - limit_, b.ymin() - limit_, b.zmin() - limit_, b.xmax() + limit_,
              b.ymax() + limit_, b.zmax() + limit_),
          &t);
    }
    for (const auto& t : others_) theirs.emplace_back(t.bbox(), &t);
    candidates_.resize(faces_.size());
    CGAL::box_intersection_d(
        mine.begin(), mine.end(), theirs.begin(), theirs.end(), [this](const Box& a, const Box& b) {
          candidates_[a.handle() - faces_.data()].push_back(
              static_cast<std::uint32_t>(b.handle() - others_.data()));
        });
    for (auto& list : candidates_) std::sort(list.begin(), list.end());
  }

  bool cover(std::size_t f)
  {
    const auto& t = faces_[f];
    active_ = candidates_[f];
    used_.clear();
    worst_ = 0;
    parts_ = 0;
    return cover({t[0], t[1], t[2]}, 0, 0);
  }

  bool cover(const Part& part, unsigned depth, std::size_t from)
  {
    if (++parts_ > most_parts || depth > deepest) return false;
    const double squared_limit = limit_ * limit_;
    // Those named already keep lists short.
    for (const std::uint32_t w : used_) {
      const double farthest = squared_distances(part, w).second;
      if (farthest > squared_limit) continue;
      worst_ = (std::max)(worst_, farthest);
      return true;
    }
    const double length = std::sqrt((std::max)(
        {CGAL::squared_distance(part[0], part[1]), CGAL::squared_distance(part[1], part[2]),
         CGAL::squared_distance(part[2], part[0])}));
    const double reach = (limit_ + length) * (limit_ + length);
    const std::size_t last = active_.size();
    double best = std::numeric_limits<double>::infinity();
    std::uint32_t witness = 0;
    for (std::size_t i = from; i < last; ++i) {
      const auto [nearest, farthest] = squared_distances(part, active_[i]);
      if (farthest < best) best = farthest, witness = active_[i];
      if (nearest <= reach) active_.push_back(active_[i]);
    }
    const bool is_covered = best <= squared_limit
        ? use(witness, best)
        : active_.size() > last && cover_quarters(part, depth, last);
    active_.resize(last);
    return is_covered;
  }

  bool use(std::uint32_t witness, double squared)
  {
    used_.push_back(witness);
    worst_ = (std::max)(worst_, squared);
    return true;
  }

  bool cover_quarters(const Part& part, unsigned depth, std::size_t from)
  {
    const auto& [a, b, c] = part;
    const Point ab = CGAL::midpoint(a, b), bc = CGAL::midpoint(b, c), ca = CGAL::midpoint(c, a);
    for (const Part& quarter :
         {Part{a, ab, ca}, Part{ab, b, bc}, Part{ca, bc, c}, Part{ab, bc, ca}})
      if (!cover(quarter, depth + 1, from)) return false;
    return true;
  }

  /// Of the nearest and of the farthest corner.
  std::pair<double, double> squared_distances(const Part& part, std::uint32_t w) const
  {
    const Kernel::Triangle_3& triangle = others_[w];
    std::pair<double, double> result{std::numeric_limits<double>::infinity(), 0};
    for (const Point& corner : part) {
      const double d = CGAL::squared_distance(corner, triangle);
      result = {(std::min)(result.first, d), (std::max)(result.second, d)};
    }
    return result;
  }

  const Triangles& faces_;
  const Triangles& others_;
  double limit_;
  std::vector<std::vector<std::uint32_t>> candidates_; ///< by face
  std::vector<std::uint32_t> active_;                  ///< a stack of lists, one for each level
  std::vector<std::uint32_t> used_;
  double worst_ = 0; ///< squared
  std::size_t parts_ = 0;
};

} // namespace surety::internal::coverings

#endif // SURETY_INTERNAL_CERTIFICATE_COVERING_MAKER_H
