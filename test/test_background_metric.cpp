// SPDX-License-Identifier: GPL-3.0-or-later
//
// A metric between vertices: lengths along edges against integrals, interpolation in faces, the
// location of points on sheets that are close to each other.
#include <surety/background_metric.h>
#include <surety/metric.h>

#include "analytic_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace {

using namespace surety::test;
using surety::Background_metric;
using surety::find_features;
using surety::find_sides;
using surety::Length_rule;
using surety::make_metric;
using surety::make_uniform_metric;
using surety::Metric_field;
using surety::Metric_kind;
using surety::metric_length;
using surety::Sides;
using Tensor = Eigen::Matrix3d;
using V = Eigen::Vector3d;
namespace with = surety::parameters;

constexpr std::array<Length_rule, 5> all_rules
    = {Length_rule::linear_size, Length_rule::simpson, Length_rule::trapezoid,
       Length_rule::end_only, Length_rule::logarithmic_mean};

Sides sides_of(const Mesh& mesh, double feature_angle = 180)
{
  return find_sides(mesh, find_features(mesh, with::feature_angle(feature_angle)));
}

/// The integral of a length over an edge, by the midpoint rule on many pieces.
double integral(const std::function<double(double)>& length)
{
  constexpr int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += length((i + 0.5) / n);
  return sum / n;
}

Tensor isotropic(double size) { return Tensor::Identity() / (size * size); }

// ---- lengths ----

TEST(Length, of_a_linear_size_is_exact)
{
  for (const auto& [a, b] : {std::pair(0.1, 0.2), {1.0, 7.0}, {3.0, 3.0}, {2.0, 2.0000001}}) {
    const V e(0.3, 0.4, 1.2);
    const double exact = integral([a = a, b = b](double t) { return 1.3 / (a + t * (b - a)); });
    EXPECT_NEAR(metric_length(e, isotropic(a), isotropic(b)), exact, 1e-7 * exact);
  }
}

TEST(Length, of_a_geometric_size_is_exact)
{
  for (const auto& [a, b] : {std::pair(0.1, 0.2), {1.0, 7.0}, {3.0, 3.0}, {2.0, 2.0000001}}) {
    const V e(0.3, 0.4, 1.2);
    const double exact
        = integral([a = a, b = b](double t) { return 1.3 / (a * std::pow(b / a, t)); });
    EXPECT_NEAR(
        metric_length(e, isotropic(a), isotropic(b), Length_rule::logarithmic_mean), exact,
        1e-7 * exact);
  }
}

TEST(Length, where_the_metric_is_constant_is_exact_for_every_rule)
{
  const Tensor m = V(4, 9, 16).asDiagonal();
  const V e(1, -2, 0.5);
  const double exact = std::sqrt(e.dot(m * e));
  for (const Length_rule rule : all_rules) {
    EXPECT_NEAR(metric_length(e, m, m, rule), exact, 1e-12 * exact);
    EXPECT_EQ(metric_length(V::Zero(), m, m, rule), 0);
  }
  EXPECT_EQ(metric_length(e, m, m, Length_rule::linear_size), exact) << "without any rounding";
  EXPECT_EQ(metric_length(e, m, m, Length_rule::logarithmic_mean), exact);
}

TEST(Length, is_continuous_where_the_sizes_meet)
{
  const V e(1, 0, 0);
  for (int k = 1; k <= 52; ++k) {
    const double b = 1 + std::pow(2.0, -k);
    const double x = std::log(b), expected = x / (b - 1);
    for (const auto rule : {Length_rule::linear_size, Length_rule::logarithmic_mean}) {
      const double l = metric_length(e, isotropic(1), isotropic(b), rule);
      EXPECT_LE(l, 1);
      EXPECT_GE(l, 1 / b);
      if (k < 20 && rule == Length_rule::linear_size) {
        EXPECT_NEAR(l, expected, 1e-9);
      }
    }
  }
}

