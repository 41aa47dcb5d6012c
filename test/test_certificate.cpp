// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate checker: it accepts sound maps, whoever made them, refuses a map for each way in
// which one of its invariants can be broken, and its bound agrees with a brute-force computation.
#include <surety/certificate.h>

#include "overlay.h"
#include "polyhedra.h"
#include "sampled_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace {

using namespace surety::test;
using surety::Certificate;
using surety::Certificate_check;
using surety::Correspondence;

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
  EXPECT_EQ(answer.bound, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(answer.face_bounds.empty());
}

void expect_accepted(const Mapped_pair& pair, double tolerance = generous)
{
  const Certificate_check answer = check(pair, tolerance);
  EXPECT_TRUE(answer.holds) << answer.reason;
  EXPECT_TRUE(answer.reason.empty());
  EXPECT_LE(answer.bound, tolerance);
  ASSERT_EQ(answer.face_bounds.size(), pair.output.number_of_faces());
  for (const double b : answer.face_bounds) EXPECT_LE(b, answer.bound);
}

Correspondence::Image& image_of(Mapped_pair& pair, std::uint32_t v)
{
  return pair.record.images[v];
}

/// The crossings of one edge, replaced.
void set_crossings(
    Mapped_pair& pair, std::size_t edge, const std::vector<Correspondence::Crossing>& crossings)
{
  auto& r = pair.record;
  const auto first = r.offsets[edge], last = r.offsets[edge + 1];
  r.crossings.erase(r.crossings.begin() + first, r.crossings.begin() + last);
  r.crossings.insert(r.crossings.begin() + first, crossings.begin(), crossings.end());
  for (std::size_t i = edge + 1; i < r.offsets.size(); ++i) {
    r.offsets[i] += std::uint32_t(crossings.size()) - (last - first);
  }
}

std::vector<Correspondence::Crossing> crossings_of(const Mapped_pair& pair, std::size_t edge)
{
  const auto& r = pair.record;
  return {r.crossings.begin() + r.offsets[edge], r.crossings.begin() + r.offsets[edge + 1]};
}

/// n vertices around an equator, and two poles (n and n + 1).
Mesh bipyramid(std::uint32_t n)
{
  Soup soup;
  for (std::uint32_t i = 0; i < n; ++i) {
    soup.points.emplace_back(std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0);
    soup.triangles.push_back({i, (i + 1) % n, n});
    soup.triangles.push_back({(i + 1) % n, i, n + 1});
  }
  soup.points.emplace_back(0, 0, 1);
  soup.points.emplace_back(0, 0, -1);
  return to_mesh(soup);
}

// ---- sound maps ----

TEST(Check_certificate, accepts_the_identity_with_bound_zero)
{
  for (const Mesh& mesh :
       {cube(2), icosphere(2), torus(8, 6), grid(4), annulus(9, 2), saddle(5), two_sheets(3, 0.1),
        plate_with_holes(2), bipyramid(3), spheres_at_scales(3)}) {
    expect_accepted(identity(mesh));
    EXPECT_EQ(check(identity(mesh)).bound, 0);
  }
}

TEST(Check_certificate, accepts_a_tetrahedron_and_a_single_triangle)
{
  Mesh tetrahedron;
  CGAL::make_tetrahedron(
      Point(0, 0, 0), Point(0, 1, 0), Point(1, 0, 0), Point(0, 0, 1), tetrahedron);
  expect_accepted(identity(tetrahedron));
  Mesh triangle;
  CGAL::make_triangle(Point(0, 0, 0), Point(0, 1, 0), Point(1, 0, 0), triangle);
  expect_accepted(identity(triangle));
  expect_accepted(refinement(triangle, 3));
}

TEST(Check_certificate, accepts_nested_refinements_with_a_bound_of_rounding_errors)
{
  for (const Mesh& mesh : {cube(), icosphere(1), torus(5, 4), grid(2), annulus(6, 1), saddle(2)}) {
    const Mapped_pair pair = refinement(rotated(mesh, 1), 3);
    expect_accepted(pair);
    EXPECT_LT(check(pair).bound, 1e-13);
  }
}

