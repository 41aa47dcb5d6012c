// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ridges, corners, borders and the normals a side: known shapes, every named parameter, invariance.
#include "meshes.h"

#include <surety/features.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace surety::test;
using surety::Features;
using surety::find_features;

namespace p = surety::parameters;

using Edge = Mesh::Edge_index;

Vertex vertex_at(const Mesh& mesh, const Point& point)
{
  for (const Vertex v : mesh.vertices()) {
    if (mesh.point(v) == point) return v;
  }
  throw std::logic_error("no vertex there");
}

/// Two unit squares that share the y axis, the second turned up by an angle in degrees.
Mesh fold(double degrees)
{
  const double a = degrees * pi / 180;
  return to_mesh(
      {{Point(0, 0, 0), Point(0, 1, 0), Point(-1, 0, 0), Point(-1, 1, 0),
        Point(std::cos(a), 0, std::sin(a)), Point(std::cos(a), 1, std::sin(a))},
       {{0, 1, 2}, {1, 3, 2}, {0, 4, 1}, {1, 4, 5}}});
}

TEST(Features, of_a_cube_are_its_edges_and_corners)
{
  for (const int n : {1, 2, 5}) {
    const auto features = find_features(cube(n), p::feature_angle(40));
    EXPECT_EQ(features.ridges, std::size_t(12 * n));
    EXPECT_EQ(features.corners, 8u);
    EXPECT_EQ(features.borders, 0u);
    EXPECT_EQ(features.constrained, 0u);
    EXPECT_EQ(std::count(features.edge.begin(), features.edge.end(), true), 12 * n);
    EXPECT_EQ(std::count(features.corner.begin(), features.corner.end(), true), 8);
  }
}

TEST(Features, without_a_feature_angle_there_are_no_ridges)
{
  EXPECT_EQ(find_features(cube(2)).ridges, 0u);
  EXPECT_EQ(find_features(cube(2)).corners, 0u);
  EXPECT_EQ(find_features(cube(2), p::feature_angle(180)).ridges, 0u);
  EXPECT_EQ(find_features(fold(179.999), p::feature_angle(180)).ridges, 0u);
}

class Folds : public testing::TestWithParam<double>
{};

