// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parameters of make_geometric_mesh: each changes the result in the direction that its
// documentation says; what is constrained stays; and whatever is refused leaves the mesh untouched.
#include <surety/geometric_mesh.h>

#include "simplification.h"

#include <surety/statistics.h>

#include <CGAL/Simple_cartesian.h>

#include <functional>
#include <stdexcept>

namespace {

using namespace surety::test;
using surety::Deviation_bound;
using surety::Effort;
using surety::Invalid_input;
using surety::make_geometric_mesh;
using surety::Placement;
using surety::Progress;
using surety::Verdict;
namespace with = surety::parameters;
namespace with_cgal = CGAL::parameters;
using Edge = Mesh::Edge_index;

constexpr double infinity = std::numeric_limits<double>::infinity();

double Q_max(const Mesh& mesh) { return surety::mesh_statistics(mesh).Q_max; }

std::size_t refused(const Simplification& s, Verdict verdict)
{
  return s.certificate.operations().refused[static_cast<std::size_t>(verdict)];
}

Mesh wavy_sheet(std::size_t n, std::uint64_t seed = 1)
{
  return jittered(
      height_field(n, [](double x, double y) { return 0.1 * std::sin(4 * x) * std::cos(3 * y); }),
      0.2 / double(n), seed);
}

// ---- shape ----

TEST(Shape_floor, bounds_the_quality_of_new_faces)
{
  for (const Mesh& input : {wavy_sheet(30), jittered(torus(60, 16), 0.01, 1)}) {
    std::vector<std::size_t> faces;
    for (const double floor : {100.0, 4.0, 2.0, 1.2}) {
      const Simplification s = simplified(input, 0.02, with::shape_floor(floor));
      EXPECT_LE(Q_max(s.output), std::max(floor, Q_max(input)) * (1 + 1e-9)) << floor;
      const Simplification moved
          = simplified(input, 0.02, with::shape_floor(floor).placement(Placement::free));
      EXPECT_LE(Q_max(moved.output), std::max(floor, Q_max(input)) * (1 + 1e-9)) << floor;
      faces.push_back(s.output.number_of_faces());
      EXPECT_TRUE(floor > 10 || refused(s, Verdict::shape) > 0);
      expect_sound(s);
    }
    // A stricter limit leaves more faces.
    EXPECT_GT(double(faces[2]), 1.1 * double(faces[0]));
    EXPECT_GT(double(faces[3]), 1.1 * double(faces[2]));
  }
}

TEST(Shape_floor, infinity_turns_the_control_off)
{
  const Simplification s
      = simplified(wavy_sheet(30), 0.1, with::shape_floor(infinity).roughness_angle(180));
  EXPECT_EQ(refused(s, Verdict::shape), 0u);
  expect_sound(s);
}

TEST(Shape_ratio, one_never_makes_the_worst_face_worse)
{
  const Mesh input = wavy_sheet(30);
  const Simplification strict = simplified(input, 0.02, with::shape_floor(1));
  EXPECT_LE(Q_max(strict.output), Q_max(input) * (1 + 1e-9));
  const Simplification loose = simplified(input, 0.02, with::shape_floor(1).shape_ratio(1.5));
  EXPECT_LT(loose.output.number_of_faces(), strict.output.number_of_faces());
  EXPECT_GT(Q_max(loose.output), Q_max(strict.output));
  expect_sound(loose);
}

// ---- roughness ----

/// The largest angle between a face of the output and the normal of the input at one of its
/// corners, all of which are vertices of the input, in degrees.
double largest_turn(const Simplification& s)
{
  std::map<Point, Vector> normal;
  for (const auto& t : to_soup(s.input).triangles) {
    std::array<Point, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = s.input.point(Vertex(Mesh::size_type(t[i])));
    Vector n = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
    n = n / std::sqrt(n.squared_length());
    for (int i = 0; i < 3; ++i) {
      const Vector a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
      const double angle = std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
      normal.try_emplace(p[i], 0, 0, 0).first->second += angle * n;
    }
  }
  double largest = 0;
  for (const auto& t : to_soup(s.output).triangles) {
    std::array<Point, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = s.output.point(Vertex(Mesh::size_type(t[i])));
    const Vector n = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
    for (const Point& q : p) {
      const Vector c = CGAL::cross_product(n, normal.at(q));
      largest = std::max(
          largest, std::atan2(std::sqrt(c.squared_length()), n * normal.at(q)) * 180 / pi);
    }
  }
  return largest;
}

TEST(Roughness_angle, bounds_the_turn_of_faces_against_the_input)
{
  for (const Mesh& input : {icosphere(4), torus(60, 30)}) {
    std::size_t previous = 0;
    for (const double angle : {90.0, 45.0, 25.0, 15.0}) {
      const Simplification s
          = simplified(input, 0.2, with::roughness_angle(angle).effort(Effort::fast));
      EXPECT_LE(largest_turn(s), angle * (1 + 1e-5)) << angle;
      EXPECT_GE(s.output.number_of_faces(), previous) << angle;
      previous = s.output.number_of_faces();
      expect_sound(s);
    }
    EXPECT_GT(previous, 2 * simplified(input, 0.2).output.number_of_faces());
  }
}

TEST(Roughness_angle, bounds_the_turn_where_vertices_have_moved)
{
  // The normals of a sphere are its radii, up to the angle that one of its edges is seen under: a
  // vertex that has moved takes the normal of a vertex nearby.
  const Mesh input = icosphere(4);
  const double edge
      = std::sqrt(CGAL::squared_distance(
            input.point(input.vertex(Edge(0), 0)), input.point(input.vertex(Edge(0), 1))))
      * 180 / pi;
  for (const Method& method : {on_surface, free_fast, free_standard}) {
    for (const double angle : {45.0, 25.0, 15.0}) {
      const Simplification s = simplified(input, 0.2, parameters_of(method).roughness_angle(angle));
      double largest = 0;
      for (const auto& t : to_soup(s.output).triangles) {
        std::array<Point, 3> p;
        for (int i = 0; i < 3; ++i) p[i] = s.output.point(Vertex(Mesh::size_type(t[i])));
        const Vector n = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
        for (const Point& q : p) {
          const Vector radius = q - CGAL::ORIGIN, c = CGAL::cross_product(n, radius);
          largest
              = std::max(largest, std::atan2(std::sqrt(c.squared_length()), n * radius) * 180 / pi);
        }
      }
      EXPECT_LE(largest, angle + 1.5 * edge) << method.name;
      EXPECT_GT(s.certificate.operations().collapses, 0u);
    }
  }
}

TEST(Roughness_angle, of_180_turns_the_control_off)
{
  const Mesh input = jittered(torus(40, 20), 0.03, 1);
  const Simplification s = simplified(input, 0.2, with::roughness_angle(180));
  EXPECT_EQ(refused(s, Verdict::roughness), 0u);
  EXPECT_LT(s.output.number_of_faces(), simplified(input, 0.2).output.number_of_faces());
  expect_sound(s);
}

// ---- self-intersections ----

TEST(Allow_self_intersections, false_by_default_keeps_sheets_apart)
{
  const Mesh bent = mapped(two_sheets(16, 1e-3), [](const Point& p) {
    return Point(p.x(), p.y(), p.z() + 0.2 * std::sin(5 * p.x()) * std::cos(4 * p.y()));
  });
  std::size_t intersections = 0;
  for (const Mesh& input :
       {bent, two_spheres(3, 0.003), jittered(two_spheres(3, 0.01), 0.002, 1)}) {
    const Simplification apart = simplified(input, 0.05);
    EXPECT_EQ(number_of_self_intersections(apart.output), 0u);
    EXPECT_GT(refused(apart, Verdict::self_intersection), 0u);

    const auto np = with::allow_self_intersections(true);
    const Simplification free = simplified(input, 0.05, np);
    intersections += number_of_self_intersections(free.output);
    EXPECT_EQ(refused(free, Verdict::self_intersection), 0u);
    expect_proof(free);

    const auto by_cgal_name = CGAL::parameters::allow_self_intersections(true);
    EXPECT_TRUE(is_identical(simplified(input, 0.05, by_cgal_name).output, free.output));
  }
  EXPECT_GT(intersections, 0u);
}

TEST(Allow_self_intersections, false_by_default_holds_for_flips_too)
{
  // Rough sheets that nearly touch, where nothing but flips is allowed.
  const auto all_vertices = CGAL::Static_boolean_property_map<Vertex, true>();
  for (unsigned seed = 0; seed < 4; ++seed) {
    for (const Mesh& shape : {two_spheres(3, 0.05), two_sheets(12, 0.05)}) {
      const Mesh input = flipped_at_random(jittered(shape, 0.015, seed), 6000, seed);
      const Simplification s = simplified(
          input, 0.1,
          with::roughness_angle(180)
              .shape_floor(infinity)
              .flip_rounds(20)
              .vertex_is_constrained_map(all_vertices));
      expect_no_new_intersections(s);
      EXPECT_GT(s.certificate.operations().flips, 1000u);
      EXPECT_GT(refused(s, Verdict::self_intersection), 100u);
      expect_proof(s);
    }
  }
}

TEST(Allow_self_intersections, leaves_what_intersects_already_in_peace)
{
  // Two spheres that cross, and a sphere of which one vertex is pushed through the other side.
  const Mesh crossing = joined({icosphere(3), translated(icosphere(3), Vector(1, 0, 0))});
  Mesh pierced = icosphere(3);
  pierced.point(Vertex(0)) = CGAL::ORIGIN - 1.5 * (pierced.point(Vertex(0)) - CGAL::ORIGIN);
  for (const Mesh& input : {crossing, pierced}) {
    ASSERT_GT(number_of_self_intersections(input), 0u);
    const Simplification s = simplified(input, 0.02);
    expect_sound(s);
    EXPECT_LT(s.output.number_of_faces(), input.number_of_faces());
  }
}

// ---- flips ----

TEST(Flip_rounds, none_means_no_flip_and_more_leave_fewer_faces)
{
  const Mesh input = jittered(torus(60, 30), 0.003, 1);
  const Simplification none = simplified(input, 0.02, with::flip_rounds(0).effort(Effort::fast));
  const Simplification one = simplified(input, 0.02, with::flip_rounds(1).effort(Effort::fast));
  const Simplification many = simplified(input, 0.02, with::flip_rounds(20).effort(Effort::fast));
  EXPECT_EQ(none.certificate.operations().flips, 0u);
  EXPECT_GT(one.certificate.operations().flips, 0u);
  EXPECT_GT(many.certificate.operations().flips, one.certificate.operations().flips);
  EXPECT_LT(one.output.number_of_faces(), none.output.number_of_faces());
  EXPECT_LE(many.output.number_of_faces(), one.output.number_of_faces());
  for (const Simplification* s : {&none, &one, &many}) expect_sound(*s);
}

TEST(Operations, account_for_every_vertex_that_is_gone)
{
  for (const Mesh& input : {wavy_sheet(20), icosphere(3), annulus(30, 4)}) {
    for (const Method& method :
         {on_surface_fast, on_surface, free_fast, free_standard, accumulated}) {
      const Simplification s = simplified(input, 0.02, parameters_of(method));
      EXPECT_EQ(
          s.certificate.operations().collapses,
          s.input.number_of_vertices() - s.output.number_of_vertices())
          << method.name;
      EXPECT_GT(refused(s, Verdict::deviation), 0u) << method.name;
    }
  }
}

TEST(Operations, relocate_where_the_effort_asks_for_it)
{
  for (const Mesh& input : {wavy_sheet(20), icosphere(3)}) {
    const auto relocations = [&](const Method& method) {
      return simplified(input, 0.02, parameters_of(method)).certificate.operations().relocations;
    };
    for (const Method& method : {on_surface_fast, free_fast, accumulated})
      EXPECT_EQ(relocations(method), 0u) << method.name;
    for (const Method& method : {on_surface, free_standard})
      EXPECT_GT(relocations(method), 0u) << method.name;
  }
}

// ---- placement and effort ----

/// The largest distance of a vertex of the output to the input.
double largest_distance_of_vertices(const Simplification& s)
{
  const Closest_triangle input(s.input);
  double largest = 0;
  for (const Vertex v : s.output.vertices())
    largest = std::max(largest, input.distance(s.output.point(v)));
  return largest;
}

TEST(Placement_parameter, on_surface_by_default_and_free_leaves_fewer_faces)
{
  for (const Mesh& input : {wavy_sheet(24), icosphere(3), torus(40, 20)}) {
    const double tolerance = 0.01;
    for (const Effort effort : {Effort::fast, Effort::standard}) {
      const Simplification on
          = simplified(input, tolerance, with::placement(Placement::on_surface).effort(effort));
      EXPECT_TRUE(
          is_identical(on.output, simplified(input, tolerance, with::effort(effort)).output));
      EXPECT_LE(largest_distance_of_vertices(on), 1e-14 * diagonal(input));
      const Simplification free
          = simplified(input, tolerance, with::placement(Placement::free).effort(effort));
      EXPECT_LT(free.output.number_of_faces(), on.output.number_of_faces());
      EXPECT_GT(largest_distance_of_vertices(free), 0.1 * tolerance);
      EXPECT_LE(largest_distance_of_vertices(free), tolerance * (1 + 1e-12));
      expect_sound(free);
    }
  }
}

TEST(Effort_parameter, more_of_it_leaves_fewer_faces)
{
  for (const Mesh& input : {wavy_sheet(14), jittered_sphere(3, 1)}) {
    for (const Placement placement : {Placement::on_surface, Placement::free}) {
      const auto np = with::placement(placement);
      const Simplification fast = simplified(input, 0.01, np.effort(Effort::fast)),
                           standard = simplified(input, 0.01, np.effort(Effort::standard)),
                           best = simplified(input, 0.01, np.effort(Effort::best));
      EXPECT_LT(standard.output.number_of_faces(), fast.output.number_of_faces());
      EXPECT_LE(best.output.number_of_faces(), standard.output.number_of_faces());
      EXPECT_TRUE(is_identical(standard.output, simplified(input, 0.01, np).output));
      for (const Simplification* s : {&fast, &standard, &best}) expect_sound(*s);
    }
  }
}

TEST(Effort_parameter, makes_no_difference_to_the_accumulated_bound)
{
  const auto np = with::deviation_bound(Deviation_bound::accumulated);
  const Mesh input = wavy_sheet(20);
  EXPECT_TRUE(is_identical(
      simplified(input, 0.02, np.effort(Effort::fast)).output,
      simplified(input, 0.02, np.effort(Effort::standard)).output));
}

TEST(Target_faces, is_where_it_stops)
{
  for (const Method& method : {on_surface_fast, on_surface, free_standard}) {
    SCOPED_TRACE(method.name);
    const auto np = parameters_of(method);
    for (const Mesh& input : {jittered_sphere(3, 1), wavy_sheet(12)}) {
      const double tolerance = 0.02;
      const std::size_t faces = input.number_of_faces(),
                        fewest = simplified(input, tolerance, np).output.number_of_faces();
      double previous = 0;
      for (const std::size_t target : {faces / 2, fewest + (faces - fewest) / 5}) {
        const Simplification s = simplified(input, tolerance, np.target_faces(target));
        EXPECT_LE(s.output.number_of_faces(), target);
        // A collapse takes two faces, at a border one.
        EXPECT_GE(s.output.number_of_faces() + 1, target);
        EXPECT_FALSE(s.certificate.is_cancelled());
        // No more of the tolerance is spent than the number asks for.
        EXPECT_GT(s.certificate.bound(), previous);
        EXPECT_LT(s.certificate.bound(), 0.9 * tolerance);
        previous = s.certificate.bound();
        expect_sound(s, 1);
      }
    }
  }
}

TEST(Target_faces, that_cannot_be_reached_gives_way_to_the_tolerance)
{
  for (const Method& method : {on_surface, free_standard}) {
    const Mesh input = wavy_sheet(12);
    const auto np = parameters_of(method);
    const double fewest = double(simplified(input, 0.02, np).output.number_of_faces());
    const Simplification s = simplified(input, 0.02, np.target_faces(1));
    EXPECT_NEAR(double(s.output.number_of_faces()), fewest, 0.15 * fewest + 4) << method.name;
    EXPECT_GT(s.certificate.bound(), 0.9 * 0.02) << method.name;
    expect_sound(s, 1);
  }
}

TEST(Target_faces, is_kept_by_the_accumulated_bound_too)
{
  // It adds up while the tolerance grows, and so may come to its end before.
  const Mesh input = wavy_sheet(16);
  for (const std::size_t target : {400u, 200u}) {
    const Simplification s
        = simplified(input, 0.02, parameters_of(accumulated).target_faces(target));
    EXPECT_GE(s.output.number_of_faces() + 1, target);
    EXPECT_LT(s.output.number_of_faces(), input.number_of_faces());
    expect_sound(s, 1);
  }
}

TEST(Target_faces, of_more_than_there_are_leaves_the_count)
{
  const Mesh input = wavy_sheet(10);
  for (const Method& method : {on_surface_fast, on_surface, free_standard, accumulated}) {
    const Simplification s
        = simplified(input, 0.01, parameters_of(method).target_faces(input.number_of_faces()));
    EXPECT_EQ(s.output.number_of_faces(), input.number_of_faces()) << method.name;
    EXPECT_EQ(s.certificate.operations().collapses, 0u) << method.name;
    expect_sound(s);
  }
}

// ---- single precision ----

/// The nearest single-precision number. It goes through memory, because g++ 12 takes the way to
/// `float` and back for the identity where it vectorises.
double to_single(double x)
{
  volatile float single = static_cast<float>(x);
  return single;
}

Point to_single(const Point& p) { return {to_single(p.x()), to_single(p.y()), to_single(p.z())}; }

Mesh rounded_to_floats(const Mesh& mesh)
{
  return mapped(mesh, [](const Point& p) { return to_single(p); });
}

bool has_float_coordinates(const Mesh& mesh)
{
  return std::all_of(mesh.vertices_begin(), mesh.vertices_end(), [&](Vertex v) {
    return to_single(mesh.point(v)) == mesh.point(v);
  });
}

TEST(Single_precision, is_that_of_every_vertex)
{
  for (const Mesh& shape :
       {wavy_sheet(14), translated(icosphere(3), Vector(300, 0, 0)), scaled(torus(20, 10), 1e-6),
        scaled(wavy_sheet(10), 0x1p100)}) {
    const Mesh input = rounded_to_floats(shape);
    const double tolerance = 0.005 * diagonal(input);
    for (const Method& method :
         {on_surface_fast, on_surface, free_fast, free_standard, accumulated}) {
      SCOPED_TRACE(method.name);
      const auto np = parameters_of(method);
      const Simplification s = simplified(input, tolerance, np.single_precision(true));
      EXPECT_TRUE(has_float_coordinates(s.output));
      expect_sound(s);
      expect_verified_distance(s);
      const bool moves = method.bound == Deviation_bound::direct
          && (method.placement == Placement::free || method.effort != Effort::fast);
      EXPECT_EQ(has_float_coordinates(simplified(input, tolerance, np).output), !moves);
      // On the surface means as near to it as a float can be.
      const double limit
          = method.placement == Placement::free ? tolerance : 0x1p-23 * largest_coordinate(input);
      EXPECT_LE(largest_distance_of_vertices(s), limit * (1 + 1e-12));
    }
  }
}

TEST(Single_precision, concerns_vertices_that_move_only)
{
  const Mesh input = wavy_sheet(20);
  const Simplification s = simplified(input, 0.02, with::single_precision(true));
  std::set<Point> points;
  for (const Vertex v : input.vertices()) points.insert(input.point(v));
  std::size_t moved = 0;
  for (const Vertex v : s.output.vertices()) {
    const Point& p = s.output.point(v);
    if (points.count(p) == 1) continue;
    ++moved;
    EXPECT_EQ(p, to_single(p));
  }
  EXPECT_GT(moved, 10u);
  expect_sound(s);
}

TEST(Single_precision, finer_than_the_tolerance_is_no_obstacle)
{
  // Neighbouring floats are 2^-7 apart here, and the tolerance is less: what cannot move stays.
  const Mesh input = rounded_to_floats(translated(icosphere(3), Vector(0x1p16, 0x1p16, 0)));
  if (!is_sound(input)) GTEST_SKIP() << "rounding has made faces without area";
  for (const Method& method : {on_surface, free_standard}) {
    const Simplification s = simplified(input, 0.004, parameters_of(method).single_precision(true));
    EXPECT_TRUE(has_float_coordinates(s.output));
    expect_sound(s);
  }
}

// ---- the bounds ----

TEST(Deviation_bound_parameter, accumulated_has_no_record_and_keeps_more_faces)
{
  for (const Mesh& input : {icosphere(4), torus(60, 30), wavy_sheet(30)}) {
    const Simplification direct
        = simplified(input, 0.01, with::deviation_bound(Deviation_bound::direct));
    const Simplification fast = simplified(input, 0.01, with::effort(Effort::fast));
    const Simplification accumulated
        = simplified(input, 0.01, with::deviation_bound(Deviation_bound::accumulated));
    EXPECT_TRUE(is_identical(direct.output, simplified(input, 0.01).output));
    EXPECT_TRUE(direct.certificate.correspondence());
    EXPECT_FALSE(accumulated.certificate.correspondence());
    EXPECT_GT(accumulated.output.number_of_faces(), fast.output.number_of_faces());
    EXPECT_LT(accumulated.output.number_of_faces(), input.number_of_faces());
    EXPECT_TRUE(accumulated.certificate.holds());
  }
}

TEST(Deviation_map, of_the_user_receives_the_bounds)
{
  const Simplification s = simplified(wavy_sheet(20), 0.02);
  Mesh mesh = s.input;
  const auto map = mesh.add_property_map<Face, double>("f:mine", -1).first;
  make_geometric_mesh(mesh, 0.02, with::deviation_map(map));
  EXPECT_FALSE((mesh.property_map<Face, double>("f:deviation").second));
  std::vector<double> values;
  for (const Face f : mesh.faces()) values.push_back(map[f]);
  EXPECT_EQ(values, deviations(s.output));
  EXPECT_GT(*std::max_element(values.begin(), values.end()), 0.01);
}

TEST(Deviation_map, by_default_replaces_the_values_of_an_earlier_run)
{
  Mesh mesh = wavy_sheet(20);
  mesh.add_property_map<Face, double>("f:deviation", 1e9);
  const Simplification s = simplified(mesh, 0.02);
  expect_sound_deviations(s, 2);
  // Of another type, it is not ours to touch.
  Mesh other = wavy_sheet(20);
  const auto text = other.add_property_map<Face, std::string>("f:deviation", "mine").first;
  make_geometric_mesh(other, 0.02);
  for (const Face f : other.faces()) EXPECT_EQ(text[f], "mine");
}

// ---- features ----

TEST(Feature_angle, keeps_ridges_as_curves)
{
  // At a tolerance of a tenth of the radius the rims of a cylinder would be rounded.
  const Mesh input = cylinder(48, 12, 1, 2);
  const Curves rims = sharp_curves(input, 40);
  for (const double tolerance : {0.1, 0.02}) {
    const Simplification s = simplified(input, tolerance, with::feature_angle(40));
    const auto height = [&](Edge e, int i) { return s.output.point(s.output.vertex(e, i)).z(); };
    const Curves kept = curves_where(s.output, [&](Edge e) {
      return std::abs(height(e, 0)) == 1 && height(e, 0) == height(e, 1)
          && dihedral_turn(s.output, e) > 40;
    });
    EXPECT_LE(curve_distance(rims, kept), tolerance + 1e-12);
    EXPECT_LT(kept.size(), rims.size() / 2);
    expect_sound(s);
  }
}

TEST(Feature_angle, decides_whether_a_low_roof_keeps_its_ridge)
{
  // The roof turns by 2 atan(0.02) = 2.29 degrees at its ridge, which lies within the tolerance.
  const Mesh roof = height_field(16, [](double x, double) { return -0.02 * std::abs(x); });
  for (const Deviation_bound bound : {Deviation_bound::direct, Deviation_bound::accumulated}) {
    const auto ridge_edges = [&](double angle) {
      const Simplification s
          = simplified(roof, 0.05, with::feature_angle(angle).deviation_bound(bound));
      expect_sound(s);
      return curves_where(s.output, [&](Edge e) {
        return s.output.point(s.output.vertex(e, 0)).x() == 0
            && s.output.point(s.output.vertex(e, 1)).x() == 0;
      });
    };
    EXPECT_TRUE(ridge_edges(180).empty());
    EXPECT_TRUE(ridge_edges(2.4).empty());
    const Curves ridge = {{Point(0, -1, 0), Point(0, 1, 0)}};
    EXPECT_LE(curve_distance(ridge_edges(2.2), ridge), 1e-15);
  }
}

TEST(Feature_angle, of_zero_keeps_every_edge_that_is_not_flat)
{
  const Mesh input = icosphere(2);
  const Simplification s = simplified(input, 1, with::feature_angle(0));
  EXPECT_TRUE(have_same_faces(input, s.output));
  EXPECT_LT(simplified(input, 1).output.number_of_faces(), 40u);
}

TEST(Feature_angle, certifies_the_curves_that_it_keeps)
{
  const Simplification s = simplified(cube(6), 0.01, with::feature_angle(40));
  EXPECT_EQ(s.certificate.correspondence()->ridges.size(), 12u * 6);
  EXPECT_TRUE(simplified(cube(6), 0.01).certificate.correspondence()->ridges.empty());
}

TEST(Corner_angle, decides_which_turns_of_a_curve_stay)
{
  // An octagonal ring: its borders turn by 45 degrees at 16 vertices, cut fine.
  const Mesh input = subdivided(annulus(8, 1), 2);
  const auto corners = [&](double angle) {
    const Simplification s = simplified(
        input, 0.2, with::corner_angle(angle).shape_floor(infinity).roughness_angle(180));
    expect_sound(s);
    std::size_t kept = 0;
    for (const Vertex v : annulus(8, 1).vertices())
      kept += has_vertex_at(s.output, annulus(8, 1).point(v));
    return kept;
  };
  EXPECT_EQ(corners(40), 16u);
  EXPECT_LT(corners(60), 16u);
  EXPECT_EQ(corners(44), 16u);
  EXPECT_LT(corners(46), 16u);
}

TEST(Edge_is_constrained_map, keeps_edges_as_curves)
{
  // A wavy line over a flat sheet, and a closed line on a sphere.
  for (const Mesh& shape : {grid(24), icosphere(4)}) {
    Mesh input = shape;
    const auto constrained = input.add_property_map<Edge, bool>("e:constrained", false).first;
    const auto height = [](const Point& p) { return p.y() - 0.4 - 0.1 * std::sin(9 * p.x()); };
    // Edges between faces below and above the line.
    const auto is_below = [&](Mesh::Halfedge_index h) {
      const auto f = input.face(h);
      if (f == Mesh::null_face()) return false;
      double sum = 0;
      for (const Vertex v : CGAL::vertices_around_face(h, input)) sum += height(input.point(v));
      return sum < 0;
    };
    for (const Edge e : input.edges())
      constrained[e] = !input.is_border(e)
          && is_below(input.halfedge(e)) != is_below(input.opposite(input.halfedge(e)));
    const Curves before = curves_where(input, [&](Edge e) { return constrained[e]; });
    ASSERT_GT(before.size(), 20u);

    for (const double tolerance : {0.01, 0.05}) {
      for (const Deviation_bound bound : {Deviation_bound::direct, Deviation_bound::accumulated}) {
        Mesh output = input;
        const auto kept = output.property_map<Edge, bool>("e:constrained").first;
        const auto certificate = make_geometric_mesh(
            output, tolerance,
            with::deviation_bound(bound).corner_angle(100).edge_is_constrained_map(kept));
        const Curves after = curves_where(output, [&](Edge e) { return kept[e]; });
        EXPECT_LE(curve_distance(before, after), tolerance + 1e-12);
        EXPECT_LT(after.size(), before.size());
        expect_sound({input, output, certificate});
      }
    }
  }
}

TEST(Edge_is_constrained_map, without_it_the_line_is_lost)
{
  Mesh input = grid(10);
  const auto constrained = input.add_property_map<Edge, bool>("e:constrained", false).first;
  for (const Edge e : input.edges()) {
    const auto x = [&](int i) { return input.point(input.vertex(e, i)).x(); };
    constrained[e] = x(0) == 0.5 && x(1) == 0.5;
  }
  EXPECT_EQ(simplified(input, 0.01).output.number_of_faces(), 2u);
  const Simplification s = simplified(input, 0.01, with_cgal::edge_is_constrained_map(constrained));
  EXPECT_TRUE(has_vertex_at(s.output, Point(0.5, 0, 0)));
  EXPECT_TRUE(has_vertex_at(s.output, Point(0.5, 1, 0)));
  EXPECT_EQ(s.output.number_of_faces(), 4u);
}

TEST(Vertex_is_constrained_map, keeps_vertices)
{
  for (const Mesh& shape : {grid(16), icosphere(3), torus(30, 12)}) {
    Mesh input = shape;
    const auto fixed = input.add_property_map<Vertex, bool>("v:fixed", false).first;
    Random random(1);
    std::vector<Point> chosen;
    for (int i = 0; i < 20; ++i) {
      const Vertex v(Mesh::size_type(random.below(input.number_of_vertices())));
      fixed[v] = true;
      chosen.push_back(input.point(v));
    }
    const auto lost = [&](const Simplification& s) {
      return std::count_if(chosen.begin(), chosen.end(), [&](const Point& p) {
        return !has_vertex_at(s.output, p);
      });
    };
    const Simplification s = simplified(input, 0.1, with_cgal::vertex_is_constrained_map(fixed));
    EXPECT_EQ(lost(s), 0);
    EXPECT_GT(lost(simplified(input, 0.1)), 10);
    expect_sound(s);
  }
}

TEST(Everything_constrained, stays)
{
  const Mesh input = icosphere(2);
  const auto all_vertices = CGAL::Static_boolean_property_map<Vertex, true>();
  const Simplification s = simplified(input, 1, with_cgal::vertex_is_constrained_map(all_vertices));
  EXPECT_EQ(s.output.number_of_vertices(), input.number_of_vertices());
  EXPECT_EQ(s.certificate.operations().collapses, 0u);
  const auto all_edges = CGAL::Static_boolean_property_map<Edge, true>();
  EXPECT_TRUE(have_same_faces(
      simplified(input, 1, with_cgal::edge_is_constrained_map(all_edges)).output, input));
}

// ---- points and other properties ----

TEST(Vertex_point_map, is_where_the_points_are)
{
  const Mesh shape = wavy_sheet(20);
  const Simplification plain = simplified(shape, 0.02);
  // The mesh's own points are useless: all the same, then not even finite.
  for (const double useless : {0.0, double(NAN)}) {
    Mesh mesh = shape;
    const auto other = mesh.add_property_map<Vertex, Point>("v:other").first;
    for (const Vertex v : mesh.vertices()) {
      other[v] = mesh.point(v);
      mesh.point(v) = Point(useless, useless, useless);
    }
    const auto certificate = make_geometric_mesh(mesh, 0.02, with_cgal::vertex_point_map(other));
    EXPECT_EQ(certificate.bound(), plain.certificate.bound());
    for (const Vertex v : mesh.vertices()) {
      EXPECT_TRUE(useless != 0 || mesh.point(v) == Point(0, 0, 0));
      mesh.point(v) = other[v];
    }
    EXPECT_TRUE(is_identical(mesh, plain.output));
  }
}

TEST(Vertex_point_map, is_what_is_checked)
{
  Mesh mesh = wavy_sheet(5);
  const auto other = mesh.add_property_map<Vertex, Point>("v:other").first; // all at the origin
  const auto before = fingerprint(mesh);
  EXPECT_THROW(make_geometric_mesh(mesh, 0.02, with_cgal::vertex_point_map(other)), Invalid_input);
  for (const Vertex v : mesh.vertices()) other[v] = mesh.point(v);
  other[Vertex(7)] = Point(0, NAN, 0);
  EXPECT_THROW(make_geometric_mesh(mesh, 0.02, with_cgal::vertex_point_map(other)), Invalid_input);
  EXPECT_TRUE(fingerprint(mesh) == before);
}

TEST(Properties, of_the_user_stay_with_what_survives)
{
  for (const Mesh& shape : {wavy_sheet(20), icosphere(3)}) {
    Mesh mesh = shape;
    const auto place = mesh.add_property_map<Vertex, Point>("v:place").first;
    const auto vertex_name = mesh.add_property_map<Vertex, std::string>("v:name").first;
    const auto edge_name = mesh.add_property_map<Edge, int>("e:name", -1).first;
    const auto halfedge_name = mesh.add_property_map<Mesh::Halfedge_index, int>("h:name", -1).first;
    const auto face_name = mesh.add_property_map<Face, int>("f:name", -1).first;
    for (const Vertex v : mesh.vertices()) {
      place[v] = mesh.point(v);
      vertex_name[v] = std::to_string(mesh.point(v).x());
    }
    for (const Edge e : mesh.edges()) edge_name[e] = int(e.idx());
    for (const auto h : mesh.halfedges()) halfedge_name[h] = int(h);
    for (const Face f : mesh.faces()) face_name[f] = int(f);

    make_geometric_mesh(mesh, 0.02, with::effort(Effort::fast)); // vertices do not move
    std::set<int> edges, halfedges, faces;
    for (const Vertex v : mesh.vertices()) {
      EXPECT_EQ(place[v], mesh.point(v));
      EXPECT_EQ(vertex_name[v], std::to_string(mesh.point(v).x()));
    }
    for (const Edge e : mesh.edges()) edges.insert(edge_name[e]);
    for (const auto h : mesh.halfedges()) halfedges.insert(halfedge_name[h]);
    for (const Face f : mesh.faces()) faces.insert(face_name[f]);
    EXPECT_EQ(edges.size(), mesh.number_of_edges());
    EXPECT_EQ(halfedges.size(), mesh.number_of_halfedges());
    EXPECT_EQ(faces.size(), mesh.number_of_faces());
    for (const auto* names : {&edges, &halfedges, &faces}) EXPECT_GE(*names->begin(), 0);
    EXPECT_EQ(mesh.properties<Vertex>().size(), shape.properties<Vertex>().size() + 2);
  }
}

TEST(Properties, of_the_user_stay_with_vertices_that_move)
{
  for (const Method& method : {on_surface, free_standard}) {
    Mesh mesh = wavy_sheet(20);
    const auto name = mesh.add_property_map<Vertex, int>("v:name", -1).first;
    for (const Vertex v : mesh.vertices()) name[v] = int(v);
    make_geometric_mesh(mesh, 0.02, parameters_of(method));
    std::set<int> names;
    for (const Vertex v : mesh.vertices()) names.insert(name[v]);
    EXPECT_EQ(names.size(), mesh.number_of_vertices()) << method.name;
    EXPECT_GE(*names.begin(), 0) << method.name;
  }
}

TEST(Properties, of_the_same_face_that_nothing_touched_are_its_own)
{
  // Half of the sheet is constrained: its faces keep their corners and their values.
  Mesh mesh = wavy_sheet(16);
  const auto fixed = mesh.add_property_map<Vertex, bool>("v:fixed").first;
  for (const Vertex v : mesh.vertices()) fixed[v] = mesh.point(v).x() < 0.3;
  const auto corners = mesh.add_property_map<Face, std::set<Point>>("f:corners").first;
  const auto corners_of = [&](Face f) {
    std::set<Point> result;
    for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      result.insert(mesh.point(v));
    return result;
  };
  for (const Face f : mesh.faces()) corners[f] = corners_of(f);
  make_geometric_mesh(
      mesh, 0.05, with::flip_rounds(0).effort(Effort::fast).vertex_is_constrained_map(fixed));
  std::size_t untouched = 0;
  for (const Face f : mesh.faces()) {
    std::size_t of_fixed = 0;
    for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) of_fixed += fixed[v];
    if (of_fixed < 3 || corners_of(f) != corners[f]) continue;
    ++untouched;
  }
  EXPECT_GT(untouched, 200u);
}

