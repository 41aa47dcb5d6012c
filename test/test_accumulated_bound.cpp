// SPDX-License-Identifier: GPL-3.0-or-later
//
// The accumulated bound: its drawings against brute force, single operations whose displacement is
// known, and whole simplifications against the claims that hold for all of them.
#include <surety/geometric_mesh.h>

#include "simplification.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <cstdlib>
#include <sstream>

namespace {

using namespace surety::test;
using surety::Deviation_bound;
using surety::Verdict;
using surety::internal::Accumulated_bound;
using surety::internal::Disc;
using surety::internal::Drawing;
using surety::internal::Index;
using surety::internal::Part;
using surety::internal::Working_mesh;
namespace with = surety::parameters;

// ---- drawings ----

struct Drawn_disc {
  std::vector<Drawing::Place> ring; ///< Q first, at the origin
  Drawing::Place removed;

  Part part() const
  {
    const Index k = Index(ring.size());
    return {0, k, k};
  }
  Drawing drawing() const
  {
    Drawing result;
    result.start(part());
    for (Index i = 1; i < ring.size(); ++i) result.place_ring(i, ring[i].x(), ring[i].y());
    result.place_removed(removed.x(), removed.y());
    return result;
  }
};

Drawing::Place polar(double degrees, double radius)
{
  return {radius * std::cos(degrees * pi / 180), radius * std::sin(degrees * pi / 180)};
}

/// A random ring round P, seen from Q.
Drawn_disc random_disc(Random& random)
{
  const std::size_t k = 3 + random.below(7);
  Drawn_disc disc;
  double angle = random.between(0, 360);
  for (std::size_t i = 0; i < k; ++i) {
    disc.ring.push_back(polar(angle, random.between(0.5, 1.5)));
    angle += 360.0 / double(k) * random.between(0.7, 1.2);
  }
  const auto q = disc.ring[0] - CGAL::ORIGIN;
  for (auto& place : disc.ring) place = place - q;
  disc.removed = CGAL::ORIGIN - q;
  return disc;
}

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
Exact::Point_2 exact(const Drawing::Place& p) { return {p.x(), p.y()}; }

/// Whether the spokes have a point in common.
bool cross(const Drawn_disc& disc, Index i, Index j)
{
  return CGAL::do_intersect(
      Exact::Segment_2(exact(disc.removed), exact(disc.ring[i])),
      Exact::Segment_2(exact(disc.ring[0]), exact(disc.ring[j])));
}

class Random_drawing : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_drawing, visits_the_crossings_that_brute_force_finds)
{
  Random random(GetParam());
  std::size_t valid = 0;
  for (int round = 0; round < 100; ++round) {
    const Drawn_disc disc = random_disc(random);
    Drawing drawing = disc.drawing();
    if (!drawing.is_valid()) continue;
    ++valid;
    std::set<std::pair<Index, Index>> visited, expected;
    drawing.all_of_crossings([&](Index i, Index j) { return visited.insert({i, j}).second; });
    const Index k = Index(disc.ring.size());
    for (Index i = 1; i < k; ++i)
      for (Index j = 2; j + 1 < k; ++j)
        if (i != j && cross(disc, i, j)) expected.insert({i, j});
    EXPECT_EQ(visited, expected);
  }
  EXPECT_GT(valid, 10u);
}

TEST_P(Random_drawing, finds_the_faces_that_hold_the_removed_vertex)
{
  Random random(GetParam());
  for (int round = 0; round < 100; ++round) {
    const Drawn_disc disc = random_disc(random);
    Drawing drawing = disc.drawing();
    if (!drawing.is_valid()) continue;
    for (Index j = 1; j + 1 < disc.ring.size(); ++j) {
      const Exact::Triangle_2 face(
          exact(disc.ring[0]), exact(disc.ring[j]), exact(disc.ring[j + 1]));
      EXPECT_EQ(drawing.contains_removed(j), !face.has_on_unbounded_side(exact(disc.removed)));
    }
  }
}

