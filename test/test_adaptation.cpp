// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that respect a metric in the background: they have its sizes, and stay within the
// tolerance of the first mesh however often they are made anew.
#include <surety/background_metric.h>
#include <surety/distance.h>
#include <surety/gradation.h>
#include <surety/metric.h>
#include <surety/remesh.h>
#include <surety/solution_metric.h>

#include "invariants.h"
#include "meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surety::test {
namespace {

using Edge = Mesh::Edge_index;

double length_of(const Mesh& mesh, Edge e)
{
  return std::sqrt(
      CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
}

double mean_edge(const Mesh& mesh)
{
  double sum = 0;
  for (const Edge e : mesh.edges()) sum += length_of(mesh, e);
  return sum / double(mesh.number_of_edges());
}

template <class Size>
Metric_field graded_metric(const Mesh& mesh, const Size& size, Metric_kind kind)
{
  Metric_field metric = make_metric(
      mesh, find_sides(mesh, find_features(mesh)), size, parameters::metric_kind(kind));
  limit_gradation(mesh, metric);
  return metric;
}

double uniform_small(const Point&) { return .1; }
double uniform_large(const Point&) { return .5; }
/// Small near to a parallel of a sphere.
double band(const Point& p) { return .04 + .4 * std::abs(p.z() - .2); }

class Kinds : public testing::TestWithParam<Metric_kind>
{};

TEST_P(Kinds, the_background_counts_where_it_is_smaller)
{
  const Mesh first = icosphere(3), carrier = rotated(jittered_sphere(4, 1), 2);
  const auto make = [&](const Metric_field& own, const Metric_field& behind) {
    Mesh mesh = first;
    const Background_metric background(carrier, behind);
    const auto made
        = make_unit_mesh(mesh, own, parameters::tolerance(.03).background_metric(background));
    EXPECT_TRUE(made.certificate.holds());
    EXPECT_TRUE(is_sound(mesh));
    EXPECT_GE(made.fit.unit_edges, 98);
    return mean_edge(mesh);
  };
  const auto small = graded_metric(first, uniform_small, GetParam());
  const auto large = graded_metric(first, uniform_large, GetParam());
  const double both_large = make(large, graded_metric(carrier, uniform_large, GetParam()));
  EXPECT_GT(both_large, .3);
  EXPECT_NEAR(make(large, graded_metric(carrier, uniform_small, GetParam())), .1, .012);
  EXPECT_NEAR(make(small, graded_metric(carrier, uniform_large, GetParam())), .1, .012);
}

TEST_P(Kinds, splits_go_down_to_the_background_where_the_first_mesh_is_coarse)
{
  const Mesh first = icosphere(2), carrier = icosphere(5);
  const Background_metric background(carrier, graded_metric(carrier, band, GetParam()));
  Mesh mesh = first;
  const auto made = make_unit_mesh(
      mesh, graded_metric(first, uniform_large, GetParam()),
      parameters::tolerance(.05).background_metric(background));
  EXPECT_TRUE(certify_distance(first, mesh, .05).holds());
  EXPECT_GE(made.fit.unit_edges, 97);
  double sum = 0;
  int number = 0;
  for (const Edge e : mesh.edges()) {
    const Point p = CGAL::midpoint(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1)));
    if (std::abs(p.z() - .2) > .02) continue;
    sum += length_of(mesh, e);
    ++number;
  }
  ASSERT_GT(number, 50);
  EXPECT_NEAR(sum / number, .045, .012);
}

/// Curves and corners ask the background, too.
TEST_P(Kinds, borders_have_the_sizes_of_the_background)
{
  const Mesh first = grid(5), carrier = grid(20);
  const Background_metric background(carrier, graded_metric(carrier, uniform_small, GetParam()));
  Mesh mesh = first;
  make_unit_mesh(
      mesh, graded_metric(first, uniform_large, GetParam()),
      parameters::tolerance(.01).background_metric(background));
  int borders = 0;
  for (const Edge e : mesh.edges()) borders += mesh.is_border(e) ? 1 : 0;
  EXPECT_GE(borders, 34);
  EXPECT_LE(borders, 50);
}

