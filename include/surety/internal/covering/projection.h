// SPDX-License-Identifier: GPL-3.0-or-later
//
// Proves at one stroke that T covers a face K of M, where T is finer than M.
//
// Let D be a set of triangles of T, and parts of triangles, and psi a map that is linear on each of
// them and takes each vertex to a point of the plane of K within the tolerance. Then psi(x) is
// within the tolerance of x for all x in D, so that every point of psi(D) is near to T. If the
// boundary of D stays clear of the interior of K under psi, then all of that interior has the same
// winding number about it; where that is not zero, psi(D) contains the interior, and K since psi(D)
// is closed.
//
// psi is stored as barycentric coordinates (u, v) with respect to K, which makes K the set u >= 0,
// v >= 0, u + v <= 1. They are doubles, and every decision about them is exact; how they came about
// does not matter, since the distance is measured to the point that they stand for. With |u| + |v|
// at most 16 the computed point errs by less than 170Cu a coordinate (rounding.h), which is within
// what convex_cell.h allows for.
#ifndef SURETY_INTERNAL_COVERING_PROJECTION_H
#define SURETY_INTERNAL_COVERING_PROJECTION_H

#include <surety/internal/covering/triangles.h>
#include <surety/internal/deviation/reference.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace surety::internal::covering {

class Projection
{
public:
  explicit Projection(const Reference& reference) : reference_(reference)
  {
    corners_.reserve(reference.number_of_faces());
    for (Index f = 0; f < reference.number_of_faces(); ++f)
      corners_.push_back(reference.vertices_of_face(f));
    images_.resize(reference.number_of_vertices());
    visited_.resize(reference.number_of_faces(), 0);
  }

  const std::array<Index, 3>& corners_of(Index triangle) const { return corners_[triangle]; }
  Triangle triangle(Index t) const
  {
    const auto& v = corners_[t];
    return {reference_.point(v[0]), reference_.point(v[1]), reference_.point(v[2]), t};
  }

  struct Proof {
    Index seed;              ///< a triangle of T next to the middle of K
    double squared_distance; ///< the largest at a vertex of D, as computed
  };

  /// \param seeds triangles of T to start from, each if those before lead nowhere
  template <class Seeds>
  std::optional<Proof> prove(const Triangle& face, const Seeds& seeds, double squared_limit)
  {
    if (!project_on(face, squared_limit)) return std::nullopt;
    for (const Index seed : seeds) {
      const Index start = walk_to_middle(seed);
      if (start == none) continue;
      if (const auto alone = proof_by_one(face, start)) return alone;
      return proof_from(start);
    }
    return std::nullopt;
  }

  /// The triangles that the last proof, or attempt at it, has visited.
  const std::vector<Index>& visited() const { return patch_; }
  /// Whether it has met a vertex so far from K, for its size, that it could not use it: triangles
  /// of T are much larger than K there.
  bool has_gone_far() const { return has_gone_far_; }

private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_2;

  struct Image {
    double u = 0, v = 0;
    double squared_distance = 0;
    Index time = 0;
    unsigned char outside = 0; ///< bits: u <= 0, v <= 0, u + v >= 1
  };
  static constexpr double largest_coordinate = 16; ///< of |u| + |v|

  /// Cuts as far out as the tolerance allows at first, then without what leads into K, then with
  /// vertices pushed out of K.
  std::optional<Proof> proof_from(Index start)
  {
    for (int attempt = 0; attempt < 4; ++attempt) {
      leaves_away_ = attempt == 1 || attempt == 3;
      if (attempt == 2 && !push_out()) return std::nullopt;
      if (!spread(start)) return std::nullopt;
      if (!intruding_.empty()) continue;
      if (winds_around_middle()) return Proof{start, largest_};
    }
    return std::nullopt;
  }