TEST(Length, does_not_depend_on_the_direction_but_where_only_one_end_counts)
{
  const Tensor a = V(4, 9, 16).asDiagonal(), b = V(25, 1, 3).asDiagonal();
  const V e(1, -2, 0.5);
  for (const Length_rule rule : all_rules) {
    const double there = metric_length(e, a, b, rule), back = metric_length(-e, b, a, rule);
    if (rule == Length_rule::end_only) {
      EXPECT_NE(there, back);
    } else {
      EXPECT_EQ(there, back);
    }
  }
}

TEST(Length, of_rules_lies_between_those_of_the_ends)
{
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double a = random.between(0.01, 1), b = random.between(0.01, 1);
    const V e = V(1, 2, 3) * random.unit();
    const double least = e.norm() / std::max(a, b), largest = e.norm() / std::min(a, b);
    for (const Length_rule rule : all_rules) {
      const double l = metric_length(e, isotropic(a), isotropic(b), rule);
      EXPECT_GE(l, least * (1 - 1e-12));
      EXPECT_LE(l, largest * (1 + 1e-12));
    }
  }
}

/// The mean of |ln(length / exact)| over random edges in a field.
double mean_error(const std::function<Tensor(const V&)>& field, Length_rule rule)
{
  Random random(7);
  double sum = 0;
  int edges = 0;
  while (edges < 400) {
    const V p(random.unit(), random.unit(), 0);
    const double turn = random.between(0, 2 * pi);
    const V d(std::cos(turn), std::sin(turn), 0);
    const V e = d / std::sqrt(d.dot(field(p) * d)); // about unit length
    const V q = p + e;
    if (q.minCoeff() < 0 || q.maxCoeff() > 1) continue;
    const double exact = integral([&](double t) {
      const V x = p + t * e;
      return std::sqrt(e.dot(field(x) * e));
    });
    sum += std::abs(std::log(metric_length(e, field(p), field(q), rule) / exact));
    ++edges;
  }
  return sum / edges;
}

/// Small sizes near a circle.
Tensor ring(const V& p)
{
  const double r = std::hypot(p.x() - 0.5, p.y() - 0.5);
  return isotropic(0.02 + 0.25 * std::abs(r - 0.35));
}

/// The small size of a layer along a circle, so that the directions turn.
Tensor turning_ring(const V& p)
{
  const V radial = V(p.x() - 0.5, p.y() - 0.5, 0).normalized();
  const double r = std::hypot(p.x() - 0.5, p.y() - 0.5), h = 0.02 + 0.25 * std::abs(r - 0.35);
  return surety::internal::metric::tangential(V::UnitZ(), radial, h, 0.1);
}

TEST(Length, of_the_default_rule_is_far_closer_than_those_of_the_paper)
{
  for (const auto& field : {ring, turning_ring}) {
    const double ours = mean_error(field, Length_rule::linear_size);
    EXPECT_LT(ours, 0.015);
    EXPECT_LT(6 * ours, mean_error(field, Length_rule::end_only));
    EXPECT_LT(ours, mean_error(field, Length_rule::trapezoid));
    EXPECT_LT(ours, mean_error(field, Length_rule::logarithmic_mean));
    EXPECT_LE(mean_error(field, Length_rule::simpson), 1.05 * ours);
  }
}

TEST(Edge_length, takes_the_stricter_side_of_a_feature_edge)
{
  const Mesh mesh = cube(2);
  Metric_field metric = make_uniform_metric(
      mesh, sides_of(mesh, 40), 0.5, with::metric_kind(Metric_kind::isotropic));
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    if (metric.normal(s).z() > 0.9) metric.set_size(s, 0.125);
  }
  for (const auto e : mesh.edges()) {
    const Point p = mesh.point(mesh.source(mesh.halfedge(e)));
    const Point q = mesh.point(mesh.target(mesh.halfedge(e)));
    const double length = std::sqrt(CGAL::squared_distance(p, q));
    const bool is_on_top = p.z() == 1 && q.z() == 1;
    EXPECT_NEAR(edge_length(mesh, metric, e), length / (is_on_top ? 0.125 : 0.5), 1e-12);
  }
}

