// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradation: the isotropic one against sweeps to convergence, the anisotropic one on layers whose
// ideal gradation is known, and both for order, limits, features and speed.
#include <surety/gradation.h>
#include <surety/metric.h>

#include "analytic_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

namespace {

using namespace surety::test;
using surety::edge_length;
using surety::find_features;
using surety::find_sides;
using surety::Invalid_input;
using surety::limit_gradation;
using surety::make_metric;
using surety::Metric_field;
using surety::Metric_kind;
using surety::Sides;
using Tensor = Eigen::Matrix3d;
using V = Eigen::Vector3d;
namespace with = surety::parameters;

constexpr double infinity = std::numeric_limits<double>::infinity();

Sides sides_of(const Mesh& mesh, double feature_angle = 180)
{
  auto features = find_features(mesh, with::feature_angle(feature_angle));
  return find_sides(mesh, features);
}

/// Positive sizes over three orders of magnitude, a function of the place only.
double random_size(const Point& p, std::uint64_t seed)
{
  Random random(seed + std::uint64_t(std::llround(1e6 * (p.x() + 3 * p.y() + 7 * p.z() + 100))));
  return std::pow(10.0, random.between(-3, 0));
}

Metric_field random_sizes(const Mesh& mesh, const Sides& sides, std::uint64_t seed)
{
  return make_metric(
      mesh, sides, [=](const Point& p) { return random_size(p, seed); },
      with::metric_kind(Metric_kind::isotropic));
}

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

// ---- isotropic ----

/// The law, by sweeps over all edges until nothing changes.
std::vector<double> by_sweeps(const Mesh& mesh, std::vector<double> size, double beta)
{
  const double slope = std::log(beta);
  for (bool changes = true; changes;) {
    changes = false;
    for (const auto h : mesh.halfedges()) {
      const V p = eigen(mesh.point(mesh.source(h))), q = eigen(mesh.point(mesh.target(h)));
      const double limit = size[mesh.source(h)] + slope * (q - p).norm();
      if (size[mesh.target(h)] <= limit) continue;
      size[mesh.target(h)] = limit;
      changes = true;
    }
  }
  return size;
}

class Random_sizes : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_sizes, are_limited_to_the_last_bit_as_by_sweeps)
{
  const Mesh mesh = random_shape(GetParam());
  const Sides sides = sides_of(mesh);
  for (const double beta : {1.0, 1.05, 1.3, 4.0}) {
    Metric_field metric = random_sizes(mesh, sides, GetParam());
    std::vector<double> given(mesh.num_vertices());
    for (const Vertex v : mesh.vertices()) given[v] = metric.size_at_vertex(v);
    const auto expected = by_sweeps(mesh, given, beta);
    limit_gradation(mesh, metric, with::gradation(beta));
    for (const Vertex v : mesh.vertices()) {
      ASSERT_EQ(metric.size_at_vertex(v), expected[v]) << "seed " << GetParam() << " beta " << beta;
    }
  }
}

TEST_P(Random_sizes, grow_at_most_by_the_gradation_along_a_unit_of_length)
{
  const Mesh mesh = random_shape(GetParam());
  Metric_field metric = random_sizes(mesh, sides_of(mesh), GetParam());
  limit_gradation(mesh, metric, with::gradation(1.2));
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    const double a = metric.size_at_vertex(mesh.source(h)),
                 b = metric.size_at_vertex(mesh.target(h));
    const double shock
        = std::pow(std::max(a, b) / std::min(a, b), 1 / edge_length(mesh, metric, e));
    EXPECT_LE(shock, 1.2 * (1 + 1e-9)) << "seed " << GetParam();
  }
}

TEST_P(Random_sizes, are_limited_the_same_in_any_numbering)
{
  const Mesh mesh = random_shape(GetParam()), other = renumbered(mesh, GetParam());
  Metric_field a = random_sizes(mesh, sides_of(mesh), 1),
               b = random_sizes(other, sides_of(other), 1);
  limit_gradation(mesh, a);
  limit_gradation(other, b);
  std::map<Point, double> size;
  for (const Vertex v : mesh.vertices()) size[mesh.point(v)] = a.size_at_vertex(v);
  for (const Vertex v : other.vertices()) {
    EXPECT_EQ(b.size_at_vertex(v), size.at(other.point(v))) << "seed " << GetParam();
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_sizes, testing::Range(0u, 8u));

TEST(Isotropic_gradation, gives_all_sides_of_a_ridge_vertex_the_least_size)
{
  const Mesh mesh = cube(4);
  Metric_field metric = make_uniform_metric(
      mesh, sides_of(mesh, 40), 0.5, with::metric_kind(Metric_kind::isotropic));
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    if (metric.normal(s).z() > 0.9) metric.set_size(s, 0.1);
  }
  limit_gradation(mesh, metric, with::gradation(1.3));
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    const double depth = 1 - mesh.point(Vertex(metric.sides().vertex[s])).z();
    EXPECT_LE(metric.size(s), 0.1 + std::log(1.3) * depth * std::sqrt(3.0) + 1e-12);
    if (depth == 0) {
      EXPECT_EQ(metric.size(s), 0.1);
    } else if (depth == 1) {
      EXPECT_GT(metric.size(s), 0.1 + 0.9 * std::log(1.3));
    }
  }
}

