// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every defect is found and named with its element and its remedy; sound meshes pass.
#include "invariants.h"
#include "meshes.h"

#include <surety/errors.h>
#include <surety/internal/validation.h>
#include <surety/parameters.h>

#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace {

using namespace surety::test;
using surety::Invalid_input;
using surety::internal::find_defect;
using surety::internal::require_in_range;
using surety::internal::require_positive;
using surety::internal::require_valid_mesh;

const double infinity = std::numeric_limits<double>::infinity();
const double nan_value = std::numeric_limits<double>::quiet_NaN();

Point at(double x, double y, double z = 0) { return {x, y, z}; }

testing::AssertionResult reports(
    const Mesh& mesh, const std::string& problem, const std::string& remedy)
{
  const auto defect = find_defect(mesh);
  if (!defect) return testing::AssertionFailure() << "no defect found";
  if (defect->problem.find(problem) == std::string::npos) {
    return testing::AssertionFailure() << "the problem is: " << defect->problem;
  }
  if (defect->remedy.find(remedy) == std::string::npos) {
    return testing::AssertionFailure() << "the remedy is: " << defect->remedy;
  }
  return testing::AssertionSuccess();
}

TEST(Validation, accepts_sound_meshes_of_every_kind)
{
  for (const Mesh& mesh :
       {cube(), icosphere(2), saddle(5), torus(12, 8), annulus(8, 2), plate_with_holes(2),
        moebius_cut(12, 2), two_sheets(2, 0.1), spheres_at_scales(4), needle_on_sphere(1e-6, 1),
        grid(1), cylinder(5, 1)}) {
    const auto defect = find_defect(mesh);
    EXPECT_FALSE(defect) << defect->problem;
    EXPECT_NO_THROW(require_valid_mesh(mesh, "test", "mesh"));
  }
}

TEST(Validation, accepts_a_single_triangle_and_a_tetrahedron)
{
  EXPECT_FALSE(find_defect(to_mesh({{at(0, 0), at(1, 0), at(0, 1)}, {{0, 1, 2}}})));
  Mesh tetrahedron;
  CGAL::make_tetrahedron(at(0, 0), at(1, 0), at(0, 1), at(0, 0, 1), tetrahedron);
  EXPECT_FALSE(find_defect(tetrahedron));
}

TEST(Validation, refuses_a_mesh_without_faces)
{
  EXPECT_TRUE(reports(Mesh(), "no face", "file"));
  Mesh points;
  points.add_vertex(at(0, 0));
  EXPECT_TRUE(reports(points, "no face", "file"));
}

TEST(Validation, refuses_isolated_vertices)
{
  Mesh mesh = cube();
  mesh.add_vertex(at(3, 3));
  EXPECT_TRUE(reports(mesh, "vertex 8 belongs to no face", "remove_isolated_vertices"));
  CGAL::Polygon_mesh_processing::remove_isolated_vertices(mesh);
  EXPECT_FALSE(find_defect(mesh));
}

TEST(Validation, refuses_polygons)
{
  Mesh mesh = grid(2);
  const auto v = mesh.halfedge(Face(0));
  CGAL::Euler::join_face(mesh.is_border(mesh.opposite(v)) ? mesh.next(v) : v, mesh);
  EXPECT_TRUE(reports(mesh, "is not a triangle", "triangulate_faces"));
  EXPECT_TRUE(reports(mesh, "is not a triangle", "--triangulate"));
  CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
  EXPECT_FALSE(find_defect(mesh));
}

TEST(Validation, refuses_coordinates_that_are_not_finite)
{
  for (const double bad : {infinity, -infinity, nan_value}) {
    for (int axis = 0; axis < 3; ++axis) {
      Mesh mesh = cube(2);
      std::array<double, 3> p = {0.5, 0.5, 0.5};
      p[std::size_t(axis)] = bad;
      mesh.point(Vertex(7)) = Point(p[0], p[1], p[2]);
      EXPECT_TRUE(reports(mesh, "vertex 7 has a coordinate that is not finite", "remove"));
    }
  }
}

TEST(Validation, refuses_extreme_sizes_but_not_large_ones)
{
  EXPECT_TRUE(reports(scaled(cube(), 1e200), "coordinates reach 1e+200", "rescale"));
  EXPECT_TRUE(reports(scaled(cube(), 1e-200), "bounding box measures", "rescale"));
  EXPECT_TRUE(reports(scaled(cube(), 0), "all vertices lie at", "check"));
  EXPECT_FALSE(find_defect(scaled(cube(), 1e90)));
  EXPECT_FALSE(find_defect(scaled(cube(), 1e-90)));
  EXPECT_FALSE(find_defect(translated(cube(), Vector(1e10, 0, 0))));
}

