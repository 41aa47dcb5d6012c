// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric metric on surfaces whose curvature is known in closed form: the gap that it
// promises, features, limits, every named parameter, metrics of the user.
#include <surety/metric.h>

#include "analytic_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace {

using namespace surety::test;
using surety::Curvature_field;
using surety::find_features;
using surety::find_sides;
using surety::Invalid_input;
using surety::make_geometric_metric;
using surety::Metric_field;
using surety::Metric_kind;
using surety::Side_curvature;
using Tensor = Eigen::Matrix3d;
using V = Eigen::Vector3d;
namespace with = surety::parameters;

double diagonal(const Mesh& mesh)
{
  V low = V::Constant(1e300), high = -low;
  for (const Vertex v : mesh.vertices()) {
    low = low.cwiseMin(eigen(mesh.point(v)));
    high = high.cwiseMax(eigen(mesh.point(v)));
  }
  return (high - low).norm();
}

// ---- the gap ----

/// The distance to the surface of the triangle whose corners are projections of those given.
double gap(const Analytic_surface& surface, std::array<V, 3> corner)
{
  for (V& p : corner) p = surface.projected(p);
  constexpr int n = 6; // a multiple of 3 and of 2: centre and midpoints are among the points
  double worst = 0;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      const V p = (i * corner[0] + j * corner[1] + (n - i - j) * corner[2]) / n;
      worst = std::max(worst, surface.distance(p));
    }
  }
  return worst;
}

/// The worst gap of the triangles that are equilateral with sides 1 in the metric at their centre.
double worst_gap(const Analytic_surface& surface, const V& centre, const V& n, const Tensor& m)
{
  const auto basis = surety::internal::metric::tangent_basis(n);
  const Tensor h = surety::internal::metric::size_tensor(m);
  double worst = 0;
  for (int turn = 0; turn < 12; ++turn) {
    std::array<V, 3> corner;
    for (int i = 0; i < 3; ++i) {
      const double a = 2 * pi * (i + turn / 12.0) / 3;
      const V unit = (std::cos(a) * basis[0] + std::sin(a) * basis[1]) / std::sqrt(3.0);
      corner[i] = centre + h * unit;
    }
    worst = std::max(worst, gap(surface, corner));
  }
  return worst;
}

/// The same for triangles that have a corner where the metric is.
double worst_gap_at_corner(const Analytic_surface& surface, const V& p, const V& n, const Tensor& m)
{
  const auto basis = surety::internal::metric::tangent_basis(n);
  const Tensor h = surety::internal::metric::size_tensor(m);
  const auto at
      = [&](double a) -> V { return p + h * (std::cos(a) * basis[0] + std::sin(a) * basis[1]); };
  double worst = 0;
  for (int turn = 0; turn < 24; ++turn) {
    const double a = 2 * pi * turn / 24.0;
    worst = std::max(worst, gap(surface, {p, at(a), at(a + pi / 3)}));
  }
  return worst;
}

struct Gap_case {
  Analytic_surface surface;
  Mesh mesh;
};

std::vector<Gap_case> gap_cases()
{
  return {
      {sphere_surface(1), icosphere(2)},
      {ellipsoid_surface(1, 0.7, 0.5), ellipsoid(3, 1, 0.7, 0.5)},
      {torus_surface(1, 0.4), torus(96, 48)},
      {saddle_surface(), saddle(24)}};
}

class Gap : public testing::TestWithParam<double>
{};

TEST_P(Gap, of_unit_triangles_is_at_most_a_tenth_above_the_tolerance)
{
  for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    for (const auto& [surface, mesh] : gap_cases()) {
      const double tolerance = GetParam() * diagonal(mesh);
      const Curvature_field field = exact_field(mesh, surface);
      const Metric_field metric = make_geometric_metric(
          mesh, field,
          with::metric_tolerance(tolerance).metric_kind(kind).maximum_size(diagonal(mesh)));
      // A stride that shares no factor with the rows of the sheets meets all their circles.
      const std::uint32_t stride = metric.number_of_sides() > 1000 ? 11 : 1;
      double worst = 0, where = 0;
      for (std::uint32_t s = 0; s < metric.number_of_sides(); s += stride) {
        const V p = eigen(mesh.point(Vertex(field.sides.vertex[s])));
        const double g = worst_gap(surface, p, metric.normal(s), metric.tensor(s)) / tolerance;
        if (g > worst) {
          worst = g;
          where = s;
        }
      }
      EXPECT_LE(worst, 1.1) << surface.name << " at side " << where;
      // And it is not met by sizes that are far too small.
      EXPECT_GE(worst, 0.8) << surface.name;
      RecordProperty(surface.name, std::to_string(worst));
    }
  }
}