TEST(Isotropic_gradation, without_a_limit_changes_nothing)
{
  const Mesh mesh = icosphere(2);
  Metric_field metric = random_sizes(mesh, sides_of(mesh), 3);
  const Metric_field given = metric;
  EXPECT_EQ(limit_gradation(mesh, metric, with::gradation(infinity)), 0u);
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    EXPECT_EQ(metric.size(s), given.size(s));
  }
  EXPECT_GT(limit_gradation(mesh, metric), 0u);
  EXPECT_EQ(limit_gradation(mesh, metric), 0u) << "a limited metric satisfies the limit";
}

// ---- anisotropic: layers in a plane ----

/// Sizes across a straight layer, by the distance from it; 0.2 along it.
struct Layer {
  const char* name;
  double (*across)(double distance);
  double turn; ///< of the layer, in radians
};

void PrintTo(const Layer& layer, std::ostream* out) { *out << layer.name << " at " << layer.turn; }

constexpr double size_along = 0.2;

Tensor layer_tensor(const Layer& layer, const Point& p)
{
  const V along(std::cos(layer.turn), std::sin(layer.turn), 0), across(-along.y(), along.x(), 0);
  const double h = layer.across(std::abs(across.dot(V(p.x() - 0.5, p.y() - 0.5, 0))));
  return along * along.transpose() / (size_along * size_along)
      + across * across.transpose() / (h * h) + V::UnitZ() * V::UnitZ().transpose();
}

/// How many unit triangles fill a plane mesh: the integral of sqrt(det M) over that of a triangle.
double unit_triangles(const Mesh& mesh, const Metric_field& metric)
{
  double sum = 0;
  for (const Face f : mesh.faces()) {
    const auto first = mesh.halfedge(f);
    const double area = std::sqrt(CGAL::squared_area(
        mesh.point(mesh.source(first)), mesh.point(mesh.target(first)),
        mesh.point(mesh.target(mesh.next(first)))));
    for (const auto h : mesh.halfedges_around_face(first)) {
      const Eigen::Matrix2d m = metric.tensor_at_corner(h).topLeftCorner<2, 2>();
      sum += area / 3 * std::sqrt(m.determinant());
    }
  }
  return sum / (std::sqrt(3.0) / 4);
}

/// What the law h_Q <= h_P + ln(beta) |PQ| across the layer alone would cost.
double ideal_ratio(const Layer& layer, double beta)
{
  constexpr int n = 20000;
  const double step = 0.5 / n, slope = std::log(beta) * step;
  std::vector<double> h(n + 1);
  for (int i = 0; i <= n; ++i) h[i] = layer.across(i * step);
  std::vector<double> limited = h;
  for (int i = 1; i <= n; ++i) limited[i] = std::min(limited[i], limited[i - 1] + slope);
  for (int i = n; i > 0; --i) limited[i - 1] = std::min(limited[i - 1], limited[i] + slope);
  double before = 0, after = 0;
  for (int i = 0; i <= n; ++i) {
    before += 1 / h[i];
    after += 1 / limited[i];
  }
  return after / before;
}

class Layers : public testing::TestWithParam<Layer>
{};

TEST_P(Layers, need_no_more_triangles_than_the_law_across_them_demands)
{
  const Mesh mesh = grid(60);
  const auto field = [](const Point& p) { return layer_tensor(GetParam(), p); };
  Metric_field metric = make_metric(mesh, sides_of(mesh), field);
  const double before = unit_triangles(mesh, metric);
  limit_gradation(mesh, metric, with::gradation(1.3));
  const double ratio = unit_triangles(mesh, metric) / before;
  EXPECT_LE(ratio, 1.02 * ideal_ratio(GetParam(), 1.3));
  EXPECT_GE(ratio, 0.9 * ideal_ratio(GetParam(), 1.3)) << "the gradation is limited";
  RecordProperty("ratio", std::to_string(ratio));
}

