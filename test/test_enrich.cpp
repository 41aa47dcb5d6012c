// SPDX-License-Identifier: GPL-3.0-or-later
//
// Enrichment, against surfaces that are known: what is enforced holds, and what is reported is
// true.
#include <surety/enrich.h>

#include "invariants.h"
#include "meshes.h"
#include "polyhedra.h"
#include "sampled_distance.h"

#include <surety/certificate.h>
#include <surety/distance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace surety::test {
namespace {

Features features_of(const Mesh& mesh, double angle = 60)
{
  return find_features(mesh, parameters::feature_angle(angle));
}

double radius(const Mesh& mesh, Vertex v)
{
  return std::sqrt((mesh.point(v) - CGAL::ORIGIN).squared_length());
}

/// How far from a unit sphere the points of a lattice in each face are at most, from its center.
double gap_to_sphere(const Mesh& mesh)
{
  constexpr int n = 6;
  double worst = 0;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Vector a = mesh.point(mesh.source(h)) - CGAL::ORIGIN;
    const Vector b = mesh.point(mesh.target(h)) - CGAL::ORIGIN;
    const Vector c = mesh.point(mesh.target(mesh.next(h))) - CGAL::ORIGIN;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Vector x = (double(n - i - j) * a + double(i) * b + double(j) * c) / double(n);
        worst = std::max(worst, std::abs(std::sqrt(x.squared_length()) - 1));
      }
    }
  }
  return worst;
}

/// The largest error of the radius of a unit sphere, at the vertices.
double error_of_sphere(const Mesh& mesh)
{
  double worst = 0;
  for (const auto v : mesh.vertices()) worst = std::max(worst, std::abs(radius(mesh, v) - 1));
  return worst;
}

void expect_vertices_kept(const Mesh& input, const Mesh& result)
{
  ASSERT_GE(result.number_of_vertices(), input.number_of_vertices());
  for (const auto v : input.vertices()) EXPECT_EQ(input.point(v), result.point(v));
}

std::vector<Point> sorted_points(const Mesh& mesh)
{
  std::vector<Point> points;
  for (const auto v : mesh.vertices()) points.push_back(mesh.point(v));
  std::sort(points.begin(), points.end());
  return points;
}

TEST(Enrich, brings_a_coarse_sphere_nearer_to_the_sphere)
{
  for (const int levels : {1, 2}) {
    const Mesh input = icosphere(levels);
    Mesh mesh = input;
    const Enrichment answer = enrich(mesh, features_of(input), 1e-3);
    EXPECT_TRUE(answer.enforced.hold());
    EXPECT_EQ(answer.damped_faces, 0u);
    EXPECT_TRUE(is_sound(mesh));
    EXPECT_TRUE(have_same_topology(input, mesh));
    expect_vertices_kept(input, mesh);
    // The chords' own gap, two thirds of a face's more at its middle, and the support's error.
    EXPECT_LT(gap_to_sphere(mesh), 2.5e-3);
    EXPECT_GT(gap_to_sphere(input), 1e-2);
  }
}

TEST(Enrich, vertices_are_off_the_sphere_by_the_fourth_order_of_the_faces)
{
  // The coarsest one would do too well: its vertices are so regular that the fits are exact.
  std::vector<double> error;
  for (const int levels : {2, 3, 4}) {
    Mesh mesh = icosphere(levels);
    enrich(mesh, features_of(mesh), 1, parameters::maximum_size(0.8 * std::pow(2., -levels)));
    error.push_back(error_of_sphere(mesh));
    RecordProperty("error", std::to_string(error.back()));
  }
  EXPECT_LT(error[1], error[0] / 16);
  EXPECT_LT(error[2], error[1] / 16);
}

TEST(Enrich, a_smaller_tolerance_gives_more_faces_and_a_smaller_gap)
{
  const Mesh input = icosphere(1);
  Mesh loose = input, tight = input;
  enrich(loose, features_of(input), 4e-3);
  enrich(tight, features_of(input), 4e-4);
  EXPECT_GT(tight.number_of_faces(), 3 * loose.number_of_faces());
  EXPECT_LT(gap_to_sphere(tight), gap_to_sphere(loose) / 2);
}

