// SPDX-License-Identifier: GPL-3.0-or-later
//
// The verifier of distances: what it proves is true, what it refutes is false, and it decides. The
// truth comes from theory, from samples, or from exact rational arithmetic over all pairs.
#include <surety/distance.h>

#include "exact_distance.h"
#include "polyhedra.h"
#include "sampled_distance.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace {

using namespace surety::test;
using surety::certify_distance;
using surety::Distance_certificate;
using surety::Distance_interval;
using surety::Hausdorff_distance;
using surety::hausdorff_distance;
using surety::Witness;
namespace params = surety::parameters;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A witness lies on the face that it names, and no point of the other mesh is closer than it says.
void expect_genuine(const Witness& witness, const Mesh& first, const Mesh& second)
{
  const Mesh& own = witness.is_on_first ? first : second;
  const Mesh& other = witness.is_on_first ? second : first;
  const Exact_triangles face(own, witness.face), all(other);
  EXPECT_TRUE(all.are_no_closer_than(witness.distance_lower_bound, witness.point));
  // The point is rounded, and the lower bound allows for that.
  EXPECT_TRUE(face.has_point_within(1e-14 * largest_coordinate(own), witness.point));
}

void expect_genuine(const Hausdorff_distance& distance, const Mesh& first, const Mesh& second)
{
  EXPECT_TRUE(distance.is_accurate());
  for (const Distance_interval& interval : {distance.forward, distance.backward}) {
    EXPECT_LE(interval.lower, interval.upper);
    EXPECT_EQ(interval.witness.distance_lower_bound, interval.lower);
    expect_genuine(interval.witness, first, second);
  }
}

/// Random points of each mesh, exactly measured, stay below the upper bounds.
void expect_sound(
    const Distance_interval& forward, const Distance_interval& backward, const Mesh& first,
    const Mesh& second, unsigned seed)
{
  const Exact_triangles a(first), b(second);
  Random random(seed);
  for (int i = 0; i < 60; ++i) {
    EXPECT_TRUE(b.has_point_within(forward.upper, a.random_point(random)));
    EXPECT_TRUE(a.has_point_within(backward.upper, b.random_point(random)));
  }
}

void expect_interval(const Distance_interval& interval, double distance)
{
  EXPECT_LE(interval.lower, distance);
  EXPECT_GE(interval.upper, distance);
}

// ---- random pairs ----

class Random_pair : public testing::TestWithParam<unsigned>
{
protected:
  /// A shape, and a distorted copy with another triangulation.
  Random_pair()
    : first(small_shape(GetParam())),
      second(jittered(split_at_random(first, 40, GetParam()), 0.02, GetParam())),
      distance(hausdorff_distance(first, second, 1e-4))
  {}

  static Mesh small_shape(unsigned seed)
  {
    switch (seed % 4) {
    case 0:
      return rotated(jittered_sphere(1, seed), seed);
    case 1:
      return rotated(cube(3), seed);
    case 2:
      return rotated(saddle(6), seed);
    default:
      return torus(10, 6);
    }
  }

  Mesh first, second;
  Hausdorff_distance distance;
};

TEST_P(Random_pair, intervals_hold_for_exactly_measured_points)
{
  expect_genuine(distance, first, second);
  expect_sound(distance.forward, distance.backward, first, second, GetParam());
}

TEST_P(Random_pair, intervals_hold_for_samples)
{
  const double rounding = 1e-14;
  EXPECT_LE(sampled_distance_to(first, second, GetParam(), 12), distance.forward.upper + rounding);
  EXPECT_LE(sampled_distance_to(second, first, GetParam(), 12), distance.backward.upper + rounding);
}

TEST_P(Random_pair, bounds_above_the_interval_hold_and_bounds_below_are_refuted)
{
  const Distance_certificate proof = certify_distance(first, second, distance.upper());
  EXPECT_TRUE(proof.holds());
  EXPECT_FALSE(proof.refuted() || proof.undecided() || proof.witness());
  EXPECT_LE(proof.upper_bound(), distance.upper());
  expect_sound(proof.forward(), proof.backward(), first, second, GetParam());

  const double too_small = distance.lower() * (1 - 1e-9);
  const Distance_certificate refutation = certify_distance(first, second, too_small);
  EXPECT_TRUE(refutation.refuted());
  EXPECT_FALSE(refutation.holds() || refutation.undecided());
  ASSERT_TRUE(refutation.witness());
  EXPECT_GT(refutation.witness()->distance_lower_bound, too_small);
  expect_genuine(*refutation.witness(), first, second);
}