TEST(Edge_length, depends_on_the_rule_and_the_points)
{
  Mesh mesh = grid(4);
  const auto field = [](const Point& p) { return 0.1 + p.x(); };
  const Metric_field metric = make_metric(mesh, sides_of(mesh), field);
  auto doubled = mesh.add_property_map<Vertex, Point>("v:doubled").first;
  for (const Vertex v : mesh.vertices()) {
    doubled[v] = CGAL::ORIGIN + 2 * (mesh.point(v) - CGAL::ORIGIN);
  }
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    const V p = eigen(mesh.point(mesh.source(h))), q = eigen(mesh.point(mesh.target(h)));
    const double plain = edge_length(mesh, metric, e);
    EXPECT_NEAR(
        edge_length(mesh, metric, e, CGAL::parameters::vertex_point_map(doubled)), 2 * plain,
        1e-12);
    if (p.x() == q.x()) continue;
    for (const Length_rule rule : all_rules) {
      const double l = edge_length(mesh, metric, e, with::length_rule(rule));
      EXPECT_NEAR(
          l, metric_length(q - p, isotropic(0.1 + p.x()), isotropic(0.1 + q.x()), rule), 1e-12);
      if (rule == Length_rule::linear_size) continue;
      EXPECT_NE(l, plain);
    }
  }
}

TEST(Edge_length, at_a_border_and_from_one_end_counts_from_the_source)
{
  const Mesh mesh = grid(3);
  const auto field = [](const Point& p) { return 0.1 + p.x() + 2 * p.y(); };
  for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    const Metric_field metric = make_metric(mesh, sides_of(mesh), field, with::metric_kind(kind));
    for (const auto e : mesh.edges()) {
      const Point p = mesh.point(mesh.source(mesh.halfedge(e)));
      const Point q = mesh.point(mesh.target(mesh.halfedge(e)));
      EXPECT_NEAR(
          edge_length(mesh, metric, e, with::length_rule(Length_rule::end_only)),
          std::sqrt(CGAL::squared_distance(p, q)) / field(p), 1e-9);
    }
  }
}

// ---- inside faces ----

TEST(Background_metric, is_linear_in_size)
{
  const Mesh mesh = grid(3);
  const auto size = [](const Point& p) { return 0.1 + p.x() + 2 * p.y(); };
  for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    const Background_metric background(
        mesh, make_metric(mesh, sides_of(mesh), size, with::metric_kind(kind)));
    Random random(2);
    for (int i = 0; i < 200; ++i) {
      const Point p(random.unit(), random.unit(), 0);
      const auto at = background.locate(eigen(p) + V(0, 0, 0.01));
      EXPECT_NEAR(at.weights.sum(), 1, 1e-12);
      EXPECT_NEAR(background.size(at), size(p), 1e-9);
      EXPECT_NEAR(background.tensor(at)(0, 0), 1 / (size(p) * size(p)), 1e-6);
    }
  }
}

TEST(Background_metric, at_vertices_is_that_of_the_side)
{
  const Mesh mesh = cube(3);
  const auto sides = sides_of(mesh, 40);
  Metric_field metric = make_uniform_metric(mesh, sides, 1);
  Random random(3);
  for (std::uint32_t s = 0; s < sides.size(); ++s) metric.set_size(s, random.between(0.1, 1));
  const Background_metric background(mesh, metric);
  for (const Face f : mesh.faces()) {
    auto h = mesh.prev(mesh.halfedge(f));
    for (int i = 0; i < 3; ++i, h = mesh.next(h)) {
      const surety::Surface_location at{f, V::Unit(i)};
      EXPECT_NEAR(
          (background.tensor(at) - metric.tensor_at_corner(h)).norm(), 0,
          1e-9 * metric.tensor_at_corner(h).norm());
    }
  }
}

