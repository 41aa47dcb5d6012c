// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shape of the geometric support: tangent planes that agree, interpolation, order of
// convergence, and the tolerance.
#include "support_surfaces.h"

#include <surety/distance.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace {

using namespace surety::test;
using surety::Features;
using surety::find_features;
using surety::Geometric_support;
using surety::make_geometric_support;
using surety::Support_location;

namespace p = surety::parameters;

// ---- tangent planes ----

/// What is seen along the edges between tangent faces that are not saturated.
struct Smoothness {
  std::size_t edges = 0, smooth_edges = 0;
  double worst_angle = 0, worst_gap = 0;
};

Smoothness smoothness(const Mesh& mesh, const Geometric_support& support)
{
  Smoothness result;
  for (const auto e : mesh.edges()) {
    if (support.is_feature(e)) continue;
    ++result.edges;
    for (const double t : {0.0, 0.07, 0.25, 0.5, 0.81, 1.0}) {
      const Support_location here = support.location_on_edge(e, t);
      // The edge opposite to the corner whose coordinate is zero at t = 1/2.
      const Support_location middle = support.location_on_edge(e, 0.5);
      int zero = 0;
      middle.barycentric.minCoeff(&zero);
      const Support_location there = support.across(here, (zero + 1) % 3);
      result.worst_gap
          = (std::max)(result.worst_gap, (support.position(here) - support.position(there)).norm());
      const auto is_smooth = [&](const Support_location& at) {
        const auto& state = support.patch_state(at.face);
        return state.is_tangent && !state.may_saturate;
      };
      if (!is_smooth(here) || !is_smooth(there)) continue;
      if (t == 0.5) ++result.smooth_edges;
      result.worst_angle
          = (std::max)(result.worst_angle, angle(support.normal(here), support.normal(there)));
    }
  }
  return result;
}

void expect_smooth(const Mesh& mesh, const Geometric_support& support, double least_share)
{
  const Smoothness s = smoothness(mesh, support);
  EXPECT_LE(s.worst_angle, 1e-8);
  EXPECT_LE(s.worst_gap, 1e-14 * diagonal_of(mesh));
  EXPECT_GE(double(s.smooth_edges), least_share * double(s.edges));
}

TEST(Support, is_g1_on_smooth_surfaces)
{
  for (const Mesh& mesh :
       {icosphere(2), jittered_sphere(3, 1), torus(24, 12), ellipsoid(3, 3, 1, 0.5)}) {
    const Features features = find_features(mesh);
    expect_smooth(mesh, make_geometric_support(mesh, no_limit, features), 1);
  }
}

class Random_normals : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_normals, still_make_it_g1)
{
  const Mesh mesh = jittered_sphere(3, GetParam());
  const Features features = find_features(mesh);
  const auto normals = random_normals(mesh, features, 0.3, GetParam());
  expect_smooth(mesh, make_geometric_support(mesh, no_limit, features, normals), 0.5);
}