// A corner sees twice as far as a centre. Where edges are short next to the radii, looking ahead to
// the side where the surface becomes elliptic keeps the gap at parabolic circles small, too.
TEST(Geometric_metric, of_fine_tolerances_serves_triangles_at_a_corner)
{
  for (const auto& [surface, mesh] : gap_cases()) {
    const double tolerance = 1e-4 * diagonal(mesh);
    const Curvature_field field = exact_field(mesh, surface);
    const Metric_field metric = make_geometric_metric(
        mesh, field, with::metric_tolerance(tolerance).maximum_size(diagonal(mesh)));
    double worst = 0;
    for (std::uint32_t s = 0; s < metric.number_of_sides(); s += 11) {
      const V p = eigen(mesh.point(Vertex(field.sides.vertex[s])));
      worst = std::max(
          worst, worst_gap_at_corner(surface, p, metric.normal(s), metric.tensor(s)) / tolerance);
    }
    EXPECT_LE(worst, 1.15) << surface.name;
    EXPECT_GE(worst, 0.8) << surface.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Tolerances, Gap, testing::Values(0.01, 0.001, 0.0001));

// ---- known sizes ----

/// Without curvature, on the sides that features leave.
Curvature_field flat_field(const Mesh& mesh, double feature_angle = 40)
{
  Curvature_field field;
  field.sides = find_sides(mesh, find_features(mesh, with::feature_angle(feature_angle)));
  field.side.resize(field.sides.size());
  field.curve.resize(mesh.num_vertices());
  return field;
}

/// The sizes in ascending order. The larger one of the tangent plane repeats along the normal.
V sizes(const Tensor& m)
{
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(m);
  return solver.eigenvalues().reverse().cwiseInverse().cwiseSqrt();
}

double size_along(const Tensor& m, const V& direction)
{
  return 1 / std::sqrt(direction.dot(m * direction));
}

/// The chord of sagitta `gap` on a circle.
double chord(double radius, double gap) { return 2 * std::sqrt(gap * (2 * radius - gap)); }

TEST(Geometric_metric, of_a_sphere_is_that_of_the_inscribed_triangle)
{
  const Mesh mesh = icosphere(2, 2);
  const double tolerance = 1e-3;
  const auto metric = make_geometric_metric(
      mesh, exact_field(mesh, sphere_surface(2)), with::metric_tolerance(tolerance));
  // An equilateral triangle with circumradius r lies R - sqrt(R^2 - r^2) below the sphere.
  const double side = std::sqrt(3.0) * std::sqrt(tolerance * (2 * 2 - tolerance));
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    for (const double size : sizes(metric.tensor(s))) EXPECT_NEAR(size, side, 1e-6 * side);
  }
}

TEST(Geometric_metric, of_a_cylinder_is_the_chord_across_and_the_limit_along)
{
  const Mesh mesh = cylinder(64, 8, 1, 2);
  Curvature_field field = flat_field(mesh);
  const Analytic_surface surface = cylinder_surface(1);
  for (std::uint32_t s = 0; s < field.sides.size(); ++s) {
    const V p = eigen(mesh.point(Vertex(field.sides.vertex[s])));
    const bool is_cap = std::hypot(p.x(), p.y()) < 0.99;
    if (!is_cap) field.side[s] = surface.curvature(p);
  }
  const auto metric
      = make_geometric_metric(mesh, field, with::metric_tolerance(1e-3).maximum_size(0.3));
  std::size_t checked = 0;
  for (const Vertex v : mesh.vertices()) {
    const V p = eigen(mesh.point(v));
    if (metric.sides().first[v + 1] - metric.sides().first[v] > 1) continue;
    const Tensor m = metric.tensor_at_vertex(v);
    if (std::hypot(p.x(), p.y()) < 0.99) {
      EXPECT_NEAR(sizes(m)[0], 0.3, 1e-12) << "caps are flat";
      continue;
    }
    const V around = V(-p.y(), p.x(), 0).normalized();
    EXPECT_NEAR(size_along(m, around), chord(1, 1e-3), 1e-4 * chord(1, 1e-3));
    EXPECT_NEAR(size_along(m, V::UnitZ()), 0.3, 1e-6);
    ++checked;
  }
  EXPECT_GT(checked, 100u);
}