TEST_P(Layers, grow_across_as_the_law_demands)
{
  const Mesh mesh = grid(60);
  const auto field = [](const Point& p) { return layer_tensor(GetParam(), p); };
  Metric_field metric = make_metric(mesh, sides_of(mesh), field);
  limit_gradation(mesh, metric, with::gradation(1.3));
  const V across(-std::sin(GetParam().turn), std::cos(GetParam().turn), 0);
  const auto size_across = [&](Vertex v) {
    const Tensor m = metric.tensor_at_vertex(v);
    return 1 / std::sqrt(across.dot(m * across));
  };
  for (const auto h : mesh.halfedges()) {
    const double length
        = (eigen(mesh.point(mesh.target(h))) - eigen(mesh.point(mesh.source(h)))).norm();
    const double a = size_across(mesh.source(h)), b = size_across(mesh.target(h));
    // Half a per cent is the slack of the gradation; t = 1/8 lets sizes grow a little less, or
    // more, than linearly.
    EXPECT_LE(b, (a + std::log(1.3) * length) * 1.02);
  }
}

TEST_P(Layers, keep_their_large_size)
{
  const Mesh mesh = grid(60);
  const auto field = [](const Point& p) { return layer_tensor(GetParam(), p); };
  Metric_field metric = make_metric(mesh, sides_of(mesh), field);
  limit_gradation(mesh, metric, with::gradation(1.3));
  const V along(std::cos(GetParam().turn), std::sin(GetParam().turn), 0);
  for (const Vertex v : mesh.vertices()) {
    const Tensor m = metric.tensor_at_vertex(v);
    EXPECT_GE(1 / std::sqrt(along.dot(m * along)), 0.98 * size_along);
  }
}

double jump(double d) { return d < 0.05 ? 0.01 : 0.2; }
double gentle(double d) { return std::min(0.01 + 0.3 * d, 0.2); }
double steep(double d) { return std::min(0.005 + d, 0.2); }
double bell(double d) { return 0.2 - 0.19 * std::exp(-50 * d * d); }

INSTANTIATE_TEST_SUITE_P(
    Sizes, Layers,
    testing::Values(
        Layer{"jump", jump, 0}, Layer{"jump", jump, 0.5}, Layer{"gentle", gentle, 0},
        Layer{"gentle", gentle, 0.5}, Layer{"steep", steep, 0}, Layer{"bell", bell, 0.3}));

TEST(Anisotropic_gradation, of_a_straight_layer_needs_less_than_a_third_more_triangles)
{
  const Mesh mesh = grid(60);
  for (const double turn : {0.0, 0.5}) {
    const Layer layer{"gentle", gentle, turn};
    Metric_field metric
        = make_metric(mesh, sides_of(mesh), [&](const Point& p) { return layer_tensor(layer, p); });
    const double before = unit_triangles(mesh, metric);
    EXPECT_GT(limit_gradation(mesh, metric, with::gradation(1.3)), mesh.num_vertices() / 2);
    EXPECT_LE(unit_triangles(mesh, metric), 1.3 * before);
  }
}

// ---- anisotropic: any tensors ----

class Random_tensors : public testing::TestWithParam<unsigned>
{};

Metric_field random_tensors(const Mesh& mesh, const Sides& sides, std::uint64_t seed)
{
  return make_metric(mesh, sides, [=](const Point& p) {
    Random random(seed + std::uint64_t(std::llround(1e6 * (p.x() + 3 * p.y() + 7 * p.z() + 100))));
    return random_tensor(random);
  });
}

TEST_P(Random_tensors, never_fall_below_the_least_size_and_never_grow)
{
  const Mesh mesh = random_shape(GetParam());
  Metric_field metric = random_tensors(mesh, sides_of(mesh, 40), GetParam());
  const Metric_field given = metric;
  double least = infinity;
  for (std::uint32_t s = 0; s < given.number_of_sides(); ++s)
    least = std::min(least, given.size(s));
  EXPECT_GT(limit_gradation(mesh, metric), 0u);
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    EXPECT_GE(metric.size(s), least * (1 - 1e-9)) << "seed " << GetParam();
    // The clamp that protects the least size gives way in other directions: only the large size
    // and the small one are promised not to grow.
    EXPECT_LE(metric.size(s), given.size(s) * (1 + 1e-9)) << "seed " << GetParam();
    EXPECT_TRUE(metric.tensor(s).allFinite());
  }
}

using Place = std::tuple<Point, double, double, double>;

