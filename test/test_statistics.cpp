// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quality and statistics: known triangles, known solids, and independence of scale, position and
// numbering.
#include "invariants.h"
#include "meshes.h"

#include <surety/parameters.h>
#include <surety/statistics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace surety::test;
using surety::mesh_statistics;
using surety::quality;

const double infinity = std::numeric_limits<double>::infinity();

Point at(double x, double y, double z = 0) { return {x, y, z}; }

// ---- quality of a triangle ----

TEST(Quality, is_one_for_the_equilateral_triangle)
{
  EXPECT_NEAR(quality(at(0, 0), at(1, 0), at(0.5, std::sqrt(3.0) / 2)), 1, 1e-15);
  EXPECT_NEAR(quality(Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1)), 1, 1e-15);
}

TEST(Quality, of_the_right_isosceles_triangle)
{
  // Inradius (2 - sqrt 2)/2, longest side sqrt 2.
  const double expected = std::sqrt(3.0) / 6 * std::sqrt(2.0) / (1 - std::sqrt(0.5));
  EXPECT_NEAR(quality(at(0, 0), at(1, 0), at(0, 1)), expected, 1e-14);
  EXPECT_NEAR(expected, 1.3938, 1e-4);
}

TEST(Quality, of_the_triangle_of_sides_3_4_5)
{
  // Inradius 1, longest side 5.
  EXPECT_NEAR(quality(at(0, 0), at(3, 0), at(0, 4)), 5 * std::sqrt(3.0) / 6, 1e-14);
}

TEST(Quality, is_infinite_for_flat_triangles)
{
  EXPECT_EQ(quality(at(0, 0), at(1, 0), at(3, 0)), infinity);
  EXPECT_EQ(quality(at(0, 0), at(0, 0), at(3, 0)), infinity);
  EXPECT_EQ(quality(at(1, 1), at(1, 1), at(1, 1)), infinity);
}

TEST(Quality, of_needles_and_caps_follows_their_aspect)
{
  // Needle: inradius about width/2. Cap over the base 2: inradius about height/2.
  for (const double thin : {1e-3, 1e-6, 1e-9}) {
    const double needle = quality(at(0, 0), at(thin, 0), at(thin / 2, 1));
    EXPECT_NEAR(needle * thin, std::sqrt(3.0) / 3, 2 * thin);
    const double cap = quality(at(-1, 0), at(1, 0), at(0, thin));
    EXPECT_NEAR(cap * thin, 2 * std::sqrt(3.0) / 3, 2 * thin);
  }
}

TEST(Quality, does_not_depend_on_the_order_of_the_corners)
{
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Point p = CGAL::ORIGIN + random.in_cube(), q = CGAL::ORIGIN + random.in_cube(),
                r = CGAL::ORIGIN + random.in_cube();
    const double expected = quality(p, q, r);
    EXPECT_GE(expected, 1);
    EXPECT_NEAR(quality(q, r, p), expected, 1e-12 * expected);
    EXPECT_NEAR(quality(q, p, r), expected, 1e-12 * expected);
  }
}

TEST(Quality, is_the_same_at_every_scale)
{
  const auto scaled_quality
      = [](double s) { return quality(at(0, 0), at(3 * s, s), at(s, 2 * s)); };
  for (const int exponent : {-330, -100, 10, 100, 330}) {
    EXPECT_EQ(scaled_quality(std::ldexp(1.0, exponent)), scaled_quality(1)) << exponent;
  }
}

// ---- statistics of a mesh ----

TEST(Mesh_statistics, of_the_unit_cube)
{
  const auto s = mesh_statistics(cube());
  EXPECT_EQ(s.vertices, 8u);
  EXPECT_EQ(s.edges, 18u);
  EXPECT_EQ(s.faces, 12u);
  EXPECT_EQ(s.components, 1u);
  EXPECT_EQ(s.border_edges, 0u);
  EXPECT_EQ(s.border_loops, 0u);
  EXPECT_EQ(s.self_intersections, 0u);
  EXPECT_EQ(s.euler, 2);
  EXPECT_EQ(s.genus_sum, 0);
  EXPECT_NEAR(s.diagonal, std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(s.area, 6, 1e-14);
  EXPECT_NEAR(s.Q_max, 1.3938, 1e-4);
  EXPECT_NEAR(s.Q_avg, 1.3938, 1e-4);
  EXPECT_EQ(s.Q_le_2, 100);
  EXPECT_NEAR(s.angle_min, 45, 1e-12);
  EXPECT_NEAR(s.angle_max, 90, 1e-12);
}

TEST(Mesh_statistics, count_loops_components_and_handles)
{
  const auto ring = mesh_statistics(annulus(12, 3));
  EXPECT_EQ(ring.border_loops, 2u);
  EXPECT_EQ(ring.border_edges, 24u);
  EXPECT_EQ(ring.genus_sum, 0);
  EXPECT_EQ(mesh_statistics(torus(12, 8)).genus_sum, 1);
  EXPECT_EQ(mesh_statistics(plate_with_holes(2)).genus_sum, 2);

  const Mesh both = joined(
      {torus(12, 8), translated(plate_with_holes(3), Vector(9, 0, 0)),
       translated(annulus(9, 2), Vector(0, 9, 0))});
  const auto s = mesh_statistics(both);
  EXPECT_EQ(s.components, 3u);
  EXPECT_EQ(s.genus_sum, 4);
  EXPECT_EQ(s.border_loops, 2u);
}

TEST(Mesh_statistics, count_intersecting_pairs)
{
  // Two unit squares of two faces that cross in a plus sign.
  const Mesh upright = mapped(grid(1), [](const Point& p) { return at(p.x(), 0.4, p.y() - 0.3); });
  const Mesh crossed = joined({grid(1), upright});
  EXPECT_EQ(mesh_statistics(crossed).self_intersections, number_of_self_intersections(crossed));
  EXPECT_GT(mesh_statistics(crossed).self_intersections, 0u);
  EXPECT_EQ(mesh_statistics(moebius_cut(24, 1)).border_loops, 1u);
}

TEST(Mesh_statistics, share_of_good_faces_is_in_per_cent)
{
  // Equilateral; right-angled with legs 1 and 3, Q = 2.18; right isosceles, Q = 1.39; a cap.
  const Mesh mesh = to_mesh(
      {{at(0, 0), at(1, 0), at(0.5, std::sqrt(3.0) / 2), at(0, -3), at(5, 0), at(6, 0), at(5, 1),
        at(5.5, -0.01)},
       {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}, {5, 4, 7}}});
  const auto s = mesh_statistics(mesh);
  EXPECT_EQ(s.Q_le_2, 50);
  EXPECT_GT(s.Q_max, 10);
  EXPECT_GT(s.angle_max, 170);
}