TEST(Geometric_metric, of_planes_is_the_largest_size_everywhere)
{
  const Mesh mesh = cube(3);
  for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    const auto metric = make_geometric_metric(
        mesh, flat_field(mesh), with::metric_tolerance(1e-3).metric_kind(kind));
    for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
      EXPECT_NEAR(metric.size(s), std::sqrt(3.0) / 10, 1e-12) << "a tenth of the diagonal";
    }
  }
}

TEST(Geometric_metric, is_finite_and_positive_for_any_finite_curvature)
{
  const Mesh mesh = icosphere(1);
  Curvature_field field = exact_field(mesh, sphere_surface(1));
  const std::array<double, 9> extremes
      = {0, -0.0, 1e-300, 1e-30, 1, -1e10, 1e100, -1e300, std::numeric_limits<double>::max()};
  for (const double k1 : extremes) {
    for (const double k2 : extremes) {
      for (const double growth : {0., 1., 1e200, -std::numeric_limits<double>::max()}) {
        Side_curvature& c = field.side[3];
        c.min_curvature = std::min(k1, k2);
        c.max_curvature = std::max(k1, k2);
        c.min_derivative = c.max_derivative = growth;
        for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
          const auto metric = make_geometric_metric(
              mesh, field,
              with::metric_tolerance(1e-3).relative_gap(0.1).turning_angle(30).metric_kind(kind));
          for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
            const V h = sizes(metric.tensor(s));
            EXPECT_TRUE(metric.tensor(s).allFinite());
            EXPECT_GE(h[0], 1e-3 * (1 - 1e-9)) << k1 << ' ' << k2 << ' ' << growth;
            EXPECT_LE(h[2], diagonal(mesh) / 10 * (1 + 1e-9)) << k1 << ' ' << k2 << ' ' << growth;
          }
        }
      }
    }
  }
}

TEST(Geometric_metric, without_directions_or_normals_takes_those_of_the_mesh)
{
  const Mesh mesh = icosphere(2);
  Curvature_field field = exact_field(mesh, sphere_surface(1));
  for (Side_curvature& c : field.side) {
    c.normal = c.min_direction = c.max_direction = V::Zero();
    c.max_curvature = 0;
  }
  const auto metric = make_geometric_metric(mesh, field, with::metric_tolerance(1e-3));
  for (const Vertex v : mesh.vertices()) {
    const auto s = metric.sides().first[v];
    EXPECT_NEAR(metric.normal(s).dot(eigen(mesh.point(v)).normalized()), 1, 1e-9);
    const V h = sizes(metric.tensor(s));
    EXPECT_NEAR(h[0], chord(1, 1e-3), 1e-6);
    EXPECT_GT(h[1], 3 * h[0]);
  }
}

TEST(Geometric_metric, scales_with_the_mesh_to_the_last_bit)
{
  const Mesh mesh = ellipsoid(2, 1, 0.7, 0.5);
  const Curvature_field field = exact_field(mesh, ellipsoid_surface(1, 0.7, 0.5));
  for (const double scale : {0x1p10, 0x1p-10}) {
    Curvature_field larger = field;
    for (Side_curvature& c : larger.side) {
      c.min_curvature /= scale;
      c.max_curvature /= scale;
      c.min_derivative /= scale * scale;
      c.max_derivative /= scale * scale;
      c.min_cross_derivative /= scale * scale;
      c.max_cross_derivative /= scale * scale;
    }
    for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
      const auto np = with::metric_kind(kind);
      const auto a = make_geometric_metric(mesh, field, np.metric_tolerance(1e-3));
      const auto b
          = make_geometric_metric(scaled(mesh, scale), larger, np.metric_tolerance(1e-3 * scale));
      for (std::uint32_t s = 0; s < a.number_of_sides(); ++s) {
        ASSERT_EQ(b.tensor(s) * (scale * scale), a.tensor(s));
      }
    }
  }
}