TEST(Enrich, the_reported_deviation_is_proven)
{
  for (const Mesh& input : {icosphere(1), torus(12, 6), cylinder(8, 2), ellipsoid(2, 1, 0.5, 2)}) {
    Mesh mesh = input;
    const Enrichment answer = enrich(mesh, features_of(input), 1e-2);
    EXPECT_GT(answer.deviation, 1e-3);
    EXPECT_GE(answer.deviation, sampled_distance(input, mesh));
    EXPECT_TRUE(certify_distance(input, mesh, 1.01 * answer.deviation).holds());
    const auto bound = mesh.property_map<Face, double>("f:deviation").first;
    double worst = 0;
    for (const auto f : mesh.faces()) worst = std::max(worst, bound[f]);
    EXPECT_EQ(worst, answer.deviation);
  }
}

TEST(Enrich, a_cube_stays_a_cube)
{
  const Mesh input = cube(1);
  Mesh mesh = input;
  const Enrichment answer = enrich(mesh, features_of(input), 1e-3);
  EXPECT_TRUE(answer.enforced.hold());
  EXPECT_EQ(mesh.number_of_faces(), input.number_of_faces());
  EXPECT_EQ(answer.deviation, 0);
  const Enrichment fine = enrich(mesh, features_of(mesh), 1e-3, parameters::maximum_size(0.3));
  EXPECT_GT(mesh.number_of_faces(), 100u);
  EXPECT_LT(fine.deviation, 1e-14);
  const auto is_feature = mesh.property_map<Mesh::Edge_index, bool>("e:is_feature").first;
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    const Point a = mesh.point(mesh.source(h)), b = mesh.point(mesh.target(h));
    EXPECT_LE(CGAL::squared_distance(a, b), 0.3 * 0.3 * (1 + 1e-12));
    // On an edge of the cube two coordinates are 0 or 1 all along.
    int fixed = 0;
    for (int i = 0; i < 3; ++i)
      fixed += std::abs(a[i] - b[i]) < 1e-14
          && (std::abs(a[i]) < 1e-14 || std::abs(a[i] - 1) < 1e-14);
    EXPECT_EQ(is_feature[e], fixed == 2);
  }
}

TEST(Enrich, a_cylinder_gets_round_and_its_rims_stay_in_their_planes)
{
  const Mesh input = cylinder(8, 2);
  Mesh mesh = input;
  const Enrichment answer = enrich(mesh, features_of(input), 1e-3);
  EXPECT_TRUE(answer.enforced.hold());
  expect_vertices_kept(input, mesh);
  const auto is_feature = mesh.property_map<Mesh::Edge_index, bool>("e:is_feature").first;
  std::size_t on_rims = 0;
  for (const auto e : mesh.edges()) {
    if (!is_feature[e]) continue;
    ++on_rims;
    const auto h = mesh.halfedge(e);
    for (const auto v : {mesh.source(h), mesh.target(h)}) {
      const Point p = mesh.point(v);
      EXPECT_NEAR(std::hypot(p.x(), p.y()), 1, 1e-2);
    }
    EXPECT_NEAR(mesh.point(mesh.source(h)).z(), mesh.point(mesh.target(h)).z(), 1e-12);
  }
  EXPECT_GE(on_rims, 64u);
}

TEST(Enrich, a_part_with_creases_between_has_the_same_ones)
{
  // The features of the result are those of the input cut up, which has not moved off their curves.
  const Mesh input = plate_with_holes(1);
  Mesh mesh = input;
  const Features features = features_of(input);
  enrich(mesh, features, 1e-2, parameters::maximum_size(0.4));
  const auto is_feature = mesh.property_map<Mesh::Edge_index, bool>("e:is_feature").first;
  const auto length = [](const Mesh& m, const auto& is_one) {
    double sum = 0;
    for (const auto e : m.edges()) {
      if (is_one(e))
        sum += std::sqrt(CGAL::squared_distance(
            m.point(m.source(m.halfedge(e))), m.point(m.target(m.halfedge(e)))));
    }
    return sum;
  };
  const double before = length(input, [&](auto e) { return bool(features.edge[e]); });
  EXPECT_NEAR(length(mesh, [&](auto e) { return bool(is_feature[e]); }), before, 1e-10 * before);
}