TEST_P(Random_pair, exchanging_the_meshes_exchanges_the_intervals)
{
  const Hausdorff_distance other = hausdorff_distance(second, first, 1e-4);
  EXPECT_EQ(other.forward.lower, distance.backward.lower);
  EXPECT_EQ(other.backward.upper, distance.forward.upper);
}

TEST_P(Random_pair, renumbering_changes_no_answer)
{
  const Mesh a = renumbered(first, GetParam()), b = renumbered(second, GetParam() + 1);
  const Hausdorff_distance other = hausdorff_distance(a, b, 1e-4);
  EXPECT_LE(other.lower(), distance.upper());
  EXPECT_GE(other.upper(), distance.lower());
}

TEST_P(Random_pair, results_scale_exactly_with_powers_of_two)
{
  for (const double s : {0x1p10, 0x1p-10, 0x1p300, 0x1p-300}) {
    const Hausdorff_distance other
        = hausdorff_distance(scaled(first, s), scaled(second, s), s * 1e-4);
    EXPECT_EQ(other.forward.lower, s * distance.forward.lower);
    EXPECT_EQ(other.forward.upper, s * distance.forward.upper);
    EXPECT_EQ(other.backward.lower, s * distance.backward.lower);
    EXPECT_EQ(other.backward.upper, s * distance.backward.upper);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(other.forward.witness.point[i], s * distance.forward.witness.point[i]);
    }
  }
}