// ---- features ----

TEST(Geometric_metric, of_a_box_has_a_side_a_face_and_isotropic_corners)
{
  const Mesh mesh = cube(4);
  Curvature_field field = flat_field(mesh);
  // The top is curved along x as a cylinder of radius 1; a field may say so of a flat mesh.
  const auto normals = surety::make_uniform_metric(mesh, field.sides, 1);
  for (std::uint32_t s = 0; s < field.sides.size(); ++s) {
    if (normals.normal(s).z() < 0.9) continue;
    field.side[s].normal = V::UnitZ();
    field.side[s].min_curvature = -1;
    field.side[s].min_direction = V::UnitX();
    field.side[s].max_direction = V::UnitY();
  }
  for (const Vertex v : mesh.vertices()) {
    const auto first = field.sides.first[v], last = field.sides.first[v + 1];
    if (last - first == 2) field.curve[v].tangent = normals.tangent(v);
  }
  const auto metric = make_geometric_metric(mesh, field, with::metric_tolerance(1e-4));
  const double thin = chord(1, 1e-4), limit = std::sqrt(3.0) / 10;
  std::array<std::size_t, 4> vertices_with{};
  for (const Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    const auto first = metric.sides().first[v], last = metric.sides().first[v + 1];
    ++vertices_with[last - first];
    for (auto s = first; s < last; ++s) {
      const V n = metric.normal(s);
      const V h = sizes(metric.tensor(s));
      const bool is_ridge_of_top = last - first == 2 && p.z() == 1;
      const bool is_along_x = std::abs(metric.tangent(v).x()) > 0.9;
      if (last - first == 3) {
        EXPECT_NEAR(h[0], h[2], 1e-9) << "corners are isotropic";
        EXPECT_NEAR(h[0], p.z() == 1 ? thin : limit, 1e-3 * thin);
      } else if (n.z() > 0.9) {
        EXPECT_NEAR(size_along(metric.tensor(s), V::UnitX()), thin, 1e-3 * thin);
        EXPECT_NEAR(size_along(metric.tensor(s), V::UnitY()), limit, 1e-6);
      } else if (is_ridge_of_top && is_along_x) {
        EXPECT_NEAR(size_along(metric.tensor(s), V::UnitX()), thin, 1e-3 * thin)
            << "both sides agree along the ridge";
        EXPECT_NEAR(size_along(metric.tensor(s), V::UnitZ()), limit, 1e-6);
      } else {
        EXPECT_NEAR(h[0], limit, 1e-9) << "a flat side keeps its own size";
      }
    }
  }
  EXPECT_EQ(vertices_with[3], 8u);
  EXPECT_EQ(vertices_with[2], 12u * 3);
}

TEST(Geometric_metric, of_a_rim_is_limited_by_the_curvature_of_the_curve)
{
  const Mesh mesh = cylinder(48, 6, 0.5, 2);
  for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    Curvature_field field = flat_field(mesh);
    for (const Vertex v : mesh.vertices()) {
      if (field.sides.first[v + 1] - field.sides.first[v] < 2) continue;
      const V p = eigen(mesh.point(v));
      field.curve[v] = {V(-p.y(), p.x(), 0).normalized(), 2};
    }
    const auto metric = make_geometric_metric(
        mesh, field, with::metric_tolerance(1e-4).metric_kind(kind).maximum_size(0.2));
    std::size_t rim = 0;
    for (const Vertex v : mesh.vertices()) {
      for (auto s = metric.sides().first[v]; s < metric.sides().first[v + 1]; ++s) {
        const Tensor m = metric.tensor(s);
        if (metric.tangent(v).isZero(0)) {
          EXPECT_NEAR(sizes(m)[0], 0.2, 1e-12);
          continue;
        }
        ++rim;
        const V t = metric.tangent(v), u = metric.normal(s).cross(t).normalized();
        const double expected = chord(0.5, 1e-4); // sqrt(8 delta / k), but for 0.005 %
        EXPECT_NEAR(expected, std::sqrt(8 * 1e-4 / 2), 1e-4 * expected);
        EXPECT_NEAR(size_along(m, t), expected, 1e-3 * expected);
        EXPECT_NEAR(size_along(m, u), kind == Metric_kind::isotropic ? expected : 0.2, 1e-3);
      }
    }
    EXPECT_EQ(rim, 2u * 2 * 48);
  }
}