TEST(Validation, refuses_faces_that_are_exactly_flat)
{
  const Mesh flat = to_mesh({{at(0, 0), at(1, 0), at(2, 0), at(1, 1)}, {{0, 1, 2}, {0, 2, 3}}});
  EXPECT_TRUE(reports(flat, "face 0 (vertices 0, 1, 2) is degenerate", "remove_degenerate_faces"));

  Mesh twins = cube();
  twins.point(Vertex(1)) = twins.point(Vertex(0));
  EXPECT_TRUE(reports(twins, "is degenerate", "remove_degenerate_faces"));
  EXPECT_TRUE(reports(twins, "more like it", "remove_degenerate_faces"));
  CGAL::Polygon_mesh_processing::remove_degenerate_faces(twins);
  EXPECT_FALSE(find_defect(twins));
}

TEST(Validation, decides_collinearity_exactly)
{
  // 0.1, 0.2, 0.3 are no multiples of one another as doubles; 1/4, 1/2, 3/4 are.
  const auto triangle = [](double a, double b, double c) {
    return to_mesh({{at(a, 3 * a), at(b, 3 * b), at(c, 3 * c)}, {{0, 1, 2}}});
  };
  EXPECT_TRUE(find_defect(triangle(0.25, 0.5, 0.75)));
  const double up = std::nextafter(2.25, 3);
  EXPECT_FALSE(find_defect(to_mesh({{at(0.25, 0.75), at(0.5, 1.5), at(0.75, up)}, {{0, 1, 2}}})))
      << "one unit in the last place off the line is not degenerate";
  EXPECT_TRUE(find_defect(scaled(triangle(0.25, 0.5, 0.75), 0x1p-200)));
}

TEST(Validation, refuses_a_pillow_of_two_faces)
{
  const Mesh pillow = to_mesh({{at(0, 0), at(1, 0), at(0, 1)}, {{0, 1, 2}, {0, 2, 1}}});
  EXPECT_TRUE(reports(pillow, "face 0 (vertices", "remove_face"));
  EXPECT_TRUE(reports(pillow, "have the same three vertices", "remove_face"));
  EXPECT_TRUE(reports(joined({cube(), pillow}), "face 12 (vertices", "remove_face"));
}