TEST_P(Kinds, the_result_does_not_depend_on_units)
{
  const Mesh first = icosphere(2), carrier = icosphere(3);
  const auto make = [&](double unit) {
    const auto size = [&](const Point& p) {
      return unit * band(Point(p.x() / unit, p.y() / unit, p.z() / unit));
    };
    const Mesh behind = scaled(carrier, unit);
    const Background_metric background(behind, graded_metric(behind, size, GetParam()));
    Mesh mesh = scaled(first, unit);
    const auto large = [&](const Point&) { return .5 * unit; };
    make_unit_mesh(
        mesh, graded_metric(mesh, large, GetParam()),
        parameters::tolerance(.05 * unit).background_metric(background));
    return mesh;
  };
  const Mesh one = make(1), other = make(1024);
  ASSERT_EQ(one.number_of_faces(), other.number_of_faces());
  for (const Vertex v : one.vertices()) EXPECT_EQ(scaled(one, 1024).point(v), other.point(v));
}

INSTANTIATE_TEST_SUITE_P(
    Both, Kinds, testing::Values(Metric_kind::isotropic, Metric_kind::anisotropic));

TEST(Adaptation, remesh_hands_the_background_on)
{
  const Mesh carrier = icosphere(4);
  const Background_metric background(
      carrier, graded_metric(carrier, uniform_small, Metric_kind::isotropic));
  Mesh with = icosphere(3), without = with;
  remesh(with, .03, parameters::background_metric(background));
  remesh(without, .03);
  EXPECT_GT(with.number_of_faces(), 2 * without.number_of_faces());
  EXPECT_NEAR(mean_edge(with), .1, .012);
}

/// Ten times, each mesh carrying the sizes of the next: what is near to the first mesh stays near
/// to it.
TEST(Adaptation, ten_loops_stay_within_the_tolerance_of_the_first_mesh)
{
  const Mesh first = icosphere(3);
  const double tolerance = .02;
  const auto features = find_features(first);
  const auto metric = graded_metric(
      first, [](const Point&) { return .35; }, Metric_kind::anisotropic);
  const auto support = make_geometric_support(first, tolerance, features);
  Mesh mesh = first;
  for (int loop = 0; loop < 10; ++loop) {
    const double place = -.5 + .1 * loop;
    auto field = mesh.add_property_map<Vertex, double>("v:u").first;
    for (const Vertex v : mesh.vertices()) field[v] = std::tanh((mesh.point(v).z() - place) / .15);
    Metric_field sizes = make_solution_metric(
        mesh, find_features(mesh), field, parameters::target_vertices(250).maximum_size(.5));
    limit_gradation(mesh, sizes);
    const Background_metric background(mesh, sizes);
    Mesh next = first;
    const auto made = make_unit_mesh(
        next, features, metric,
        parameters::tolerance(tolerance).geometric_support(support).background_metric(background));
    EXPECT_TRUE(made.certificate.holds());
    EXPECT_TRUE(certify_distance(first, next, tolerance).holds()) << loop;
    EXPECT_GE(made.fit.unit_edges, 97) << loop;
    EXPECT_TRUE(have_same_topology(first, next));
    mesh = next;
    // Zones of a sphere have areas in proportion to their heights: vertices crowd at the front.
    int near = 0, far = 0;
    for (const Vertex v : mesh.vertices()) {
      const double z = std::abs(mesh.point(v).z() - place);
      if (z < .2) ++near;
      if (z > .5) ++far;
    }
    const double far_height = 2 - (std::min(1., place + .5) - std::max(-1., place - .5));
    EXPECT_GT(near / .4, 1.5 * far / far_height) << loop;
  }
}

} // namespace
} // namespace surety::test
