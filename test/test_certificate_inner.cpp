// SPDX-License-Identifier: GPL-3.0-or-later
//
// Certificates of outputs whose vertices are free: points inside faces of the input go to vertices
// of the output (inner items), and vertices go to vertices with an offset. The sound ones are made
// by hand and by central projection; each is then broken in all ways that it has.
#include <surety/certificate.h>

#include "free_projection.h"
#include "polyhedra.h"
#include "sampled_distance.h"

#include <gtest/gtest.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <functional>
#include <sstream>
#include <string>

namespace {

using namespace surety::test;
using surety::Certificate;
using surety::Certificate_check;
using surety::Correspondence;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

constexpr double generous = 10;

Certificate_check check(const Mapped_pair& pair, double tolerance = generous)
{
  return surety::check_certificate(
      pair.input, pair.output, Certificate(tolerance, tolerance, pair.record));
}

/// The expected first word of the reason.
void expect_refused(
    const Mapped_pair& pair, const std::string& invariant, double tolerance = generous)
{
  const Certificate_check answer = check(pair, tolerance);
  EXPECT_FALSE(answer.holds);
  EXPECT_EQ(answer.reason.substr(0, invariant.size() + 1), invariant + ":") << answer.reason;
}

void expect_accepted(const Mapped_pair& pair)
{
  const Certificate_check answer = check(pair);
  EXPECT_TRUE(answer.holds) << answer.reason;
}

// ---- by hand ----

Mesh tetrahedron(double size = 1)
{
  Soup soup;
  soup.points = {Point(0, 0, 0), Point(size, 0, 0), Point(0, size, 0), Point(0, 0, size)};
  soup.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return to_mesh(soup);
}

/// A tetrahedron, one of whose faces is split in the output by a vertex above it.
Mapped_pair split_face(std::size_t face, double height)
{
  Mapped_pair pair = identity(tetrahedron());
  Soup soup = to_soup(pair.output);
  auto triangle = soup.triangles[face];
  const auto& [a, b, c] = triangle;
  const Point &p = soup.points[a], &q = soup.points[b], &r = soup.points[c];
  const Vector normal = CGAL::unit_normal(p, q, r);
  auto sorted = triangle;
  std::sort(sorted.begin(), sorted.end());
  // Weights in quarters and eighths, so that the place is exact.
  const Point place = soup.points[sorted[0]]
      + 0.25 * (soup.points[sorted[1]] - soup.points[sorted[0]])
      + 0.625 * (soup.points[sorted[2]] - soup.points[sorted[0]]);
  soup.points.push_back(place + height * normal);
  soup.triangles[face] = {a, b, 4};
  soup.triangles.push_back({b, c, 4});
  soup.triangles.push_back({c, a, 4});
  pair.output = to_mesh(soup);
  pair.record.inner = {{std::uint32_t(face), 4, 0.25, 0.625}};
  return pair;
}

TEST(Inner_item, of_a_face_that_the_output_splits)
{
  for (const std::size_t face : {0, 1, 2, 3}) {
    for (const double height : {0.0, 0.125, -0.0625}) {
      const Mapped_pair pair = split_face(face, height);
      const Certificate_check answer = check(pair);
      ASSERT_TRUE(answer.holds) << answer.reason;
      EXPECT_GE(answer.bound, std::abs(height));
      EXPECT_NEAR(answer.bound, std::abs(height), 1e-14);
      EXPECT_GE(answer.bound, sampled_distance(pair.input, pair.output, 1));
      const std::size_t touched = 3;
      std::size_t far = 0;
      for (const double bound : answer.face_bounds) far += bound > 0.01;
      EXPECT_EQ(far, height == 0 ? 0 : touched);
    }
  }
}

TEST(Inner_item, must_be_there)
{
  for (const std::size_t face : {0, 1, 2, 3}) {
    Mapped_pair pair = split_face(face, 0.125);
    pair.record.inner.clear();
    expect_refused(pair, "I3");
  }
}

TEST(Inner_item, must_be_in_its_face)
{
  for (const std::uint32_t face : {0, 1, 2, 3}) {
    const Mapped_pair sound = split_face(face, 0.125);
    for (const std::uint32_t other : {0, 1, 2, 3}) {
      if (other == face) continue;
      Mapped_pair broken = sound;
      broken.record.inner[0].face = other;
      expect_refused(broken, "I3");
      EXPECT_FALSE(check(broken, 0.13).holds);
    }
  }
}

TEST(Inner_item, must_go_to_its_vertex)
{
  Mapped_pair pair = split_face(2, 0.125);
  for (const std::uint32_t vertex : {1, 2, 3}) {
    pair.record.inner[0].vertex = vertex;
    expect_refused(pair, "I3");
  }
  pair.record.inner[0].vertex
      = 0; // there are cells, the other three faces, which turn the other way
  expect_refused(pair, "degree");
  for (const std::uint32_t vertex : {5u, 0xffffffffu}) {
    pair.record.inner[0].vertex = vertex;
    expect_refused(pair, "structure");
  }
}

TEST(Inner_item, is_measured)
{
  Mapped_pair pair = split_face(2, 0.125);
  EXPECT_TRUE(check(pair, 0.12501).holds);
  expect_refused(pair, "I2", 0.12499);
  pair.record.inner[0].lambda += 0.01;
  expect_accepted(pair);
  expect_refused(pair, "I2", 0.12501);
  pair.record.inner[0] = {2, 4, 0, 1};
  expect_accepted(pair);
  expect_refused(pair, "I2", 0.2);
}

TEST(Inner_item, that_does_not_fit_is_refused)
{
  const Mapped_pair sound = split_face(2, 0.125);
  using Mutation = std::function<void(std::vector<Correspondence::Inner>&)>;
  for (const Mutation& mutate : std::initializer_list<Mutation>{
           [](auto& i) { i[0].face = 4; }, [](auto& i) { i[0].face = 0xffffffffu; },
           [](auto& i) { i.push_back(i[0]); }, // two in one face
           [](auto& i) {
             i.push_back({1, 4, 0.25, 0.25});
           }, // not sorted
           [](auto& i) { i[0].lambda = -0x1p-60; }, [](auto& i) { i[0].mu = -0x1p-60; },
           [](auto& i) { i[0].lambda = NAN; }, [](auto& i) { i[0].mu = NAN; },
           [](auto& i) { i[0].mu = INFINITY; }, [](auto& i) { i[0].mu = 0.75 + 0x1p-52; }}) {
    Mapped_pair broken = sound;
    mutate(broken.record.inner);
    expect_refused(broken, "structure");
  }
}

TEST(Inner_item, that_is_not_needed_is_measured_and_does_no_harm)
{
  // At corners of their faces, and far away from them.
  Mapped_pair pair = identity(icosphere(1));
  for (std::uint32_t f = 0; f < pair.input.num_faces(); f += 3) {
    const auto h = pair.input.halfedge(Face(f));
    pair.record.inner.push_back({f, std::uint32_t(pair.input.target(h)), 0.25, 0.25});
    pair.record.inner.push_back({f + 1, 7, 0.25, 0.25});
  }
  expect_accepted(pair);
  expect_refused(pair, "I2", 1.0);
}

TEST(Inner_item, comes_before_a_face_of_the_other_side)
{
  // The input is a lens of a face and a tetrahedron's other three; in the output the face is split,
  // and those three are one face with the same corners as it.
  Soup lens;
  lens.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0.25, 0.25, -0.25)};
  lens.triangles = {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}};
  Mapped_pair pair;
  pair.input = to_mesh(lens);
  lens.points[3] = Point(0.25, 0.25, 0.25);
  lens.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  pair.output = to_mesh(lens);
  const std::uint32_t back = 0;
  pair.record.images = {at_vertex(0), at_vertex(1), at_vertex(2), at_face(back)};
  pair.record.offsets = {0};
  pair.record.inner = {{0, 3, 0.25, 0.25}};
  expect_accepted(pair);
  EXPECT_NEAR(check(pair).bound, 0.25, 1e-14);
  pair.record.inner.clear();
  expect_refused(pair, "degree");
}

