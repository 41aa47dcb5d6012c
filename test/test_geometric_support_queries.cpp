// SPDX-License-Identifier: GPL-3.0-or-later
//
// Questions to the geometric support: closest points against an exhaustive search, walks, threads,
// hostile faces; and the tolerance, proven and sampled, on generated shapes and real models.
#include "support_surfaces.h"

#include <surety/distance.h>
#include <surety/features_by_need.h>
#include <surety/geometric_mesh.h>
#include <surety/support_on_geometric_mesh.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

namespace {

using namespace surety::test;
using surety::Features;
using surety::find_features;
using surety::Geometric_support;
using surety::make_geometric_support;
using surety::make_support_on_geometric_mesh;
using surety::Support_location;

namespace p = surety::parameters;

// ---- closest points ----

/// The closest point of one patch by its values on finer and finer lattices about the best point.
double exhaustive_distance(const Geometric_support& support, const Vec& target)
{
  double best = no_limit;
  static const std::vector<Vec> coarse = lattice(24), fine = lattice(8);
  for (std::uint32_t f = 0; f < support.number_of_faces(); ++f) {
    Vec at = coarse.front();
    double nearest = no_limit;
    const auto visit = [&](const Vec& b, Vec& found) {
      const double d = (support.position({f, b}) - target).norm();
      if (d < nearest) nearest = d, found = b;
    };
    for (const Vec& b : coarse) visit(b, at);
    for (double size = 1. / 12; size > 1e-7; size /= 3) {
      Vec found = at;
      for (const Vec& b : fine) {
        for (const double sign : {1., -1.}) {
          const Vec offset = at + sign * size * (b - Vec::Constant(1. / 3));
          if (offset.minCoeff() >= 0) visit(offset, found);
          const Vec clamped = offset.cwiseMax(0.0);
          visit(clamped / clamped.sum(), found);
        }
      }
      at = found;
    }
    best = (std::min)(best, nearest);
  }
  return best;
}

class Closest_point : public testing::TestWithParam<double>
{};

TEST_P(Closest_point, is_that_of_an_exhaustive_search)
{
  const double far = GetParam();
  struct Case {
    Mesh mesh;
    double feature_angle, tolerance;
  };
  for (const Case& c :
       {Case{jittered_sphere(1, 2), 180, no_limit}, Case{torus(12, 8), 180, 0.05},
        Case{rotated(cylinder(12, 2), 3), 40, no_limit}, Case{saddle(4), 180, 0.02}}) {
    const Features features = find_features(c.mesh, p::feature_angle(c.feature_angle));
    const auto support = make_geometric_support(c.mesh, c.tolerance, features);
    const double h = mean_edge(c.mesh);
    Random random(std::uint64_t(100 * far));
    for (int i = 0; i < 40; ++i) {
      const Vec target = random_point_near(support, far * h, random);
      const auto found = support.guaranteed_closest_point(target);
      ASSERT_TRUE(found.is_found());
      const double distance = std::sqrt(found.squared_distance);
      EXPECT_NEAR(distance, exhaustive_distance(support, target), 1e-6 * h);
      EXPECT_NEAR((support.position(found.location) - found.point).norm(), 0, 1e-14);
      EXPECT_NEAR((found.point - target).norm(), distance, 1e-14);
      const auto fast = support.closest_point(target);
      EXPECT_GE(std::sqrt(fast.squared_distance), distance - 1e-6 * h);
      // Near a smooth surface the descent finds it, too.
      const bool is_smooth = c.feature_angle == 180 && c.tolerance == no_limit;
      if (is_smooth && far <= 0.02) {
        EXPECT_NEAR(std::sqrt(fast.squared_distance), distance, 1e-6 * h);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Edges_away, Closest_point, testing::Values(0.02, 0.3, 1.0, 3.0));

TEST(Closest_point, of_5000_points_is_never_farther_by_branch_and_bound_than_fast)
{
  const Mesh mesh = torus(48, 24);
  const auto support = make_geometric_support(mesh, no_limit, find_features(mesh));
  const double h = mean_edge(mesh);
  for (const double far : {0.02, 0.3, 1.0, 3.0}) {
    Random random(7);
    int farther = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec target = random_point_near(support, far * h, random);
      const double fast = std::sqrt(support.closest_point(target).squared_distance);
      const double sure = std::sqrt(support.guaranteed_closest_point(target).squared_distance);
      EXPECT_LE(sure, fast + 1e-7 * h);
      farther += fast > sure + 1e-7 * h;
    }
    EXPECT_LE(farther, far > 0.5 ? 50 : 5);
  }
}

TEST(Closest_point, of_a_point_between_two_sheets_depends_on_the_normal)
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

// ---- the tolerance ----

/// Samples every patch; both the face's bound and the report's must hold.
void expect_within_tolerance(const Mesh& mesh, const Geometric_support& support, int density)
{
  const auto& report = support.report();
  EXPECT_LE(report.deviation, report.tolerance / 2);
  EXPECT_LE(report.sampled_saturated_share, report.saturated_share + 1e-12);
  const double rounding = 1e-14 * diagonal_of(mesh);
  const auto samples = lattice(density);
  double excess = -no_limit;
  for (const Face f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Vec a = vec(mesh.point(mesh.source(h))), b = vec(mesh.point(mesh.target(h))),
              c = vec(mesh.point(mesh.target(mesh.next(h))));
    for (const Vec& at : samples) {
      const double moved = (support.position({f, at}) - (at[0] * a + at[1] * b + at[2] * c)).norm();
      excess = (std::max)(excess, moved - support.displacement_bound(f));
      ASSERT_LE(moved, report.deviation + rounding);
    }
  }
  EXPECT_LE(excess, rounding);
}

TEST(Support, of_a_cube_without_features_stays_within_the_tolerance)
{
  for (const double tolerance : {0.1, 0.017, 0.001}) {
    const Mesh mesh = cube(1);
    const auto support = make_geometric_support(mesh, tolerance, find_features(mesh));
    expect_within_tolerance(mesh, support, 30);
  }
}

TEST(Support, within_a_tolerance_is_proven_by_the_verifier_as_well)
{
  // The triangulated support, an independent witness up to the fineness of its triangles.
  const Mesh mesh = torus(16, 8);
  const double tolerance = 0.02;
  const auto support = make_geometric_support(mesh, tolerance, find_features(mesh));
  EXPECT_GT(support.report().saturated_share, 0.5);
  expect_within_tolerance(mesh, support, 12);
  Soup soup;
  const int n = 12;
  for (const Face f : mesh.faces()) {
    std::vector<std::vector<std::size_t>> row(n + 1);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Vec q = support.position(
            {std::uint32_t(f), Vec(double(n - i - j) / n, double(i) / n, double(j) / n)});
        row[i].push_back(soup.points.size());
        soup.points.emplace_back(q.x(), q.y(), q.z());
      }
    }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        soup.triangles.push_back({row[i][j], row[i + 1][j], row[i][j + 1]});
        if (i + j + 1 < n)
          soup.triangles.push_back({row[i + 1][j], row[i + 1][j + 1], row[i][j + 1]});
      }
    }
  }
  EXPECT_TRUE(surety::certify_distance(mesh, to_mesh(soup), tolerance).holds());
}

