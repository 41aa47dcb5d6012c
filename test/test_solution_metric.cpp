// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metric of a field: exact where the field is quadratic, of the complexity or the error that
// was asked for, optimal, and the same in any unit.
#include <surety/metric.h>
#include <surety/solution_metric.h>

#include "meshes.h"

#include <gtest/gtest.h>

#include <CGAL/boost/graph/generators.h>

#include <cmath>
#include <functional>
#include <limits>

namespace surety::test {
namespace {

using Field = Mesh::Property_map<Vertex, double>;

Field field_on(Mesh& mesh, const std::function<double(const Point&)>& u)
{
  const Field field = mesh.add_property_map<Vertex, double>("v:u").first;
  for (const Vertex v : mesh.vertices()) field[v] = u(mesh.point(v));
  return field;
}

Mesh tilted(const Mesh& mesh) { return rotated(mesh, 3); }

template <class Parameters>
Metric_field metric_on(
    Mesh& mesh, const std::function<double(const Point&)>& u, const Parameters& np)
{
  const Field field = field_on(mesh, u);
  return make_solution_metric(mesh, find_features(mesh), field, np);
}

const auto wide = [](const auto& np) {
  return np.minimum_size(1e-6).maximum_size(1e6).maximum_aspect_ratio(1e6);
};

class Noisy_plane : public testing::TestWithParam<unsigned>
{};

TEST_P(Noisy_plane, has_the_exact_metric_of_a_quadratic_field)
{
  SCOPED_TRACE(GetParam());
  Random random(GetParam());
  // A flat mesh of irregular vertices, also where it ends, stretched by 8.
  Mesh mesh = mapped(grid(12), [&](const Point& p) {
    return Point(p.x() + random.between(-.02, .02), (p.y() + random.between(-.02, .02)) / 8, 0);
  });
  // H = [6 2; 2 -40]; for infinite p the metric is D |H|.
  const auto u = [](const Point& p) {
    return 3 * p.x() * p.x() + 2 * p.x() * p.y() - 20 * p.y() * p.y() + p.x() - 7;
  };
  const auto metric = metric_on(
      mesh, u,
      wide(parameters::target_vertices(1000).norm_exponent(
          std::numeric_limits<double>::infinity())));
  Eigen::Matrix2d h;
  h << 6, 2, 2, -40;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(h);
  const Eigen::Matrix2d absolute = solver.eigenvectors()
      * solver.eigenvalues().cwiseAbs().asDiagonal() * solver.eigenvectors().transpose();
  // The area is about 1/8: 1000 = 2/sqrt(3) D sqrt(det) area.
  const Eigen::Matrix2d first = metric.tensor(0).topLeftCorner<2, 2>();
  const double d = std::sqrt(first.determinant() / absolute.determinant());
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    const Eigen::Matrix2d m = metric.tensor(s).topLeftCorner<2, 2>();
    EXPECT_LT((m / d - absolute).norm(), 1e-7 * absolute.norm()) << s;
  }
  EXPECT_NEAR(metric_complexity(mesh, metric) * 2 / std::sqrt(3), 1000, 1);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Noisy_plane, testing::Range(0u, 4u));

TEST(Solution_metric, converges_to_the_hessian_on_a_sphere)
{
  // On the unit sphere the Hessian of a linear function l is -l times the identity.
  double before = 0;
  for (const int levels : {2, 3, 4}) {
    Mesh mesh = icosphere(levels);
    const auto u = [](const Point& p) { return 5 + p.z(); };
    const auto metric = metric_on(
        mesh, u,
        wide(parameters::target_error(1.).norm_exponent(std::numeric_limits<double>::infinity())));
    // Equal errors everywhere: |z| h^2 / 6 = 1.
    double worst = 0;
    for (const Vertex v : mesh.vertices()) {
      const Eigen::Matrix3d m = metric.tensor_at_vertex(v);
      const Eigen::Vector3d n = internal::to_vector(mesh.point(v));
      const Eigen::Matrix3d expected
          = std::abs(n.z()) / 6 * (Eigen::Matrix3d::Identity() - n * n.transpose());
      const Eigen::Matrix3d part = m - n * n.dot(m * n) * n.transpose();
      worst = std::max(worst, (part - expected).norm());
    }
    if (before > 0) {
      EXPECT_LT(worst, .6 * before) << levels;
    }
    before = worst;
  }
  EXPECT_LT(before, .01);
}

double front(const Point& p) { return std::tanh((p.z() - .2) / .1); }

TEST(Solution_metric, has_the_complexity_that_was_asked_for)
{
  for (const Metric_kind kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    for (const double p : {1., 2., 4.}) {
      for (const double number : {500., 5000.}) {
        Mesh mesh = icosphere(4);
        const auto metric = metric_on(
            mesh, front,
            parameters::target_vertices(number).norm_exponent(p).metric_kind(kind).minimum_size(
                1e-4));
        EXPECT_NEAR(metric_complexity(mesh, metric) * 2 / std::sqrt(3), number, .001 * number);
        EXPECT_EQ(metric.kind(), kind);
      }
    }
  }
}

TEST(Solution_metric, predicts_the_error_that_was_asked_for)
{
  // On a regular grid of equilateral triangles the interpolation error is known: that of x^2 + y^2
  // for sides h is h^2 (1/3 - r^2), and its square has the mean h^4 / 15.
  Mesh mesh = mapped(grid(10), [](const Point& p) { return p; });
  const double error = .003;
  const auto u = [](const Point& p) { return p.x() * p.x() + p.y() * p.y(); };
  const auto metric = metric_on(mesh, u, wide(parameters::target_error(error)));
  const double h = metric.size(0);
  EXPECT_NEAR(h * h / std::sqrt(15.), error, 1e-3 * error);
}

TEST(Solution_metric, knows_the_mean_errors_of_the_equilateral_triangle)
{
  // Means of half of l1 l2 + l2 l3 + l3 l1 over the triangle, by the integrals of its powers.
  EXPECT_NEAR(internal::solution_metric::mean_interpolation_error(1), 1. / 8, 1e-9);
  EXPECT_NEAR(internal::solution_metric::mean_interpolation_error(2), .5 / std::sqrt(15.), 1e-9);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(internal::solution_metric::mean_interpolation_error(infinite), 1. / 6, 1e-15);
  EXPECT_NEAR(internal::solution_metric::mean_interpolation_error(1000), 1. / 6, 2e-3);
}

TEST(Solution_metric, follows_a_front_along_its_direction)
{
  Mesh mesh = icosphere(5);
  const auto metric = metric_on(mesh, front, parameters::target_vertices(2000));
  double near = 0, far = 1e9;
  for (const Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    const double size = metric.size_at_vertex(v);
    if (std::abs(p.z() - .2) > .04 && std::abs(p.z() - .2) < .1) {
      const Eigen::Vector3d n = internal::to_vector(p), around(-p.y(), p.x(), 0);
      const Eigen::Vector3d across = n.cross(around).normalized();
      EXPECT_NEAR(1 / std::sqrt(across.dot(metric.tensor_at_vertex(v) * across)), size, .02 * size);
      EXPECT_GT(
          1 / std::sqrt(around.normalized().dot(metric.tensor_at_vertex(v) * around.normalized())),
          1.5 * size);
      near = std::max(near, size);
    }
    if (p.z() < -.6) far = std::min(far, size);
  }
  EXPECT_LT(near, far / 3);
}

TEST(Solution_metric, takes_the_largest_sizes_where_the_field_is_linear)
{
  Mesh mesh = tilted(grid(8));
  const auto u = [](const Point& p) { return 1 + 2 * p.x() - p.y() + 3 * p.z(); };
  const auto metric = metric_on(mesh, u, parameters::target_vertices(1e5).maximum_size(.25));
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s)
    EXPECT_NEAR(metric.size(s), .25, 1e-12);
}

