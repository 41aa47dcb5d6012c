// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the verifier of distances: bounds of the distance from a point to a triangle against
// exact arithmetic, the change of coordinates, and the cuts of cells.
#include <surety/distance.h>

#include "exact_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace {

using surety::test::Exact_point;
using surety::test::Exact_triangle;
using surety::test::Random;
using surety::test::Rational;
using namespace surety::internal::hausdorff;

Point random_point(Random& random)
{
  return Point(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
}

Exact_point exact(const Point& p) { return {p.x(), p.y(), p.z()}; }

Rational exact_squared_distance(const Point& p, const Triangle& t)
{
  return surety::test::squared_distance_to_triangle(
      exact(p), Exact_triangle{exact(t[0]), exact(t[1]), exact(t[2])});
}

/// From fair triangles to needles, caps, segments and points.
Triangle random_triangle(Random& random, double thickness)
{
  const Point a = random_point(random), b = random_point(random);
  const Point on_ab = a + random.between(-1, 2) * (b - a);
  Triangle t = {a, b, on_ab + thickness * (random_point(random) - CGAL::ORIGIN)};
  if (random.below(10) == 0) t[2] = t[random.below(2)];
  if (random.below(20) == 0) t[1] = t[2] = t[0];
  const double size = std::pow(2., -double(random.below(40)));
  for (Point& p : t) p = t[0] + size * (p - t[0]);
  return t;
}

class Thickness : public testing::TestWithParam<double>
{};

TEST_P(Thickness, bounds_enclose_the_exact_distance)
{
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const Triangle t = random_triangle(random, GetParam());
    Point p = random_point(random);
    // Close points, and points on the triangle up to rounding, are the hard ones.
    if (i % 3 != 0) p = CGAL::centroid(t[0], t[1], t[2]);
    if (i % 3 == 1) p = p + std::pow(2., -double(random.below(60))) * (random_point(random) - p);
    const Bounds bounds = distance_bounds(p, t);
    const Rational squared = exact_squared_distance(p, t);
    EXPECT_LE(0, bounds.lower);
    EXPECT_LE(Rational(bounds.lower) * Rational(bounds.lower), squared);
    EXPECT_GE(Rational(bounds.upper) * Rational(bounds.upper), squared);
    EXPECT_EQ(bounds.upper, distance_upper_bound(p, t));
  }
}