TEST(Inner_item, one_does_not_serve_two_vertices)
{
  // A face of the input is split twice.
  Mapped_pair pair = split_face(2, 0);
  Soup soup = to_soup(pair.output);
  const auto [a, b, c] = soup.triangles[2];
  soup.points.push_back(CGAL::centroid(soup.points[a], soup.points[b], soup.points[c]));
  soup.triangles[2] = {a, b, 5};
  soup.triangles.push_back({b, c, 5});
  soup.triangles.push_back({c, a, 5});
  pair.output = to_mesh(soup);
  expect_refused(pair, "I3");
  pair.record.inner[0].vertex = 5;
  expect_refused(pair, "I3");
  pair.record.inner.push_back({2, 4, 0.25, 0.25});
  expect_refused(pair, "structure");
}

/// n vertices around an equator, and two poles (n and n + 1).
Mesh bipyramid(std::uint32_t n)
{
  Soup soup;
  for (std::uint32_t k = 0; k < n; ++k) {
    soup.points.emplace_back(std::cos(2 * pi * k / n), std::sin(2 * pi * k / n), 0);
    soup.triangles.push_back({k, (k + 1) % n, n});
    soup.triangles.push_back({(k + 1) % n, k, n + 1});
  }
  soup.points.emplace_back(0, 0, 0.5);
  soup.points.emplace_back(0, 0, -0.5);
  return to_mesh(soup);
}

