// SPDX-License-Identifier: GPL-3.0-or-later
//
// Upper bounds, rounding included, of the angle between the normals of a face of M and of the faces
// of T that the map takes there.
//
// e = 2^-52 bounds the relative error of one operation in every rounding mode.
//
// One normal: n = u x v, where u and v are differences of stored points, with largest coordinates p
// and q. In each coordinate, first order: a product of two differences errs by 3 e p q, and so does
// the other; their difference, at most 2 p q, by 2 e p q: 8 e p q, or 8 sqrt(3) e p q < 14 e p q
// for the vector; we take r = 16 e p q. The exact normal is in the ball of radius r about the
// computed one, so the angle between them is at most asin(r / |n|) <= pi/2 r / |n|, if r < |n|. We
// take 1.6 for pi/2, which covers the rounding of this quotient. If r >= |n|, the face may have no
// area, and we know nothing; with an area of 0 it is always so. The two shorter sides, by their
// largest coordinates, give the least r. With a side below 2^-400 we know nothing either: above it,
// what a product loses in an underflow is far below r. Multiplication by a power of two, so that
// the largest coordinate is in [1/2, 1), changes no angle.
//
// Two normals a and b, computed and scaled: the angle is that of the point (c, s), c = a b, s =
// |a x b|, at a distance |a| |b| >= 1/4 from the origin. A coordinate of a x b: products 1 + 1,
// difference 2: 4 e, so s errs by 4 sqrt(3) e < 7 e and, being at most 3, by 3 e of it for the
// norm: 16 e. c: products 3, sums 2 + 3: 8 e. So the point moves by less than 18 e, and its angle
// by less than 73 e. The function atan2 is good to an ulp or so; we allow for sixteen, 32 e, and
// add 128 e in all. Sums and the change to degrees: 6 e relative, and we take 8.
//
// Faces with the same three corners have the same normal: 0.
#ifndef SURETY_INTERNAL_CERTIFICATE_NORMALS_H
#define SURETY_INTERNAL_CERTIFICATE_NORMALS_H

#include <surety/internal/certificate/items.h>
#include <surety/internal/certificate/measure.h>
#include <surety/internal/certificate/polygon_cutter.h>

#include <limits>

namespace surety::internal::checker {

/// A vector with its largest coordinate in [1/2, 1), and a bound of its angle to the exact normal.
struct Normal {
  Point vector = {0, 0, 0};
  double error = std::numeric_limits<double>::infinity(); ///< in radians; infinite: nothing known
};

/// From two sides and the product of their largest coordinates.
inline Normal normal_of_sides(const Point& first, const Point& second, double product)
{
  Normal normal;
  normal.vector = cross(first, second);
  const double largest = largest_coordinate(normal.vector), radius = 0x1p-48 * product;
  if (!(largest > radius / 2) || !std::isfinite(largest)) return Normal();
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double scale = std::ldexp(1.0, -exponent);
  for (double& c : normal.vector) c *= scale;
  const double sine = scale * radius / std::sqrt(dot(normal.vector, normal.vector));
  if (!(sine < 1)) return Normal();
  normal.error = 1.6 * sine;
  return normal;
}

inline Normal normal_of_face(const Triangle_table& mesh, Index face)
{
  const auto& t = mesh.corners(face);
  std::array<Point, 3> sides; // from corner k to corner k + 1
  std::array<double, 3> largest;
  for (std::size_t k = 0; k < 3; ++k) {
    sides[k] = difference(mesh.point(t[(k + 1) % 3]), mesh.point(t[k]));
    largest[k] = largest_coordinate(sides[k]);
    if (!(largest[k] >= 0x1p-400)) return Normal();
  }
  // The two sides that follow on the longest one.
  const auto longest = static_cast<std::size_t>(
      std::max_element(largest.begin(), largest.end()) - largest.begin());
  const std::size_t i = (longest + 1) % 3, j = (longest + 2) % 3;
  return normal_of_sides(sides[i], sides[j], largest[i] * largest[j]);
}

/// In degrees, at most 180, which is the answer where nothing is known.
inline double angle_bound(const Normal& a, const Normal& b)
{
  constexpr double degrees = 57.295779513082320877;
  const double error = a.error + b.error;
  if (!std::isfinite(error)) return 180;
  const Point c = cross(a.vector, b.vector);
  const double angle = std::atan2(std::sqrt(dot(c, c)), dot(a.vector, b.vector));
  return (std::min)(180.0, (angle + error + 0x1p-45) * degrees * (1 + 0x1p-49));
}

/// For each face of M, the largest angle to the faces of T of its cells.
class Normal_deviations
{
public:
  /// Faces at a vertex of M that are compared where a cell shrinks to it: a limit of the work.
  static constexpr std::size_t most_faces_at_vertex = 100;

