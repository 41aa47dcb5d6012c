// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothing: sweeps that keep the number of faces, make them rounder, and keep every promise.
#include <surety/geometric_mesh.h>
#include <surety/hierarchy.h>

#include "cad_meshes.h"
#include "simplification.h"

#include <surety/statistics.h>

#include <functional>

namespace {

using namespace surety::test;
using surety::Effort;
using surety::Invalid_input;
using surety::make_geometric_mesh;
using surety::Placement;
using surety::Progress;
namespace with = surety::parameters;

constexpr double ridge_angle = 40;
constexpr unsigned plenty = 30;

struct Shape {
  const char* name;
  Mesh mesh;
  double tolerance;
};

void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }

/// A tube whose rims have vertices at uneven distances, so that they have reason to slide.
Mesh uneven_tube()
{
  return mapped(cylinder(120, 20), [](const Point& p) {
    const double angle = std::atan2(p.y(), p.x()), turned = angle + 0.25 * std::sin(3 * angle);
    const double radius = std::hypot(p.x(), p.y());
    return Point(radius * std::cos(turned), radius * std::sin(turned), p.z());
  });
}

std::vector<Shape> shapes()
{
  return {
      {"sphere", jittered_sphere(4, 5), 0.01},
      {"sheet",
       jittered(
           height_field(
               24, [](double x, double y) { return 0.1 * std::sin(4 * x) * std::cos(3 * y); }),
           0.008, 3),
       0.01},
      {"part", remeshed(cad_part(), 0.15), 0.02},
      {"tube", uneven_tube(), 0.02}};
}

class Smoothed : public testing::TestWithParam<std::tuple<Shape, Method>>
{
protected:
  const Shape shape = std::get<0>(GetParam());
  const Method method = std::get<1>(GetParam());

  Simplification smoothed(unsigned sweeps, double scale = 1) const
  {
    return simplified(
        scaled(shape.mesh, scale), scale * shape.tolerance,
        parameters_of(method).feature_angle(ridge_angle).smoothing_sweeps(sweeps));
  }
};

TEST_P(Smoothed, shape_has_as_many_faces_of_a_better_shape_and_keeps_every_promise)
{
  const Simplification rough = smoothed(0), round = smoothed(plenty);
  expect_sound(round, 1);
  EXPECT_EQ(round.output.number_of_faces(), rough.output.number_of_faces());
  const auto before = surety::mesh_statistics(rough.output),
             after = surety::mesh_statistics(round.output);
  EXPECT_LT(after.Q_avg, 0.99 * before.Q_avg);
  EXPECT_LE(after.Q_max, before.Q_max * (1 + 1e-9));
  EXPECT_GT(round.certificate.operations().relocations, rough.certificate.operations().relocations);
  const auto curves = [](const Mesh& mesh) {
    Curves all = sharp_curves(mesh, ridge_angle), borders = border_curves(mesh);
    all.insert(all.end(), borders.begin(), borders.end());
    return all;
  };
  EXPECT_EQ(curves(round.output).size(), curves(rough.output).size());
  EXPECT_LE(
      curve_distance(curves(round.input), curves(round.output)),
      shape.tolerance + sampling_error(round.input));
}

TEST_P(Smoothed, shape_is_the_same_at_any_size)
{
  EXPECT_TRUE(is_identical(scaled(smoothed(3).output, 0x1p10), smoothed(3, 0x1p10).output));
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Smoothed,
    testing::Combine(
        testing::ValuesIn(shapes()),
        testing::Values(on_surface_fast, on_surface, free_fast, free_standard)),
    [](const auto& info) {
      return std::string(std::get<0>(info.param).name) + '_' + std::get<1>(info.param).name;
    });

TEST(Smoothing, gets_better_from_sweep_to_sweep)
{
  const Mesh input = jittered_sphere(4, 5);
  std::vector<double> means;
  for (const unsigned sweeps : {0u, 1u, plenty})
    means.push_back(
        surety::mesh_statistics(
            simplified(input, 0.01, with::smoothing_sweeps(sweeps).effort(Effort::fast)).output)
            .Q_avg);
  EXPECT_LT(means[1], 0.95 * means[0]);
  EXPECT_LT(means[2], means[1]);
}