/// A bipyramid of twelve sides that lacks its upper pole: the equator is filled with one large
/// triangle and three small ones at each of its sides. It maps to a bipyramid of 12 / turns sides,
/// so that the large triangle winds about the upper pole that often.
Mapped_pair filled_equator(std::uint32_t turns)
{
  const std::uint32_t n = 12, sides = n / turns;
  Mapped_pair pair;
  pair.output = bipyramid(sides);
  Soup soup = to_soup(bipyramid(n));
  const Point lower_pole = soup.points.back();
  soup.points.resize(n);
  soup.points.push_back(lower_pole);
  soup.triangles = {{0, 4, 8}};
  for (std::uint32_t k = 0; k < n; ++k) soup.triangles.push_back({(k + 1) % n, k, n});
  std::map<std::array<std::uint32_t, 2>, std::vector<std::uint32_t>> passed;
  for (const std::uint32_t first : {0, 4, 8}) {
    for (const std::uint32_t k : {first + 1, first + 2, first + 3}) {
      const std::uint32_t next = (k + 1) % n;
      soup.triangles.push_back({first, k, next});
      auto& spokes = passed[{std::min(first, next), std::max(first, next)}];
      for (std::uint32_t i = first + 1; i <= k; ++i) spokes.push_back(i % sides);
      if (next < first) std::reverse(spokes.begin(), spokes.end());
    }
  }
  pair.input = to_mesh(soup);
  for (std::uint32_t k = 0; k < n; ++k) pair.record.images.push_back(at_vertex(k % sides));
  pair.record.images.push_back(at_vertex(sides + 1));
  pair.record.offsets = {0};
  for (const auto& [edge, spokes] : passed) {
    pair.record.edges.push_back(edge);
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      const double lambda = double(i + 1) / double(spokes.size() + 1);
      pair.record.crossings.push_back({spokes[i], sides, lambda});
    }
    pair.record.offsets.push_back(std::uint32_t(pair.record.crossings.size()));
  }
  pair.record.inner = {{0, sides, 1.0 / 3, 1.0 / 3}};
  return pair;
}

TEST(Inner_item, serves_a_triangle_that_winds_once_but_not_more)
{
  expect_accepted(filled_equator(1));
  expect_refused(filled_equator(2), "degree");
  expect_refused(filled_equator(3), "degree");
  for (const std::uint32_t turns : {1, 2, 3}) {
    Mapped_pair pair = filled_equator(turns);
    pair.record.inner.clear();
    expect_refused(pair, "I3");
  }
}