// ---- on a geometric mesh ----

/// A geometric mesh of a shape, and the support on it.
struct On_geometric_mesh {
  On_geometric_mesh(const Mesh& input, double tolerance, double spent)
    : original(input), mesh(input)
  {
    surety::make_geometric_mesh(mesh, spent);
    const auto deviation = mesh.property_map<Face, double>("f:deviation").first;
    support = std::make_unique<Geometric_support>(
        make_support_on_geometric_mesh(mesh, deviation, tolerance, find_features(mesh)));
  }

  /// From points of the support to the original, which as a support without normals is flat.
  double sampled_distance() const
  {
    const Features features = find_features(original);
    const std::vector<Vec> no_normals(find_sides(original, features).size(), Vec::Zero());
    const auto exact = make_geometric_support(original, 1, features, no_normals);
    EXPECT_LE(exact.report().deviation, 1e-12);
    double largest = 0;
    for (std::uint32_t f = 0; f < support->number_of_faces(); ++f) {
      for (const Vec& b : lattice(8)) {
        const auto near = exact.guaranteed_closest_point(support->position({f, b}));
        largest = (std::max)(largest, std::sqrt(near.squared_distance));
      }
    }
    return largest;
  }

  Mesh original, mesh;
  std::unique_ptr<Geometric_support> support;
};

