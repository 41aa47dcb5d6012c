// SPDX-License-Identifier: GPL-3.0-or-later
//
// What make_geometric_mesh keeps to besides one tolerance: tolerances that vary, normals, faces
// that stay, stages and numbers of faces; and large meshes, which it simplifies in patches.
#include <surety/geometric_mesh.h>

#include "cad_meshes.h"
#include "simplification.h"

#include <CGAL/Simple_cartesian.h>

namespace {

using namespace surety::test;
using surety::Effort;
using surety::Invalid_input;
using surety::make_geometric_mesh;
using surety::Placement;
using surety::Progress;
namespace with = surety::parameters;

constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<Method> methods = {on_surface_fast, on_surface, free_fast, free_standard};

#ifdef CGAL_LINKED_WITH_TBB
using Parallel = CGAL::Parallel_tag;
#else
using Parallel = CGAL::Sequential_tag;
#endif

// ---- tolerances that vary ----

/// A sphere whose tolerance is small on the left.
double tolerance_at(const Point& p) { return p.x() < 0 ? 0.002 : 0.02; }

/// Every sampled point of the input lies within its own tolerance.
template <class Tolerance_of_face>
void expect_within(const Mesh& input, const Mesh& output, const Tolerance_of_face& tolerance_of)
{
  const Closest_triangle closest(output);
  for (const Face f : input.faces()) {
    std::vector<Point> corner;
    for (const Vertex v : input.vertices_around_face(input.halfedge(f)))
      corner.push_back(input.point(v));
    const Point centre = CGAL::centroid(corner[0], corner[1], corner[2]);
    EXPECT_LE(closest.distance(centre), tolerance_of(f, centre));
    for (const Point& p : corner) EXPECT_LE(closest.distance(p), tolerance_of(f, p));
  }
}

TEST(Vertex_tolerance_map, is_kept_everywhere_and_saves_faces_where_it_is_large)
{
  const Mesh input = icosphere(4);
  for (const Method& method : methods) {
    Mesh output = input;
    const auto map = output.add_property_map<Vertex, double>("v:tolerance").first;
    for (const Vertex v : output.vertices()) map[v] = tolerance_at(output.point(v));
    const auto certificate
        = make_geometric_mesh(output, 0.02, parameters_of(method).vertex_tolerance_map(map));
    EXPECT_TRUE(certificate.holds());
    EXPECT_TRUE(check_certificate(input, output, certificate).holds);
    EXPECT_TRUE(surety::certify_distance(input, output, 0.02).holds());
    // Between the two halves the tolerance is linear.
    expect_within(input, output, [](Face, const Point& p) { return p.x() < -0.05 ? 0.002 : 0.02; });

    std::size_t left = 0, right = 0;
    for (const Face f : output.faces()) {
      const Point& p = output.point(output.target(output.halfedge(f)));
      ++(p.x() < 0 ? left : right);
    }
    EXPECT_GT(left, 3 * right) << method.name;
    Mesh fine = input, coarse = input;
    make_geometric_mesh(fine, 0.002, parameters_of(method));
    make_geometric_mesh(coarse, 0.02, parameters_of(method));
    EXPECT_LT(output.number_of_faces(), fine.number_of_faces());
    EXPECT_GT(output.number_of_faces(), coarse.number_of_faces());
  }
}

TEST(Face_tolerance_map, is_kept_all_over_each_face)
{
  const Mesh input = torus(48, 24);
  for (const Method& method : methods) {
    Mesh output = input;
    const auto map = output.add_property_map<Face, double>("f:tolerance").first;
    for (const Face f : output.faces()) map[f] = f % 2 == 0 ? 0.001 : 0.05;
    make_geometric_mesh(output, 1, parameters_of(method).face_tolerance_map(map));
    expect_within(
        input, output, [](Face f, const Point&) { return (f % 2 == 0 ? 0.001 : 0.05) + 1e-12; });
  }
}

TEST(Tolerance_maps, that_allow_more_change_nothing_and_bad_ones_are_refused)
{
  const Mesh input = icosphere(3);
  Mesh plain = input, mapped = input;
  make_geometric_mesh(plain, 0.02);
  const auto map = mapped.add_property_map<Vertex, double>("v:tolerance", 0.5).first;
  make_geometric_mesh(mapped, 0.02, with::vertex_tolerance_map(map));
  EXPECT_EQ(to_soup(plain).points, to_soup(mapped).points);
  EXPECT_EQ(to_soup(plain).triangles, to_soup(mapped).triangles);

  for (const double bad : {0.0, -1.0, std::nan("")}) {
    Mesh mesh = input;
    const auto wrong = mesh.add_property_map<Vertex, double>("v:tolerance", bad).first;
    EXPECT_THROW(make_geometric_mesh(mesh, 0.02, with::vertex_tolerance_map(wrong)), Invalid_input);
    EXPECT_EQ(mesh.number_of_faces(), input.number_of_faces());
  }
  Mesh mesh = input;
  const auto small = mesh.add_property_map<Vertex, double>("v:tolerance", 0.001).first;
  EXPECT_THROW(
      make_geometric_mesh(
          mesh, 0.02,
          with::deviation_bound(surety::Deviation_bound::accumulated).vertex_tolerance_map(small)),
      Invalid_input);
}

// ---- normals ----

TEST(Normal_tolerance, is_proven_by_the_checker)
{
  for (const Mesh& input :
       {jittered(torus(60, 30), 0.004, 3), height_field(24, [](double x, double y) {
          return 0.1 * std::sin(4 * x) * std::cos(3 * y);
        })})
    for (const Method& method : methods) {
      std::size_t last = input.number_of_faces() + 1;
      for (const double angle : {8.0, 20.0, 60.0}) {
        const Simplification s
            = simplified(input, 0.03, parameters_of(method).normal_tolerance(angle));
        expect_sound(s);
        const auto check = check_certificate(s.input, s.output, s.certificate);
        EXPECT_LE(check.largest_normal_deviation, angle) << method.name;
        EXPECT_LE(s.output.number_of_faces(), last * 1.1) << method.name;
        last = s.output.number_of_faces();
      }
    }
}

TEST(Normal_tolerance, that_is_out_of_range_is_refused)
{
  for (const double bad : {0.0, -3.0, 181.0, std::nan("")}) {
    Mesh mesh = icosphere(2);
    EXPECT_THROW(make_geometric_mesh(mesh, 0.1, with::normal_tolerance(bad)), Invalid_input);
  }
}

// ---- ridges ----

Mesh wavy_sheet()
{
  return height_field(
      24, [](double x, double y) { return 0.1 * std::sin(4 * x) * std::cos(3 * y); });
}

TEST(Ridge_tolerance, bounds_curves_by_less_than_the_surface)
{
  const Mesh tube = cylinder(60, 15), sheet = wavy_sheet();
  for (const Mesh& input : {tube, sheet})
    for (const Method& method : methods) {
      std::size_t last = 0;
      for (const double largest : {1.0, 0.01, 0.001}) {
        const Simplification s = simplified(
            input, 0.04, parameters_of(method).feature_angle(40).ridge_tolerance(largest));
        expect_sound(s);
        const auto curves = [](const Mesh& mesh) {
          return CGAL::is_closed(mesh) ? sharp_curves(mesh, 40) : border_curves(mesh);
        };
        const double distance = curve_distance(curves(s.input), curves(s.output));
        const auto check = check_certificate(s.input, s.output, s.certificate);
        EXPECT_LE(check.curve_bound, std::min(0.04, largest)) << method.name;
        EXPECT_LE(distance, check.curve_bound + sampling_error(input)) << method.name;
        // What is measured is about what is proven.
        EXPECT_GE(distance, 0.5 * check.curve_bound) << method.name;
        const std::size_t edges = curves(s.output).size();
        EXPECT_GT(edges, last) << method.name << ' ' << largest;
        last = edges;
      }
    }
}

TEST(Ridge_tolerance, above_that_of_the_surface_changes_nothing)
{
  const auto with_ridges = with::feature_angle(40).placement(Placement::free);
  const Mesh input = cylinder(60, 15);
  EXPECT_TRUE(is_identical(
      simplified(input, 0.03, with_ridges).output,
      simplified(input, 0.03, with_ridges.ridge_tolerance(0.5)).output));
}

TEST(Ridge_tolerance, is_proven_to_be_nothing_where_there_are_no_curves)
{
  const Simplification s = simplified(icosphere(3), 0.03, with::ridge_tolerance(0.001));
  EXPECT_EQ(check_certificate(s.input, s.output, s.certificate).curve_bound, 0);
}

TEST(Ridge_tolerance, that_cannot_be_kept_is_refused)
{
  for (const double bad : {0.0, -3.0, infinity, std::nan("")}) {
    Mesh mesh = icosphere(2);
    EXPECT_THROW(make_geometric_mesh(mesh, 0.1, with::ridge_tolerance(bad)), Invalid_input);
  }
  Mesh mesh = icosphere(2);
  EXPECT_THROW(
      make_geometric_mesh(
          mesh, 0.1,
          with::ridge_tolerance(0.01).deviation_bound(surety::Deviation_bound::accumulated)),
      Invalid_input);
}

// ---- faces that stay ----

TEST(Face_is_constrained_map, keeps_faces_to_the_bit)
{
  const Mesh input = jittered_sphere(4, 5);
  for (const Method& method : methods) {
    Mesh output = input;
    const auto map = output.add_property_map<Face, bool>("f:stays", false).first;
    std::set<std::set<Point>> kept;
    for (const Face f : output.faces()) {
      if (f % 37 != 0) continue;
      map[f] = true;
      std::set<Point> corners;
      for (const Vertex v : output.vertices_around_face(output.halfedge(f)))
        corners.insert(output.point(v));
      kept.insert(corners);
    }
    make_geometric_mesh(output, 0.1, parameters_of(method).face_is_constrained_map(map));
    EXPECT_LT(output.number_of_faces(), input.number_of_faces() * 3 / 4);
    for (const Face f : output.faces()) {
      std::set<Point> corners;
      for (const Vertex v : output.vertices_around_face(output.halfedge(f)))
        corners.insert(output.point(v));
      kept.erase(corners);
    }
    EXPECT_TRUE(kept.empty()) << method.name;
  }
}

// ---- stages ----

TEST(Stages, keep_every_promise)
{
  const Mesh input = jittered(torus(48, 24), 0.002, 1);
  for (const Method& method : methods)
    for (const unsigned stages : {2u, 7u})
      expect_sound(simplified(input, 0.02, parameters_of(method).stages(stages)));
  Mesh mesh = input;
  EXPECT_THROW(make_geometric_mesh(mesh, 0.02, with::stages(0)), Invalid_input);
}

TEST(Target_faces, are_met_at_a_small_bound)
{
  const Mesh input = icosphere(4);
  for (const Method& method : methods) {
    const Simplification s = simplified(input, 1, parameters_of(method).target_faces(200));
    expect_sound(s);
    EXPECT_LE(s.output.number_of_faces(), 200u) << method.name;
    EXPECT_GE(s.output.number_of_faces(), 198u) << method.name;
    // Not much more than the tolerance at which a run without a target comes to that number.
    const Simplification at_bound
        = simplified(input, 0.6 * s.certificate.bound(), parameters_of(method));
    EXPECT_GT(at_bound.output.number_of_faces(), 200u) << method.name;
  }
}

// ---- patches ----

bool are_equal(const Mesh& a, const Mesh& b)
{
  return to_soup(a).points == to_soup(b).points && to_soup(a).triangles == to_soup(b).triangles;
}

class Large : public testing::TestWithParam<Method>
{};

TEST_P(Large, mesh_is_sound_and_the_same_on_many_threads)
{
  for (const Mesh& input : {torus(420, 180), grid(280)}) {
    ASSERT_GT(input.number_of_faces(), 140'000u);
    const double tolerance = 0.002;
    Mesh output = input, parallel = input;
    const auto certificate = make_geometric_mesh(output, tolerance, parameters_of(GetParam()));
    make_geometric_mesh<Parallel>(parallel, tolerance, parameters_of(GetParam()));
    EXPECT_TRUE(are_equal(output, parallel));
    const Simplification s{
        input, output, certificate, promised_vertices(parameters_of(GetParam()))};
    expect_sound_mesh(s);
    expect_no_new_intersections(s);
    expect_proof(s);
    expect_verified_distance(s);
    // No seams: cuts between patches are simplified like the rest.
    if (!is_closed(input)) {
      EXPECT_LE(output.number_of_faces(), 16u);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Geometric_mesh, Large, testing::Values(on_surface_fast, free_fast),
    [](const auto& info) { return info.param.name; });

TEST(Large_mesh, can_be_cancelled_anywhere)
{
  struct Impatient {
    int* calls;
    int patience;
    bool on_progress(const Progress&) { return ++*calls < patience; }
  };
  const Mesh input = torus(420, 180);
  for (const int patience : {1, 12, 40}) {
    int calls = 0;
    Mesh output = input;
    const auto certificate = make_geometric_mesh<Parallel>(
        output, 0.002, with::effort(Effort::fast).visitor(Impatient{&calls, patience}));
    EXPECT_TRUE(certificate.is_cancelled());
    EXPECT_TRUE(check_certificate(input, output, certificate).holds);
    EXPECT_TRUE(is_sound(output));
  }
}

} // namespace