TEST(Check_certificate, accepts_a_refinement_far_from_the_origin)
{
  // Coordinates near 2^20 have a spacing of 2^-32, so the midpoints leave the faces by that much.
  const Mapped_pair pair = refinement(translated(rotated(cube(), 1), Vector(1 << 20, 0, 0)), 3);
  expect_accepted(pair);
  EXPECT_LT(check(pair).bound, 0x1p-30);
}

class Overlay : public testing::TestWithParam<unsigned>
{
protected:
  const unsigned seed = GetParam();
};

TEST_P(Overlay, accepts_central_projections)
{
  for (const std::size_t vertices : {6, 10, 30, 100})
    expect_accepted(sphere_on_hull(2, vertices, seed));
  for (const double keep : {0.0, 0.02, 0.2, 0.7}) expect_accepted(square_on_square(12, keep, seed));
}

/// The distances of all items, with exact constructions nowhere near those of the checker.
double brute_force_bound(const Mapped_pair& pair)
{
  const auto distance = [&](const Point& x, const Correspondence::Image& image) {
    const auto at = [&](std::uint32_t v) { return pair.output.point(Vertex(v)); };
    if (image.kind == Kind::vertex) return std::sqrt(CGAL::squared_distance(x, at(image.a)));
    if (image.kind == Kind::edge) {
      return std::sqrt(CGAL::squared_distance(x, Kernel::Segment_3(at(image.a), at(image.b))));
    }
    const auto h = pair.output.halfedge(Face(image.a));
    return std::sqrt(CGAL::squared_distance(
        x,
        Kernel::Triangle_3(
            at(pair.output.source(h)), at(pair.output.target(h)),
            at(pair.output.target(pair.output.next(h))))));
  };
  double bound = 0;
  for (std::uint32_t v = 0; v < pair.record.images.size(); ++v) {
    bound = std::max(bound, distance(pair.input.point(Vertex(v)), pair.record.images[v]));
  }
  for (std::size_t e = 0; e < pair.record.edges.size(); ++e) {
    const auto [s, t] = pair.record.edges[e];
    for (const auto& c : crossings_of(pair, e)) {
      const Point p = pair.input.point(Vertex(s)), q = pair.input.point(Vertex(t));
      bound = std::max(bound, distance(p + c.lambda * (q - p), on_edge(c.a, c.b)));
    }
  }
  return bound;
}

TEST_P(Overlay, bound_agrees_with_brute_force_and_is_never_below_a_sampled_distance)
{
  for (Mapped_pair pair : {sphere_on_hull(2, 20, seed), square_on_square(10, 0.1, seed)}) {
    pair.input = jittered(pair.input, 0.02, seed);
    const Certificate_check answer = check(pair);
    ASSERT_TRUE(answer.holds) << answer.reason;
    EXPECT_NEAR(answer.bound, brute_force_bound(pair), 1e-13);
    EXPECT_GE(answer.bound, sampled_distance(pair.input, pair.output, seed));
    const double largest = *std::max_element(answer.face_bounds.begin(), answer.face_bounds.end());
    EXPECT_EQ(largest, answer.bound);
  }
}

TEST_P(Overlay, every_face_bound_covers_the_samples_of_its_face)
{
  Mapped_pair pair = sphere_on_hull(2, 20, seed);
  pair.input = jittered(pair.input, 0.02, seed);
  const Certificate_check answer = check(pair);
  ASSERT_TRUE(answer.holds) << answer.reason;
  for (const Face f : pair.output.faces()) {
    Mesh face;
    const auto h = pair.output.halfedge(f);
    CGAL::make_triangle(
        pair.output.point(pair.output.source(h)), pair.output.point(pair.output.target(h)),
        pair.output.point(pair.output.target(pair.output.next(h))), face);
    EXPECT_GE(answer.face_bounds[f], sampled_distance_to(face, pair.input, seed, 6));
  }
}