TEST(Geometric_metric, has_the_tangent_of_a_curve_as_an_axis_of_all_its_sides)
{
  const Mesh mesh = cylinder(48, 6, 0.5, 2);
  Random random(5);
  Curvature_field with_curve = flat_field(mesh);
  for (Side_curvature& c : with_curve.side) {
    const double k[2] = {random.between(-3, 3), random.between(-3, 3)};
    c.min_curvature = std::min(k[0], k[1]);
    c.max_curvature = std::max(k[0], k[1]);
    const double turn = random.between(0, pi);
    c.max_direction = V(std::cos(turn), std::sin(turn), std::cos(3 * turn));
  }
  for (const Vertex v : mesh.vertices()) {
    if (with_curve.sides.first[v + 1] - with_curve.sides.first[v] < 2) continue;
    const V p = eigen(mesh.point(v));
    with_curve.curve[v] = {V(-p.y(), p.x(), 0).normalized(), random.between(0, 5)};
  }
  const auto np = with::metric_tolerance(1e-3).maximum_aspect_ratio(1e9);
  const auto aligned = make_geometric_metric(mesh, with_curve, np);
  for (std::uint32_t s = 0; s < aligned.number_of_sides(); ++s) {
    const Vertex v(aligned.sides().vertex[s]);
    const V t = aligned.tangent(v);
    if (t.isZero(0)) continue;
    const Tensor m = aligned.tensor(s);
    const V u = aligned.normal(s).cross(t).normalized();
    EXPECT_NEAR(t.dot(m * u), 0, 1e-9 * m.norm()) << "the tangent is an axis";
    for (auto other = aligned.sides().first[v]; other < aligned.sides().first[v + 1]; ++other) {
      EXPECT_NEAR(size_along(aligned.tensor(other), t), size_along(m, t), 1e-9)
          << "all sides agree";
    }
  }
}

TEST(Aligned_tensor, satisfies_the_tensor_that_it_replaces)
{
  Random random(9);
  for (int i = 0; i < 1000; ++i) {
    const double turn = random.between(0, pi), h1 = random.between(0.01, 1);
    const double h2 = random.between(0.01, 1);
    const V d(std::cos(turn), std::sin(turn), 0);
    const Tensor m = surety::internal::metric::tangential(V::UnitZ(), d, h1, h2);
    const surety::internal::metric::Aligned_tensor aligned(m, V::UnitX(), V::UnitY());
    for (const double more : {1.0, 1.5, 10.0}) {
      const double along = more * aligned.along;
      // The difference is positive semidefinite, and singular: it asks for no more than it must.
      const double p = along - m(0, 0), q = aligned.across(along) - m(1, 1);
      EXPECT_GE(p, -1e-9 * m.norm());
      EXPECT_GE(q, -1e-9 * m.norm());
      EXPECT_NEAR(p * q, m(0, 1) * m(0, 1), 1e-9 * m.squaredNorm());
    }
  }
}

// ---- named parameters ----

class Parameters_of_the_metric : public testing::Test
{
protected:
  template <class Np>
  Metric_field with_parameters(const Np& np) const
  {
    return make_geometric_metric(mesh, field, np);
  }

  /// At the end of the longest axis of the ellipsoid, where curvatures are largest.
  template <class Np>
  V sizes_at_tip(const Np& np) const
  {
    return sizes(with_parameters(np).tensor(tip()));
  }

  std::uint32_t tip() const
  {
    Vertex best(0);
    for (const Vertex v : mesh.vertices()) {
      if (mesh.point(v).x() > mesh.point(best).x()) best = v;
    }
    return field.sides.first[best];
  }

  Mesh mesh = ellipsoid(3, 1, 0.4, 0.25);
  Curvature_field field = exact_field(mesh, ellipsoid_surface(1, 0.4, 0.25));
};

