// SPDX-License-Identifier: GPL-3.0-or-later
//
// The normal deviations of a certificate: never below, and hardly above, what a computation in high
// precision finds for all pairs of faces that lie over each other.
#include <surety/certificate.h>

#include "free_projection.h"
#include "polyhedra.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using namespace surety::test;
using surety::Certificate;
using surety::Certificate_check;
using surety::Correspondence;
using Real = boost::multiprecision::cpp_bin_float_100;
using Triangle = std::array<Point, 3>;

constexpr double generous = 10;

Certificate_check check(const Mapped_pair& pair)
{
  return surety::check_certificate(
      pair.input, pair.output, Certificate(generous, generous, pair.record));
}

Triangle triangle(const Mesh& mesh, Face f)
{
  const auto h = mesh.halfedge(f);
  return {
      mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
      mesh.point(mesh.target(mesh.next(h)))};
}

using Real_vector = std::array<Real, 3>;

Real_vector cross(const Real_vector& a, const Real_vector& b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Real dot(const Real_vector& a, const Real_vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Real_vector normal(const Triangle& t)
{
  const auto side = [&](std::size_t k) {
    Real_vector d;
    for (int i = 0; i < 3; ++i) d[std::size_t(i)] = Real(t[k][i]) - Real(t[0][i]);
    return d;
  };
  return cross(side(1), side(2));
}

/// In degrees; both triangles have an area.
Real angle(const Triangle& s, const Triangle& t)
{
  const Real_vector a = normal(s), b = normal(t), c = cross(a, b);
  return atan2(sqrt(dot(c, c)), dot(a, b)) * 180 / boost::math::constants::pi<Real>();
}

// ---- two triangles ----

/// The certificate of a single triangle mapped to another.
double angle_of_certificate(const Triangle& s, const Triangle& t, double tolerance)
{
  Mesh input, output;
  CGAL::make_triangle(s[0], s[1], s[2], input);
  CGAL::make_triangle(t[0], t[1], t[2], output);
  Correspondence record;
  const auto vertex_at = [&](const Point& p) {
    for (std::uint32_t v = 0; v < 3; ++v)
      if (output.point(Vertex(v)) == t[std::size_t(std::find(s.begin(), s.end(), p) - s.begin())])
        return v;
    return ~0u;
  };
  for (const Vertex v : input.vertices())
    record.images.push_back(at_vertex(vertex_at(input.point(v))));
  record.offsets = {0};
  const auto answer
      = surety::check_certificate(input, output, Certificate(tolerance, tolerance, record));
  EXPECT_TRUE(answer.holds) << answer.reason;
  return answer.largest_normal_deviation;
}

class Two_triangles : public testing::TestWithParam<unsigned>
{
protected:
  Random random{GetParam()};

  Point point() { return Point(0, 0, 0) + random.in_cube(); }

  void expect_angle(const Triangle& s, const Triangle& t, double slack, double tolerance = 100)
  {
    const double bound = angle_of_certificate(s, t, tolerance);
    const Real exact = angle(s, t);
    EXPECT_GE(Real(bound), exact);
    EXPECT_LE(Real(bound), exact + slack);
  }
};

TEST_P(Two_triangles, of_any_kind)
{
  for (int i = 0; i < 200; ++i)
    expect_angle({point(), point(), point()}, {point(), point(), point()}, 1e-9);
}

TEST_P(Two_triangles, that_are_nearly_parallel_or_nearly_opposite)
{
  for (int i = 0; i < 200; ++i) {
    const Triangle s = {point(), point(), point()};
    for (const double step : {1e-3, 1e-8, 1e-12, 1e-15}) {
      Triangle t = s;
      for (Point& p : t) p = p + step * random.in_cube();
      if (t[0] == s[0] && t[1] == s[1] && t[2] == s[2]) continue;
      expect_angle(s, t, 1e-9);
      expect_angle(s, {t[1], t[0], t[2]}, 1e-9);
    }
  }
}

TEST_P(Two_triangles, that_are_needles_and_caps)
{
  for (int i = 0; i < 100; ++i) {
    const Triangle t = {point(), point(), point()};
    for (const double thin : {1e-3, 1e-6, 1e-9}) {
      const Point p = point(), q = point();
      const Point needle = q + thin * random.in_cube();
      const Point cap = CGAL::midpoint(p, q) + thin * random.in_cube();
      // Coordinates are exact, so a needle's normal hardly suffers; a cap's error grows as 1 /
      // thin.
      expect_angle({p, q, needle}, t, 1e-8);
      expect_angle({q, needle, p}, t, 1e-8);
      expect_angle({p, q, cap}, t, 1e-10 / thin);
    }
  }
}

TEST_P(Two_triangles, that_are_far_from_the_origin_small_or_large)
{
  for (int i = 0; i < 50; ++i) {
    const Vector far = 1e6 * random.in_cube();
    expect_angle(
        {point() + far, point() + far, point() + far}, {point(), point(), point()}, 1e-9, 1e8);
    for (const double scale : {0x1p-400, 0x1p-100, 0x1p100, 0x1p300}) {
      const auto scaled = [&] { return Point(0, 0, 0) + scale * random.in_cube(); };
      expect_angle(
          {scaled(), scaled(), scaled()}, {scaled(), scaled(), scaled()}, 1e-9, 100 * scale);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Two_triangles, testing::Range(0u, 5u));

TEST(Normal_deviation, of_a_face_without_area_is_180)
{
  const Triangle sound = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  const Triangle flat = {Point(0, 0, 0), Point(1, 0, 0), Point(3, 0, 0)};
  const Triangle slanted = {Point(0, 0, 0), Point(0.1, 0.3, 0.7), Point(0.2, 0.6, 1.4)};
  const Triangle tiny = {Point(0, 0, 0), Point(1e-200, 0, 0), Point(0, 1e-200, 0)};
  for (const Triangle& other : {flat, slanted}) {
    EXPECT_EQ(angle_of_certificate(other, sound, 10), 180);
    EXPECT_EQ(angle_of_certificate(sound, other, 10), 180);
    EXPECT_EQ(angle_of_certificate(flat, other, 10), 180);
  }
  EXPECT_EQ(angle_of_certificate(sound, tiny, 10), 180);
  EXPECT_EQ(angle_of_certificate(sound, sound, 10), 0);
}

TEST(Normal_deviation, of_opposite_faces_is_180)
{
  const Triangle up = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  EXPECT_EQ(angle_of_certificate(up, {up[1], up[0], up[2]}, 10), 180);
}

// ---- whole meshes ----

TEST(Normal_deviation, of_the_identity_is_zero)
{
  for (const Mesh& mesh :
       {cube(2), icosphere(2), torus(8, 6), grid(4), rotated(saddle(5), 1), two_sheets(3, 0.1)}) {
    const Certificate_check answer = check(identity(mesh));
    ASSERT_TRUE(answer.holds) << answer.reason;
    EXPECT_EQ(answer.normal_deviations, std::vector<double>(mesh.num_faces(), 0));
    EXPECT_EQ(answer.largest_normal_deviation, 0);
  }
}

TEST(Normal_deviation, of_a_refinement_is_that_of_rounding)
{
  for (const Mesh& mesh : {cube(), icosphere(1), torus(5, 4), annulus(6, 1)}) {
    const Certificate_check answer = check(refinement(rotated(mesh, 1), 3));
    ASSERT_TRUE(answer.holds) << answer.reason;
    EXPECT_LT(answer.largest_normal_deviation, 1e-10);
  }
}

TEST(Normal_deviation, is_not_proven_if_the_certificate_does_not_hold)
{
  Mapped_pair pair = identity(cube());
  pair.record.images[0] = at_vertex(7);
  const Certificate_check answer = check(pair);
  ASSERT_FALSE(answer.holds);
  EXPECT_TRUE(answer.normal_deviations.empty());
  EXPECT_EQ(answer.largest_normal_deviation, std::numeric_limits<double>::infinity());
}

/// Whether two triangles, seen from the origin, cover a common area: two cones are separated by a
/// plane through two of their rays, if at all, and on which side a corner lies is decided exactly.
bool overlap(const Triangle& s, const Triangle& t)
{
  std::vector<Point> rays(s.begin(), s.end());
  rays.insert(rays.end(), t.begin(), t.end());
  for (const Point& p : rays) {
    for (const Point& q : rays) {
      if (p == q) continue;
      const auto side = [&](const Point& r) { return CGAL::orientation({0, 0, 0}, p, q, r); };
      const auto in_front = [&](const Point& r) { return side(r) != CGAL::NEGATIVE; };
      const auto behind = [&](const Point& r) { return side(r) != CGAL::POSITIVE; };
      if (std::all_of(s.begin(), s.end(), in_front) && std::all_of(t.begin(), t.end(), behind))
        return false;
    }
  }
  return true;
}

/// For central projections: the largest angle of all pairs of faces that lie over each other.
std::vector<double> brute_force_deviations(const Mapped_pair& pair)
{
  std::vector<double> largest(pair.output.num_faces(), 0);
  for (const Face f : pair.output.faces()) {
    const Triangle t = triangle(pair.output, f);
    for (const Face g : pair.input.faces()) {
      const Triangle s = triangle(pair.input, g);
      if (overlap(s, t)) largest[f] = std::max(largest[f], double(angle(s, t)));
    }
  }
  return largest;
}

class Projection : public testing::TestWithParam<unsigned>
{};

TEST_P(Projection, normal_deviations_agree_with_brute_force)
{
  for (const Mapped_pair& pair :
       {sphere_on_hull(2, 20, GetParam()), sphere_on_hull(1, 8, GetParam()),
        sphere_on_hull(2, 60, GetParam()), free_spheres(icosphere(2), icosphere(0), GetParam()),
        free_spheres(icosphere(1), jittered_sphere(1, GetParam()), GetParam())}) {
    const Certificate_check answer = check(pair);
    ASSERT_TRUE(answer.holds) << answer.reason;
    const std::vector<double> expected = brute_force_deviations(pair);
    ASSERT_EQ(answer.normal_deviations.size(), expected.size());
    double largest = 0;
    for (std::size_t f = 0; f < expected.size(); ++f) {
      EXPECT_GE(answer.normal_deviations[f], expected[f] * (1 - 1e-15));
      EXPECT_NEAR(answer.normal_deviations[f], expected[f], 1e-9);
      largest = std::max(largest, answer.normal_deviations[f]);
    }
    EXPECT_EQ(answer.largest_normal_deviation, largest);
    EXPECT_GT(largest, 5);
  }
}

TEST_P(Projection, normal_deviations_do_not_change_with_the_scale)
{
  const Mapped_pair pair = sphere_on_hull(2, 20, GetParam());
  const auto expected = check(pair).normal_deviations;
  for (const double scale : {0x1p10, 0x1p-10, 0x1p-300}) {
    const Mapped_pair other{scaled(pair.input, scale), scaled(pair.output, scale), pair.record};
    const auto answer = surety::check_certificate(
        other.input, other.output, Certificate(generous * scale, generous * scale, other.record));
    EXPECT_EQ(answer.normal_deviations, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Projection, testing::Range(0u, 6u));

// ---- cells without a face of their own ----

/// A tetrahedron with a corner O, and X, Y and Z on the axes. In the input, the face z = 0, (O, Y,
/// X), is cut into the given triangles with more points, from 4 on, which have the given images.
double deviation_of_split_corner(
    const std::vector<Point>& points, const std::vector<Image>& images,
    const std::vector<std::array<std::size_t, 3>>& triangles)
{
  Soup soup;
  soup.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)};
  soup.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  Mapped_pair pair = identity(to_mesh(soup));
  soup.points.insert(soup.points.end(), points.begin(), points.end());
  soup.triangles.erase(soup.triangles.begin());
  for (const auto& t : triangles) soup.triangles.push_back({t[0], t[1], t[2]});
  pair.input = to_mesh(soup);
  for (const Image& image : images) pair.record.images.push_back(image);
  const Certificate_check answer = check(pair);
  EXPECT_TRUE(answer.holds) << answer.reason;
  return answer.largest_normal_deviation;
}

constexpr double small = 0x1p-20;

TEST(Normal_deviation, compares_a_cell_at_an_edge_with_the_better_face)
{
  // P is near the middle of the edge (O, X) and goes to it. The triangle (X, O, P) lies in the
  // plane of either of its faces, or in that of y = 0 with the opposite orientation.
  const auto deviation = [](double y, double z) {
    return deviation_of_split_corner(
        {Point(0.5, y, z)}, {on_edge(0, 1)}, {{0, 2, 4}, {2, 1, 4}, {1, 0, 4}});
  };
  EXPECT_LT(deviation(small, 0), 1e-3);
  EXPECT_LT(deviation(0, -small), 1e-3);
  EXPECT_NEAR(deviation(0, small), 90, 1e-3);
}

TEST(Normal_deviation, compares_a_cell_at_a_vertex_with_the_best_face)
{
  // P and Q are near O and go to it. The triangle (O, Q, P) lies in the plane x = 0, with its
  // orientation or against it; the others are at an edge that has a face for them, or nearly in z =
  // 0.
  const auto deviation = [](double z) {
    return deviation_of_split_corner(
        {Point(0, 0, z), Point(0, small, z)}, {at_vertex(0), at_vertex(0)},
        {{0, 5, 4}, {0, 2, 5}, {2, 1, 5}, {5, 1, 4}, {1, 0, 4}});
  };
  EXPECT_LT(deviation(-small), 1e-3);
  EXPECT_NEAR(deviation(small), 90, 1e-3);
}

} // namespace