  bool project_on(const Triangle& face, double squared_limit)
  {
    face_ = &face;
    squared_limit_ = squared_limit;
    limit_ = std::sqrt(squared_limit) * (1 - 1e-9);
    patch_.clear();
    has_gone_far_ = false;
    ++now_;
    const double bb = face.ab.squaredNorm(), bc = face.ab.dot(face.ac), cc = face.ac.squaredNorm();
    const double determinant = bb * cc - bc * bc;
    if (!(determinant > 1e-20 * bb * cc)) return false;
    dual_u_ = (cc * face.ab - bc * face.ac) / determinant;
    dual_v_ = (bb * face.ac - bc * face.ab) / determinant;
    return true;
  }

  static unsigned char codes(double u, double v)
  {
    // u + v is sum + error exactly (Knuth, The Art of Computer Programming, 4.2.2, theorem B).
    const double sum = u + v, part = sum - u;
    const double error = (u - (sum - part)) + (v - part);
    const bool is_beyond = sum > 1 || (sum == 1 && error >= 0);
    return static_cast<unsigned char>((u <= 0 ? 1 : 0) | (v <= 0 ? 2 : 0) | (is_beyond ? 4 : 0));
  }

  const Image& image(Index vertex)
  {
    Image& result = images_[vertex];
    if (result.time != now_) {
      const Vector p = reference_.point(vertex) - face_->a;
      result = image_of(reference_.point(vertex), snapped(dual_u_.dot(p)), snapped(dual_v_.dot(p)));
    }
    return result;
  }
  /// Vertices that T shares with M belong on its corners.
  static double snapped(double x)
  {
    constexpr double little = 1e-11;
    return std::abs(x) < little ? 0 : std::abs(x - 1) < little ? 1 : x;
  }
  Image image_of(const Vector& p, double u, double v)
  {
    Image result{u, v, std::numeric_limits<double>::infinity(), now_, codes(u, v)};
    if (std::abs(u) + std::abs(v) <= largest_coordinate)
      result.squared_distance = (p - face_->a - u * face_->ab - v * face_->ac).squaredNorm();
    else
      has_gone_far_ = true;
    return result;
  }
  bool is_near(Index vertex) { return image(vertex).squared_distance <= squared_limit_; }

  Index beyond(Index triangle, int side) const
  {
    const auto& faces = reference_.faces_of_edge(reference_.edges_of_face(triangle)[side]);
    return faces[0] == triangle ? faces[1] : faces[0];
  }

  /// Where the straight way to the middle of K ends: a triangle over it, or none.
  Index walk_to_middle(Index t)
  {
    constexpr int most_steps = 64;
    constexpr double middle = 1. / 3;
    Index from = none;
    for (int step = 0; step < most_steps && t != none; ++step) {
      const auto& v = corners_[t];
      Index onward = none;
      double least = 0;
      for (int i = 0; i < 3; ++i) {
        const Image &a = image(v[i]), &b = image(v[(i + 1) % 3]);
        const double side = (b.u - a.u) * (middle - a.v) - (b.v - a.v) * (middle - a.u);
        const Index next = beyond(t, i);
        if (side >= least || next == from) continue;
        least = side, onward = next;
        if (next == none) onward = t;
      }
      if (onward == none) return t;
      if (onward == t) return none;
      from = t;
      t = onward;
    }
    return none;
  }

  /// All of K is near to one triangle of T where its corners are.
  std::optional<Proof> proof_by_one(const Triangle& face, Index t) const
  {
    const Triangle one = triangle(t);
    double largest = 0;
    for (const Vector& p : face.corners()) {
      largest = std::max(largest, one.squared_distance(p));
      if (largest > squared_limit_) return std::nullopt;
    }
    return Proof{t, largest};
  }