TEST_P(Random_pair, far_from_the_origin_results_are_sound)
{
  // The translation rounds the points, so this is another pair of meshes, and the exact points
  // tell.
  const Vector far(3e6, -2e7, 1e5);
  const Mesh a = translated(first, far), b = translated(second, far);
  const Hausdorff_distance moved = hausdorff_distance(a, b, 1e-4);
  expect_genuine(moved, a, b);
  expect_sound(moved.forward, moved.backward, a, b, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_pair, testing::Range(0u, 12u));

// ---- known distances ----

TEST(Hausdorff_distance, of_a_mesh_to_itself_is_zero)
{
  const Mesh mesh = jittered_sphere(3, 1);
  const Hausdorff_distance distance = hausdorff_distance(mesh, renumbered(mesh, 2), 1e-12);
  EXPECT_EQ(distance.lower(), 0);
  EXPECT_LE(distance.upper(), 1e-14);
}

TEST(Hausdorff_distance, does_not_depend_on_the_triangulation_of_flat_regions)
{
  const Mesh other = split_at_random(subdivided(cube(), 2), 50, 1);
  const Hausdorff_distance distance = hausdorff_distance(cube(4), other, 1e-12);
  EXPECT_TRUE(distance.is_accurate());
  EXPECT_LE(distance.upper(), 1e-12);
}

TEST(Hausdorff_distance, of_parallel_planes_is_their_offset)
{
  const double offset = 0.1;
  for (const std::size_t n : {1, 3, 7, 20}) {
    const Hausdorff_distance distance
        = hausdorff_distance(grid(5), translated(grid(n), Vector(0, 0, offset)), 1e-12);
    EXPECT_TRUE(distance.is_accurate()) << n;
    expect_interval(distance.forward, offset);
    expect_interval(distance.backward, offset);
  }
}

TEST(Hausdorff_distance, of_concentric_spheres_is_the_gap)
{
  // The copy of a vertex, on the same ray, is its closest point: the small sphere is convex, and
  // the ray lies in the normal cone of the copy.
  const Mesh outer = icosphere(2), inner = scaled(outer, 0.75);
  const Hausdorff_distance distance = hausdorff_distance(outer, inner, 1e-9);
  EXPECT_TRUE(distance.is_accurate());
  EXPECT_NEAR(distance.forward.lower, 0.25, 1e-9);
  EXPECT_LT(distance.backward.upper, 0.25);
}

TEST(Hausdorff_distance, of_a_chord_over_a_groove_is_the_depth)
{
  // The farthest points of the lid are on the medial line above the crease, far from all vertices.
  const double depth = 0.25;
  const Mesh groove = to_mesh(
      sheet(2, 40, [&](double i, double j) { return Point(i - 1, j / 10, i == 1 ? -depth : 0); }));
  const Mesh lid
      = to_mesh(sheet(1, 1, [](double i, double j) { return Point(2 * i - 1, 4 * j, 0); }));
  const double truth = depth / std::sqrt(1 + depth * depth);
  const Hausdorff_distance distance = hausdorff_distance(lid, groove, 1e-9);
  EXPECT_TRUE(distance.is_accurate());
  EXPECT_NEAR(distance.forward.lower, truth, 2e-9);
  EXPECT_NEAR(distance.backward.lower, depth, 2e-9);
}

TEST(Hausdorff_distance, of_meshes_far_apart)
{
  const Hausdorff_distance distance
      = hausdorff_distance(icosphere(3), translated(icosphere(2), Vector(100, 0, 0)), 1e-6);
  EXPECT_TRUE(distance.is_accurate());
  EXPECT_GT(distance.lower(), 99.9);
  EXPECT_LT(distance.upper(), 100.1);
}

TEST(Certify_distance, finds_a_needle_thinner_than_the_bound)
{
  // Every point of the plate is close to the mesh with the needle: one direction is not enough.
  const double height = 0.5;
  const Mesh needle = needle_on_plate(1e-4, height), plate = grid(9);
  for (const bool needle_first : {true, false}) {
    const Distance_certificate proof = needle_first ? certify_distance(needle, plate, 0.01)
                                                    : certify_distance(plate, needle, 0.01);
    EXPECT_TRUE(proof.refuted());
    ASSERT_TRUE(proof.witness());
    EXPECT_EQ(proof.witness()->is_on_first, needle_first);
  }
  const Hausdorff_distance distance = hausdorff_distance(needle, plate, 1e-6);
  EXPECT_NEAR(distance.forward.lower, height, 2e-6);
  EXPECT_LE(distance.backward.upper, 1e-4);
}

TEST(Certify_distance, decides_next_to_the_distance)
{
  const double offset = 0.001;
  const Mesh a = split_at_random(grid(6), 30, 1);
  const Mesh b = translated(split_at_random(grid(31), 30, 2), Vector(0, 0, offset));
  EXPECT_TRUE(certify_distance(a, b, offset * (1 + 1e-10)).holds());
  EXPECT_TRUE(certify_distance(a, b, offset * (1 - 1e-10)).refuted());
  const Distance_certificate tie = certify_distance(a, b, offset);
  EXPECT_FALSE(tie.refuted());
  EXPECT_GE(tie.upper_bound(), offset);
  EXPECT_LE(tie.lower_bound(), offset);
  EXPECT_LE(tie.upper_bound(), offset * 1.02);
}

TEST(Certify_distance, copes_with_fans_of_many_faces)
{
  const Mesh fan = cylinder(500, 1);
  const Mesh other = subdivided(fan);
  EXPECT_TRUE(certify_distance(fan, other, 1e-10).holds());
}

// ---- what meshes may be ----

/// A grid with faces of zero area: on edges, and collapsed to points.
Mesh with_degenerate_faces(const Mesh& mesh)
{
  Soup soup = to_soup(mesh);
  const std::size_t n = soup.points.size();
  const auto t = soup.triangles.front();
  soup.points.push_back(soup.points[t[0]]);
  soup.points.push_back(CGAL::midpoint(soup.points[t[0]], soup.points[t[1]]));
  soup.points.push_back(soup.points[t[1]]);
  soup.triangles.push_back({n, n + 1, n + 2});
  for (int i = 0; i < 3; ++i) soup.points.push_back(soup.points[t[0]]);
  soup.triangles.push_back({n + 3, n + 4, n + 5});
  return to_mesh(soup);
}

TEST(Certify_distance, accepts_degenerate_faces)
{
  const Mesh a = with_degenerate_faces(saddle(5));
  const Mesh b = with_degenerate_faces(jittered(saddle(5), 0.01, 1));
  const Hausdorff_distance distance = hausdorff_distance(a, b, 1e-6);
  const Hausdorff_distance plain
      = hausdorff_distance(saddle(5), jittered(saddle(5), 0.01, 1), 1e-6);
  EXPECT_TRUE(distance.is_accurate());
  EXPECT_NEAR(distance.lower(), plain.lower(), 1e-6);
  EXPECT_TRUE(certify_distance(a, b, plain.upper() * 1.001).holds());
}

TEST(Certify_distance, compares_meshes_of_different_types)
{
  using Polyhedron = CGAL::Polyhedron_3<CGAL::Simple_cartesian<double>>;
  Polyhedron polyhedron;
  CGAL::copy_face_graph(icosphere(1), polyhedron);
  EXPECT_TRUE(certify_distance(polyhedron, icosphere(1), 1e-12).holds());
  EXPECT_TRUE(certify_distance(icosphere(1), polyhedron, 1e-12).holds());
}

TEST(Certify_distance, accepts_meshes_with_removed_elements)
{
  Mesh mesh = grid(4);
  CGAL::Euler::remove_face(mesh.halfedge(Face(3)), mesh);
  ASSERT_TRUE(mesh.has_garbage());
  Mesh compact = mesh;
  compact.collect_garbage();
  EXPECT_TRUE(certify_distance(mesh, compact, 1e-12).holds());
  const Distance_certificate proof = certify_distance(grid(4), mesh, 1e-3);
  ASSERT_TRUE(proof.witness());
  EXPECT_EQ(proof.witness()->face, 3u);
}

TEST(Certify_distance, reads_the_points_of_each_mesh_from_its_own_map)
{
  Mesh a = grid(3), b = grid(3);
  const auto lift = [](Mesh& mesh, double height) {
    const auto map = mesh.add_property_map<Vertex, Point>("v:lifted").first;
    for (const Vertex v : mesh.vertices()) map[v] = mesh.point(v) + Vector(0, 0, height);
    return map;
  };
  const auto of_a = CGAL::parameters::vertex_point_map(lift(a, 1));
  const auto of_b = CGAL::parameters::vertex_point_map(lift(b, 3));
  EXPECT_NEAR(hausdorff_distance(a, b, 1e-9, of_a, of_b).lower(), 2, 1e-9);
  EXPECT_NEAR(hausdorff_distance(a, b, 1e-9, of_a).lower(), 1, 1e-9);
  EXPECT_TRUE(certify_distance(a, b, 2.001, of_a, of_b).holds());
  EXPECT_TRUE(certify_distance(a, b, 2.001, CGAL::parameters::default_values(), of_b).refuted());
}

// ---- parameters and bad input ----

TEST(Certify_distance, refines_the_upper_bound_to_the_relative_slack)
{
  const Mesh a = icosphere(2), b = jittered(icosphere(3), 0.01, 1);
  const double bound = 2 * hausdorff_distance(a, b, 1e-6).upper();
  const Distance_certificate fine = certify_distance(a, b, bound);
  const Distance_certificate coarse = certify_distance(a, b, bound, params::relative_slack(1));
  EXPECT_TRUE(fine.holds() && coarse.holds());
  EXPECT_LE(fine.upper_bound() - fine.lower_bound(), 0.01 * bound * (1 + 1e-12));
  EXPECT_GT(coarse.upper_bound() - coarse.lower_bound(), 0.01 * bound);
}

TEST(Certify_distance, is_undecided_when_the_subdivisions_are_used_up)
{
  const Mesh a = grid(2), b = translated(subdivided(grid(3), 3), Vector(0, 0, 1e-3));
  const double bound = 1.01e-3;
  EXPECT_TRUE(certify_distance(a, b, bound).holds());
  const Distance_certificate proof = certify_distance(a, b, bound, params::maximum_subdivisions(3));
  EXPECT_TRUE(proof.undecided());
  EXPECT_FALSE(proof.holds() || proof.refuted() || proof.witness());
  expect_sound(proof.forward(), proof.backward(), a, b, 0);
  const Hausdorff_distance distance
      = hausdorff_distance(a, b, 1e-6, params::maximum_subdivisions(3));
  EXPECT_FALSE(distance.is_accurate());
  EXPECT_GE(distance.upper(), 1e-3);
}

TEST(Certify_distance, refuses_bad_numbers)
{
  const Mesh mesh = grid(2);
  for (const double bad : {0., -1., infinity, std::nan("")}) {
    EXPECT_THROW(certify_distance(mesh, mesh, bad), surety::Invalid_input);
    EXPECT_THROW(hausdorff_distance(mesh, mesh, bad), surety::Invalid_input);
    EXPECT_THROW(
        certify_distance(mesh, mesh, 1, params::relative_slack(bad)), surety::Invalid_input);
  }
  EXPECT_THROW(
      certify_distance(mesh, mesh, 1, params::maximum_subdivisions(0)), surety::Invalid_input);
}

TEST(Certify_distance, names_the_mesh_that_it_refuses)
{
  const auto refused = [](const Mesh& a, const Mesh& b) -> std::string {
    try {
      certify_distance(a, b, 1);
    } catch (const surety::Invalid_input& error) {
      return error.argument();
    }
    return "none";
  };
  const Mesh good = grid(2);
  Mesh quad, infinite = good;
  CGAL::make_quad(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), quad);
  infinite.point(Vertex(1)) = Point(infinity, 0, 0);
  EXPECT_EQ(refused(Mesh(), good), "first");
  EXPECT_EQ(refused(good, Mesh()), "second");
  EXPECT_EQ(refused(quad, good), "first");
  EXPECT_EQ(refused(good, infinite), "second");
  EXPECT_EQ(refused(good, good), "none");
}