TEST_F(Parameters_of_the_metric, the_tolerance_scales_sizes_with_its_root)
{
  const V coarse = sizes_at_tip(with::metric_tolerance(4e-5));
  const V fine = sizes_at_tip(with::metric_tolerance(1e-5));
  EXPECT_NEAR(coarse[0] / fine[0], 2, 0.05);
}

TEST_F(Parameters_of_the_metric, the_relative_gap_makes_sizes_follow_the_radii)
{
  const auto metric = with_parameters(with::relative_gap(1e-6).minimum_size(1e-9));
  for (std::uint32_t s = 0; s < field.side.size(); s += 7) {
    // The paper's formula, with the triangle's constant in place of the chord's.
    const double k1 = -field.side[s].min_curvature;
    const double expected = std::sqrt(0.75) * 2 / k1 * std::sqrt(1e-6 * (2 - 1e-6));
    EXPECT_NEAR(metric.size(s), expected, 0.01 * expected);
  }
}

TEST_F(Parameters_of_the_metric, the_turning_angle_makes_sizes_follow_the_radii)
{
  const double k1 = -field.side[tip()].min_curvature;
  const double degrees = 0.1;
  const double expected = 2 / k1 * std::sin(degrees / 2 * pi / 180);
  EXPECT_NEAR(
      sizes_at_tip(with::turning_angle(degrees).minimum_size(1e-9))[0], expected, 0.02 * expected);
}

TEST_F(Parameters_of_the_metric, the_least_size_of_several_laws_counts)
{
  const V a = sizes_at_tip(with::metric_tolerance(1e-3));
  const V b = sizes_at_tip(with::turning_angle(2).minimum_size(1e-3));
  const V both = sizes_at_tip(with::metric_tolerance(1e-3).turning_angle(2));
  EXPECT_LT(b[0], a[0]);
  EXPECT_NEAR(both[0], b[0], 1e-9);
}

TEST_F(Parameters_of_the_metric, the_kind_decides_whether_directions_count)
{
  const auto np = with::metric_tolerance(1e-4);
  const V isotropic = sizes_at_tip(np.metric_kind(Metric_kind::isotropic));
  const V anisotropic = sizes_at_tip(np.metric_kind(Metric_kind::anisotropic));
  EXPECT_EQ(isotropic[0], isotropic[2]);
  EXPECT_GT(anisotropic[2], 1.3 * anisotropic[0]);
  EXPECT_EQ(sizes_at_tip(np), anisotropic) << "the default";
}

TEST_F(Parameters_of_the_metric, the_constant_replaces_the_triangles)
{
  const auto np = with::metric_tolerance(1e-5);
  const V triangle = sizes_at_tip(np), chord = sizes_at_tip(np.gap_constant(1. / 8));
  EXPECT_NEAR(chord[0] / triangle[0], std::sqrt(4. / 3), 0.01);
}

TEST_F(Parameters_of_the_metric, sizes_stay_in_their_range)
{
  for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    const auto metric = with_parameters(
        with::metric_tolerance(1e-4).metric_kind(kind).minimum_size(0.01).maximum_size(0.02));
    double least = 1, largest = 0;
    for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
      const V h = sizes(metric.tensor(s));
      least = std::min(least, h[0]);
      largest = std::max(largest, h[2]);
    }
    EXPECT_NEAR(least, 0.01, 1e-12);
    EXPECT_NEAR(largest, 0.02, 1e-12);
  }
}

TEST_F(Parameters_of_the_metric, the_default_minimum_is_the_tolerance)
{
  field.side[5].min_curvature = -1e9;
  const auto metric = with_parameters(with::metric_tolerance(1e-3));
  EXPECT_NEAR(metric.size(5), 1e-3, 1e-12);
}

TEST_F(Parameters_of_the_metric, the_aspect_ratio_is_limited)
{
  for (Side_curvature& c : field.side) c.max_curvature = 0;
  for (const double limit : {1.0, 3.0, 10.0}) {
    const auto metric = with_parameters(with::metric_tolerance(1e-6).maximum_aspect_ratio(limit));
    double largest = 0;
    for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
      const V h = sizes(metric.tensor(s));
      largest = std::max(largest, h[2] / h[0]);
    }
    EXPECT_NEAR(largest, limit, 1e-6);
  }
}