  /// Makes D: all triangles with a near vertex that hang together over K, less what is beyond their
  /// cut edges.
  bool spread(Index start)
  {
    patch_.clear();
    intruding_.clear();
    largest_ = 0;
    ++visit_;
    visit(start);
    for (std::size_t i = 0; i < patch_.size(); ++i) {
      const Index t = patch_[i];
      const auto v = corners_[t];
      for (int side = 0; side < 3; ++side) {
        const Index a = v[side], b = v[(side + 1) % 3];
        const bool near_a = is_near(a), near_b = is_near(b);
        if (near_a) largest_ = std::max(largest_, images_[a].squared_distance);
        if (!near_a && !near_b) continue;
        const Image from = near_a ? images_[a] : cut(b, a), to = near_b ? images_[b] : cut(a, b);
        if ((from.outside & to.outside) != 0) continue;
        const Index next = beyond(t, side);
        if (next != none)
          visit(next);
        else if (intrudes(from, to))
          intruding_.push_back(t);
      }
      if (is_cut(t)) check_cut(t);
    }
    return !patch_.empty();
  }

  void visit(Index t)
  {
    if (visited_[t] == visit_) return;
    visited_[t] = visit_;
    const auto& v = corners_[t];
    if (is_near(v[0]) || is_near(v[1]) || is_near(v[2])) patch_.push_back(t);
  }

  bool is_cut(Index t)
  {
    const auto& v = corners_[t];
    return !is_near(v[0]) || !is_near(v[1]) || !is_near(v[2]);
  }

  /// Where an edge from a near to a far vertex leaves the tolerance: a point a + lambda (b - a)
  /// that is a function of the edge alone, so that both triangles there agree on it.
  Image cut(Index a, Index b)
  {
    const Image from = image(a), to = image(b);
    const Vector &p = reference_.point(a), &q = reference_.point(b);
    const double height_a = face_->normal.dot(p - face_->a),
                 height_b = face_->normal.dot(q - face_->a);
    double lambda = 0;
    if (std::abs(height_b) > limit_ && std::abs(height_a) < limit_)
      lambda = (std::copysign(limit_, height_b) - height_a) / (height_b - height_a);
    const double reach = std::abs(to.u) + std::abs(to.v);
    if (reach > largest_coordinate) lambda = std::min(lambda, 1 / reach);
    if (lambda > 0) {
      const Image result = image_of(
          p + lambda * (q - p), from.u + lambda * (to.u - from.u),
          from.v + lambda * (to.v - from.v));
      // What leads from an edge of K into it, next to a ridge that is sharper than a right angle,
      // is left away.
      if (leaves_away_ && from.outside != 0 && (from.outside & result.outside) == 0) return from;
      if (result.squared_distance <= squared_limit_) {
        largest_ = std::max(largest_, result.squared_distance);
        return result;
      }
    }
    return from;
  }

  /// The part of a triangle that belongs to D.
  struct Part {
    std::array<Image, 4> corner;
    int size = 0;
    std::array<int, 2> end{}; ///< the corners where the cut begins and ends
  };
  Part part(Index t)
  {
    Part result;
    const auto& v = corners_[t];
    for (int i = 0; i < 3; ++i) {
      const Index a = v[i], b = v[(i + 1) % 3];
      if (is_near(a)) {
        result.corner[result.size++] = images_[a];
        if (is_near(b)) continue;
        result.end[0] = result.size;
        result.corner[result.size++] = cut(a, b);
      } else if (is_near(b)) {
        result.end[1] = result.size;
        result.corner[result.size++] = cut(b, a);
      }
    }
    return result;
  }

  void check_cut(Index t)
  {
    const Part p = part(t);
    if (intrudes(p.corner[p.end[0]], p.corner[p.end[1]])) intruding_.push_back(t);
  }

  /// Whether the image of a straight piece of the boundary of D enters the interior of K.
  static bool intrudes(const Image& a, const Image& b)
  {
    if ((a.outside & b.outside) != 0) return false;
    const Point p(a.u, a.v), q(b.u, b.v);
    if (p == q) return a.outside == 0;
    const auto first = CGAL::orientation(p, q, Point(0, 0));
    const auto second = CGAL::orientation(p, q, Point(1, 0));
    const auto third = CGAL::orientation(p, q, Point(0, 1));
    const bool on_left
        = first != CGAL::RIGHT_TURN && second != CGAL::RIGHT_TURN && third != CGAL::RIGHT_TURN;
    const bool on_right
        = first != CGAL::LEFT_TURN && second != CGAL::LEFT_TURN && third != CGAL::LEFT_TURN;
    return !on_left && !on_right;
  }