TEST_P(Folds, are_ridges_exactly_below_their_angle)
{
  const double degrees = GetParam();
  for (const double sign : {1.0, -1.0}) {
    const Mesh mesh = fold(sign * degrees);
    EXPECT_EQ(find_features(mesh, p::feature_angle(degrees - 1e-4)).ridges, 1u);
    EXPECT_EQ(find_features(mesh, p::feature_angle(degrees + 1e-4)).ridges, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Degrees, Folds, testing::Values(0.001, 1.0, 30.0, 60.0, 90.0, 120.0, 179.0, 179.999));

TEST(Features, of_a_cylinder_are_its_two_rims_without_corners)
{
  const std::size_t around = 24;
  const auto rims = find_features(cylinder(around, 3), p::feature_angle(40));
  EXPECT_EQ(rims.ridges, 2 * around);
  EXPECT_EQ(rims.corners, 0u);
  const auto facets = find_features(cylinder(around, 3), p::feature_angle(10));
  EXPECT_EQ(facets.ridges, 2 * around + 3 * around) << "facets of 15 degrees, three rings long";
  EXPECT_EQ(facets.corners, 2 * around);
}

TEST(Features, corners_of_a_square_border_depend_on_the_corner_angle)
{
  const std::size_t n = 4;
  const auto features = find_features(grid(n));
  EXPECT_EQ(features.borders, 4 * n);
  EXPECT_EQ(features.ridges, 0u);
  EXPECT_EQ(features.corners, 4u);
  EXPECT_EQ(find_features(grid(n), p::corner_angle(91)).corners, 0u);
  EXPECT_EQ(find_features(grid(n), p::corner_angle(89)).corners, 4u);
  const auto ring = annulus(36, 2);
  EXPECT_EQ(find_features(ring).corners, 0u);
  EXPECT_EQ(find_features(ring, p::corner_angle(9.9)).corners, 72u);
}

TEST(Features, a_ridge_that_meets_the_border_makes_corners)
{
  const Mesh mesh = fold(50);
  const auto features = find_features(mesh, p::feature_angle(40));
  EXPECT_EQ(features.ridges, 1u);
  EXPECT_EQ(features.borders, 6u);
  EXPECT_TRUE(features.corner[vertex_at(mesh, Point(0, 0, 0))]);
  EXPECT_TRUE(features.corner[vertex_at(mesh, Point(0, 1, 0))]);
  EXPECT_EQ(features.corners, 6u);
}

TEST(Features, constrained_edges_are_features_whatever_their_angle)
{
  Mesh mesh = grid(4);
  auto constrained = mesh.add_property_map<Edge, bool>("e:mine", false).first;
  const auto along = [&](double x0, double x1) {
    const auto h
        = mesh.halfedge(vertex_at(mesh, Point(x0, 0.5, 0)), vertex_at(mesh, Point(x1, 0.5, 0)));
    return mesh.edge(h);
  };
  constrained[along(0.25, 0.5)] = constrained[along(0.5, 0.75)] = true;
  const auto features
      = find_features(mesh, p::feature_angle(40).edge_is_constrained_map(constrained));
  EXPECT_EQ(features.constrained, 2u);
  EXPECT_EQ(features.borders, 16u);
  EXPECT_TRUE(features.edge[along(0.25, 0.5)]);
  EXPECT_FALSE(features.edge[along(0, 0.25)]);
  EXPECT_EQ(features.corners, 4u + 2u) << "both ends of the constrained line, not its middle";
  EXPECT_FALSE(features.corner[vertex_at(mesh, Point(0.5, 0.5, 0))]);
}

TEST(Features, kinds_of_edges_are_counted_once)
{
  Mesh mesh = cube();
  auto all = mesh.add_property_map<Edge, bool>("e:all", true).first;
  const auto features = find_features(mesh, p::feature_angle(40).edge_is_constrained_map(all));
  EXPECT_EQ(features.constrained, 18u);
  EXPECT_EQ(features.ridges, 0u);
  Mesh open = grid(1);
  auto edges = open.add_property_map<Edge, bool>("e:all", true).first;
  const auto square = find_features(open, CGAL::parameters::edge_is_constrained_map(edges));
  EXPECT_EQ(square.borders, 4u);
  EXPECT_EQ(square.constrained, 1u);
}

TEST(Features, constrained_vertices_are_corners_anywhere)
{
  Mesh mesh = icosphere(1);
  auto constrained = mesh.add_property_map<Vertex, bool>("v:mine", false).first;
  constrained[Vertex(5)] = true;
  const auto features
      = find_features(mesh, p::corner_angle(60).vertex_is_constrained_map(constrained));
  EXPECT_EQ(features.corners, 1u);
  EXPECT_TRUE(features.corner[5]);
}

TEST(Features, read_the_vertex_point_map)
{
  Mesh mesh = fold(50);
  auto flat = mesh.add_property_map<Vertex, Point>("v:flat").first;
  for (const Vertex v : mesh.vertices()) flat[v] = fold(0).point(v);
  EXPECT_EQ(find_features(mesh, p::feature_angle(40)).ridges, 1u);
  EXPECT_EQ(find_features(mesh, p::feature_angle(40).vertex_point_map(flat)).ridges, 0u);
}

TEST(Features, refuse_angles_out_of_range)
{
  const auto argument = [](const auto& np) {
    try {
      find_features(cube(), np);
    } catch (const surety::Invalid_input& error) {
      EXPECT_EQ(error.function(), "find_features");
      return error.argument();
    }
    return std::string("accepted");
  };
  EXPECT_EQ(argument(p::feature_angle(-1)), "feature_angle");
  EXPECT_EQ(argument(p::feature_angle(181)), "feature_angle");
  EXPECT_EQ(argument(p::feature_angle(NAN)), "feature_angle");
  EXPECT_EQ(argument(p::corner_angle(-1)), "corner_angle");
  EXPECT_EQ(argument(p::corner_angle(INFINITY)), "corner_angle");
  EXPECT_EQ(argument(p::feature_angle(0).corner_angle(180)), "accepted");
}

TEST(Features, are_found_on_meshes_with_removed_elements)
{
  Mesh mesh = joined({grid(3), translated(cube(2), Vector(5, 0, 0))});
  for (Mesh::size_type f = 0; f < 18; ++f) CGAL::Euler::remove_face(mesh.halfedge(Face(f)), mesh);
  ASSERT_TRUE(mesh.has_garbage());
  const auto features = find_features(mesh, p::feature_angle(40));
  EXPECT_EQ(features.ridges, 24u);
  EXPECT_EQ(features.borders, 0u);
  for (const Edge e : mesh.edges()) ASSERT_LT(e.idx(), features.edge.size());
}

class Random_features : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_features, are_the_same_at_every_scale_to_the_last_bit)
{
  const Mesh mesh = random_shape(GetParam());
  const auto np = p::feature_angle(30).corner_angle(20);
  const auto expected = find_features(mesh, np);
  for (const int exponent : {-300, -10, 10, 300}) {
    const Mesh other = scaled(mesh, std::ldexp(1.0, exponent));
    const auto features = find_features(other, np);
    EXPECT_EQ(features.edge, expected.edge) << "seed " << GetParam();
    EXPECT_EQ(features.corner, expected.corner) << "seed " << GetParam();
  }
}

TEST_P(Random_features, do_not_depend_on_orientation_and_numbering)
{
  const Mesh mesh = random_shape(GetParam());
  const auto np = p::feature_angle(30.123).corner_angle(20.123);
  const auto expected = find_features(mesh, np);
  for (const Mesh& other : {reversed(mesh), renumbered(mesh, GetParam())}) {
    const auto features = find_features(other, np);
    EXPECT_EQ(features.ridges, expected.ridges) << "seed " << GetParam();
    EXPECT_EQ(features.borders, expected.borders) << "seed " << GetParam();
    EXPECT_EQ(features.corners, expected.corners) << "seed " << GetParam();
  }
}

// ---- normals ----

TEST_P(Random_features, normals_are_unit_and_agree_within_a_sector)
{
  const Mesh mesh = random_shape(GetParam());
  const auto features = find_features(mesh, p::feature_angle(30));
  const auto normals = corner_normals(mesh, features);
  for (const auto h : mesh.halfedges()) {
    if (mesh.is_border(h)) {
      EXPECT_EQ(normals[h], Vector(0, 0, 0));
      continue;
    }
    EXPECT_NEAR(normals[h].squared_length(), 1, 1e-9) << "seed " << GetParam();
    const auto across = mesh.opposite(mesh.next(h));
    if (!mesh.is_border(across) && !features.edge[mesh.edge(across)]) {
      EXPECT_EQ(normals[h], normals[across]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_features, testing::Range(0u, 20u));

TEST(Corner_normals, of_a_cube_are_its_face_normals)
{
  const Mesh mesh = cube(3);
  const auto normals = corner_normals(mesh, find_features(mesh, p::feature_angle(40)));
  for (const Face f : mesh.faces()) {
    const auto first = mesh.halfedge(f);
    const Vector n = CGAL::unit_normal(
        mesh.point(mesh.source(first)), mesh.point(mesh.target(first)),
        mesh.point(mesh.target(mesh.next(first))));
    for (const auto h : mesh.halfedges_around_face(first)) {
      EXPECT_NEAR((normals[h] - n).squared_length(), 0, 1e-20);
    }
  }
}

TEST(Corner_normals, of_a_smooth_cube_point_along_its_diagonals)
{
  // One sector a vertex; weighting by angle makes the diagonals of the squares irrelevant.
  const Mesh mesh = translated(cube(), Vector(-0.5, -0.5, -0.5));
  const auto normals = corner_normals(mesh, find_features(mesh));
  for (const auto h : mesh.halfedges()) {
    const Vector diagonal = mesh.point(mesh.target(h)) - CGAL::ORIGIN;
    EXPECT_NEAR(normals[h] * diagonal, std::sqrt(diagonal.squared_length()), 1e-12);
  }
}

TEST(Corner_normals, differ_between_the_sides_of_a_fold)
{
  const Mesh mesh = fold(60);
  const auto sides = corner_normals(mesh, find_features(mesh, p::feature_angle(40)));
  const auto smooth = corner_normals(mesh, find_features(mesh));
  const Vertex v = vertex_at(mesh, Point(0, 0, 0));
  const double half = pi / 6;
  for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
    if (mesh.is_border(h)) continue;
    const bool left = mesh.face(h) == Face(0) || mesh.face(h) == Face(1);
    const Vector expected
        = left ? Vector(0, 0, 1) : Vector(-std::sin(2 * half), 0, std::cos(2 * half));
    EXPECT_NEAR(std::abs(sides[h] * expected), 1, 1e-12);
    EXPECT_NEAR(std::abs(smooth[h] * Vector(-std::sin(half), 0, std::cos(half))), 1, 1e-12);
  }
}

TEST(Corner_normals, of_a_sphere_approach_its_radii)
{
  double previous = 1;
  for (const int levels : {2, 3, 4}) {
    const Mesh mesh = icosphere(levels);
    const auto normals = corner_normals(mesh, find_features(mesh));
    double worst = 0;
    for (const auto h : mesh.halfedges()) {
      const Vector radius = mesh.point(mesh.target(h)) - CGAL::ORIGIN;
      worst = (std::max)(worst, std::sqrt((normals[h] - radius).squared_length()));
    }
    EXPECT_LT(worst, 0.6 * previous);
    previous = worst;
  }
}

} // namespace