TEST_F(Parameters_of_the_metric, a_size_function_is_respected)
{
  const auto wanted = [](const Point& p) { return p.x() > 0 ? 0.01 : 1.0; };
  for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    const auto np = with::metric_tolerance(1e-3).metric_kind(kind);
    const auto plain = with_parameters(np), metric = with_parameters(np.size_field(wanted));
    for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
      const Point p = mesh.point(Vertex(field.sides.vertex[s]));
      if (p.x() > 0) {
        EXPECT_NEAR(sizes(metric.tensor(s))[2], 0.01, 1e-9);
      } else {
        EXPECT_NEAR((metric.tensor(s) - plain.tensor(s)).norm(), 0, 1e-9 * plain.tensor(s).norm());
      }
    }
  }
}

TEST_F(Parameters_of_the_metric, a_size_field_may_be_a_property_map_tensors_or_a_solution)
{
  auto map = mesh.add_property_map<Vertex, double>("v:size", 1).first;
  auto tensors = mesh.add_property_map<Vertex, Tensor>("v:metric", Tensor::Identity()).first;
  const Vertex v(11);
  map[v] = 0.01;
  tensors[v] = V(1e4, 1e4, 1e4).asDiagonal();
  surety::Medit_solution solution;
  for (const Vertex u : mesh.vertices()) solution.sizes.push_back(map[u]);
  const auto np = with::metric_tolerance(1e-3);
  const auto plain = with_parameters(np);
  const auto s = field.sides.first[v];
  EXPECT_GT(plain.size(s), 0.02);
  for (const auto& metric :
       {with_parameters(np.size_field(map)), with_parameters(np.size_field(tensors)),
        with_parameters(np.size_field(solution))}) {
    EXPECT_NEAR(metric.size(s), 0.01, 1e-9);
    EXPECT_DOUBLE_EQ(metric.size(s + 1), plain.size(s + 1));
  }
}

TEST_F(Parameters_of_the_metric, points_may_come_from_a_map)
{
  auto points = mesh.add_property_map<Vertex, Point>("v:tenfold").first;
  for (const Vertex v : mesh.vertices())
    points[v] = CGAL::ORIGIN + 10 * (mesh.point(v) - CGAL::ORIGIN);
  for (Side_curvature& c : field.side) c.min_curvature = c.max_curvature = 0;
  const auto np = with::metric_tolerance(1e-3);
  EXPECT_NEAR(sizes_at_tip(np.vertex_point_map(points))[0], 10 * sizes_at_tip(np)[0], 1e-9);
}

TEST_F(Parameters_of_the_metric, what_makes_no_sense_is_rejected)
{
  const auto np = with::metric_tolerance(1e-3);
  EXPECT_THROW(with_parameters(CGAL::parameters::default_values()), Invalid_input);
  EXPECT_THROW(with_parameters(with::minimum_size(1)), Invalid_input);
  for (const double bad : {0., -1., double(NAN), double(INFINITY)}) {
    EXPECT_THROW(with_parameters(with::metric_tolerance(bad)), Invalid_input) << bad;
    EXPECT_THROW(with_parameters(with::relative_gap(bad)), Invalid_input) << bad;
    EXPECT_THROW(with_parameters(with::turning_angle(bad)), Invalid_input) << bad;
    EXPECT_THROW(with_parameters(np.gap_constant(bad)), Invalid_input) << bad;
    EXPECT_THROW(with_parameters(np.minimum_size(bad)), Invalid_input) << bad;
    EXPECT_THROW(with_parameters(np.maximum_size(bad)), Invalid_input) << bad;
    const auto function = [=](const Point&) { return bad; };
    EXPECT_THROW(with_parameters(np.size_field(function)), Invalid_input) << bad;
  }
  EXPECT_THROW(with_parameters(with::relative_gap(1.01)), Invalid_input);
  EXPECT_THROW(with_parameters(with::turning_angle(181)), Invalid_input);
  EXPECT_THROW(with_parameters(np.maximum_aspect_ratio(0.9)), Invalid_input);
  EXPECT_THROW(with_parameters(np.minimum_size(0.2).maximum_size(0.1)), Invalid_input);
  const auto indefinite = [](const Point&) { return Tensor(V(1, -1, 1).asDiagonal()); };
  EXPECT_THROW(with_parameters(np.size_field(indefinite)), Invalid_input);
  surety::Medit_solution short_solution{{0.1, 0.2}, {}};
  EXPECT_THROW(with_parameters(np.size_field(short_solution)), Invalid_input);
  EXPECT_THROW(make_geometric_metric(icosphere(1), field, np), Invalid_input);
  field.side[2].max_curvature = NAN;
  EXPECT_THROW(with_parameters(np), Invalid_input);
}

