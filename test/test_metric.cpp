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

INSTANTIATE_TEST_SUITE_P(Tolerances, Gap, testing::Values(0.01, 0.001, 0.0001));

} // namespace