TEST(Garbage, in_the_input_is_no_obstacle)
{
  for (const bool with_border : {false, true}) {
    Mesh input = with_border ? wavy_sheet(20) : icosphere(3);
    Random random(1);
    for (int i = 0; i < 60; ++i) {
      Edge e(Mesh::size_type(random.below(input.number_of_edges())));
      if (!input.is_removed(e) && CGAL::Euler::does_satisfy_link_condition(e, input)
          && !input.is_border(e) && !input.is_border(input.vertex(e, 0))
          && !input.is_border(input.vertex(e, 1)))
        CGAL::Euler::collapse_edge(e, input);
    }
    ASSERT_TRUE(input.has_garbage());
    if (!is_sound(input)) continue;
    for (const Method& method :
         {on_surface_fast, on_surface, free_fast, free_standard, accumulated}) {
      const Simplification s = simplified(input, 0.02, parameters_of(method));
      expect_sound(s);
      EXPECT_LT(s.output.number_of_faces(), input.number_of_faces()) << method.name;
    }
    const Simplification untouched = simplified(input, 1e-12);
    expect_sound(untouched);
    EXPECT_EQ(untouched.output.number_of_faces(), input.number_of_faces());
  }
}

TEST(Other_kernels, are_served_in_their_precision)
{
  using Plain_mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<float>::Point_3>;
  const Mesh shape = rounded_to_floats(wavy_sheet(20));
  const auto as_plain = [](const Mesh& mesh) {
    Plain_mesh plain;
    const Soup soup = to_soup(mesh);
    for (const Point& p : soup.points) plain.add_vertex({float(p.x()), float(p.y()), float(p.z())});
    for (const auto& t : soup.triangles)
      plain.add_face(
          Plain_mesh::Vertex_index(unsigned(t[0])), Plain_mesh::Vertex_index(unsigned(t[1])),
          Plain_mesh::Vertex_index(unsigned(t[2])));
    return plain;
  };
  const Plain_mesh input = as_plain(shape);
  for (const Method& method :
       {on_surface_fast, on_surface, free_fast, free_standard, accumulated}) {
    SCOPED_TRACE(method.name);
    const auto np = parameters_of(method);
    Plain_mesh output = input;
    const auto certificate = make_geometric_mesh(output, 0.02, np);
    EXPECT_TRUE(certificate.holds());
    if (certificate.correspondence()) {
      const auto check = surety::check_certificate(input, output, certificate);
      EXPECT_TRUE(check.holds) << check.reason;
    }
    // What double precision can hold as well, it finds as well.
    const Simplification doubles = simplified(shape, 0.02, np.single_precision(true));
    ASSERT_EQ(output.number_of_vertices(), doubles.output.number_of_vertices());
    for (const Vertex v : doubles.output.vertices()) {
      const auto& p = output.point(Plain_mesh::Vertex_index(v));
      EXPECT_EQ(Point(p.x(), p.y(), p.z()), doubles.output.point(v));
    }
    EXPECT_EQ(certificate.bound(), doubles.certificate.bound());
  }
}