// ---- by projection ----

class Free_output : public testing::TestWithParam<unsigned>
{
protected:
  const unsigned seed = GetParam();

  /// Coarser, as fine, and finer than their inputs.
  std::vector<Mapped_pair> examples() const
  {
    return {
        free_spheres(icosphere(2), icosphere(0), seed),
        free_spheres(icosphere(2), jittered_sphere(1, seed), seed),
        free_spheres(icosphere(1), tetrahedron_about_the_origin(), seed),
        free_spheres(icosphere(0), octahedron(), seed),
        free_spheres(octahedron(), tetrahedron_about_the_origin(), seed),
        free_spheres(tetrahedron_about_the_origin(), tetrahedron_about_the_origin(), seed),
        free_squares(4, 3, seed),
        free_squares(3, 1, seed)};
  }

  static Mesh octahedron()
  {
    Soup soup;
    for (const double s : {1.0, -1.0}) {
      soup.points.emplace_back(s, 0, 0);
      soup.points.emplace_back(0, s, 0);
      soup.points.emplace_back(0, 0, s);
    }
    soup.triangles
        = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
    return to_mesh(soup);
  }
  static Mesh tetrahedron_about_the_origin()
  {
    return translated(tetrahedron(4), Vector(-0.5, -0.5, -0.5));
  }
};

TEST_P(Free_output, is_accepted)
{
  for (const Mapped_pair& pair : examples()) {
    EXPECT_GT(pair.record.inner.size(), 1u);
    expect_accepted(pair);
  }
}

/// The distances of all inner items, exact.
double largest_inner_distance(const Mapped_pair& pair)
{
  double largest = 0;
  for (const auto& inner : pair.record.inner) {
    std::vector<std::uint32_t> v;
    const auto h = pair.input.halfedge(Face(inner.face));
    for (const Vertex w : CGAL::vertices_around_face(h, pair.input)) v.push_back(w);
    std::sort(v.begin(), v.end());
    const auto exact = [](const Point& p) { return Exact::Point_3(p.x(), p.y(), p.z()); };
    const auto at = [&](std::size_t k) { return exact(pair.input.point(Vertex(v[k]))); };
    const Exact::Point_3 x
        = at(0) + Exact::FT(inner.lambda) * (at(1) - at(0)) + Exact::FT(inner.mu) * (at(2) - at(0));
    const auto d = CGAL::squared_distance(x, exact(pair.output.point(Vertex(inner.vertex))));
    largest = std::max(largest, std::sqrt(CGAL::to_double(d)));
  }
  return largest;
}

TEST_P(Free_output, bound_is_never_below_the_truth)
{
  for (Mapped_pair pair : examples()) {
    const Certificate_check answer = check(pair);
    ASSERT_TRUE(answer.holds) << answer.reason;
    EXPECT_GE(answer.bound, sampled_distance(pair.input, pair.output, seed));
    EXPECT_GE(answer.bound, largest_inner_distance(pair) * (1 - 1e-15));
  }
}

TEST_P(Free_output, inner_items_are_measured_as_by_exact_arithmetic)
{
  // All other items stay where they are, so the bound is that of the inner item moved away.
  for (Mapped_pair pair : examples()) {
    for (const double far : {20.0, 1e6, 1e12}) {
      const std::size_t i = seed % pair.record.inner.size();
      Mapped_pair moved = pair;
      auto& p = moved.output.point(Vertex(pair.record.inner[i].vertex));
      p = p + Vector(far / 3, -far, far / 7);
      const Certificate_check answer = check(moved, 10 * far);
      ASSERT_TRUE(answer.holds) << answer.reason;
      EXPECT_GE(answer.bound, largest_inner_distance(moved) * (1 - 1e-15));
      EXPECT_LE(answer.bound, largest_inner_distance(moved) * (1 + 1e-13));
    }
  }
}