TEST_P(Thickness, bounds_are_sharp)
{
  Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const Triangle t = random_triangle(random, GetParam());
    const Point p = random_point(random);
    const Bounds bounds = distance_bounds(p, t);
    // The edges of a needle stand in for its interior, whose plane is ill-conditioned.
    EXPECT_LE(bounds.upper - bounds.lower, GetParam() >= 0.1 ? 1e-12 : 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Needles, Thickness, testing::Values(1., 1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-16, 0.));

Soup soup_of(const std::vector<Coordinates>& points) { return {points, {{0, 0, 0}}}; }

TEST(Frame, is_exact_at_the_points_of_the_meshes)
{
  Random random(3);
  for (const double offset : {0., 1., 1e3, -1e9, 1e15}) {
    for (const double size : {1., 1e-8, 1e8, 1e200, 1e-200}) {
      std::vector<Coordinates> points;
      for (int i = 0; i < 50; ++i) {
        points.push_back({size * (offset + random.unit()), size * random.unit(), -size});
      }
      const Frame frame(soup_of(points), soup_of(points));
      for (const Coordinates& p : points) {
        const Point local = frame.to_local(p);
        EXPECT_LT(largest_coordinate(local - CGAL::ORIGIN), 1);
        EXPECT_EQ(frame.to_mesh(local), p);
      }
      const Point &p = frame.to_local(points[0]), &q = frame.to_local(points[1]);
      EXPECT_EQ(
          Rational(p.x()) - Rational(q.x()),
          (Rational(points[0][0]) - Rational(points[1][0])) * Rational(frame.to_local(1.)));
    }
  }
}

TEST(Frame, rounds_lengths_outwards)
{
  const Frame frame(soup_of({{1e-310, 0, 0}}), soup_of({{3e-310, 0, 0}}));
  const double third = 1. / 3;
  EXPECT_GT(frame.to_local(frame.upper_to_mesh(third)), third);
  EXPECT_LT(frame.to_local(frame.lower_to_mesh(third)), third);
  EXPECT_EQ(frame.upper_to_mesh(0), 0);
}

/// Cuts a random triangle again and again, by planes, chords and bisections alike.
std::vector<Cell> cut_at_random(std::vector<Corner>& corners, Random& random, int cuts)
{
  std::vector<Cell> cells(1);
  for (std::uint32_t i = 0; i < 3; ++i) cells[0].push_back(i);
  for (int i = 0; i < cuts; ++i) {
    const std::size_t k = random.below(cells.size());
    const Cell cell = cells[k];
    Cell_values values;
    const Vector normal = random_point(random) - CGAL::ORIGIN;
    const Point origin = CGAL::midpoint(corners[cell[0]].point, corners[cell[1]].point);
    for (int j = 0; j < cell.size(); ++j) {
      values[j] = normal * (corners[cell[j]].point - origin);
      if (random.below(10) == 0) values[j] = 0;
    }
    if (cell.size() > Cell::comfortable) values = chord_values(cell);
    if (!is_proper_cut(cell, values)) continue;
    const auto pieces = cut(cell, values, corners);
    cells[k] = pieces.first;
    cells.push_back(pieces.second);
  }
  return cells;
}

TEST(Cells, cover_what_they_are_cut_from)
{
  // In the plane of the triangle, exactly: a point is in a convex polygon if it is on the same side
  // of all edges, up to the error that the corners claim.
  for (unsigned seed = 0; seed < 20; ++seed) {
    Random random(seed);
    std::vector<Corner> corners(3);
    for (Corner& c : corners) c.point = Point(random.unit(), random.unit(), 0);
    const Triangle t = {corners[0].point, corners[1].point, corners[2].point};
    const std::vector<Cell> cells = cut_at_random(corners, random, 60);
    EXPECT_GT(cells.size(), 10u);
    for (int i = 0; i < 200; ++i) {
      double r = random.unit(), s = random.unit();
      if (r + s > 1) r = 1 - r, s = 1 - s;
      const Point p = t[0] + r * (t[1] - t[0]) + s * (t[2] - t[0]);
      const bool is_covered = std::any_of(cells.begin(), cells.end(), [&](const Cell& cell) {
        double low = 0, high = 0;
        for (int j = 0; j < cell.size(); ++j) {
          const Point &a = corners[cell[j]].point, &b = corners[cell[cell.after(j)]].point;
          const double side = CGAL::cross_product(b - a, p - a).z();
          low = (std::min)(low, side);
          high = (std::max)(high, side);
        }
        return (std::min)(-low, high) <= 1e-14;
      });
      EXPECT_TRUE(is_covered) << "seed " << seed;
    }
  }
}

TEST(Cells, stay_in_the_triangle_within_their_error)
{
  for (unsigned seed = 0; seed < 20; ++seed) {
    Random random(seed);
    std::vector<Corner> corners(3);
    for (Corner& c : corners) c.point = random_point(random);
    const Triangle t = {corners[0].point, corners[1].point, corners[2].point};
    cut_at_random(corners, random, 60);
    for (const Corner& c : corners) {
      EXPECT_LE(exact_squared_distance(c.point, t), Rational(c.error) * Rational(c.error));
      EXPECT_LT(c.error, 1e-13);
    }
  }
}

TEST(Cells, are_cut_only_where_the_signs_change_twice)
{
  Cell square;
  for (std::uint32_t i = 0; i < 4; ++i) square.push_back(i);
  EXPECT_TRUE(is_proper_cut(square, {1, 1, -1, -1}));
  EXPECT_TRUE(is_proper_cut(square, {1, 0, -1, 0}));
  EXPECT_TRUE(is_proper_cut(square, chord_values(square)));
  EXPECT_FALSE(is_proper_cut(square, {1, -1, 1, -1}));
  EXPECT_FALSE(is_proper_cut(square, {1, 0, 0, 1}));
  EXPECT_FALSE(is_proper_cut(square, {0, 0, 0, 0}));
}

TEST(Face_tree, bounds_enclose_the_distance_to_all_faces)
{
  for (unsigned seed = 0; seed < 10; ++seed) {
    Random random(seed);
    Soup soup;
    for (std::uint32_t f = 0; f < 60; ++f) {
      for (const Point& p : random_triangle(random, f % 3 == 0 ? 1e-6 : 1.)) {
        soup.points.push_back({p.x(), p.y(), p.z()});
      }
      soup.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    const Frame frame(soup, soup);
    const Triangle_set triangles(soup, frame);
    const Face_tree tree(triangles);
    for (int i = 0; i < 50; ++i) {
      const Point p = random_point(random);
      const auto nearest = tree.nearest(p, std::uint32_t(random.below(60)));
      Rational best = exact_squared_distance(p, triangles.triangle(0));
      for (std::uint32_t f = 1; f < 60; ++f) {
        best = (std::min)(best, exact_squared_distance(p, triangles.triangle(f)));
      }
      EXPECT_LE(Rational(nearest.lower) * Rational(nearest.lower), best);
      EXPECT_GE(Rational(nearest.upper) * Rational(nearest.upper), best);
      EXPECT_GE(
          Rational(nearest.upper) * Rational(nearest.upper),
          exact_squared_distance(p, triangles.triangle(nearest.face)));
      EXPECT_LE(nearest.upper - nearest.lower, 1e-5);
    }
  }
}

} // namespace
