// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unit meshes: that they are unit, within the tolerance by every witness, of the same topology,
// with their curves and corners kept, and that the covering bound behind them is sound.
#include <surety/covering_certificate.h>
#include <surety/distance.h>
#include <surety/geometric_mesh.h>
#include <surety/remesh.h>
#include <surety/statistics.h>

#include "invariants.h"
#include "meshes.h"
#include "sampled_distance.h"

#include <gtest/gtest.h>

#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace surety::test {
namespace {

double diagonal_of(const Mesh& mesh) { return mesh_statistics(mesh).diagonal; }

/// What holds for every result.
void expect_promises(
    const Mesh& before, const Mesh& after, double tolerance, const Unit_mesh_result& result)
{
  EXPECT_TRUE(is_sound(after));
  EXPECT_TRUE(have_same_topology(before, after));
  EXPECT_TRUE(result.certificate.holds());
  EXPECT_LE(result.certificate.bound(), tolerance);
  EXPECT_TRUE(certify_distance(before, after, tolerance).holds());
  const auto covering = make_covering(before, after, tolerance);
  EXPECT_TRUE(covering && check_covering(before, after, *covering).holds);
  EXPECT_LE(number_of_self_intersections(after), number_of_self_intersections(before));
  // b(K) is a bound for the points of K.
  const auto deviation = after.property_map<Face, double>("f:deviation").first;
  const Closest_triangle input(before);
  for (const Face f : after.faces()) {
    const auto h = after.halfedge(f);
    const Point centre = CGAL::centroid(
        after.point(after.source(h)), after.point(after.target(h)),
        after.point(after.target(after.next(h))));
    EXPECT_LE(input.distance(centre), deviation[f] * (1 + 1e-12) + 1e-14);
  }
}

Mesh wavy_grid(std::size_t n)
{
  return height_field(n, [](double x, double y) { return .1 * std::sin(4 * x) * std::cos(3 * y); });
}

TEST(Remesh, makes_a_sphere_unit)
{
  const Mesh sphere = icosphere(4);
  const double tolerance = .002 * diagonal_of(sphere);
  Mesh result = sphere;
  const Remeshing answer = remesh(result, tolerance);
  expect_promises(sphere, result, tolerance, answer.unit_mesh);
  EXPECT_GE(answer.unit_mesh.fit.unit_edges, 99.5);
  EXPECT_GE(answer.unit_mesh.fit.efficiency_index, .975);
  EXPECT_LE(answer.unit_mesh.fit.Q_avg, 1.17);
  EXPECT_LE(answer.unit_mesh.fit.Q_max, 2.5);
  EXPECT_GT(answer.unit_mesh.certificate.operations().collapses, 0u);
  EXPECT_GT(answer.unit_mesh.certificate.operations().relocations, 0u);
}

TEST(Remesh, splits_where_sizes_are_smaller_than_the_input)
{
  Mesh result = icosphere(2);
  const Mesh sphere = result;
  const double size = .12;
  const Remeshing answer
      = remesh(result, .05, parameters::feature_angle(180).minimum_size(size).maximum_size(size));
  expect_promises(sphere, result, .05, answer.unit_mesh);
  EXPECT_GT(answer.unit_mesh.certificate.operations().splits, 400u);
  // Some 0.43 size^2 a face; edges may be longer by a factor of sqrt(2).
  const double expected = 4 * pi / (.433 * size * size);
  EXPECT_GT(double(result.number_of_faces()), .5 * expected);
  EXPECT_LT(double(result.number_of_faces()), 1.5 * expected);
  EXPECT_GE(answer.unit_mesh.fit.unit_edges, 99);
}

Mesh unit_cube()
{
  Mesh cube;
  CGAL::make_hexahedron(
      Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), Point(0, 1, 1),
      Point(0, 0, 1), Point(1, 0, 1), Point(1, 1, 1), cube);
  CGAL::Polygon_mesh_processing::triangulate_faces(cube);
  return cube;
}