// ---- the visitor ----

/// Notes what it is told in a place that outlives the copies that are made of it.
struct Visitor {
  std::vector<Progress>* calls;
  std::size_t last = std::size_t(-1); ///< the call at which it cancels
  bool throws = false;

  bool on_progress(const Progress& progress)
  {
    calls->push_back(progress);
    if (calls->size() < last) return true;
    if (throws) throw std::runtime_error("the user's own");
    return false;
  }
};

class Visitor_parameter : public testing::TestWithParam<Method>
{};

TEST_P(Visitor_parameter, is_told_the_progress)
{
  std::vector<Progress> calls;
  const Mesh input = jittered_sphere(5, 1);
  const auto np = parameters_of(GetParam());
  const Simplification s = simplified(input, 0.01, np.visitor(Visitor{&calls}));
  EXPECT_TRUE(is_identical(s.output, simplified(input, 0.01, np).output));
  EXPECT_FALSE(s.certificate.is_cancelled());
  ASSERT_GT(calls.size(), 10u);
  std::size_t faces = input.number_of_faces();
  std::set<std::string> stages;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    EXPECT_GE(calls[i].fraction, 0);
    EXPECT_LE(calls[i].fraction, 1);
    EXPECT_LE(calls[i].faces, faces);
    EXPECT_GE(calls[i].faces, s.output.number_of_faces());
    faces = calls[i].faces;
    stages.insert(calls[i].stage);
    // A stage that starts anew, starts at zero.
    const bool goes_on
        = i > 0 && calls[i].fraction > 0 && std::string(calls[i].stage) == calls[i - 1].stage;
    EXPECT_TRUE(!goes_on || calls[i].fraction > calls[i - 1].fraction - 0.1)
        << calls[i].stage << ": " << calls[i - 1].fraction << ", then " << calls[i].fraction;
  }
  std::set<std::string> expected = {"collapse", "flip"};
  if (GetParam().effort != Effort::fast && GetParam().bound == Deviation_bound::direct)
    expected.insert({"predict", "relocate"});
  EXPECT_EQ(stages, expected);
}