  Normal_deviations(const Triangle_table& input, const Items& items)
    : input_(input), items_(items), angles_(items.output().number_of_faces(), 0)
  {
    const Triangle_table& output = items.output();
    normals_.reserve(output.number_of_faces());
    for (Index f = 0; f < output.number_of_faces(); ++f)
      normals_.push_back(normal_of_face(output, f));
  }

  /// Cells of the face t of T.
  void add(Index t, const Cell* first, const Cell* last)
  {
    const Normal normal = normal_of_face(input_, t);
    Index counted = none; // most cells are in the face of the one before
    for (const Cell* cell = first; cell != last; ++cell) {
      const auto faces = faces_that_hold(*cell);
      if (faces.size() == 1 && faces[0] == counted) continue;
      counted = faces.size() == 1 ? faces[0] : none;
      add(t, normal, faces);
    }
  }

  const std::vector<double>& angles() const { return angles_; }

private:
  struct Range {
    const Index* first;
    std::size_t number;

    const Index* begin() const { return first; }
    const Index* end() const { return first + number; }
    std::size_t size() const { return number; }
    Index operator[](std::size_t i) const { return first[i]; }
  };

  /// A cell that shrinks to an edge or a vertex goes to the best of the faces there.
  void add(Index t, const Normal& normal, Range faces)
  {
    double least = std::numeric_limits<double>::infinity();
    Index best = none;
    for (const Index face : faces) {
      const double bound = angle(t, normal, face);
      if (bound >= least) continue;
      least = bound;
      best = face;
    }
    angles_[best] = (std::max)(angles_[best], least);
  }

  double angle(Index t, const Normal& normal, Index face) const
  {
    const double bound = angle_bound(normal, normals_[face]);
    return bound < 1 && has_same_corners(t, face) ? 0 : bound;
  }

  bool has_same_corners(Index t, Index face) const
  {
    const auto &u = input_.corners(t), &v = items_.output().corners(face);
    for (int k = 0; k < 3; ++k) {
      bool same = true;
      for (int i = 0; i < 3; ++i)
        same = same && input_.point(u[i]) == items_.output().point(v[(i + k) % 3]);
      if (same) return true;
    }
    return false;
  }

  /// All faces of M that hold a cell, but for the limit at a vertex.
  Range faces_that_hold(const Cell& cell)
  {
    const Triangle_table& output = items_.output();
    unsigned at[3];
    for (int i = 0; i < 3; ++i) at[i] = items_.position_in_face(cell.items[i], cell.face);
    if (at[0] < 3 && at[0] == at[1] && at[1] == at[2])
      return faces_at(output.corners(cell.face)[at[0]]);
    for (unsigned k = 0; k < 3; ++k) {
      const auto is_on_side = [&](unsigned p) { return p == k || p == (k + 1) % 3 || p == k + 3; };
      if (!is_on_side(at[0]) || !is_on_side(at[1]) || !is_on_side(at[2])) continue;
      const auto& faces = output.edges()[output.sides(cell.face)[k]].faces;
      if (faces[0] != none && faces[1] != none) return {faces.data(), 2};
    }
    return {&cell.face, 1};
  }

  /// The first faces at a vertex of M; found for all vertices when they are first asked for.
  Range faces_at(Index vertex)
  {
    const Triangle_table& output = items_.output();
    if (faces_at_.empty()) {
      faces_at_.resize(output.number_of_vertices());
      for (Index f = 0; f < output.number_of_faces(); ++f) {
        for (const Index v : output.corners(f))
          if (faces_at_[v].size() < most_faces_at_vertex) faces_at_[v].push_back(f);
      }
    }
    return {faces_at_[vertex].data(), faces_at_[vertex].size()};
  }

  const Triangle_table& input_;
  const Items& items_;
  std::vector<double> angles_;
  std::vector<Normal> normals_; ///< of the faces of M
  std::vector<std::vector<Index>> faces_at_;
};

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_NORMALS_H