TEST(Background_metric, between_tensors_interpolates_the_inverse_roots)
{
  const Mesh mesh = to_mesh({{Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)}, {{0, 1, 2}}});
  Metric_field metric = make_uniform_metric(mesh, sides_of(mesh), 1);
  const std::array<V, 3> size = {V(0.1, 1, 1), V(0.5, 0.2, 0.5), V(0.3, 0.4, 0.4)};
  for (const Vertex v : mesh.vertices()) {
    const V h = size[v];
    metric.set_tensor(metric.sides().first[v], h.cwiseAbs2().cwiseInverse().asDiagonal());
  }
  const Background_metric background(mesh, metric);
  const V w(0.2, 0.3, 0.5);
  const Point p(w[1], w[2], 0);
  const auto at = background.locate(eigen(p));
  for (int i = 0; i < 2; ++i) {
    const double h = w[0] * size[0][i] + w[1] * size[1][i] + w[2] * size[2][i];
    EXPECT_NEAR(background.tensor(at)(i, i), 1 / (h * h), 1e-9);
  }
}

// ---- location ----

TEST(Location, is_the_nearest_point_of_all_faces)
{
  const Mesh mesh = random_shape(3);
  const Background_metric background(mesh, make_uniform_metric(mesh, sides_of(mesh), 1));
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Vector d = 1.5 * random.in_cube();
    const V p(d.x(), d.y(), d.z());
    const auto at = background.locate(p);
    const auto corners_of = [&](Face f) {
      std::array<V, 3> corners;
      auto h = mesh.prev(mesh.halfedge(f));
      for (V& c : corners) {
        c = eigen(mesh.point(mesh.target(h)));
        h = mesh.next(h);
      }
      return corners;
    };
    const auto c = corners_of(Face(at.face));
    const V found = at.weights[0] * c[0] + at.weights[1] * c[1] + at.weights[2] * c[2];
    double least = 1e300;
    for (const Face f : mesh.faces()) {
      const auto t = corners_of(f);
      const Kernel::Triangle_3 triangle(cgal(t[0]), cgal(t[1]), cgal(t[2]));
      least = std::min(least, std::sqrt(CGAL::squared_distance(cgal(p), triangle)));
    }
    EXPECT_NEAR((found - p).norm(), least, 1e-9);
    EXPECT_GE(at.weights.minCoeff(), 0);
  }
}

TEST(Location, does_not_mix_up_the_sheets_of_a_thin_plate)
{
  const Mesh mesh = scaled(cube(4), 1, 1, 0.001);
  Metric_field metric = make_uniform_metric(
      mesh, sides_of(mesh, 40), 0.5, with::metric_kind(Metric_kind::isotropic));
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    if (metric.normal(s).z() > 0.9) metric.set_size(s, 0.1);
  }
  const Background_metric background(mesh, metric);
  for (const double z : {-0.01, 0.0, 0.0004, 0.001, 0.01}) {
    const V p(0.4, 0.3, z);
    EXPECT_NEAR(background.size(background.locate(p, V::UnitZ())), 0.1, 1e-12) << z;
    EXPECT_NEAR(background.size(background.locate(p, -V::UnitZ())), 0.5, 1e-12) << z;
  }
  EXPECT_NEAR(background.size(background.locate(V(0.4, 0.3, 0.01))), 0.1, 1e-12);
  EXPECT_NEAR(background.size(background.locate(V(0.4, 0.3, -0.01))), 0.5, 1e-12);
}

TEST(Location, falls_back_on_any_face_when_none_looks_that_way)
{
  const Mesh mesh = grid(3); // looks along z
  const Background_metric background(mesh, make_uniform_metric(mesh, sides_of(mesh), 1));
  const auto at = background.locate(V(0.5, 0.5, 0.1), -V::UnitZ());
  EXPECT_LT(at.face, mesh.num_faces());
  EXPECT_NEAR(at.weights.sum(), 1, 1e-12);
}

TEST(Background_metric, rejects_a_metric_of_another_mesh)
{
  const Mesh mesh = grid(3), other = grid(4);
  const Metric_field metric = make_uniform_metric(mesh, sides_of(mesh), 1);
  EXPECT_THROW(Background_metric(other, metric), surety::Invalid_input);
}

} // namespace
