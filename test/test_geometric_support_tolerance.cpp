// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tolerance of the geometric support, sampled and proven by an independent program, on
// generated shapes and real models; and supports on geometric meshes.
#include "support_surfaces.h"

#include <surety/distance.h>
#include <surety/features_by_need.h>
#include <surety/geometric_mesh.h>
#include <surety/support_on_geometric_mesh.h>
#include <surety/support_tessellation.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace {

using namespace surety::test;
using surety::Features;
using surety::find_features;
using surety::Geometric_support;
using surety::make_geometric_support;
using surety::make_support_on_geometric_mesh;

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

/// \brief An independent program proves that the support cut into triangles is within what is
/// promised of the whole: the promise is that each point moves by at most half of the tolerance
/// from its flat face, which then holds for all points of such triangles, however coarse or fine.
///
/// The slack is that of the proof, one per cent.
void expect_certified(const Mesh& mesh, const Geometric_support& support, std::size_t subdivisions)
{
  const auto pieces = surety::tessellate(support, subdivisions);
  Mesh drawn;
  for (const auto& at : pieces.location) {
    const Vec q = support.position(at);
    drawn.add_vertex(Point(q.x(), q.y(), q.z()));
  }
  for (const auto& [a, b, c] : pieces.triangle) {
    drawn.add_face(
        Vertex(Mesh::size_type(a)), Vertex(Mesh::size_type(b)), Vertex(Mesh::size_type(c)));
  }
  const double bound = 1.01 * support.report().tolerance / 2;
  const auto proof = surety::certify_distance(mesh, drawn, bound);
  EXPECT_TRUE(proof.holds()) << proof.lower_bound() << " to " << proof.upper_bound() << " of "
                             << bound;
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
  expect_certified(mesh, support, 12);
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
      if (mesh.number_of_faces() < 6000) expect_certified(mesh, support, 3);
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