  /// Moves near vertices of what enters K to the nearest edge of K, as far as the tolerance allows:
  /// ridges and borders of T lie beside the edges of M that stand for them.
  bool push_out()
  {
    for (const Index t : intruding_)
      for (const Index vertex : corners_[t]) {
        if (!is_near(vertex)) continue;
        const Image at = images_[vertex];
        if (at.outside != 0) continue;
        const double w = 1 - at.u - at.v;
        // Of the third edge both coordinates are rounded: a little beyond it.
        constexpr double beyond = 0x1p-50;
        const std::array<std::array<double, 2>, 3> place{
            {{0, at.v + at.u / 2},
             {at.u + at.v / 2, 0},
             {at.u + w / 2 + beyond, at.v + w / 2 + beyond}}};
        Image best;
        best.squared_distance = std::numeric_limits<double>::infinity();
        for (const auto& [u, v] : place) {
          const Image moved = image_of(reference_.point(vertex), u, v);
          if (moved.squared_distance < best.squared_distance) best = moved;
        }
        if (best.squared_distance > squared_limit_) return false;
        images_[vertex] = best;
      }
    return true;
  }

  /// Whether the winding number of D about a point of the interior of K is not zero. The point is
  /// chosen off all images of edges.
  bool winds_around_middle()
  {
    for (const double shift : {0., 0.0123, -0.0171}) {
      if (const auto number = winding_number(Point(1. / 3 + shift, 1. / 3 - 1.7 * shift)))
        return *number != 0;
    }
    return false;
  }
  std::optional<int> winding_number(const Point& z)
  {
    int number = 0;
    for (const Index t : patch_) {
      const Part p = part(t);
      for (int i = 2; i < p.size; ++i) {
        const auto sign = sign_around(z, p.corner[0], p.corner[i - 1], p.corner[i]);
        if (!sign) return std::nullopt;
        number += *sign;
      }
    }
    return number;
  }
  /// The winding number of a triangle; none where the point lies on its boundary.
  static std::optional<int> sign_around(
      const Point& z, const Image& a, const Image& b, const Image& c)
  {
    if (std::max({a.u, b.u, c.u}) < z.x() || std::min({a.u, b.u, c.u}) > z.x()
        || std::max({a.v, b.v, c.v}) < z.y() || std::min({a.v, b.v, c.v}) > z.y())
      return 0;
    const Point p(a.u, a.v), q(b.u, b.v), r(c.u, c.v);
    const auto left = CGAL::orientation(p, q, z), right = CGAL::orientation(q, r, z),
               last = CGAL::orientation(r, p, z);
    if (left == CGAL::COLLINEAR || right == CGAL::COLLINEAR || last == CGAL::COLLINEAR)
      return std::nullopt;
    if (left != right || right != last) return 0;
    return left == CGAL::LEFT_TURN ? 1 : -1;
  }

  const Reference& reference_;
  std::vector<std::array<Index, 3>> corners_;
  std::vector<Image> images_;
  std::vector<Index> visited_;
  Index now_ = 0, visit_ = 0;

  const Triangle* face_ = nullptr;
  Vector dual_u_, dual_v_;
  double squared_limit_ = 0, limit_ = 0, largest_ = 0;
  bool leaves_away_ = false, has_gone_far_ = false;
  std::vector<Index> patch_;
  std::vector<Index> intruding_; ///< triangles where the boundary of D does
};

} // namespace surety::internal::covering

#endif // SURETY_INTERNAL_COVERING_PROJECTION_H