TEST(Enrich, the_result_is_the_same_at_any_scale)
{
  for (const double scale : {0x1p10, 0x1p-10}) {
    Mesh mesh = torus(12, 6), other = scaled(mesh, scale);
    enrich(mesh, features_of(mesh), 1e-2);
    enrich(other, features_of(other), 1e-2 * scale);
    EXPECT_EQ(sorted_points(scaled(mesh, scale)), sorted_points(other));
  }
}

TEST(Enrich, sheets_near_each_other_do_not_meet)
{
  // Two shells, the inner one of which would bulge through the outer one's flat faces.
  const Mesh outer = icosphere(1);
  const Mesh input = joined({outer, reversed(scaled(outer, 0.95))});
  ASSERT_EQ(number_of_self_intersections(input), 0u);
  Mesh mesh = input;
  const Features features = features_of(input);
  // The outer shell is kept as it is by a support that is flat there: its edges are all ridges.
  Features flat = features;
  for (const auto e : input.edges()) {
    const auto v = input.source(input.halfedge(e));
    if (radius(input, v) > 0.97) flat.edge[e] = true;
  }
  for (const auto v : input.vertices()) {
    if (radius(input, v) > 0.97) flat.corner[v] = true;
  }
  Mesh free = input;
  const Enrichment crossing = enrich(free, flat, 1e-3, parameters::allow_self_intersections(true));
  EXPECT_GT(number_of_self_intersections(free), 0u);
  EXPECT_EQ(crossing.damped_faces, 0u);
  const Enrichment answer = enrich(mesh, flat, 1e-3);
  EXPECT_TRUE(answer.enforced.hold());
  EXPECT_GT(answer.damped_faces, 0u);
  EXPECT_EQ(number_of_self_intersections(mesh), 0u);
}

TEST(Enrich, too_few_rounds_are_told)
{
  Mesh mesh = icosphere(1);
  const Enrichment answer
      = enrich(mesh, features_of(mesh), 1e-5, parameters::maximum_size(10).number_of_iterations(2));
  EXPECT_EQ(answer.rounds, 2u);
  EXPECT_FALSE(answer.enforced.is_fine);
  EXPECT_FALSE(answer.enforced.hold());
  EXPECT_TRUE(is_sound(mesh));
}

TEST(Enrich, takes_a_support)
{
  const Mesh input = icosphere(1);
  const Features features = features_of(input);
  Mesh mesh = input;
  const auto support = make_geometric_support(input, 1e-2, features);
  const Enrichment answer = enrich(mesh, features, 1e-3, parameters::geometric_support(support));
  EXPECT_GT(answer.deviation, 4e-3);
  EXPECT_LE(answer.deviation, 5e-3 * (1 + 1e-9));
}

TEST(Enrich, borders_stay)
{
  const Mesh input = saddle(4);
  Mesh mesh = input;
  EXPECT_TRUE(enrich(mesh, features_of(input), 1e-3).enforced.hold());
  EXPECT_TRUE(have_same_topology(input, mesh));
  expect_vertices_kept(input, mesh);
  const auto is_feature = mesh.property_map<Mesh::Edge_index, bool>("e:is_feature").first;
  for (const auto e : mesh.edges()) {
    EXPECT_TRUE(!mesh.is_border(e) || is_feature[e]);
  }
}

TEST(Enrich, refuses_bad_input_and_leaves_the_mesh_alone)
{
  const Mesh input = icosphere(1);
  Mesh mesh = input;
  const Features features = features_of(input);
  for (const double tolerance : {0., -1., double(NAN), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(enrich(mesh, features, tolerance), Invalid_input);
  EXPECT_THROW(enrich(mesh, Features(), 1e-3), Invalid_input);
  EXPECT_THROW(enrich(mesh, features, 1e-3, parameters::maximum_size(0)), Invalid_input);
  EXPECT_THROW(enrich(mesh, features, 1e-3, parameters::maximum_size(NAN)), Invalid_input);
  const Mesh other = icosphere(0);
  const auto support = make_geometric_support(other, 1, features_of(other));
  EXPECT_THROW(enrich(mesh, features, 1e-3, parameters::geometric_support(support)), Invalid_input);
  EXPECT_EQ(sorted_points(mesh), sorted_points(input));
  EXPECT_EQ(mesh.number_of_faces(), input.number_of_faces());
  Mesh empty;
  EXPECT_THROW(enrich(empty, Features(), 1e-3), Invalid_input);
}

} // namespace
} // namespace surety::test