TEST(Solution_metric, respects_its_limits)
{
  Mesh mesh = icosphere(4);
  const auto metric = metric_on(
      mesh, front,
      parameters::target_vertices(1e5).minimum_size(.05).maximum_size(.2).maximum_aspect_ratio(3));
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(metric.tensor(s));
    const Eigen::Vector3d sizes = solver.eigenvalues().cwiseSqrt().cwiseInverse();
    EXPECT_GE(sizes.minCoeff(), .05 * (1 - 1e-9));
    EXPECT_LE(sizes.maxCoeff(), .2 * (1 + 1e-9));
    EXPECT_LE(sizes.maxCoeff(), 3 * sizes.minCoeff() * (1 + 1e-9));
  }
}

/// The same metric in other units, to the last bit.
TEST(Solution_metric, does_not_depend_on_units)
{
  for (const int exponent : {10, -10}) {
    const double unit = std::ldexp(1., exponent);
    Mesh mesh = icosphere(3), other = scaled(mesh, unit);
    const auto in_units = [&](const Point& p) {
      return 1024 * front(Point(p.x() / unit, p.y() / unit, p.z() / unit));
    };
    const auto vertices = parameters::target_vertices(3000);
    const auto a = metric_on(mesh, front, vertices), b = metric_on(other, in_units, vertices);
    const auto c = metric_on(mesh, front, parameters::target_error(.01));
    const auto d = metric_on(other, in_units, parameters::target_error(.01 * 1024 * unit));
    for (std::uint32_t s = 0; s < a.number_of_sides(); ++s) {
      EXPECT_EQ(a.tensor(s), b.tensor(s) * unit * unit);
      EXPECT_EQ(c.tensor(s), d.tensor(s) * unit * unit);
    }
  }
}