TEST(Support_on_geometric_mesh, stays_within_what_it_proves)
{
  for (const Mesh& input : {torus(48, 24), cube(6), subdivided(cylinder(12, 3), 2), saddle(12)}) {
    const double tolerance = 0.03;
    const On_geometric_mesh on(input, tolerance, tolerance / 2);
    const auto& report = on.support->report();
    EXPECT_LE(report.deviation, tolerance);
    EXPECT_LE(on.sampled_distance(), report.deviation + 1e-8);
  }
}

TEST(Support_on_geometric_mesh, promotes_the_creases_of_a_cube_and_keeps_a_sphere_smooth)
{
  const On_geometric_mesh box(cube(6), 0.01, 0.005);
  EXPECT_EQ(box.support->report().promoted_edges, 12u);
  EXPECT_EQ(box.support->report().refused_faces, 0u);
  EXPECT_LE(box.support->report().deviation, 1e-12) << "flat faces";
  const On_geometric_mesh ball(icosphere(4), 0.05, 0.005);
  EXPECT_EQ(ball.support->report().promoted_edges, 0u);
  EXPECT_EQ(ball.support->report().flattened_faces, 0u);
  EXPECT_TRUE(ball.support->report().faces_to_refine.empty());
  const On_geometric_mesh tight(icosphere(4), 0.006, 0.005);
  EXPECT_GT(tight.support->report().flattened_faces + tight.support->report().promoted_edges, 0u);
  EXPECT_FALSE(tight.support->report().faces_to_refine.empty());
}

class Model : public testing::TestWithParam<const char*>
{};

TEST_P(Model, has_a_smooth_support_within_the_tolerance)
{
  const char* const folder = std::getenv("SURETY_DATA_DIR");
  if (folder == nullptr || std::string(folder).empty()) GTEST_SKIP() << "no models";
  Mesh mesh;
  if (!CGAL::IO::read_polygon_mesh(std::string(folder) + "/" + GetParam() + ".off", mesh))
    GTEST_SKIP() << "no such model";
  for (const double relative : {0.01, 0.001}) {
    const double tolerance = relative * diagonal_of(mesh);
    for (const bool has_ridges : {false, true}) {
      const Features features
          = has_ridges ? surety::find_features_by_need(mesh, tolerance) : find_features(mesh);
      const auto support = make_geometric_support(mesh, tolerance, features);
      expect_within_tolerance(mesh, support, 6);
      double worst = 0;
      for (const auto e : mesh.edges()) {
        if (support.is_feature(e)) continue;
        for (const double t : {0.1, 0.5}) {
          const auto here = support.location_on_edge(e, t);
          int zero = 0;
          here.barycentric.minCoeff(&zero);
          const auto there = support.across(here, (zero + 1) % 3);
          const auto &s = support.patch_state(here.face), &o = support.patch_state(there.face);
          if (!s.is_tangent || !o.is_tangent || s.may_saturate || o.may_saturate) continue;
          worst = (std::max)(worst, angle(support.normal(here), support.normal(there)));
        }
      }
      EXPECT_LE(worst, 1e-8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Models, Model,
    testing::Values(
        "cube", "mannequin-devil", "cow", "elk", "couplingdown", "fandisk", "anchor_dense",
        "elephant", "blade", "lion-head", "rotor_small"));

} // namespace