TEST_P(Free_output, every_inner_item_counts)
{
  for (const Mapped_pair& sound : examples()) {
    for (std::size_t i = 0; i < sound.record.inner.size(); ++i) {
      Mapped_pair broken = sound;
      broken.record.inner.erase(broken.record.inner.begin() + std::ptrdiff_t(i));
      expect_refused(broken, "I3");
    }
  }
}

TEST_P(Free_output, inner_items_in_neighbouring_faces_or_at_other_vertices_are_refused)
{
  for (const Mapped_pair& sound : examples()) {
    std::set<std::uint32_t> taken;
    for (const auto& inner : sound.record.inner) taken.insert(inner.face);
    for (std::size_t i = 0; i < sound.record.inner.size(); ++i) {
      Mapped_pair broken = sound;
      auto& inner = broken.record.inner[i];
      inner.vertex = broken.record.inner[(i + 1) % broken.record.inner.size()].vertex;
      expect_refused(broken, "I3");
      for (const auto h :
           CGAL::halfedges_around_face(sound.input.halfedge(Face(inner.face)), sound.input)) {
        const Face other = sound.input.face(sound.input.opposite(h));
        if (other == Mesh::null_face() || taken.count(other) > 0) continue;
        broken = sound;
        broken.record.inner[i].face = other;
        std::sort(
            broken.record.inner.begin(), broken.record.inner.end(),
            [](const auto& p, const auto& q) { return p.face < q.face; });
        expect_refused(broken, "I3");
      }
    }
  }
}

TEST_P(Free_output, certificate_survives_a_file)
{
  for (const Mapped_pair& pair : examples()) {
    std::stringstream file;
    write_certificate(file, Certificate(generous, generous, pair.record));
    const Certificate copy = surety::read_certificate(file);
    const auto answer = surety::check_certificate(pair.input, pair.output, copy);
    EXPECT_TRUE(answer.holds) << answer.reason;
    EXPECT_EQ(answer.bound, check(pair).bound);
    EXPECT_EQ(copy.correspondence()->inner.size(), pair.record.inner.size());
  }
}

TEST_P(Free_output, bound_scales_exactly_with_powers_of_two)
{
  for (const Mapped_pair& pair : examples()) {
    for (const double scale : {0x1p10, 0x1p-300}) {
      const Mapped_pair other{scaled(pair.input, scale), scaled(pair.output, scale), pair.record};
      EXPECT_EQ(check(other, generous * scale).bound, check(pair).bound * scale);
    }
  }
}

TEST_P(Free_output, faces_are_counted_in_iteration_order_when_the_mesh_has_gaps)
{
  Mapped_pair pair = free_spheres(icosphere(2), icosphere(0), seed);
  Mesh holey = joined({icosphere(0), pair.input});
  for (int f = 0; f < 20; ++f) CGAL::Euler::remove_face(holey.halfedge(Face(f)), holey);
  ASSERT_TRUE(holey.has_garbage());
  pair.input = holey;
  expect_accepted(pair);
}

// ---- vertices with an offset ----

TEST_P(Free_output, vertices_may_go_to_vertices_elsewhere)
{
  Mapped_pair pair = sphere_on_hull(2, 30, seed);
  pair.output = scaled(pair.output, 1.0625);
  const Certificate_check answer = check(pair);
  ASSERT_TRUE(answer.holds) << answer.reason;
  double largest = 0;
  for (std::uint32_t v = 0; v < pair.record.images.size(); ++v) {
    const Image& image = pair.record.images[v];
    if (image.kind != Kind::vertex) continue;
    const Point &p = pair.input.point(Vertex(v)), &q = pair.output.point(Vertex(image.a));
    largest = std::max(largest, std::sqrt(CGAL::squared_distance(p, q)));
  }
  EXPECT_GT(largest, 0.04);
  EXPECT_GE(answer.bound, largest);
  EXPECT_GE(answer.bound, sampled_distance(pair.input, pair.output, seed));
  expect_refused(pair, "I2", largest * (1 - 1e-12));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Free_output, testing::Range(0u, 6u));

} // namespace