TEST(Solution_metric, small_exponents_resolve_weak_features)
{
  // A strong front and one of a hundredth of its height.
  const auto two = [](const Point& p) {
    return std::tanh((p.z() - .4) / .1) + .01 * std::tanh((p.z() + .4) / .1);
  };
  Mesh mesh = icosphere(5);
  const auto size_at_weak = [&](double p) {
    Mesh copy = mesh;
    const auto metric = metric_on(copy, two, parameters::target_vertices(3000).norm_exponent(p));
    double sum = 0;
    int number = 0;
    for (const Vertex v : mesh.vertices())
      if (std::abs(std::abs(mesh.point(v).z() + .4) - .07) < .03)
        sum += metric.size_at_vertex(v), ++number;
    return sum / number;
  };
  EXPECT_LT(size_at_weak(1), .8 * size_at_weak(8));
}

TEST(Solution_metric, does_not_look_across_features)
{
  // |x| on a plane that is cut along x = 0 has no curvature on either side.
  Mesh mesh = mapped(grid(10), [](const Point& p) { return Point(p.x() - .5, p.y(), 0); });
  auto is_cut = mesh.add_property_map<Mesh::Edge_index, bool>("e:cut", false).first;
  for (const auto e : mesh.edges())
    is_cut[e] = mesh.point(mesh.vertex(e, 0)).x() == 0 && mesh.point(mesh.vertex(e, 1)).x() == 0;
  const Field field = field_on(mesh, [](const Point& p) { return std::abs(p.x()); });
  const auto np = parameters::target_vertices(1000).maximum_size(.5);
  const auto features = find_features(mesh, CGAL::parameters::edge_is_constrained_map(is_cut));
  const auto metric = make_solution_metric(mesh, features, field, np);
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s)
    EXPECT_NEAR(metric.size(s), .5, 1e-12);
  const auto blind = make_solution_metric(mesh, find_features(mesh), field, np);
  EXPECT_LT(blind.size(60), .1);
}

TEST(Solution_metric, refuses_what_makes_no_sense)
{
  Mesh mesh = icosphere(2);
  const Field field = field_on(mesh, front);
  const auto features = find_features(mesh);
  EXPECT_THROW(make_solution_metric(mesh, features, field), Invalid_input);
  EXPECT_THROW(
      make_solution_metric(
          mesh, features, field, parameters::target_vertices(100).target_error(.1)),
      Invalid_input);
  for (const double bad : {0., -1., std::nan("")}) {
    EXPECT_THROW(
        make_solution_metric(mesh, features, field, parameters::target_vertices(bad)),
        Invalid_input);
    EXPECT_THROW(
        make_solution_metric(mesh, features, field, parameters::target_error(bad)), Invalid_input);
    EXPECT_THROW(
        make_solution_metric(
            mesh, features, field, parameters::target_vertices(100).norm_exponent(bad)),
        Invalid_input);
  }
  EXPECT_THROW(
      make_solution_metric(
          mesh, find_features(icosphere(3)), field, parameters::target_vertices(100)),
      Invalid_input);
  field[Vertex(7)] = std::nan("");
  EXPECT_THROW(
      make_solution_metric(mesh, features, field, parameters::target_vertices(100)), Invalid_input);
}

} // namespace
} // namespace surety::test