TEST_P(Random_normals, that_look_away_from_their_faces_make_no_patch_that_does)
{
  const Mesh mesh = jittered_sphere(3, GetParam());
  const Features features = find_features(mesh);
  const auto normals = random_normals(mesh, features, 1.5, GetParam());
  const auto support = make_geometric_support(mesh, no_limit, features, normals);
  EXPECT_GT(support.report().refused_faces, 0u);
  expect_smooth(mesh, support, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_normals, testing::Range(0u, 5u));

TEST(Support, is_g1_beside_ridges_borders_and_corners)
{
  for (const Mesh& mesh :
       {rotated(cylinder(24, 8), 1), rotated(cube(4), 2), saddle(6), annulus(24, 3),
        moebius_cut(40, 4)}) {
    const Features features = find_features(mesh, p::feature_angle(40));
    expect_smooth(mesh, make_geometric_support(mesh, no_limit, features), 0.9);
  }
}

TEST(Support, has_curved_ridges_with_one_tangent_for_both_sides)
{
  const std::size_t around = 24;
  const Mesh mesh = cylinder(around, 6);
  const Features features = find_features(mesh, p::feature_angle(40));
  const auto support = make_geometric_support(mesh, no_limit, features);
  for (const auto e : mesh.edges()) {
    if (!features.edge[e]) continue;
    for (const double t : {0.0, 0.3, 0.5, 1.0}) {
      const auto at = support.curve_point(e, t);
      EXPECT_NEAR(std::hypot(at.point.x(), at.point.y()), 1, 2e-5) << "a circle";
      EXPECT_NEAR(at.tangent.dot(Vec(at.point.x(), at.point.y(), 0)), 0, 2e-3);
      EXPECT_NEAR(at.tangent.norm(), 1, 1e-12);
      EXPECT_NEAR(at.tangent.z(), 0, 1e-12);
    }
  }
}

// ---- interpolation ----

TEST(Support, interpolates_vertices_and_normals)
{
  const Mesh mesh = torus(24, 12);
  const Features features = find_features(mesh);
  const auto exact = analytic_torus();
  const auto support = make_geometric_support(
      mesh, no_limit, features, side_normals(mesh, features, exact.normal));
  for (std::uint32_t f = 0; f < support.number_of_faces(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const Vec p = vec(mesh.point(Vertex(support.corners(f)[i])));
      const Support_location at{f, Vec::Unit(i)};
      EXPECT_EQ(support.position(at), p);
      EXPECT_LE(angle(support.normal(at), exact.normal(p)), 1e-12);
    }
  }
}

TEST(Support, derivatives_are_those_of_the_position)
{
  const Mesh mesh = jittered_sphere(1, 3);
  const Features features = find_features(mesh);
  // With saturation: the displacements reach some 0.05.
  for (const double tolerance : {no_limit, 0.08}) {
    const auto support = make_geometric_support(mesh, tolerance, features);
    std::size_t saturated = 0;
    for (std::uint32_t f = 0; f < support.number_of_faces(); ++f) {
      saturated += support.patch_state(f).may_saturate;
      const Vec at(0.5, 0.2, 0.3);
      const auto point = [&](double v, double w) {
        return support.position({f, at + Vec(-v - w, v, w)});
      };
      const double h = 1e-4;
      const auto jet = support.derivatives({f, at});
      EXPECT_LE((jet.point - point(0, 0)).norm(), 1e-14);
      EXPECT_LE((jet.v - (point(h, 0) - point(-h, 0)) / (2 * h)).norm(), 1e-4 * jet.v.norm());
      EXPECT_LE((jet.w - (point(0, h) - point(0, -h)) / (2 * h)).norm(), 1e-4 * jet.w.norm());
      const auto second = [&](double v, double w) {
        return Vec((point(v, w) - 2 * point(0, 0) + point(-v, -w)) / (h * h));
      };
      const double size = jet.vv.norm() + jet.ww.norm() + jet.vw.norm();
      EXPECT_LE((jet.vv - second(h, 0)).norm(), 5e-2 * size);
      EXPECT_LE((jet.ww - second(0, h)).norm(), 5e-2 * size);
      EXPECT_LE((2 * jet.vw + jet.vv + jet.ww - second(h, h)).norm(), 1e-1 * size);
    }
    EXPECT_EQ(saturated > 0, tolerance < no_limit);
  }
}

TEST(Support, has_the_curvature_of_spheres_and_tori)
{
  const Mesh mesh = icosphere(4);
  const auto support = make_geometric_support(mesh, no_limit, find_features(mesh));
  for (std::uint32_t f = 0; f < support.number_of_faces(); f += 7) {
    const auto k = support.curvature({f, Vec(0.3, 0.3, 0.4)});
    EXPECT_NEAR(k.min_curvature, -1, 0.05) << "outward normals";
    EXPECT_NEAR(k.max_curvature, -1, 0.05);
  }
  const Mesh ring = torus(96, 48);
  const Features features = find_features(ring);
  const auto exact = analytic_torus();
  const auto around = make_geometric_support(
      ring, no_limit, features, side_normals(ring, features, exact.normal));
  for (std::uint32_t f = 0; f < around.number_of_faces(); f += 7) {
    const Support_location at{f, Vec(0.3, 0.3, 0.4)};
    const auto k = around.curvature(at);
    const Vec q = around.position(at);
    const double cosine = (std::hypot(q.x(), q.y()) - 1) / 0.4;
    EXPECT_NEAR(k.min_curvature, -2.5, 0.1);
    EXPECT_NEAR(k.max_curvature, -cosine / (1 + 0.4 * cosine), 0.1);
    EXPECT_NEAR(k.min_direction.dot(k.max_direction), 0, 1e-12);
    EXPECT_NEAR(k.min_direction.dot(Vec(-q.y(), q.x(), 0).normalized()), 0, 0.05);
  }
}

// ---- order of convergence ----

double order(double coarse, double fine) { return std::log2(coarse / fine); }

TEST(Support, converges_with_order_four_on_the_sphere)
{
  const Errors coarse = support_errors(icosphere(3), unit_sphere());
  const Errors fine = support_errors(icosphere(4), unit_sphere());
  EXPECT_GE(order(coarse.largest, fine.largest), 3.8);
  EXPECT_GE(order(coarse.median, fine.median), 3.8);
}

TEST(Support, converges_on_the_torus)
{
  const Errors coarse = support_errors(torus(64, 32), analytic_torus());
  const Errors fine = support_errors(torus(128, 64), analytic_torus());
  EXPECT_GE(order(coarse.largest, fine.largest), 2.9);
  EXPECT_GE(order(coarse.median, fine.median), 3.7);
}

TEST(Support, errs_by_at_most_a_quarter_of_what_pn_triangles_do)
{
  for (const Mesh& mesh : {icosphere(3), jittered_sphere(4, 1)}) {
    EXPECT_LE(
        4 * support_errors(mesh, unit_sphere()).median, pn_errors(mesh, unit_sphere()).median);
  }
  for (const Mesh& mesh : {torus(64, 32), jittered_torus(64, 1)}) {
    EXPECT_LE(
        4 * support_errors(mesh, analytic_torus()).median,
        pn_errors(mesh, analytic_torus()).median);
  }
}

} // namespace