TEST_P(Overlay, bound_scales_exactly_with_powers_of_two)
{
  Mapped_pair pair = sphere_on_hull(2, 20, seed);
  const double bound = check(pair).bound;
  for (const double scale : {0x1p10, 0x1p-10}) {
    Mapped_pair other{scaled(pair.input, scale), scaled(pair.output, scale), pair.record};
    EXPECT_EQ(check(other, generous * scale).bound, bound * scale);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Overlay, testing::Range(0u, 6u));

TEST(Check_certificate, counts_elements_in_iteration_order_when_the_mesh_has_gaps)
{
  Mapped_pair pair = identity(cube(2));
  Mesh holey = joined({icosphere(0), pair.input});
  for (int f = 0; f < 20; ++f) CGAL::Euler::remove_face(holey.halfedge(Face(f)), holey);
  ASSERT_TRUE(holey.has_garbage());
  pair.input = holey;
  expect_accepted(pair);
  pair.output = holey;
  expect_accepted(pair);
}

TEST(Check_certificate, reads_the_vertex_point_map_of_each_mesh)
{
  Mapped_pair pair = identity(cube());
  auto moved = pair.input.add_property_map<Vertex, Point>("v:moved").first;
  for (const Vertex v : pair.input.vertices()) moved[v] = pair.input.point(v) + Vector(0, 0, 2);
  const Certificate certificate(generous, generous, pair.record);
  const auto bound = [&](const auto& np) {
    return surety::check_certificate(pair.input, pair.output, certificate, np).bound;
  };
  EXPECT_EQ(bound(CGAL::parameters::default_values()), 0);
  EXPECT_NEAR(bound(CGAL::parameters::vertex_point_map(moved)), 2, 1e-14);
}

// ---- each invariant broken ----

TEST(Check_certificate, refuses_a_record_that_does_not_fit)
{
  const Mapped_pair sound = square_on_square(8, 0.1, 3);
  ASSERT_TRUE(check(sound).holds);
  ASSERT_GT(sound.record.edges.size(), 2u);
  using Mutation = std::function<void(Correspondence&)>;
  const std::uint32_t huge = 0xfffffff0u;
  for (const Mutation& mutate : std::initializer_list<Mutation>{
           [](auto& r) { r.images.pop_back(); },
           [](auto& r) { r.images.push_back(at_vertex(0)); },
           [](auto& r) { r.images.clear(); },
           [&](auto& r) { r.images[0].a = huge; },
           [&](auto& r) { r.images[0] = at_face(huge); },
           [&](auto& r) {
             r.images[0] = {Kind::edge, huge, huge + 1};
           },
           [](auto& r) {
             r.images[0] = {Kind::edge, 3, 3};
           },
           [](auto& r) {
             r.images[0] = {Kind::vertex, 0, 1};
           },
           [](auto& r) {
             r.images[0] = {Kind(7), 0, 0};
           },
           [](auto& r) { r.edges.pop_back(); },
           [](auto& r) { std::swap(r.edges[0], r.edges[1]); },
           [](auto& r) { std::swap(r.edges[0][0], r.edges[0][1]); },
           [](auto& r) { r.edges[1] = r.edges[0]; },
           [&](auto& r) {
             r.edges.back() = {huge, huge + 1};
           },
           [](auto& r) { r.offsets.pop_back(); },
           [](auto& r) { r.offsets[0] = 1; },
           [&](auto& r) { r.offsets[1] = huge; },
           [](auto& r) { ++r.offsets.back(); },
           [](auto& r) { r.crossings.pop_back(); },
           [](auto& r) { r.crossings[0].lambda = -0x1p-60; },
           [](auto& r) { r.crossings[0].lambda = 1 + 0x1p-52; },
           [](auto& r) { r.crossings[0].lambda = NAN; },
           [](auto& r) { std::swap(r.crossings[0].a, r.crossings[0].b); },
           [&](auto& r) { r.crossings[0].b = huge; },
           [](auto& r) {
             r.ridges = {{1, 0}};
           },
           [&](auto& r) {
             r.ridges = {{0, huge}};
           }}) {
    Mapped_pair broken = sound;
    mutate(broken.record);
    expect_refused(broken, "structure");
  }
}

TEST(Check_certificate, refuses_edges_that_do_not_exist)
{
  Mapped_pair pair = sphere_on_hull(1, 8, 1);
  pair.record.images[5] = on_edge(0, 7); // opposite sides of a cube-like hull, or
  bool refused = !check(pair).holds;     // an edge that does not touch the neighbours' faces
  EXPECT_TRUE(refused);

  pair = identity(grid(3));
  pair.record.edges = {{0, 15}}; // opposite corners
  pair.record.offsets = {0, 1};
  pair.record.crossings = {{5, 6, 0.5}};
  expect_refused(pair, "structure");
}

TEST(Check_certificate, refuses_decreasing_parameters)
{
  Mapped_pair pair = square_on_square(8, 0.05, 1);
  for (std::size_t e = 0; e < pair.record.edges.size(); ++e) {
    auto crossings = crossings_of(pair, e);
    if (crossings.size() < 2) continue;
    std::swap(crossings[0].lambda, crossings[1].lambda);
    set_crossings(pair, e, crossings);
    return expect_refused(pair, "structure");
  }
  FAIL() << "no edge has two crossings";
}

TEST(Check_certificate, refuses_an_output_that_is_not_a_simplicial_complex)
{
  Soup lens;
  lens.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  lens.triangles = {{0, 1, 2}, {0, 2, 1}};
  expect_refused(identity(to_mesh(lens)), "structure");
  Mapped_pair pair = identity(grid(2));
  pair.output.point(Vertex(4)) = Point(NAN, 0, 0);
  expect_refused(pair, "structure");
  pair = identity(grid(2));
  pair.output = Mesh();
  expect_refused(pair, "structure");
}

TEST(Check_certificate, throws_when_a_face_is_not_a_triangle)
{
  Mesh quad;
  CGAL::make_quad(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), quad);
  EXPECT_THROW(check({quad, grid(1), {}}), surety::Invalid_input);
  EXPECT_THROW(check({grid(1), quad, {}}), surety::Invalid_input);
}

