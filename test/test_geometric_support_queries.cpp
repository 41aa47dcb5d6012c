// SPDX-License-Identifier: GPL-3.0-or-later
//
// Questions to the geometric support: thin sheets, walks, threads, hostile faces, scale.
#include "support_surfaces.h"

#include <gtest/gtest.h>

#include <thread>

namespace {

using namespace surety::test;
using surety::Features;
using surety::find_features;
using surety::Geometric_support;
using surety::make_geometric_support;
using surety::Support_location;

namespace p = surety::parameters;

// ---- thin sheets ----

TEST(Thin_sheets, have_a_closest_point_each_that_depends_on_the_normal)
{
  const Mesh mesh = scaled(cube(4), 1, 1, 0.01);
  const Features features = find_features(mesh, p::feature_angle(40));
  const auto support = make_geometric_support(mesh, 0.001, features);
  const Vec inside(0.37, 0.41, 0.004);
  EXPECT_NEAR(support.closest_point(inside).point.z(), 0, 1e-12);
  for (const bool is_sure : {false, true}) {
    const Geometric_support::Facing up{Vec(0, 0, 1), 60};
    const auto found = is_sure ? support.guaranteed_closest_point(inside, up)
                               : support.closest_point(inside, up);
    EXPECT_NEAR(found.point.z(), 0.01, 1e-12);
    const Geometric_support::Facing oblique{Vec(1, 1, 1).normalized(), 10};
    EXPECT_FALSE((is_sure ? support.guaranteed_closest_point(inside, oblique)
                          : support.closest_point(inside, oblique))
                     .is_found());
  }
}

// ---- walks ----

TEST(Walk, goes_round_the_sphere_in_small_steps)
{
  const Mesh mesh = jittered_sphere(3, 4);
  const auto support = make_geometric_support(mesh, no_limit, find_features(mesh));
  Support_location at{0, Vec(0.2, 0.3, 0.5)};
  const Vec start = support.position(at);
  const Vec axis = start.cross(Vec(0.3, -0.5, 0.8)).normalized();
  const int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const Vec q = support.position(at);
    const auto walk = support.walk(at, axis.cross(q).normalized() * 2 * pi / steps);
    EXPECT_EQ(walk.remaining, Vec::Zero());
    at = walk.location;
  }
  EXPECT_LE((support.position(at) - start).norm(), 0.02);
}

TEST(Walk, stops_at_borders_and_if_asked_at_features)
{
  const Mesh mesh = grid(3);
  const auto support = make_geometric_support(mesh, 0.1, find_features(mesh));
  const auto out = support.walk({0, Vec::Constant(1. / 3)}, Vec(5, 0.01, 0));
  EXPECT_NEAR(support.position(out.location).x(), 1, 1e-12);
  EXPECT_GT(out.remaining.norm(), 3);

  const Mesh box = cube(2);
  const auto edges = find_features(box, p::feature_angle(40));
  const auto solid = make_geometric_support(box, 0.1, edges);
  const auto start = solid.closest_point(Vec(0.6, 0.55, 1.2)).location;
  const auto round = solid.walk(start, Vec(0.7, 0, 0));
  EXPECT_LE((solid.position(round.location) - Vec(1, 0.55, 0.7)).norm(), 1e-9);
  EXPECT_LE(
      (solid.position(solid.walk(start, Vec(0.7, 0, 0), false).location) - Vec(1, 0.55, 1)).norm(),
      1e-9);
}

// ---- robustness ----

TEST(Support, of_hostile_faces_and_normals_has_no_nan)
{
  for (const double thin : {1e-3, 1e-8, 1e-15}) {
    const Mesh mesh = jittered(scaled(icosphere(2), 1, thin, 1), 1e-3 * thin, 1);
    const Features features = find_features(mesh);
    for (int kind = 0; kind < 3; ++kind) {
      std::vector<Vec> normals;
      Random random(5);
      for (std::size_t s = 0; s < mesh.number_of_vertices(); ++s) {
        const Vector n = random.in_cube();
        normals.push_back(
            kind == 0       ? Vec(Vec::Zero())
                : kind == 1 ? Vec(0, s % 2 == 0 ? 1 : -1, 0)
                            : Vec(n.x(), n.y(), n.z()));
      }
      const auto support = make_geometric_support(mesh, 0.01, features, normals);
      for (std::uint32_t f = 0; f < support.number_of_faces(); ++f) {
        for (const Vec& b : lattice(3)) {
          const auto jet = support.derivatives({f, b});
          EXPECT_TRUE(jet.point.allFinite() && jet.vv.allFinite() && jet.vw.allFinite());
          EXPECT_NEAR(support.normal({f, b}).norm(), 1, 1e-9);
          EXPECT_TRUE(std::isfinite(support.curvature({f, b}).max_curvature));
        }
      }
      for (int i = 0; i < 20; ++i) {
        const Vector q = random.in_cube();
        const auto found = support.guaranteed_closest_point(Vec(q.x(), q.y(), q.z()));
        EXPECT_TRUE(std::isfinite(found.squared_distance) && found.point.allFinite());
      }
      EXPECT_LE(support.report().deviation, 0.005);
    }
  }
}

TEST(Support, scales_with_the_mesh_to_the_last_bit)
{
  const Mesh mesh = jittered_sphere(2, 3);
  const Features features = find_features(mesh);
  const auto support = make_geometric_support(mesh, 0.01, features);
  for (const double s : {0x1p10, 0x1p-10}) {
    const auto larger = make_geometric_support(scaled(mesh, s), 0.01 * s, features);
    EXPECT_EQ(larger.report().deviation, s * support.report().deviation);
    Random random(1);
    for (int i = 0; i < 200; ++i) {
      const Vec target = random_point_near(support, 0.2, random);
      const auto one = support.closest_point(target), other = larger.closest_point(s * target);
      EXPECT_EQ(Vec(s * one.point), other.point);
      EXPECT_EQ(one.location.face, other.location.face);
    }
  }
}

TEST(Support, answers_several_threads_as_it_answers_one)
{
  const Mesh mesh = torus(32, 16);
  const auto support = make_geometric_support(mesh, 0.01, find_features(mesh));
  const auto answers = [&support] {
    std::vector<double> result;
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
      const Vec target = random_point_near(support, 0.1, random);
      result.push_back(support.closest_point(target).squared_distance);
      result.push_back(support.guaranteed_closest_point(target).squared_distance);
    }
    return result;
  };
  const auto expected = answers();
  std::vector<std::vector<double>> found(4);
  std::vector<std::thread> threads;
  for (auto& f : found) threads.emplace_back([&] { f = answers(); });
  for (auto& thread : threads) thread.join();
  for (const auto& f : found) EXPECT_EQ(f, expected);
}

TEST(Support, refuses_what_is_not_of_its_mesh)
{
  const Mesh mesh = icosphere(1);
  const Features features = find_features(mesh);
  EXPECT_THROW(make_geometric_support(mesh, 0, features), surety::Invalid_input);
  EXPECT_THROW(make_geometric_support(mesh, NAN, features), surety::Invalid_input);
  EXPECT_THROW(make_geometric_support(Mesh(), 1, Features()), surety::Invalid_input);
  EXPECT_THROW(make_geometric_support(mesh, 1, Features()), surety::Invalid_input);
  EXPECT_THROW(
      make_geometric_support(mesh, 1, features, std::vector<Vec>(3)), surety::Invalid_input);
}

} // namespace