TEST_P(Random_drawing, weights_name_the_same_place_before_and_after)
{
  Random random(GetParam());
  for (int round = 0; round < 100; ++round) {
    const Drawn_disc disc = random_disc(random);
    Drawing drawing = disc.drawing();
    if (!drawing.is_valid()) continue;
    const auto vector = [&](Index i) { return disc.ring[i] - disc.ring[0]; };
    const auto p = disc.removed - disc.ring[0];
    const auto expect_equal
        = [](const auto& a, const auto& b) { EXPECT_LT((a - b).squared_length(), 1e-20); };
    for (Index j = 1; j + 1 < disc.ring.size(); ++j) {
      if (!drawing.contains_removed(j)) continue;
      const auto [v, w] = drawing.weights_of_removed<double>(j);
      expect_equal(p, v * vector(j) + w * vector(j + 1));
    }
    drawing.all_of_crossings([&](Index i, Index j) {
      const auto [a, b] = drawing.weights_of_crossing<double>(i, j);
      EXPECT_TRUE(a > 0 && a < 1 && b > 0 && b < 1) << a << ' ' << b;
      expect_equal((1 - a) * p + a * vector(i), b * vector(j));
      return true;
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_drawing, testing::Range(0u, 5u));

TEST(Drawing, with_the_removed_vertex_on_a_spoke_has_no_crossing_there)
{
  const Drawn_disc disc{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {1, 1}};
  Drawing drawing = disc.drawing();
  ASSERT_TRUE(drawing.is_valid());
  EXPECT_TRUE(drawing.contains_removed(1));
  EXPECT_TRUE(drawing.contains_removed(2));
  EXPECT_TRUE(drawing.all_of_crossings([](Index, Index) { return false; }));
}

// All faces turn left here, before and after, but they go round P twice and overlap.
TEST(Drawing, that_winds_twice_is_refused)
{
  Drawn_disc disc{{{0, 0}}, polar(30, 0.01)};
  for (int i = 0; i < 8; ++i) disc.ring.push_back(polar(60 * i, 1 + 0.1 * i));
  const std::size_t k = disc.ring.size();
  for (std::size_t i = 0; i < k; ++i)
    ASSERT_EQ(
        CGAL::orientation(disc.removed, disc.ring[i], disc.ring[(i + 1) % k]), CGAL::LEFT_TURN);
  for (std::size_t j = 1; j + 1 < k; ++j)
    ASSERT_EQ(CGAL::orientation(disc.ring[0], disc.ring[j], disc.ring[j + 1]), CGAL::LEFT_TURN);
  EXPECT_FALSE(disc.drawing().is_valid());

  Drawn_disc once{{{0, 0}}, polar(150, 0.01)};
  for (int i = 0; i < 6; ++i) once.ring.push_back(polar(60 * i, 1 + 0.1 * i));
  EXPECT_TRUE(once.drawing().is_valid());
}

TEST(Drawing, of_overflowed_places_is_refused)
{
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE((Drawn_disc{{{0, 0}, {infinity, 0}, {2, 2}, {0, 2}}, {1, 1}}).drawing().is_valid());
  EXPECT_FALSE((Drawn_disc{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {NAN, 1}}).drawing().is_valid());
}

// ---- single operations ----

/// A mesh as the policy sees it; only vertex 0 may be removed.
class Stage
{
public:
  explicit Stage(const Mesh& mesh)
    : elements_(mesh, get(CGAL::vertex_point, mesh)),
      connectivity_(surety::internal::read_connectivity(mesh, elements_)),
      reference_(surety::internal::make_reference(elements_, points_of(mesh), connectivity_)),
      working_(surety::internal::make_working_mesh(
          elements_, surety::find_features(mesh, with::feature_angle(180)), connectivity_,
          points_of(mesh), journal_))
  {}

  Disc collapse_onto(Index q) const
  {
    Disc disc;
    surety::internal::make_collapse_disc(working_, halfedge(0, q), disc);
    EXPECT_TRUE(surety::internal::satisfies_ridge_rule(working_, disc));
    return disc;
  }
  Disc flip_of(Index a, Index b) const
  {
    Disc disc;
    surety::internal::make_flip_disc(working_, halfedge(a, b), disc);
    return disc;
  }
  Accumulated_bound bound(double tolerance) const { return {reference_, working_, tolerance}; }

  /// The index in the mesh of a vertex of the flat structures.
  Index outside(Index v) const { return elements_.input_position[v]; }

  /// The largest bound after the operation, which must be admitted.
  double bound_after(const Disc& disc) const
  {
    Accumulated_bound policy = bound(1e9);
    EXPECT_EQ(policy.check(disc), Verdict::accept);
    policy.commit(disc);
    const auto bounds = policy.face_bounds();
    return *std::max_element(bounds.begin(), bounds.end());
  }

private:
  std::vector<surety::internal::Vector> points_of(const Mesh& mesh) const
  {
    return surety::internal::points_in_order(elements_, get(CGAL::vertex_point, mesh), 1.0);
  }
  /// The index that a vertex of the mesh has in the flat structures.
  Index inside(Index v) const
  {
    const auto& positions = elements_.input_position;
    return static_cast<Index>(std::find(positions.begin(), positions.end(), v) - positions.begin());
  }
  Index halfedge(Index from, Index to) const
  {
    Index result = surety::internal::none;
    working_.for_each_outgoing(inside(from), [&](Index h) {
      if (working_.target(h) == inside(to)) result = h;
    });
    EXPECT_NE(result, surety::internal::none);
    return result;
  }

  surety::internal::Elements<Mesh> elements_;
  Working_mesh::Connectivity connectivity_;
  surety::internal::Reference reference_;
  surety::internal::Journal journal_;
  Working_mesh working_;
};

/// Vertex 0 over a ring.
Mesh pyramid(const Point& apex, const std::vector<Point>& ring)
{
  Soup soup{{apex}, {}};
  soup.points.insert(soup.points.end(), ring.begin(), ring.end());
  for (std::size_t i = 0; i < ring.size(); ++i)
    soup.triangles.push_back({0, 1 + i, 1 + (i + 1) % ring.size()});
  return to_mesh(soup);
}

std::vector<Point> hexagon()
{
  std::vector<Point> ring;
  for (int i = 0; i < 6; ++i) ring.push_back({std::cos(i * pi / 3), std::sin(i * pi / 3), 0});
  return ring;
}

void expect_close_above(double bound, double distance)
{
  EXPECT_GE(bound, distance);
  EXPECT_LE(bound, distance * (1 + 1e-12));
}

TEST(Collapse, of_a_pyramid_costs_its_height)
{
  const Stage stage(pyramid({0.125, 0.25, 0.5}, hexagon()));
  const Disc disc = stage.collapse_onto(3);
  expect_close_above(stage.bound_after(disc), 0.5);
  EXPECT_EQ(stage.bound(0.50001).check(disc), Verdict::accept);
  EXPECT_EQ(stage.bound(0.5).check(disc), Verdict::deviation); // for the reserve
}

TEST(Collapse, costs_in_proportion_at_any_size)
{
  for (const double size : {1e-130, 1e-70, 1e70, 1e130}) {
    const Stage stage(scaled(pyramid({0.125, 0.25, 0.5}, hexagon()), size));
    Accumulated_bound policy = stage.bound(0.6 * size);
    const Disc disc = stage.collapse_onto(3);
    ASSERT_EQ(policy.check(disc), Verdict::accept) << size;
    policy.commit(disc);
    const auto bounds = policy.face_bounds();
    expect_close_above(*std::max_element(bounds.begin(), bounds.end()), 0.5 * size);
  }
}

TEST(Collapse, adds_to_the_bounds_of_the_faces_it_overlays)
{
  const Stage stage(pyramid({0.125, 0.25, 0.5}, hexagon()));
  const Disc disc = stage.collapse_onto(3);
  Accumulated_bound policy = stage.bound(1.25);
  ASSERT_EQ(policy.check(disc), Verdict::accept);
  policy.commit(disc);
  // M is not changed, so that the same operation is there again, with a face that P lies in.
  EXPECT_EQ(policy.check(disc), Verdict::accept);
  policy.commit(disc);
  EXPECT_EQ(policy.check(disc), Verdict::deviation);
  const auto bounds = policy.face_bounds();
  expect_close_above(*std::max_element(bounds.begin(), bounds.end()), 1);
}

TEST(Collapse, that_folds_over_in_every_direction_is_refused)
{
  // The ring turns back on itself under the apex: the fan about Q cannot be seen from one side.
  std::vector<Point> ring = hexagon();
  ring[2] = Point(1.5, -0.25, 0);
  const Stage stage(pyramid({0, 0, 1}, ring));
  EXPECT_EQ(stage.bound(1e9).check(stage.collapse_onto(1)), Verdict::deviation);
}

/// A sheet above the x axis, with P on its border between Q = 1 and R = 2, and a notch at P.
Mesh notched_sheet(double depth)
{
  return to_mesh(
      {{Point(1, depth, 0), Point(0, 0, 0), Point(2, 0, 0), Point(2, 2, 0), Point(0, 2, 0)},
       {{0, 4, 1}, {0, 3, 4}, {0, 2, 3}}});
}

TEST(Collapse, along_a_border_costs_the_distance_of_the_border)
{
  const Stage stage(notched_sheet(0.25));
  for (const Index q : {1u, 2u}) {
    const Disc disc = stage.collapse_onto(q);
    expect_close_above(stage.bound_after(disc), 0.25);
    EXPECT_EQ(stage.bound(0.2499).check(disc), Verdict::deviation);
  }
}

TEST(Flip, of_a_flat_quadrangle_costs_nothing)
{
  const Stage stage(to_mesh(
      {{Point(1, 0, 0), Point(0, 1, 0), Point(-1, 0, 0), Point(0, -1, 0)},
       {{0, 1, 2}, {0, 2, 3}}}));
  EXPECT_LE(stage.bound_after(stage.flip_of(0, 2)), 1e-15);
}

TEST(Flip, costs_the_distance_of_the_diagonals)
{
  const Stage stage(to_mesh(
      {{Point(1, 0, 0.25), Point(0, 1, -0.25), Point(-1, 0, 0.25), Point(0, -1, -0.25)},
       {{0, 1, 2}, {0, 2, 3}}}));
  expect_close_above(stage.bound_after(stage.flip_of(0, 2)), 0.5);
}

TEST(Flip, of_a_quadrangle_that_is_not_convex_is_refused)
{
  const Stage stage(to_mesh(
      {{Point(2, 0, 0), Point(0, 1, 0), Point(0.5, 0, 0), Point(0, -1, 0)},
       {{0, 1, 2}, {0, 2, 3}}}));
  EXPECT_EQ(stage.bound(1e9).check(stage.flip_of(0, 2)), Verdict::deviation);
}

// ---- random operations: each face within its own bound ----

class Random_collapse : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_collapse, keeps_each_new_face_within_its_bound)
{
  Random random(GetParam());
  std::size_t admitted = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Point> ring;
    const std::size_t k = 3 + random.below(7);
    for (std::size_t i = 0; i < k; ++i) {
      const double angle = 2 * pi * (double(i) + random.between(-0.3, 0.3)) / double(k);
      ring.push_back(Point(std::cos(angle), std::sin(angle), 0) + 0.3 * random.in_cube());
    }
    const Mesh before = pyramid(CGAL::ORIGIN + 0.4 * random.in_cube(), ring);
    const Stage stage(before);
    const Disc disc = stage.collapse_onto(1);
    Accumulated_bound policy = stage.bound(10);
    if (policy.check(disc) != Verdict::accept) continue;
    ++admitted;
    policy.commit(disc);
    const auto bounds = policy.face_bounds();
    double largest = 0;
    Soup after{to_soup(before).points, {}};
    for (Index j = 1; j + 1 < k; ++j) {
      Soup face{
          after.points,
          {{stage.outside(disc.ring[0]), stage.outside(disc.ring[j]),
            stage.outside(disc.ring[j + 1])}}};
      after.triangles.push_back(face.triangles[0]);
      EXPECT_LE(sampled_distance_to(to_mesh(face), before, 0, 8), bounds[disc.face[j]] + 1e-15);
      largest = std::max(largest, bounds[disc.face[j]]);
    }
    EXPECT_LE(sampled_distance_to(before, to_mesh(after), 0, 8), largest + 1e-15);
  }
  EXPECT_GT(admitted, 50u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_collapse, testing::Range(0u, 3u));

// ---- whole simplifications ----

void expect_all_claims(const Simplification& s)
{
  expect_sound(s, 1);
  expect_verified_distance(s);
  const double tolerance = s.certificate.tolerance() + sampling_error(s.input);
  EXPECT_LE(curve_distance(border_curves(s.output), border_curves(s.input)), tolerance);
}

TEST(Accumulated, leaves_more_faces_than_the_direct_bound_on_a_noisy_surface)
{
  const Mesh input = jittered(torus(60, 32), 0.01, 1);
  const double tolerance = 0.02;
  const auto direct = simplified(input, tolerance, with::effort(surety::Effort::fast));
  const auto accumulated
      = simplified(input, tolerance, with::deviation_bound(Deviation_bound::accumulated));
  EXPECT_GT(accumulated.output.number_of_faces(), direct.output.number_of_faces());
  expect_all_claims(accumulated);
}

TEST(Accumulated, follows_borders_and_ridges_as_curves)
{
  const double angle = 40;
  const auto options = with::feature_angle(angle).deviation_bound(Deviation_bound::accumulated);
  for (const Mesh& input :
       {annulus(120, 12), moebius_cut(96, 6), cylinder(96, 12),
        jittered(cylinder(60, 10), 0.002, 1)}) {
    const auto s = simplified(input, 0.01 * diagonal(input), options);
    EXPECT_LT(s.output.number_of_faces(), input.number_of_faces() / 2);
    expect_all_claims(s);
    const Curves ridges = sharp_curves(input, angle);
    // The ridges of the input lie near edges of the output, whatever their angle is now.
    const Curves edges = curves_where(s.output, [](auto) { return true; });
    for (const auto& [p, q] : ridges)
      for (int i = 0; i <= 4; ++i)
        EXPECT_LE(distance_to_curves(p + i / 4.0 * (q - p), edges), s.certificate.bound() + 1e-13);
  }
}

TEST(Accumulated, leaves_a_flat_square_with_two_faces_and_no_deviation)
{
  const auto s = simplified(grid(16), 1e-6, with::deviation_bound(Deviation_bound::accumulated));
  EXPECT_EQ(s.output.number_of_faces(), 2u);
  EXPECT_LE(s.certificate.bound(), 1e-14);
}

class Real_model : public testing::TestWithParam<const char*>
{};

TEST_P(Real_model, is_sound_and_at_most_four_times_the_direct_count)
{
  const char* const folder = std::getenv("SURETY_DATA_DIR");
  Mesh input;
  if (folder == nullptr
      || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(
          std::string(folder) + '/' + GetParam(), input))
    GTEST_SKIP() << "no meshes of libcgal-demo";
  const double tolerance = 0.002 * diagonal(input);
  const auto s = simplified(input, tolerance, with::deviation_bound(Deviation_bound::accumulated));
  // The same operations under the other bound.
  const auto direct = simplified(input, tolerance, with::effort(surety::Effort::fast));
  EXPECT_GT(s.certificate.operations().flips, 0u);
  EXPECT_LE(s.output.number_of_faces(), 4 * direct.output.number_of_faces());
  RecordProperty(
      "faces_over_direct",
      std::to_string(double(s.output.number_of_faces()) / direct.output.number_of_faces()));
  expect_sound(s, 1);
  expect_verified_distance(s);
}

INSTANTIATE_TEST_SUITE_P(
    Models, Real_model, testing::Values("elephant.off", "fandisk.off", "holes.off"),
    [](const auto& info) {
      const std::string name = info.param;
      return name.substr(0, name.find('.'));
    });

} // namespace