TEST(Check_certificate, I1_refuses_a_missing_crossing)
{
  const Mapped_pair sound = square_on_square(8, 0.05, 1);
  for (std::size_t e = 0; e < sound.record.edges.size(); ++e) {
    Mapped_pair broken = sound;
    auto crossings = crossings_of(sound, e);
    crossings.erase(crossings.begin());
    set_crossings(broken, e, crossings);
    EXPECT_FALSE(check(broken).holds);
  }
}

TEST(Check_certificate, I1_refuses_a_vertex_that_jumps_to_a_distant_face)
{
  Mapped_pair pair = refinement(cube(2), 2);
  for (std::uint32_t v = 0; v < pair.record.images.size(); ++v) {
    if (image_of(pair, v).kind != Kind::face) continue;
    image_of(pair, v).a = (image_of(pair, v).a + 24) % std::uint32_t(pair.output.num_faces());
    return expect_refused(pair, "I1");
  }
}

TEST(Check_certificate, I2_refuses_a_vertex_that_is_too_far)
{
  Mapped_pair pair = identity(cube(2));
  pair.input.point(Vertex(3)) = pair.input.point(Vertex(3)) + Vector(0.25, 0, 0);
  expect_accepted(pair, 0.25 * (1 + 1e-14));
  EXPECT_GE(check(pair).bound, 0.25);
  expect_refused(pair, "I2", 0.25 * (1 - 1e-14));
  expect_refused(pair, "I2", 0.0);
  expect_refused(pair, "I2", -1.0);
  expect_refused(pair, "I2", NAN);
}

TEST(Check_certificate, I2_refuses_a_crossing_that_is_too_far)
{
  const Mapped_pair sound = square_on_square(8, 0.05, 1);
  Mapped_pair broken = sound;
  auto crossings = crossings_of(sound, 0);
  ASSERT_LT(check(sound).bound, 1e-12);
  crossings.back().lambda = 1;
  set_crossings(broken, 0, crossings);
  expect_refused(broken, "I2", 1e-12);
}