/// Two faces on the same three vertices that share no edge: only low-level calls can make them.
Mesh twin_triangles()
{
  Mesh mesh;
  std::array<Vertex, 3> v
      = {mesh.add_vertex(at(0, 0)), mesh.add_vertex(at(1, 0)), mesh.add_vertex(at(0, 1))};
  for (int k = 0; k < 2; ++k) {
    const Face f = mesh.add_face();
    std::array<Mesh::Halfedge_index, 3> h;
    for (std::size_t i = 0; i < 3; ++i) {
      h[i] = mesh.add_edge();
      mesh.set_target(h[i], v[(i + 1) % 3]);
      mesh.set_target(mesh.opposite(h[i]), v[i]);
      mesh.set_face(h[i], f);
      mesh.set_halfedge(v[(i + 1) % 3], h[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      mesh.set_next(h[i], h[(i + 1) % 3]);
      mesh.set_next(mesh.opposite(h[(i + 1) % 3]), mesh.opposite(h[i]));
    }
    mesh.set_halfedge(f, h[0]);
  }
  return mesh;
}

TEST(Validation, refuses_two_edges_between_the_same_vertices)
{
  EXPECT_TRUE(reports(twin_triangles(), "two edges join vertex 0 and vertex", "split_edge"));
  // A flip whose new edge is there already, across a torus that is three faces thick.
  const Mesh mesh = torus(3, 7);
  std::size_t flips = 0;
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    const Vertex a = mesh.target(mesh.next(h)), b = mesh.target(mesh.next(mesh.opposite(h)));
    if (mesh.halfedge(a, b) == Mesh::null_halfedge()) continue;
    Mesh flipped = mesh;
    CGAL::Euler::flip_edge(h, flipped);
    EXPECT_TRUE(reports(flipped, "two edges join vertex", "split_edge"));
    ++flips;
  }
  EXPECT_GT(flips, 0u);
}

Mesh octahedron()
{
  return to_mesh(
      {{at(1, 0), at(-1, 0), at(0, 1), at(0, -1), at(0, 0, 1), at(0, 0, -1)},
       {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}});
}

TEST(Validation, refuses_vertices_where_sheets_only_touch)
{
  // Two octahedra that share a vertex: two turns of faces round it.
  Mesh bowtie = joined({octahedron(), translated(octahedron(), Vector(2, 0, 0))});
  const Vertex left(0), right(7); // both at (1, 0, 0)
  ASSERT_EQ(bowtie.point(left), bowtie.point(right));
  for (const auto h : CGAL::halfedges_around_target(right, bowtie)) bowtie.set_target(h, left);
  bowtie.remove_vertex(right);
  EXPECT_TRUE(reports(bowtie, "vertex 0 is not manifold", "duplicate_non_manifold_vertices"));
  CGAL::Polygon_mesh_processing::duplicate_non_manifold_vertices(bowtie);
  EXPECT_FALSE(find_defect(bowtie));

  // Two triangles that share a vertex: one turn round it, but two borders in it.
  Mesh pinched
      = to_mesh({{at(0, 0), at(1, 0), at(0, 1), at(-1, 0), at(0, -1)}, {{0, 1, 2}, {0, 3, 4}}});
  EXPECT_TRUE(reports(pinched, "vertex 0 is not manifold", "duplicate_non_manifold_vertices"));
  CGAL::Polygon_mesh_processing::duplicate_non_manifold_vertices(pinched);
  EXPECT_FALSE(find_defect(pinched));
}

TEST(Validation, refuses_broken_connectivity_without_running_for_ever)
{
  Mesh mesh = icosphere(1);
  const auto h = mesh.halfedge(Face(3));
  mesh.set_face(h, Face(4));
  EXPECT_TRUE(find_defect(mesh));
  Mesh looped = icosphere(1);
  const auto k = looped.halfedge(Face(3));
  looped.set_next(looped.opposite(k), looped.next(looped.next(k)));
  EXPECT_TRUE(find_defect(looped));
}

TEST(Validation, counts_elements_as_iteration_does)
{
  Mesh mesh = joined({grid(1), cube()});
  for (Mesh::size_type f = 0; f < 2; ++f) CGAL::Euler::remove_face(mesh.halfedge(Face(f)), mesh);
  ASSERT_TRUE(mesh.has_garbage());
  EXPECT_FALSE(find_defect(mesh)) << "removed elements are no defect";
  mesh.point(Vertex(4 + 6)) = at(nan_value, 0);
  EXPECT_TRUE(reports(mesh, "vertex 6 has a coordinate", "remove"));
}

TEST(Validation, tells_function_argument_element_and_remedy)
{
  Mesh mesh = cube();
  mesh.add_vertex(at(3, 3));
  try {
    require_valid_mesh(mesh, "certify_distance", "reference");
    FAIL() << "accepted";
  } catch (const Invalid_input& error) {
    EXPECT_EQ(error.function(), "certify_distance");
    EXPECT_EQ(error.argument(), "reference");
    EXPECT_EQ(error.problem(), "vertex 8 belongs to no face");
    EXPECT_EQ(
        error.what(),
        error.function() + ": " + error.argument() + ": " + error.problem() + "; "
            + error.remedy());
  }
}

TEST(Validation, reads_the_vertex_point_map)
{
  Mesh mesh = cube();
  auto points = mesh.add_property_map<Vertex, Point>("v:other", at(nan_value, 0)).first;
  EXPECT_FALSE(find_defect(mesh));
  EXPECT_TRUE(find_defect(mesh, surety::parameters::feature_angle(1).vertex_point_map(points)));
}

TEST(Validation, is_exact_with_an_inexact_kernel_too)
{
  using Inexact = CGAL::Simple_cartesian<double>;
  CGAL::Surface_mesh<Inexact::Point_3> mesh;
  const double up = std::nextafter(2.25, 3);
  mesh.add_face(
      mesh.add_vertex({0.25, 0.75, 0}), mesh.add_vertex({0.5, 1.5, 0}),
      mesh.add_vertex({0.75, up, 0}));
  EXPECT_FALSE(find_defect(mesh));
}

class Random_validation : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_validation, accepts_random_shapes_in_any_numbering)
{
  const Mesh mesh = random_shape(GetParam());
  const auto defect = find_defect(mesh);
  EXPECT_FALSE(defect) << "seed " << GetParam() << ": " << defect->problem;
  EXPECT_FALSE(find_defect(renumbered(scaled(mesh, 0x1p-60), GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_validation, testing::Range(0u, 20u));

// ---- numbers ----

TEST(Require_positive, accepts_finite_positive_numbers_only)
{
  EXPECT_NO_THROW(require_positive(1e-300, "f", "x"));
  EXPECT_NO_THROW(require_positive(std::numeric_limits<double>::denorm_min(), "f", "x"));
  for (const double bad : {0.0, -0.0, -1.0, infinity, -infinity, nan_value}) {
    EXPECT_THROW(require_positive(bad, "f", "x"), Invalid_input) << bad;
  }
}

TEST(Require_in_range, includes_both_ends_and_refuses_nan)
{
  EXPECT_NO_THROW(require_in_range(1, 1, 2, "f", "x"));
  EXPECT_NO_THROW(require_in_range(2, 1, 2, "f", "x"));
  EXPECT_NO_THROW(require_in_range(infinity, 1, infinity, "f", "x"));
  for (const double bad : {0.999, 2.001, infinity, nan_value}) {
    EXPECT_THROW(require_in_range(bad, 1, 2, "f", "x"), Invalid_input) << bad;
  }
  try {
    require_in_range(180.25, 0, 180, "find_features", "feature_angle");
  } catch (const Invalid_input& error) {
    EXPECT_STREQ(
        error.what(), "find_features: feature_angle: 180.25 is not in the range from 0 to 180");
  }
}

TEST(Invalid_input, without_a_remedy_ends_with_the_problem)
{
  EXPECT_STREQ(Invalid_input("f", "x", "is bad").what(), "f: x: is bad");
  EXPECT_STREQ(Invalid_input("f", "x", "is bad", "mend it").what(), "f: x: is bad; mend it");
  EXPECT_EQ(Invalid_input("f", "x", "is bad", "mend it").remedy(), "mend it");
}

} // namespace