// ---- intersection ----

Tensor random_tensor(Random& random)
{
  Tensor a;
  for (int i = 0; i < 9; ++i) a(i / 3, i % 3) = random.between(-1, 1);
  const Eigen::SelfAdjointEigenSolver<Tensor> solver(a + a.transpose());
  V lambda;
  for (int i = 0; i < 3; ++i) lambda[i] = std::pow(10.0, random.between(0, 4));
  const Tensor m = solver.eigenvectors() * lambda.asDiagonal() * solver.eigenvectors().transpose();
  return (m + m.transpose()) / 2;
}

TEST(Intersection, of_tensors_lies_in_both_and_touches_them)
{
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Tensor a = random_tensor(random), b = random_tensor(random);
    const Tensor both = surety::intersect(a, b);
    const auto least_ratio = [](const Tensor& of, const Tensor& to) {
      const Tensor h = surety::internal::metric::size_tensor(to);
      return Eigen::SelfAdjointEigenSolver<Tensor>(h * of * h).eigenvalues()[0];
    };
    for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
      const double ratio = least_ratio(both, one);
      EXPECT_GE(ratio, 1 - 1e-8);
      // Unless the other one asks for more in all directions, the ball touches this one's.
      if (least_ratio(other, one) < 1) {
        EXPECT_LE(ratio, 1 + 1e-6);
      }
    }
    EXPECT_EQ(both, surety::intersect(b, a)) << "the order does not matter";
    EXPECT_NEAR((surety::intersect(both, a) - both).norm(), 0, 1e-7 * both.norm());
  }
}

TEST(Intersection, of_a_tensor_that_contains_the_other_is_the_other)
{
  const Tensor small = V(100, 400, 900).asDiagonal(), large = V(1, 4, 9).asDiagonal();
  EXPECT_EQ(surety::intersect(small, large), small);
  EXPECT_EQ(surety::intersect(large, small), small);
  EXPECT_EQ(surety::intersect(small, small), small);
  EXPECT_THROW(surety::intersect(small, Tensor::Zero()), Invalid_input);
  EXPECT_THROW(surety::intersect(-small, small), Invalid_input);
}

TEST(Intersection, of_fields_satisfies_both_in_the_tangent_planes)
{
  const Mesh mesh = icosphere(2);
  const auto sides = flat_field(mesh).sides;
  Random random(4);
  const auto any = [&](const Point&) { return random_tensor(random); };
  const Metric_field a = surety::make_metric(mesh, sides, any);
  const Metric_field b = surety::make_metric(mesh, sides, any);
  Metric_field both = a, other_way = b;
  surety::intersect(both, b);
  surety::intersect(other_way, a);
  for (std::uint32_t s = 0; s < a.number_of_sides(); ++s) {
    const auto basis = surety::internal::metric::tangent_basis(a.normal(s));
    for (int i = 0; i < 16; ++i) {
      const V d = std::cos(i * pi / 16) * basis[0] + std::sin(i * pi / 16) * basis[1];
      const double least = std::min(size_along(a.tensor(s), d), size_along(b.tensor(s), d));
      EXPECT_LE(size_along(both.tensor(s), d), least * (1 + 1e-8));
    }
    EXPECT_NEAR((both.tensor(s) - other_way.tensor(s)).norm(), 0, 1e-7 * both.tensor(s).norm());
  }
  const Metric_field elsewhere
      = surety::make_uniform_metric(icosphere(1), flat_field(icosphere(1)).sides, 1);
  EXPECT_THROW(surety::intersect(both, elsewhere), Invalid_input);
}

} // namespace