std::set<Point> rim_of(const Mesh& mesh)
{
  std::set<Point> rim;
  for (const auto& [a, b] : sharp_curves(mesh, ridge_angle)) rim.insert({a, b});
  return rim;
}

TEST(Smoothing, slides_vertices_along_ridges_from_one_of_the_input_to_another)
{
  for (const Placement placement : {Placement::on_surface, Placement::free}) {
    const auto np = with::feature_angle(ridge_angle).effort(Effort::fast).placement(placement);
    const Mesh input = uneven_tube();
    const Simplification rough = simplified(input, 0.02, np);
    const Simplification round = simplified(input, 0.02, np.smoothing_sweeps(plenty));
    const std::set<Point> before = rim_of(rough.output), after = rim_of(round.output),
                          all = rim_of(input);
    EXPECT_EQ(before.size(), after.size());
    EXPECT_NE(before, after);
    if (placement == Placement::on_surface) {
      EXPECT_TRUE(std::includes(all.begin(), all.end(), after.begin(), after.end()));
    }
    expect_sound(round, 1);
  }
}

TEST(Smoothing, leaves_corners_and_constrained_vertices_where_they_are)
{
  Mesh input = remeshed(cad_part(), 0.15);
  const auto is_constrained = input.add_property_map<Vertex, bool>("v:stays", false).first;
  std::vector<Point> stay;
  for (const Vertex v : input.vertices())
    if (v.idx() % 50 == 0) is_constrained[v] = true, stay.push_back(input.point(v));
  const Simplification s = simplified(
      input, 0.02,
      with::feature_angle(ridge_angle)
          .smoothing_sweeps(plenty)
          .vertex_is_constrained_map(is_constrained));
  for (const Point& p : stay) EXPECT_TRUE(has_vertex_at(s.output, p)) << p;
  expect_sound(s, 1);
}

TEST(Smoothing, is_made_in_the_last_level_of_a_hierarchy_and_recorded)
{
  const Mesh input = uneven_tube();
  const auto np = with::feature_angle(ridge_angle).smoothing_sweeps(5);
  const auto hierarchy = surety::make_hierarchy(input, {0.005, 0.02}, np);
  ASSERT_EQ(hierarchy.levels().size(), 2u);
  const auto& [finest, coarsest] = std::tie(hierarchy.levels()[0], hierarchy.levels()[1]);
  EXPECT_EQ(finest.certificate.operations().relocations, 0u);
  EXPECT_GT(coarsest.certificate.operations().relocations, 0u);
  EXPECT_TRUE(check_certificate(input, coarsest.mesh, coarsest.certificate).holds);
  const auto& operations = hierarchy.record().operations;
  EXPECT_TRUE(is_identical(hierarchy.extract(operations.size()).mesh, coarsest.mesh));
}

struct Stop_at_smoothing {
  bool* was_told;
  bool on_progress(const Progress& progress) const
  {
    *was_told = *was_told || progress.stage == std::string("smooth");
    return !*was_told;
  }
};

TEST(Smoothing, can_be_cancelled)
{
  bool was_told = false;
  const Simplification s = simplified(
      jittered_sphere(4, 5), 0.01, with::smoothing_sweeps(5).visitor(Stop_at_smoothing{&was_told}));
  EXPECT_TRUE(was_told);
  EXPECT_TRUE(s.certificate.is_cancelled());
  expect_sound(s, 1);
}

TEST(Smoothing, under_the_accumulated_bound_is_refused)
{
  Mesh mesh = icosphere(2);
  EXPECT_THROW(
      make_geometric_mesh(
          mesh, 0.1,
          with::smoothing_sweeps(1).deviation_bound(surety::Deviation_bound::accumulated)),
      Invalid_input);
}

} // namespace