Place place_of(const Mesh& mesh, const Metric_field& metric, std::uint32_t s)
{
  const V& n = metric.normal(s);
  return {mesh.point(Vertex(metric.sides().vertex[s])), n.x(), n.y(), n.z()};
}

TEST_P(Random_tensors, are_limited_the_same_in_any_numbering)
{
  const Mesh mesh = random_shape(GetParam()), other = renumbered(mesh, GetParam() + 1);
  for (const unsigned rounds : {0u, 2u}) {
    Metric_field a = random_tensors(mesh, sides_of(mesh, 40), 1);
    Metric_field b = random_tensors(other, sides_of(other, 40), 1);
    limit_gradation(mesh, a, with::smoothing_rounds(rounds));
    limit_gradation(other, b, with::smoothing_rounds(rounds));
    std::map<Place, Tensor> tensor;
    for (std::uint32_t s = 0; s < a.number_of_sides(); ++s)
      tensor[place_of(mesh, a, s)] = a.tensor(s);
    for (std::uint32_t s = 0; s < b.number_of_sides(); ++s) {
      const auto found = tensor.find(place_of(other, b, s));
      ASSERT_NE(found, tensor.end()) << "seed " << GetParam();
      EXPECT_EQ(b.tensor(s), found->second) << "seed " << GetParam();
    }
  }
}

TEST_P(Random_tensors, scale_with_the_mesh_to_the_last_bit)
{
  const Mesh mesh = random_shape(GetParam());
  const Sides sides = sides_of(mesh, 40);
  const Metric_field given = random_tensors(mesh, sides, GetParam());
  Metric_field expected = given;
  limit_gradation(mesh, expected);
  for (const double s : {0x1p10, 0x1p-10}) {
    const Mesh large = scaled(mesh, s);
    Metric_field metric = make_uniform_metric(large, sides, 1);
    for (std::uint32_t i = 0; i < sides.size(); ++i)
      metric.set_tensor(i, given.tensor(i) / (s * s));
    Metric_field again = make_uniform_metric(mesh, sides, 1);
    for (std::uint32_t i = 0; i < sides.size(); ++i) again.set_tensor(i, given.tensor(i));
    limit_gradation(large, metric);
    limit_gradation(mesh, again);
    for (std::uint32_t i = 0; i < sides.size(); ++i) {
      ASSERT_EQ(metric.tensor(i) * (s * s), again.tensor(i)) << "seed " << GetParam();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_tensors, testing::Range(0u, 8u));

TEST(Anisotropic_gradation, hands_only_the_size_along_a_ridge_across_it)
{
  // Faces z = 1 of a cube want 0.05 along x and 0.5 along y; the others 0.5 everywhere.
  const Mesh mesh = cube(8);
  Metric_field metric = make_uniform_metric(mesh, sides_of(mesh, 40), 0.5);
  const Tensor layer = V(400, 4, 4).asDiagonal();
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    if (metric.normal(s).z() > 0.9) metric.set_tensor(s, layer);
  }
  limit_gradation(mesh, metric, with::gradation(1.3));
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    const Point p = mesh.point(Vertex(metric.sides().vertex[s]));
    const bool is_inner = p.z() == 1 && p.x() > 0.2 && p.x() < 0.8;
    const bool is_middle = p.z() == 1 && p.y() > 0.3 && p.y() < 0.7;
    const Tensor m = metric.tensor(s);
    const V n = metric.normal(s);
    if (is_inner && std::abs(n.y()) > 0.9) {
      // The ridges along x carry the thin size; down the face the size stays large.
      EXPECT_NEAR(1 / std::sqrt(m(0, 0)), 0.05, 0.001);
      EXPECT_GT(1 / std::sqrt(m(2, 2)), 0.4);
    }
    if (is_middle && std::abs(n.x()) > 0.9) {
      // The ridges along y carry the large one: the thin size across them stays on its own side.
      EXPECT_GT(1 / std::sqrt(m(1, 1)), 0.2);
      EXPECT_GT(1 / std::sqrt(m(2, 2)), 0.2);
    }
  }
}