TEST_P(Visitor_parameter, may_cancel_at_any_call)
{
  std::vector<Progress> calls;
  const auto np = parameters_of(GetParam());
  const Mesh input = jittered_sphere(4, 1);
  simplified(input, 0.01, np.visitor(Visitor{&calls}));
  const std::size_t number = calls.size();
  ASSERT_GT(number, 4u);
  std::size_t previous = input.number_of_faces();
  for (std::size_t last = 1; last <= number; last += 1 + number / 8) {
    calls.clear();
    const Simplification s = simplified(input, 0.01, np.visitor(Visitor{&calls, last}));
    EXPECT_EQ(calls.size(), last);
    EXPECT_TRUE(s.certificate.is_cancelled());
    EXPECT_LE(s.output.number_of_faces(), previous);
    previous = s.output.number_of_faces();
    expect_sound(s, 1);
  }
  EXPECT_LT(previous, input.number_of_faces());
}

TEST_P(Visitor_parameter, that_throws_leaves_the_mesh_untouched)
{
  std::vector<Progress> calls;
  const auto np = parameters_of(GetParam());
  Mesh mesh = jittered_sphere(4, 1);
  const auto before = fingerprint(mesh);
  simplified(mesh, 0.01, np.visitor(Visitor{&calls}));
  const std::size_t number = calls.size();
  for (std::size_t last = 1; last <= number; last += 1 + number / 8) {
    calls.clear();
    EXPECT_THROW(
        make_geometric_mesh(mesh, 0.01, np.visitor(Visitor{&calls, last, true})),
        std::runtime_error);
    EXPECT_EQ(calls.size(), last);
    EXPECT_TRUE(fingerprint(mesh) == before);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Methods, Visitor_parameter,
    testing::Values(on_surface_fast, on_surface, free_fast, free_standard, accumulated),
    [](const auto& info) { return std::string(info.param.name); });

// ---- what is refused ----

template <class NamedParameters = CGAL::parameters::Default_named_parameters>
void expect_refused(
    Mesh mesh, double tolerance, const std::string& argument,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  const auto before = fingerprint(mesh);
  try {
    make_geometric_mesh(mesh, tolerance, np);
    ADD_FAILURE() << "accepted: bad " << argument;
  } catch (const Invalid_input& error) {
    EXPECT_EQ(error.argument(), argument) << error.what();
    EXPECT_FALSE(error.problem().empty());
  }
  EXPECT_TRUE(fingerprint(mesh) == before) << "changed: bad " << argument;
}

TEST(Refuses, tolerances_that_are_no_length)
{
  for (const double tolerance : {0.0, -0.0, -1.0, double(NAN), infinity, -infinity})
    expect_refused(icosphere(1), tolerance, "tolerance");
}

TEST(Refuses, parameters_out_of_range)
{
  const Mesh mesh = icosphere(1);
  for (const double angle : {-1.0, 180.5, double(NAN), infinity}) {
    expect_refused(mesh, 0.1, "feature_angle", with::feature_angle(angle));
    expect_refused(mesh, 0.1, "corner_angle", with::corner_angle(angle));
    expect_refused(mesh, 0.1, "roughness_angle", with::roughness_angle(angle));
  }
  expect_refused(mesh, 0.1, "roughness_angle", with::roughness_angle(0));
  for (const double ratio : {0.999, 0.0, -1.0, double(NAN), -infinity}) {
    expect_refused(mesh, 0.1, "shape_ratio", with::shape_ratio(ratio));
    expect_refused(mesh, 0.1, "shape_floor", with::shape_floor(ratio));
  }
}

TEST(Refuses, to_place_freely_under_the_accumulated_bound)
{
  for (const Effort effort : {Effort::fast, Effort::standard, Effort::best})
    expect_refused(
        icosphere(1), 0.1, "placement",
        with::placement(Placement::free)
            .effort(effort)
            .deviation_bound(Deviation_bound::accumulated));
}

TEST(Refuses, meshes_that_are_no_surface)
{
  const auto refuse = [](const Mesh& mesh) { expect_refused(mesh, 0.1, "mesh"); };
  refuse(Mesh());

  Mesh quad;
  CGAL::make_quad(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0), quad);
  refuse(quad);

  for (const double bad : {double(NAN), infinity, -infinity, 1e200}) {
    Mesh mesh = grid(4);
    mesh.point(Vertex(12)) = Point(0.5, bad, 0);
    refuse(mesh);
  }

  Mesh isolated = grid(2);
  isolated.add_vertex(Point(0, 0, 1));
  refuse(isolated);

  Mesh degenerate = grid(2);
  degenerate.point(Vertex(0)) = degenerate.point(Vertex(1));
  refuse(degenerate);
  Mesh flat = grid(1);
  flat.point(Vertex(1)) = CGAL::midpoint(flat.point(Vertex(0)), flat.point(Vertex(3)));
  refuse(flat);

  Soup twice;
  twice.points = {Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0)};
  twice.triangles = {{0, 1, 2}, {0, 2, 1}};
  refuse(to_mesh(twice));

  Soup bow_tie = to_soup(joined({grid(2), translated(grid(2), Vector(1, 1, 0))}));
  for (auto& t : bow_tie.triangles)
    for (std::size_t& v : t)
      if (v == 9) v = 8; // the corner that both have at (1, 1)
  bow_tie.points.erase(bow_tie.points.begin() + 9);
  for (auto& t : bow_tie.triangles)
    for (std::size_t& v : t)
      if (v > 9) --v;
  refuse(to_mesh(bow_tie));

  refuse(scaled(icosphere(1), 1e-120));
}