TEST(Remesh, keeps_the_edges_of_a_cube)
{
  const Mesh cube = subdivided(unit_cube(), 3);
  Mesh result = cube;
  const Remeshing answer = remesh(result, .01, parameters::feature_angle(40));
  expect_promises(cube, result, .01, answer.unit_mesh);
  EXPECT_EQ(answer.features.corners, 8u);
  // Twelve edges of length 1 stay straight.
  const auto is_feature = result.property_map<Mesh::Edge_index, bool>("e:is_feature").first;
  double length = 0;
  for (const auto e : result.edges()) {
    if (!is_feature[e]) continue;
    const auto h = result.halfedge(e);
    length += std::sqrt(
        CGAL::squared_distance(result.point(result.source(h)), result.point(result.target(h))));
  }
  EXPECT_NEAR(length, 12, 1e-9);
}

/// Whether two points are the ends of an edge.
bool has_edge(const Mesh& mesh, const Point& p, const Point& q)
{
  for (const auto h : mesh.halfedges())
    if (mesh.point(mesh.source(h)) == p && mesh.point(mesh.target(h)) == q) return true;
  return false;
}

/// Twenty-four sides, each of two triangles that are as long as it.
Mesh faceted_cylinder()
{
  Mesh result;
  CGAL::make_regular_prism(24, result, Point(0, 0, 0), 2, .5, true);
  CGAL::Polygon_mesh_processing::triangulate_faces(result);
  return result;
}

TEST(Remesh, divides_the_long_faces_of_a_coarse_part)
{
  const Mesh cylinder = faceted_cylinder();
  const double tolerance = .001 * diagonal_of(cylinder);
  Mesh result = cylinder;
  const Remeshing answer = remesh(result, tolerance);
  expect_promises(cylinder, result, tolerance, answer.unit_mesh);
  EXPECT_EQ(answer.features.ridges, 48u) << "the two rims";
  EXPECT_GE(answer.unit_mesh.fit.unit_edges, 80);
  EXPECT_LE(answer.unit_mesh.fit.Q_avg, 1.5);
  // Sizes give way where it is needed, and not over the whole of faces as long as the part.
  EXPECT_LE(result.number_of_faces(), 6000u);
}

TEST(Remesh, does_not_split_edges_that_are_to_stay_whole)
{
  const Mesh cube = unit_cube();
  const Point p(0, 0, 0), q(1, 0, 0);
  for (const bool stays_whole : {false, true}) {
    Features features = find_features(cube, parameters::feature_angle(40));
    if (stays_whole) {
      for (const auto e : cube.edges()) {
        const Point a = cube.point(cube.vertex(e, 0)), b = cube.point(cube.vertex(e, 1));
        features.whole.push_back((a == p && b == q) || (a == q && b == p));
      }
    }
    Mesh result = cube;
    const Remeshing answer = remesh(result, features, .01, parameters::maximum_size(.2));
    expect_promises(cube, result, .01, answer.unit_mesh);
    EXPECT_EQ(has_edge(result, p, q), stays_whole);
    EXPECT_FALSE(has_edge(result, Point(0, 1, 1), Point(1, 1, 1)));
  }
  Features wrong = find_features(cube);
  wrong.whole.assign(3, true);
  Mesh result = cube;
  EXPECT_THROW(remesh(result, wrong, .01), Invalid_input);
}

TEST(Remesh, leaves_a_cube_of_twelve_faces_within_the_tolerance)
{
  const Mesh cube = unit_cube();
  Mesh result = cube;
  const double tolerance = .01 * std::sqrt(3);
  const Remeshing answer
      = remesh(result, tolerance, parameters::feature_angle(180).number_of_iterations(3u));
  expect_promises(cube, result, tolerance, answer.unit_mesh);
}

TEST(Remesh, serves_open_meshes)
{
  const Mesh patch = wavy_grid(24);
  Mesh result = patch;
  const double tolerance = .003 * diagonal_of(patch);
  const Remeshing answer = remesh(result, tolerance);
  expect_promises(patch, result, tolerance, answer.unit_mesh);
  EXPECT_EQ(border_loops(result), 1u);
}

TEST(Remesh, stretches_faces_along_a_torus)
{
  const Mesh tube = torus(120, 40, 1, .15);
  const double tolerance = .001 * diagonal_of(tube);
  Mesh round = tube, stretched = tube;
  remesh(round, tolerance);
  const Remeshing answer
      = remesh(stretched, tolerance, parameters::metric_kind(Metric_kind::anisotropic));
  expect_promises(tube, stretched, tolerance, answer.unit_mesh);
  EXPECT_LT(1.2 * double(stretched.number_of_faces()), double(round.number_of_faces()));
  EXPECT_GE(answer.unit_mesh.fit.unit_edges, 98.5);
  EXPECT_LE(answer.unit_mesh.fit.Q_avg, 1.19);
}