TEST(Anisotropic_gradation, turns_directions_with_the_surface)
{
  // Rings of a cylinder want small sizes along the axis at one end; all the way round the direction
  // is handed on as the axis.
  const Mesh mesh = to_mesh(sheet(
      24, 48,
      [](double i, double j) {
        const double a = 2 * pi * j / 48;
        return Point(std::cos(a), std::sin(a), i / 12);
      },
      false, true));
  Metric_field metric = make_uniform_metric(mesh, sides_of(mesh), 0.5);
  const Tensor layer = V(4, 4, 1e4).asDiagonal();
  const Vertex source(0);
  metric.set_tensor(metric.sides().first[source], layer);
  limit_gradation(mesh, metric, with::gradation(1.1));
  for (const Vertex v : mesh.vertices()) {
    const Tensor m = metric.tensor_at_vertex(v);
    const V n = metric.normal(metric.sides().first[v]), around = n.cross(V::UnitZ()).normalized();
    EXPECT_GE(1 / std::sqrt(around.dot(m * around)), 0.3) << v;
    if (mesh.point(v).z() > 0) continue;
    EXPECT_LT(1 / std::sqrt(m(2, 2)), 0.3) << v;
  }
}

TEST(Anisotropic_gradation, with_the_gradation_1_makes_isotropic_sizes_uniform)
{
  const Mesh mesh = icosphere(2);
  Metric_field metric = make_uniform_metric(mesh, sides_of(mesh), 0.5);
  metric.set_size(7, 0.125);
  limit_gradation(mesh, metric, with::gradation(1));
  for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
    EXPECT_NEAR(metric.size(s), 0.125, 1e-3);
  }
}

// ---- smoothing ----

TEST(Smoothing, saves_the_anisotropy_of_noisy_directions)
{
  const Mesh mesh = grid(60);
  const auto noisy = [&](std::uint64_t seed) {
    Random random(seed);
    Metric_field metric = make_uniform_metric(mesh, sides_of(mesh), 1);
    for (std::uint32_t s = 0; s < metric.number_of_sides(); ++s) {
      const Layer layer{"noise", gentle, random.between(-0.3, 0.3)};
      metric.set_tensor(s, layer_tensor(layer, Point(0.5, 0.5, 0)));
    }
    return metric;
  };
  Metric_field rough = noisy(1), smooth = noisy(1);
  limit_gradation(mesh, rough);
  limit_gradation(mesh, smooth, with::smoothing_rounds(3));
  EXPECT_LT(unit_triangles(mesh, smooth), 0.7 * unit_triangles(mesh, rough));
}

/// A vertex of a cube inside one of its edges.
Vertex vertex_on_ridge(const Mesh& mesh)
{
  for (const Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    if (p.x() == 0 && p.y() == 0 && p.z() > 0.3 && p.z() < 0.7) return v;
  }
  throw std::logic_error("no vertex there");
}

TEST(Smoothing, leaves_curves_of_features_alone)
{
  const Mesh mesh = cube(6);
  Metric_field metric = make_uniform_metric(mesh, sides_of(mesh, 40), 0.5);
  const std::uint32_t on_ridge = metric.sides().first[vertex_on_ridge(mesh)];
  metric.set_size(on_ridge, 0.1);
  const Metric_field given = metric;
  limit_gradation(mesh, metric, with::gradation(infinity).smoothing_rounds(2));
  EXPECT_EQ(metric.tensor(on_ridge), given.tensor(on_ridge));
}

// ---- arguments and speed ----

TEST(Gradation, rejects_what_makes_no_sense)
{
  const Mesh mesh = icosphere(1);
  Metric_field metric = make_uniform_metric(mesh, sides_of(mesh), 1);
  EXPECT_THROW(limit_gradation(mesh, metric, with::gradation(0.99)), Invalid_input);
  EXPECT_THROW(limit_gradation(mesh, metric, with::gradation(NAN)), Invalid_input);
  EXPECT_THROW(limit_gradation(icosphere(2), metric), Invalid_input);
}

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

TEST(Gradation, of_100_000_vertices_takes_a_fraction_of_a_second)
{
#ifdef NDEBUG
  const Mesh mesh = grid(316);
  const Sides sides = sides_of(mesh);
  Metric_field isotropic = random_sizes(mesh, sides, 1);
  const Layer layer{"bell", bell, 0.3};
  Metric_field tensors
      = make_metric(mesh, sides, [&](const Point& p) { return layer_tensor(layer, p); });
  const double start = cpu_seconds();
  limit_gradation(mesh, isotropic);
  const double middle = cpu_seconds();
  limit_gradation(mesh, tensors);
  const double end = cpu_seconds();
  EXPECT_LT(middle - start, 0.1 * 4) << "a tenth of a second, with room for a slow machine";
  EXPECT_LT(end - middle, 0.6 * 4);
  RecordProperty("isotropic", std::to_string(middle - start));
  RecordProperty("anisotropic", std::to_string(end - middle));
#else
  GTEST_SKIP() << "not optimised";
#endif
}

} // namespace