TEST(Check_certificate, refuses_a_recorded_bound_that_is_too_good)
{
  Mapped_pair pair = identity(cube());
  pair.input = translated(pair.input, Vector(0.5, 0, 0));
  const auto with_bound = [&](double bound) {
    return surety::check_certificate(pair.input, pair.output, Certificate(1, bound, pair.record));
  };
  EXPECT_TRUE(with_bound(0.5).holds);
  EXPECT_TRUE(with_bound(0.75).holds);
  EXPECT_FALSE(with_bound(0.49).holds);
  EXPECT_EQ(with_bound(0.49).reason.substr(0, 3), "I2:");
  EXPECT_FALSE(with_bound(1.5).holds);
  EXPECT_FALSE(with_bound(NAN).holds);
}

/// The images around vertex v of a mesh that maps to itself: v goes into the face (v, x_0, x_1),
/// and its edges turn to x_2, x_3, ... across the spokes, `forward` of them one way and the others
/// back.
Mapped_pair wound_about(const Mesh& mesh, Vertex v, std::size_t forward)
{
  Mapped_pair pair = identity(mesh);
  std::vector<std::uint32_t> link;
  auto h = mesh.halfedge(v);
  do {
    link.push_back(mesh.source(h));
    h = mesh.prev(mesh.opposite(h));
  } while (h != mesh.halfedge(v));
  const std::size_t n = link.size();
  for (const Face f : mesh.faces()) {
    std::set<std::uint32_t> corners;
    for (const Vertex w : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) corners.insert(w);
    if (corners == std::set<std::uint32_t>{v, link[0], link[1]}) image_of(pair, v) = at_face(f);
  }
  std::map<std::array<std::uint32_t, 2>, std::vector<Correspondence::Crossing>> crossings;
  for (std::size_t k = 2; k < n; ++k) {
    std::vector<std::uint32_t> spokes;
    if (k <= forward)
      for (std::size_t i = 1; i < k; ++i) spokes.push_back(link[i]);
    else
      for (std::size_t i = n; i > k; --i) spokes.push_back(link[i % n]);
    if (v > link[k]) std::reverse(spokes.begin(), spokes.end());
    auto& list
        = crossings[{std::min<std::uint32_t>(v, link[k]), std::max<std::uint32_t>(v, link[k])}];
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      const Image e = on_edge(v, spokes[i]);
      list.push_back({e.a, e.b, (double(i) + 0.5) / double(spokes.size())});
    }
  }
  for (const auto& [edge, list] : crossings) {
    pair.record.edges.push_back(edge);
    pair.record.crossings.insert(pair.record.crossings.end(), list.begin(), list.end());
    pair.record.offsets.push_back(std::uint32_t(pair.record.crossings.size()));
  }
  return pair;
}

TEST(Check_certificate, I3_refuses_a_triangle_that_winds_about_an_unpinned_vertex)
{
  const Mesh mesh = icosphere(1);
  for (std::size_t forward = 1; forward < 6; ++forward) {
    expect_refused(wound_about(mesh, Vertex(20), forward), "I3");
  }
}

/// The other edges of the output at one end of an edge, in order from one side of it to the other.
std::vector<Correspondence::Crossing> other_way_around(
    const Mesh& output, Vertex w, Vertex x, double lambda)
{
  std::vector<Correspondence::Crossing> spokes;
  const auto start = output.halfedge(x, w);
  for (auto h = output.opposite(output.next(start)); h != start;
       h = output.opposite(output.next(h))) {
    const Image e = on_edge(output.source(h), w);
    spokes.push_back({e.a, e.b, lambda});
  }
  return spokes;
}

TEST_P(Overlay, I3_refuses_a_crossing_led_around_the_other_side_of_a_vertex)
{
  const Mapped_pair sound = sphere_on_hull(2, 20, seed);
  for (std::size_t edge = 0; edge < sound.record.edges.size(); ++edge) {
    const auto crossings = crossings_of(sound, edge);
    int refused_by_I3 = 0;
    for (int variant = 0; variant < 4; ++variant) {
      Mapped_pair broken = sound;
      const auto& c = crossings[edge % crossings.size()];
      auto detour = other_way_around(
          sound.output, Vertex(variant % 2 ? c.a : c.b), Vertex(variant % 2 ? c.b : c.a), c.lambda);
      if (variant / 2) std::reverse(detour.begin(), detour.end());
      auto changed = crossings;
      const auto place = changed.begin() + std::ptrdiff_t(edge % crossings.size());
      changed.insert(changed.erase(place), detour.begin(), detour.end());
      set_crossings(broken, edge, changed);
      const Certificate_check answer = check(broken);
      EXPECT_FALSE(answer.holds);
      refused_by_I3 += answer.reason.substr(0, 3) == "I3:";
    }
    EXPECT_GE(refused_by_I3, 2); // the other two turn the wrong way, and break I1
  }
}