TEST(Remesh, takes_fewer_faces_when_asked)
{
  // Sizes vary, so that their growth counts.
  const Mesh shape = ellipsoid(5, 2, 1, .3);
  const double tolerance = .001 * diagonal_of(shape);
  Mesh close = shape, few = shape;
  remesh(close, tolerance);
  const Remeshing answer = remesh(few, tolerance, parameters::fewest_faces(true));
  expect_promises(shape, few, tolerance, answer.unit_mesh);
  EXPECT_LT(few.number_of_faces(), close.number_of_faces());
}

TEST(Remesh, lets_sizes_jump_when_asked)
{
  const Mesh shape = ellipsoid(4, 2, 1, .3);
  const double tolerance = .001 * diagonal_of(shape);
  Mesh graded = shape, free = shape;
  remesh(graded, tolerance, parameters::gradation(1.1));
  const Remeshing answer
      = remesh(free, tolerance, parameters::gradation(std::numeric_limits<double>::infinity()));
  expect_promises(shape, free, tolerance, answer.unit_mesh);
  EXPECT_LT(free.number_of_faces(), graded.number_of_faces());
  EXPECT_THROW(remesh(free, tolerance, parameters::gradation(.5)), Invalid_input);
}

TEST(Remesh, fits_round_faces_into_narrow_strips)
{
  const Mesh plate = scaled(cube(), 4, 4, .2);
  const double tolerance = .001 * diagonal_of(plate);
  Mesh mesh = plate, crowded = plate;
  const Remeshing answer = remesh(mesh, tolerance);
  expect_promises(plate, mesh, tolerance, answer.unit_mesh);
  EXPECT_GE(answer.unit_mesh.fit.unit_edges, 98);
  EXPECT_LE(answer.unit_mesh.fit.Q_max, 2);
  const Remeshing other = remesh(crowded, tolerance, parameters::proximity(false));
  EXPECT_LT(crowded.number_of_faces(), mesh.number_of_faces());
  EXPECT_GT(other.unit_mesh.fit.Q_avg, answer.unit_mesh.fit.Q_avg);
}

TEST(Remesh, is_deterministic_and_free_of_scale)
{
  const Mesh shape = torus(48, 24);
  Mesh one = shape, two = shape, large = shape;
  for (const auto v : large.vertices()) {
    const Point& p = shape.point(v);
    large.point(v) = Point(1024 * p.x(), 1024 * p.y(), 1024 * p.z());
  }
  remesh(one, .01);
  remesh(two, .01);
  remesh(large, 10.24);
  ASSERT_EQ(one.number_of_vertices(), two.number_of_vertices());
  ASSERT_EQ(one.number_of_vertices(), large.number_of_vertices());
  for (const auto v : one.vertices()) {
    EXPECT_EQ(one.point(v), two.point(v));
    EXPECT_EQ(1024 * one.point(v).x(), large.point(v).x());
  }
}

struct Impatient {
  int* left;
  bool on_progress(const Progress& progress) const
  {
    EXPECT_STREQ(progress.stage, "unit_mesh");
    return --*left > 0;
  }
};

TEST(Remesh, leaves_a_certified_mesh_when_cancelled)
{
  const Mesh sphere = icosphere(4);
  for (const int patience : {1, 3, 10}) {
    int left = patience;
    Mesh result = sphere;
    const Remeshing answer
        = remesh(result, .005, parameters::placement(Placement::free).visitor(Impatient{&left}));
    EXPECT_TRUE(answer.unit_mesh.certificate.is_cancelled());
    expect_promises(sphere, result, .005, answer.unit_mesh);
  }
}