// ---- real models ----

/// CGAL renames its own stop predicates.
struct Down_to_a_tenth {
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t initial, std::size_t current) const
  {
    return 10 * current < initial;
  }
};

class Real_model : public testing::TestWithParam<const char*>
{
protected:
  void SetUp() override
  {
    const char* folder = std::getenv("SURETY_DATA_DIR");
    if (folder == nullptr || *folder == '\0') GTEST_SKIP() << "SURETY_DATA_DIR is not set";
    const std::string path = std::string(folder) + "/" + GetParam();
    ASSERT_TRUE(CGAL::IO::read_polygon_mesh(path, model)) << path;
    simplified = model;
    CGAL::Surface_mesh_simplification::edge_collapse(simplified, Down_to_a_tenth());
    simplified.collect_garbage();
    const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(model);
    diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  }

  static double distance_of(const Witness& witness, const Mesh& other)
  {
    const auto& p = witness.point;
    return Closest_triangle(other).distance(Point(p[0], p[1], p[2]));
  }

  Mesh model, simplified;
  double diagonal = 0;
};

TEST_P(Real_model, distance_to_a_simplification_agrees_with_samples_and_witnesses)
{
  const double accuracy = 1e-5 * diagonal;
  const Hausdorff_distance distance = hausdorff_distance(model, simplified, accuracy);
  EXPECT_TRUE(distance.is_accurate());
  const double rounding = 1e-14 * diagonal;
  EXPECT_LE(sampled_distance_to(model, simplified, 1, 3), distance.forward.upper + rounding);
  EXPECT_LE(sampled_distance_to(simplified, model, 1, 12), distance.backward.upper + rounding);
  EXPECT_GE(distance_of(distance.forward.witness, simplified), distance.forward.lower - rounding);
  EXPECT_GE(distance_of(distance.backward.witness, model), distance.backward.lower - rounding);
  EXPECT_TRUE(certify_distance(model, simplified, distance.upper()).holds());
  EXPECT_TRUE(certify_distance(model, simplified, distance.lower() * (1 - 1e-9)).refuted());
}

INSTANTIATE_TEST_SUITE_P(
    Models, Real_model,
    testing::Values("fandisk.off", "elephant.off", "turbine.off", "anchor_dense.off"));

} // namespace