TEST(Mesh_statistics, of_a_flat_face_are_infinite_not_a_crash)
{
  const Mesh mesh = to_mesh({{at(0, 0), at(1, 0), at(2, 0), at(1, 1)}, {{0, 1, 2}, {0, 2, 3}}});
  const auto s = mesh_statistics(mesh);
  EXPECT_EQ(s.Q_max, infinity);
  EXPECT_EQ(s.angle_min, 0);
  EXPECT_EQ(s.angle_max, 180);
  EXPECT_NEAR(s.area, 1, 1e-15);
}

TEST(Mesh_statistics, read_the_vertex_point_map)
{
  Mesh mesh = cube();
  auto doubled = mesh.add_property_map<Vertex, Point>("v:doubled").first;
  for (const Vertex v : mesh.vertices()) {
    doubled[v] = CGAL::ORIGIN + 2 * (mesh.point(v) - CGAL::ORIGIN);
  }
  const auto np = surety::parameters::feature_angle(40).vertex_point_map(doubled);
  EXPECT_NEAR(mesh_statistics(mesh, np).area, 24, 1e-12);
  EXPECT_NEAR(mesh_statistics(mesh, np).diagonal, 2 * std::sqrt(3.0), 1e-12);
}

TEST(Mesh_statistics, ignore_removed_elements)
{
  Mesh mesh = joined({cube(), translated(cube(), Vector(5, 0, 0))});
  for (Mesh::size_type f = 0; f < 12; ++f) CGAL::Euler::remove_face(mesh.halfedge(Face(f)), mesh);
  ASSERT_TRUE(mesh.has_garbage());
  const auto s = mesh_statistics(mesh);
  EXPECT_EQ(s.vertices, 8u);
  EXPECT_EQ(s.edges, 18u);
  EXPECT_EQ(s.faces, 12u);
  EXPECT_EQ(s.components, 1u);
  EXPECT_NEAR(s.area, 6, 1e-12);
}

TEST(Mesh_statistics, refuse_meshes_without_faces_and_with_polygons)
{
  EXPECT_THROW(mesh_statistics(Mesh()), surety::Invalid_input);
  Mesh quad;
  CGAL::make_quad(at(0, 0), at(1, 0), at(1, 1), at(0, 1), quad);
  EXPECT_THROW(mesh_statistics(quad), surety::Invalid_input);
}

class Random_statistics : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_statistics, do_not_depend_on_scale_position_and_numbering)
{
  const Mesh mesh = random_shape(GetParam());
  const auto s = mesh_statistics(mesh);
  EXPECT_EQ(s.euler, euler_characteristic(mesh));
  EXPECT_EQ(s.border_loops, border_loops(mesh));
  EXPECT_EQ(s.components, number_of_components(mesh));
  EXPECT_GE(s.Q_avg, 1);
  EXPECT_LE(s.Q_avg, s.Q_max);
  EXPECT_LE(s.angle_min, 60);
  EXPECT_GE(s.angle_max, 60);

  const auto large = mesh_statistics(scaled(mesh, 1024));
  EXPECT_EQ(large.Q_max, s.Q_max);
  EXPECT_EQ(large.Q_avg, s.Q_avg);
  EXPECT_EQ(large.angle_min, s.angle_min);
  EXPECT_EQ(large.diagonal, 1024 * s.diagonal);

  const Mesh other = renumbered(translated(mesh, Vector(3, 4, 5)), GetParam());
  const auto moved = mesh_statistics(other);
  EXPECT_EQ(moved.genus_sum, s.genus_sum);
  EXPECT_EQ(moved.faces, s.faces);
  EXPECT_NEAR(moved.Q_avg, s.Q_avg, 1e-6 * s.Q_avg);
  EXPECT_NEAR(moved.area, s.area, 1e-9 * s.area);
}

TEST_P(Random_statistics, angles_of_a_triangle_sum_to_a_straight_angle)
{
  Random random(GetParam());
  for (int i = 0; i < 100; ++i) {
    const double flat = std::pow(10, random.between(-10, 0));
    const auto sides = surety::internal::triangle_sides(
        at(random.unit(), random.unit()), at(random.unit(), random.unit()),
        at(random.unit(), flat * random.unit()));
    const auto angle = surety::internal::angles(sides);
    EXPECT_NEAR(angle[0] + angle[1] + angle[2], 180, 1e-9) << "seed " << GetParam();
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_statistics, testing::Range(0u, 12u));

} // namespace
