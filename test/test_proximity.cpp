// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sizes where curves of features are near to each other: on plates and rings whose widths are
// known.
#include <surety/proximity.h>

#include "meshes.h"
#include "polyhedra.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace surety::test;
using surety::Features;
using surety::find_features;
using surety::Invalid_input;
using surety::limit_proximity;
using surety::Metric_field;
using surety::Metric_kind;
namespace with = surety::parameters;

const double row = 2 / std::sqrt(3.); // size over height of an equilateral triangle

Metric_field uniform(
    const Mesh& mesh, const Features& features, double size,
    Metric_kind kind = Metric_kind::isotropic)
{
  auto sides = surety::find_sides(mesh, features);
  std::vector<Metric_field::Vector> normals(sides.size(), {0, 0, 1}),
      tangents(mesh.number_of_vertices(), Metric_field::Vector::Zero());
  return Metric_field(kind, std::move(sides), std::move(normals), std::move(tangents), size);
}

/// 4 x 4 x 0.2, with vertices half a unit apart.
Mesh plate() { return scaled(brick(8, 8, 1), 0.5, 0.5, 0.2); }

bool is_at_rim(const Point& p) { return p.x() == 0 || p.x() == 4 || p.y() == 0 || p.y() == 4; }
bool is_corner(const Point& p) { return (p.x() == 0 || p.x() == 4) && (p.y() == 0 || p.y() == 4); }

TEST(Proximity, lets_one_row_of_faces_fit_between_two_ridges)
{
  const Mesh mesh = plate();
  const Features features = find_features(mesh, with::feature_angle(40));
  Metric_field metric = uniform(mesh, features, 1);
  EXPECT_GT(limit_proximity(mesh, metric, features), 0u);
  for (const Vertex v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    const double size = metric.size_at_vertex(v);
    if (!is_at_rim(p))
      EXPECT_EQ(size, 1);
    else if (is_corner(p))
      EXPECT_NEAR(size, 0.2, 1e-12) << "the edge down from it is a curve between two corners";
    else // widths are measured at the middles of the edges, a quarter of a unit away
      EXPECT_NEAR(size, 0.2 * row + std::log(1.3) * 0.25, 1e-12);
  }
}

TEST(Proximity, counts_at_borders_too)
{
  constexpr double width = 0.05;
  const Mesh ring = annulus(400, 3, 1 - width, 1);
  const Features features = find_features(ring);
  Metric_field metric = uniform(ring, features, 0.5);
  limit_proximity(ring, metric, features);
  for (const Vertex v : ring.vertices()) {
    const double size = metric.size_at_vertex(v);
    if (ring.is_border(v))
      EXPECT_NEAR(size, width * row, 0.05 * width);
    else
      EXPECT_EQ(size, 0.5);
  }
}

TEST(Proximity, leaves_sizes_alone_where_there_is_room)
{
  const Mesh mesh = cube(4);
  const Features features = find_features(mesh, with::feature_angle(40));
  Metric_field metric = uniform(mesh, features, 0.8);
  EXPECT_EQ(limit_proximity(mesh, metric, features), 0u);
}

TEST(Proximity, does_not_count_where_curves_meet_at_an_angle)
{
  // Halves of a square: the sides at the corner of 45 degrees come as near as one likes.
  Mesh triangle;
  std::array<Vertex, 3> v{
      triangle.add_vertex(Point(0, 0, 0)), triangle.add_vertex(Point(8, 0, 0)),
      triangle.add_vertex(Point(8, 8, 0))};
  triangle.add_face(v[0], v[1], v[2]);
  triangle = subdivided(triangle, 5);
  const Features features = find_features(triangle);
  Metric_field metric = uniform(triangle, features, 1);
  EXPECT_EQ(limit_proximity(triangle, metric, features), 0u);
}

TEST(Proximity, respects_the_least_size)
{
  const Mesh mesh = plate();
  const Features features = find_features(mesh, with::feature_angle(40));
  Metric_field metric = uniform(mesh, features, 1);
  limit_proximity(mesh, metric, features, with::minimum_size(0.6));
  for (const Vertex v : mesh.vertices())
    EXPECT_EQ(metric.size_at_vertex(v), is_at_rim(mesh.point(v)) ? 0.6 : 1);
}

TEST(Proximity, reaches_farther_the_slower_sizes_may_grow)
{
  const Mesh mesh = plate();
  const Features features = find_features(mesh, with::feature_angle(40));
  Metric_field slow = uniform(mesh, features, 1), fast = slow;
  limit_proximity(mesh, slow, features, with::gradation(1.1));
  limit_proximity(mesh, fast, features, with::gradation(2));
  for (const Vertex v : mesh.vertices()) {
    if (!is_at_rim(mesh.point(v)) || is_corner(mesh.point(v))) continue;
    EXPECT_LT(slow.size_at_vertex(v), fast.size_at_vertex(v));
  }
}

TEST(Proximity, scales_with_the_mesh)
{
  const Mesh mesh = plate(), large = scaled(mesh, 1024);
  const Features features = find_features(mesh, with::feature_angle(40));
  Metric_field metric = uniform(mesh, features, 1), of_large = uniform(large, features, 1024);
  limit_proximity(mesh, metric, features);
  limit_proximity(large, of_large, features);
  for (const Vertex v : mesh.vertices())
    EXPECT_EQ(1024 * metric.size_at_vertex(v), of_large.size_at_vertex(v));
}

TEST(Proximity, refuses_what_it_cannot_limit)
{
  const Mesh mesh = plate(), other = cube(2);
  const Features features = find_features(mesh, with::feature_angle(40));
  Metric_field metric = uniform(mesh, features, 1);
  Metric_field tensors = uniform(mesh, features, 1, Metric_kind::anisotropic);
  EXPECT_THROW(limit_proximity(mesh, tensors, features), Invalid_input);
  EXPECT_THROW(limit_proximity(other, metric, find_features(other)), Invalid_input);
  EXPECT_THROW(limit_proximity(other, metric, features), Invalid_input);
  EXPECT_THROW(limit_proximity(mesh, metric, features, with::gradation(0.5)), Invalid_input);
  EXPECT_THROW(limit_proximity(mesh, metric, features, with::minimum_size(-1)), Invalid_input);
}

} // namespace