TEST(Remesh, keeps_vertices_on_the_support_when_asked)
{
  const Mesh sphere = icosphere(4);
  Mesh result = sphere;
  const Remeshing answer = remesh(result, .005, parameters::placement(Placement::on_surface));
  expect_promises(sphere, result, .005, answer.unit_mesh);
  for (const auto v : result.vertices()) {
    const Point& p = result.point(v);
    const auto nearest
        = answer.support.guaranteed_closest_point(Eigen::Vector3d(p.x(), p.y(), p.z()));
    EXPECT_LT(std::sqrt(nearest.squared_distance), 1e-6);
  }
}

TEST(Remesh, refuses_what_it_cannot_use)
{
  Mesh mesh = icosphere(1);
  const Mesh before = mesh;
  EXPECT_THROW(remesh(mesh, 0), Invalid_input);
  EXPECT_THROW(remesh(mesh, -1), Invalid_input);
  EXPECT_THROW(remesh(mesh, .1, parameters::gradation(.5)), Invalid_input);
  EXPECT_THROW(remesh(mesh, .1, parameters::maximum_size(-1.)), Invalid_input);
  Mesh empty;
  EXPECT_THROW(remesh(empty, .1), Invalid_input);
  const Features features = find_features(before);
  const Metric_field other = make_uniform_metric(
      icosphere(2), find_sides(icosphere(2), find_features(icosphere(2))), .1);
  EXPECT_THROW(make_unit_mesh(mesh, features, other), Invalid_input);
  EXPECT_THROW(make_unit_mesh(mesh, find_features(icosphere(2)), other), Invalid_input);
  EXPECT_THROW(remesh(mesh, find_features(icosphere(2)), .1), Invalid_input);
  EXPECT_EQ(mesh.number_of_faces(), before.number_of_faces());
}

/// A cone whose apex has more faces than there are candidates to cover a cell.
TEST(Covering_bound, proves_every_face_of_a_large_fan)
{
  constexpr std::size_t around = 200;
  Mesh cone;
  const Vertex apex = cone.add_vertex(Point(0, 0, .3));
  std::vector<Vertex> ring;
  for (std::size_t i = 0; i < around; ++i) {
    const double t = 2 * pi * double(i) / double(around);
    ring.push_back(cone.add_vertex(Point(std::cos(t), std::sin(t), 0)));
  }
  for (std::size_t i = 0; i < around; ++i) cone.add_face(apex, ring[i], ring[(i + 1) % around]);
  const double tolerance = .005 * diagonal_of(cone);
  for (const auto kind : {Metric_kind::isotropic, Metric_kind::anisotropic}) {
    Mesh result = cone;
    const Remeshing answer = remesh(result, tolerance, parameters::metric_kind(kind));
    expect_promises(cone, result, tolerance, answer.unit_mesh);
  }
}

TEST(Covering_bound, simplifies_within_the_tolerance)
{
  for (const Mesh& mesh : {icosphere(3), torus(48, 24), wavy_grid(24)}) {
    for (const double share : {.001, .01}) {
      const double tolerance = share * diagonal_of(mesh);
      Mesh result = mesh;
      const Certificate certificate = make_geometric_mesh(
          result, tolerance,
          parameters::deviation_bound(Deviation_bound::covering).effort(Effort::fast));
      EXPECT_TRUE(certificate.holds());
      if (share == .01) {
        EXPECT_LT(2 * result.number_of_faces(), mesh.number_of_faces());
      }
      EXPECT_TRUE(certify_distance(mesh, result, tolerance).holds());
      EXPECT_TRUE(have_same_topology(mesh, result));
    }
  }
}

TEST(Remesh, keeps_its_promises_on_real_models)
{
  const char* const folder = std::getenv("SURETY_DATA_DIR");
  if (folder == nullptr || *folder == 0) GTEST_SKIP() << "SURETY_DATA_DIR is not set";
  for (const std::string name : {"fandisk", "rotor_small", "blobby"}) {
    Mesh mesh;
    ASSERT_TRUE(CGAL::IO::read_polygon_mesh(std::string(folder) + "/" + name + ".off", mesh));
    SCOPED_TRACE(name);
    Mesh result = mesh;
    const double tolerance = .002 * diagonal_of(mesh);
    const Remeshing answer = remesh(result, tolerance);
    expect_promises(mesh, result, tolerance, answer.unit_mesh);
    EXPECT_GE(answer.unit_mesh.fit.unit_edges, 95);
  }
}

} // namespace
} // namespace surety::test