TEST(Refuses, a_degenerate_face_far_into_a_large_mesh)
{
  Mesh mesh = icosphere(4);
  const auto h = mesh.halfedge(Face(4321));
  mesh.point(mesh.target(h))
      = CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(mesh.next(h))));
  try {
    make_geometric_mesh(mesh, 0.1);
    // A midpoint in doubles need not be collinear exactly; then the mesh is fine.
    EXPECT_TRUE(is_sound(mesh));
  } catch (const Invalid_input& error) {
    EXPECT_NE(error.problem().find("4321"), std::string::npos) << error.what();
  }
}

// ---- the smallest meshes ----

TEST(Smallest_meshes, are_left_or_lose_what_they_can)
{
  Mesh triangle, tetrahedron, octahedron;
  CGAL::make_triangle(Point(0, 0, 0), Point(0, 1, 0), Point(1, 0, 0), triangle);
  CGAL::make_tetrahedron(
      Point(0, 0, 0), Point(0, 1, 0), Point(1, 0, 0), Point(0, 0, 1), tetrahedron);
  const auto anything_goes
      = with::roughness_angle(180).shape_floor(infinity).allow_self_intersections(true);
  for (const Mesh& mesh : {triangle, tetrahedron}) {
    for (const double tolerance : {1e-9, 0.1, 1e9}) {
      const Simplification s = simplified(mesh, tolerance, anything_goes);
      EXPECT_TRUE(have_same_faces(mesh, s.output));
      EXPECT_EQ(s.certificate.bound(), 0);
      expect_sound(s);
    }
  }
  // Whatever the tolerance, the topological type stays.
  for (const Mesh& mesh :
       {grid(1), grid(2), annulus(3, 1), annulus(8, 2), cube(2), torus(3, 3), torus(8, 6),
        icosphere(1), joined({triangle, tetrahedron})}) {
    const Simplification s
        = simplified(mesh, 1e9, with::roughness_angle(180).shape_floor(infinity).corner_angle(180));
    expect_sound(s);
    expect_verified_distance(s);
    EXPECT_EQ(
        topological_type(simplified(mesh, 1e9, anything_goes).output), topological_type(mesh));
  }
}

} // namespace