TEST(Check_certificate, degree_refuses_a_sphere_folded_onto_its_northern_half)
{
  Mapped_pair pair = identity(bipyramid(5));
  image_of(pair, 6) = at_vertex(5); // the south pole goes north
  expect_refused(pair, "degree");
}

TEST(Check_certificate, degree_refuses_maps_that_cover_twice)
{
  for (const std::uint32_t times : {2, 3}) {
    Mapped_pair pair{bipyramid(4 * times), bipyramid(4), {}};
    for (std::uint32_t i = 0; i < 4 * times; ++i) pair.record.images.push_back(at_vertex(i % 4));
    pair.record.images.push_back(at_vertex(4));
    pair.record.images.push_back(at_vertex(5));
    expect_refused(pair, "degree");
  }
  Mapped_pair pair = identity(icosphere(0));
  pair.input = joined({pair.input, pair.input});
  for (std::uint32_t v = 0; v < 12; ++v) pair.record.images.push_back(at_vertex(v));
  expect_refused(pair, "degree");
}

TEST(Check_certificate, degree_refuses_a_component_that_is_not_covered)
{
  Mapped_pair pair = identity(icosphere(0));
  pair.output = joined({pair.output, translated(pair.output, Vector(0.1, 0, 0))});
  expect_refused(pair, "degree");
}

TEST(Check_certificate, degree_refuses_a_component_without_area)
{
  Mapped_pair pair = identity(two_spheres(1, 0.1));
  for (std::uint32_t v = 0; v < pair.record.images.size() / 2; ++v)
    image_of(pair, v) = at_vertex(0);
  expect_refused(pair, "degree");
}

TEST(Check_certificate, degree_refuses_the_opposite_orientation)
{
  Mapped_pair pair = identity(icosphere(0));
  pair.output = reversed(pair.output);
  expect_refused(pair, "degree");
}

TEST(Check_certificate, degree_refuses_a_square_folded_in_two)
{
  // The left half of the grid lies on the right half; the border of the output is not the image.
  Mapped_pair pair = identity(grid(2));
  for (std::uint32_t j = 0; j < 3; ++j) image_of(pair, j) = at_vertex(6 + j);
  EXPECT_FALSE(check(pair).holds);
}

TEST(Check_certificate, border_refuses_a_hole_that_is_closed_in_the_output)
{
  // The input lacks one face; its border maps to edges that are no border.
  Mapped_pair pair = identity(icosphere(0));
  CGAL::Euler::remove_face(pair.input.halfedge(Face(7)), pair.input);
  EXPECT_FALSE(check(pair).holds);
  std::swap(pair.input, pair.output);
  EXPECT_FALSE(check(pair).holds);
}

TEST(Check_certificate, border_refuses_a_crossing_on_either_border)
{
  Mapped_pair pair = identity(grid(2));
  pair.record.edges = {{0, 1}};
  pair.record.offsets = {0, 1};
  pair.record.crossings = {{0, 1, 0.5}};
  expect_refused(pair, "border");
  pair.record.edges = {{1, 4}};
  expect_refused(pair, "border");
}

TEST(Check_certificate, border_refuses_a_border_vertex_inside_the_output)
{
  // The midpoint of a border edge goes to the face beside it, or to the edge across.
  Mapped_pair sound = refinement(grid(1), 1);
  ASSERT_TRUE(check(sound).holds);
  for (std::uint32_t v = 4; v < sound.record.images.size(); ++v) {
    if (!sound.input.is_border(Vertex(v))) continue;
    Mapped_pair broken = sound;
    const Image edge = image_of(sound, v);
    const auto h = sound.output.halfedge(Vertex(edge.a), Vertex(edge.b));
    const Face f = sound.output.is_border(h) ? sound.output.face(sound.output.opposite(h))
                                             : sound.output.face(h);
    image_of(broken, v) = at_face(f);
    expect_refused(broken, "border");
  }
}

