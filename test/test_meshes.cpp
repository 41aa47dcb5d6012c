// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tools of the tests are tested too: every generated shape is sound and has the topology that
// its name promises, modifiers keep the surface, and sampled distances are right where they are
// known.
#include "invariants.h"
#include "meshes.h"
#include "sampled_distance.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using namespace surety::test;

struct Shape {
  std::string name;
  Mesh mesh;
  std::vector<std::pair<long, std::size_t>> type; ///< Euler characteristic, border loops
};

std::vector<Shape> shapes()
{
  return {
      {"grid", grid(5), {{1, 1}}},
      {"saddle", saddle(8), {{1, 1}}},
      {"annulus", annulus(12, 3), {{0, 2}}},
      {"moebius_cut", moebius_cut(24, 3), {{1, 1}}},
      {"icosphere", icosphere(2), {{2, 0}}},
      {"jittered_sphere", jittered_sphere(3, 1), {{2, 0}}},
      {"ellipsoid", ellipsoid(2, 3, 2, 1), {{2, 0}}},
      {"torus", torus(20, 10), {{0, 0}}},
      {"cube", cube(), {{2, 0}}},
      {"cube4", cube(4), {{2, 0}}},
      {"subdivided_cube", subdivided(cube(), 2), {{2, 0}}},
      {"split_cube", split_at_random(cube(), 200, 3), {{2, 0}}},
      {"split_grid", split_at_random(grid(3), 200, 3), {{1, 1}}},
      {"double_torus", plate_with_holes(2), {{-2, 0}}},
      {"cylinder", cylinder(30, 4), {{2, 0}}},
      {"needle_on_plate", needle_on_plate(1e-3, 0.5), {{1, 1}}},
      {"needle_on_sphere", needle_on_sphere(1e-3, 0.5), {{2, 0}}},
      {"fin", fin(1e-3, 0.5), {{1, 1}}},
      {"two_sheets", two_sheets(4, 1e-3), {{1, 1}, {1, 1}}},
      {"two_spheres", two_spheres(2, 1e-3), {{2, 0}, {2, 0}}},
      {"spheres_at_scales", spheres_at_scales(3), {{2, 0}, {2, 0}, {2, 0}}},
  };
}

TEST(Meshes, are_sound_and_have_the_topology_of_their_name)
{
  for (const Shape& shape : shapes()) {
    EXPECT_TRUE(is_sound(shape.mesh)) << shape.name;
    EXPECT_EQ(topological_type(shape.mesh).components, shape.type) << shape.name;
    EXPECT_EQ(number_of_components(shape.mesh), shape.type.size()) << shape.name;
  }
}

TEST(Meshes, do_not_intersect_themselves)
{
  for (const Shape& shape : shapes()) {
    if (shape.name == "spheres_at_scales" || shape.name == "moebius_cut") continue;
    EXPECT_EQ(number_of_self_intersections(shape.mesh), 0u) << shape.name;
  }
}

TEST(Meshes, closed_ones_face_outwards)
{
  for (const Mesh& mesh :
       {icosphere(1), torus(20, 10), cube(2), cylinder(12, 2), plate_with_holes(1),
        needle_on_sphere(0.01, 1)}) {
    double volume = 0;
    for (const auto& t : to_soup(mesh).triangles) {
      const auto p
          = [&](int i) { return mesh.point(Vertex(Mesh::size_type(t[i]))) - CGAL::ORIGIN; };
      volume += CGAL::cross_product(p(0), p(1)) * p(2) / 6;
    }
    EXPECT_GT(volume, 0);
  }
}

TEST(Meshes, moebius_strip_is_no_orientable_surface)
{
  EXPECT_THROW(to_mesh(moebius(24, 3)), std::logic_error);
}

TEST(Meshes, modifiers_keep_the_surface)
{
  const Mesh mesh = torus(14, 9);
  EXPECT_LT(sampled_distance(mesh, subdivided(mesh)), 1e-12);
  EXPECT_LT(sampled_distance(mesh, renumbered(mesh, 4)), 1e-12);
  EXPECT_LT(sampled_distance(cube(), split_at_random(cube(), 100, 1)), 1e-12);
  EXPECT_TRUE(have_same_topology(mesh, reversed(mesh)));
}

TEST(Meshes, rotations_keep_lengths_and_differ_by_seed)
{
  const Mesh mesh = cube(2), a = rotated(mesh, 1), b = rotated(mesh, 2);
  for (const auto e : mesh.edges()) {
    const auto length = [&](const Mesh& m) {
      return CGAL::squared_distance(m.point(m.vertex(e, 0)), m.point(m.vertex(e, 1)));
    };
    EXPECT_NEAR(length(mesh), length(a), 1e-12);
  }
  EXPECT_GT(sampled_distance(a, b), 0.1);
}

TEST(Sampled_distance, is_exact_for_parallel_squares_and_nested_cubes)
{
  EXPECT_NEAR(sampled_distance(grid(4), translated(grid(3), Vector(0, 0, 0.25))), 0.25, 1e-12);
  const Mesh inner = translated(cube(), Vector(-0.5, -0.5, -0.5));
  EXPECT_NEAR(sampled_distance_to(inner, scaled(inner, 3)), 1, 1e-12);
  EXPECT_NEAR(sampled_distance_to(scaled(inner, 3), inner), std::sqrt(3.0), 1e-12);
}

TEST(Sampled_distance, sees_a_needle_in_one_direction_only)
{
  const Mesh plate = grid(9), needle = needle_on_plate(1e-3, 0.5);
  EXPECT_LT(sampled_distance_to(plate, needle), 1e-3);
  EXPECT_NEAR(sampled_distance_to(needle, plate), 0.5, 1e-12);
}

TEST(Sampled_distance, agrees_with_the_smallest_distance_over_all_triangles)
{
  Random random(7);
  const Mesh mesh = random_shape(7);
  const Closest_triangle closest(mesh);
  for (int i = 0; i < 50; ++i) {
    const Point p = CGAL::ORIGIN + 2 * random.in_cube();
    double least = std::numeric_limits<double>::infinity();
    for (const Face f : mesh.faces()) {
      const auto h = mesh.halfedge(f);
      const Kernel::Triangle_3 t(
          mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
          mesh.point(mesh.target(mesh.next(h))));
      least = (std::min)(least, std::sqrt(CGAL::squared_distance(p, t)));
    }
    EXPECT_NEAR(closest.distance(p), least, 1e-9);
  }
}

class Random_shapes : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_shapes, are_sound)
{
  EXPECT_TRUE(is_sound(random_shape(GetParam()))) << "seed " << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_shapes, testing::Range(0u, 30u));

} // namespace