TEST(Check_certificate, border_edges_may_not_swap)
{
  // The identity of a square, turned by a quarter without turning the faces' images, is broken.
  Mapped_pair pair = identity(grid(1));
  const std::array<std::uint32_t, 4> turned = {2, 0, 3, 1};
  for (std::uint32_t v = 0; v < 4; ++v) image_of(pair, v) = at_vertex(turned[v]);
  EXPECT_FALSE(check(pair).holds);
}

// ---- ridges ----

/// A cube of which the twelve sharp edges are recorded as ridges of a refinement.
Mapped_pair cube_with_ridges(int times)
{
  Mapped_pair pair = refinement(cube(), times);
  const auto sharp = [&](std::uint32_t u, std::uint32_t v) {
    return CGAL::squared_distance(pair.output.point(Vertex(u)), pair.output.point(Vertex(v))) < 1.5;
  };
  record_ridges(pair, sharp);
  return pair;
}

TEST(Check_certificate, I5_accepts_the_ridges_of_a_refined_cube)
{
  for (int times = 0; times < 4; ++times) {
    const Mapped_pair pair = cube_with_ridges(times);
    EXPECT_EQ(pair.record.ridges.size(), 12u << times);
    expect_accepted(pair);
  }
}

TEST(Check_certificate, I5_refuses_a_gap_in_a_ridge)
{
  const Mapped_pair sound = cube_with_ridges(2);
  for (std::size_t i = 0; i < sound.record.ridges.size(); ++i) {
    Mapped_pair broken = sound;
    broken.record.ridges.erase(broken.record.ridges.begin() + std::ptrdiff_t(i));
    expect_refused(broken, "I5");
  }
}

TEST(Check_certificate, I5_refuses_a_ridge_twice)
{
  for (const int times : {0, 2}) {
    Mapped_pair pair = cube_with_ridges(times);
    pair.record.ridges.push_back(pair.record.ridges[5]);
    expect_refused(pair, "I5");
  }
}

TEST(Check_certificate, I5_refuses_a_ridge_through_a_face)
{
  const Mapped_pair sound = cube_with_ridges(2);
  for (const auto e : sound.input.edges()) {
    const std::uint32_t u = sound.input.vertex(e, 0), v = sound.input.vertex(e, 1);
    const bool in_face
        = sound.record.images[u].kind == Kind::face || sound.record.images[v].kind == Kind::face;
    if (!in_face) continue;
    Mapped_pair broken = sound;
    broken.record.ridges.push_back({std::min(u, v), std::max(u, v)});
    expect_refused(broken, "I5");
  }
}

TEST(Check_certificate, I5_refuses_ridges_that_are_no_edges_or_on_the_border)
{
  Mapped_pair pair = cube_with_ridges(1);
  pair.record.ridges.push_back({0, 7});
  expect_refused(pair, "I5");
  pair = identity(grid(2));
  pair.record.ridges = {{0, 1}};
  expect_refused(pair, "I5");
  pair.record.ridges = {{1, 4}};
  expect_accepted(pair);
}

TEST(Check_certificate, I5_refuses_a_ridge_with_a_crossing)
{
  Mapped_pair pair = square_on_square(8, 0.05, 1);
  pair.record.ridges = {pair.record.edges[0]};
  expect_refused(pair, "I5");
}

// ---- certificates without a map ----

TEST(Check_certificate, says_which_check_serves_an_accumulated_bound)
{
  const Certificate certificate(1, 0.5, std::nullopt);
  const auto answer = surety::check_certificate(cube(), cube(), certificate);
  EXPECT_FALSE(answer.holds);
  EXPECT_NE(answer.reason.find("certify_distance"), std::string::npos);
}

} // namespace
