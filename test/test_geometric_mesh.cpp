// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric mesh of generated shapes: what it promises holds for every shape, tolerance, method
// and feature angle, wherever the shape lies, however large it is and in whatever order it comes.
#include <surety/geometric_mesh.h>

#include "simplification.h"

#include <functional>
#include <sstream>
#include <tuple>

namespace {

using namespace surety::test;
using surety::Deviation_bound;
using surety::Effort;
using surety::make_geometric_mesh;
using surety::Placement;
namespace with = surety::parameters;

struct Shape {
  const char* name;
  std::function<Mesh()> make;
};

void PrintTo(const Shape& shape, std::ostream* out) { *out << shape.name; }

const std::vector<Shape>& shapes()
{
  static const std::vector<Shape> all = {
      {"sphere", [] { return icosphere(3); }},
      {"jittered_sphere", [] { return jittered_sphere(3, 1); }},
      {"ellipsoid", [] { return ellipsoid(3, 1, 0.5, 0.2); }},
      {"torus", [] { return torus(40, 20); }},
      {"noisy_torus", [] { return jittered(torus(30, 16), 0.01, 1); }},
      {"saddle", [] { return saddle(20); }},
      {"annulus", [] { return annulus(48, 6); }},
      {"grid", [] { return grid(20); }},
      {"noisy_grid", [] { return jittered(grid(20), 0.005, 1); }},
      {"cut_moebius_strip", [] { return moebius_cut(48, 4); }},
      {"unit_cube", [] { return cube(); }},
      {"cube", [] { return cube(6); }},
      {"irregular_cube", [] { return split_at_random(cube(3), 400, 1); }},
      {"double_torus", [] { return subdivided(plate_with_holes(2), 1); }},
      {"cylinder", [] { return cylinder(32, 8); }},
      {"needle", [] { return needle_on_sphere(0.001, 1); }},
      {"fin", [] { return fin(0.001, 0.5); }},
      {"two_sheets", [] { return two_sheets(12, 0.002); }},
      {"two_spheres", [] { return two_spheres(3, 0.01); }},
      {"spheres_at_scales", [] { return spheres_at_scales(6); }},
  };
  return all;
}

std::string name_of_shape_and_method(const testing::TestParamInfo<std::tuple<Shape, Method>>& info)
{
  return std::string(std::get<0>(info.param).name) + '_' + std::get<1>(info.param).name;
}

// ---- every shape at every tolerance by every method ----

class Any_shape : public testing::TestWithParam<std::tuple<Shape, double, Method, double>>
{};

TEST_P(Any_shape, keeps_every_promise)
{
  const auto& [shape, relative, method, angle] = GetParam();
  const Mesh input = shape.make();
  const double tolerance = relative * diagonal(input);
  const Simplification s = simplified(input, tolerance, parameters_of(method).feature_angle(angle));
  EXPECT_EQ(s.certificate.tolerance(), tolerance);
  EXPECT_FALSE(s.certificate.is_cancelled());
  EXPECT_EQ(s.certificate.correspondence().has_value(), method.bound == Deviation_bound::direct);
  expect_sound(s);
  expect_verified_distance(s);
  EXPECT_LE(
      curve_distance(border_curves(s.output), border_curves(input)),
      tolerance + sampling_error(input));
}

std::string name_of(const testing::TestParamInfo<Any_shape::ParamType>& info)
{
  const auto& [shape, relative, method, angle] = info.param;
  std::ostringstream name;
  name << shape.name << "_within_1_in_" << std::lround(1 / relative) << '_' << method.name
       << (angle < 180 ? "_with_ridges" : "");
  return name.str();
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Any_shape,
    testing::Combine(
        testing::ValuesIn(shapes()), testing::Values(0.03, 0.003, 0.0003),
        testing::Values(on_surface_fast, accumulated), testing::Values(180.0, 40.0)),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Moving, Any_shape,
    testing::Combine(
        testing::ValuesIn(shapes()), testing::Values(0.02, 0.0005),
        testing::Values(on_surface, free_fast, free_standard), testing::Values(180.0)),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Moving_with_ridges, Any_shape,
    testing::Combine(
        testing::ValuesIn(shapes()), testing::Values(0.003),
        testing::Values(on_surface, free_fast, free_standard), testing::Values(40.0)),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Small_shapes, Any_shape,
    testing::Combine(
        testing::Values(
            Shape{"sphere", [] { return jittered_sphere(2, 1); }},
            Shape{"torus", [] { return jittered(torus(20, 10), 0.01, 1); }},
            Shape{"grid", [] { return jittered(grid(10), 0.01, 1); }},
            Shape{"cylinder", [] { return cylinder(20, 5); }},
            Shape{"fin", [] { return fin(0.001, 0.5); }}),
        testing::Values(0.01), testing::Values(on_surface_best, free_best),
        testing::Values(180.0, 40.0)),
    name_of);

// ---- how few faces remain ----

TEST(Fewest_faces, a_flat_square_ends_with_two)
{
  // No shape limit stands in the way: both triangles have Q = 2.09.
  for (const Method& method : {on_surface_fast, on_surface, free_fast, free_standard}) {
    for (const double tolerance : {1e-6, 1e-2}) {
      for (const Mesh& mesh : {grid(20), rotated(grid(20), 1)})
        EXPECT_EQ(simplified(mesh, tolerance, parameters_of(method)).output.number_of_faces(), 2u)
            << method.name;
    }
  }
}

TEST(Fewest_faces, a_polyhedron_ends_with_its_corners)
{
  // Only corners remain, so that Euler's formula gives the count: F = 2 (V - chi).
  for (const Method& method : {on_surface_fast, on_surface, free_fast, free_standard}) {
    for (const double angle : {180.0, 40.0}) {
      SCOPED_TRACE(method.name);
      const auto faces = [&](const Mesh& mesh) {
        return simplified(mesh, 1e-6, parameters_of(method).feature_angle(angle).shape_floor(100))
            .output.number_of_faces();
      };
      EXPECT_EQ(faces(cube(8)), 12u);
      EXPECT_EQ(faces(rotated(cube(8), 1)), 12u);
      EXPECT_EQ(faces(rotated(subdivided(brick(4, 2, 1), 2), 1)), 12u);
      EXPECT_LE(faces(rotated(split_at_random(cube(), 500, 1), 1)), 14u);
      for (int holes = 1; holes <= 3; ++holes) {
        const auto ideal = unsigned(2 * (8 + 8 * holes - (2 - 2 * holes)));
        EXPECT_LE(faces(subdivided(plate_with_holes(holes), 2)), 1.1 * ideal);
      }
    }
  }
}

TEST(Fewest_faces, a_polyhedron_of_corners_only_stays_as_it_is)
{
  for (const Mesh& mesh : {cube(), rotated(cube(), 1)}) {
    for (const Method& method : {on_surface_fast, on_surface, free_fast, free_standard}) {
      for (const double tolerance : {1e-6, 0.01, 0.1}) {
        const Simplification s = simplified(mesh, tolerance, parameters_of(method));
        EXPECT_TRUE(have_same_faces(s.input, s.output)) << method.name;
        EXPECT_EQ(s.certificate.bound(), 0);
      }
    }
  }
}

TEST(Fewest_faces, a_faceted_cylinder_ends_with_its_rims)
{
  // 2 n vertices on a closed surface of Euler characteristic 2.
  for (const std::size_t n : {12, 24}) {
    const Simplification s = simplified(cylinder(n, 20, 1, 2), 1e-6, with::shape_floor(1e6));
    EXPECT_EQ(s.output.number_of_faces(), 2 * (2 * n - 2));
    expect_sound(s);
  }
}

TEST(Fewest_faces, a_sphere_needs_at_most_twice_the_limit)
{
  // A regular triangulation with vertices on the sphere and gap delta has 4 pi / (1.5 sqrt(3)
  // delta) faces: an equilateral triangle with circumradius r lies r^2 / 2 below.
  const Mesh input = jittered_sphere(5, 1);
  double previous = 0;
  for (const double delta : {0.08, 0.04, 0.02, 0.01}) {
    const auto faces = [&](const Method& method) {
      return double(simplified(input, delta, parameters_of(method)).output.number_of_faces());
    };
    const double limit = 4 * pi / (1.5 * std::sqrt(3) * delta);
    const double fast = faces(on_surface_fast), standard = faces(on_surface),
                 free = faces(free_standard);
    EXPECT_LE(fast, 2 * limit) << delta;
    EXPECT_LT(standard, fast) << delta;
    EXPECT_GE(standard, limit) << delta;
    // With vertices as far outside as the faces lie inside, the gap may be twice as large.
    EXPECT_LE(free, limit) << delta;
    EXPECT_GE(free, limit / 2) << delta;
    // Halving the tolerance doubles the count.
    const double growth = standard / previous;
    EXPECT_TRUE(previous == 0 || (growth > 1.7 && growth < 2.3)) << growth;
    previous = standard;
  }
}

TEST(Fewest_faces, a_component_within_the_tolerance_shrinks_but_stays)
{
  for (const Method& method :
       {on_surface_fast, on_surface, free_fast, free_standard, accumulated}) {
    SCOPED_TRACE(method.name);
    const Simplification s = simplified(
        spheres_at_scales(6), 0.01, parameters_of(method).roughness_angle(180).shape_floor(1e9));
    EXPECT_EQ(number_of_components(s.output), 6u);
    // The four spheres that fit into the tolerance end as tetrahedra.
    std::size_t tetrahedra = 0;
    for (const Mesh& part : components(s.output)) tetrahedra += part.number_of_faces() == 4;
    EXPECT_GE(tetrahedra, 3u);
    expect_sound(s);
  }
}

TEST(Fewest_faces, a_larger_tolerance_leaves_fewer)
{
  for (const Mesh& mesh : {jittered_sphere(4, 1), torus(48, 24), saddle(30)}) {
    std::size_t previous = mesh.number_of_faces() + 1;
    for (const double tolerance : {1e-4, 1e-3, 1e-2, 1e-1}) {
      const std::size_t faces = simplified(mesh, tolerance).output.number_of_faces();
      EXPECT_LE(faces, previous);
      previous = faces;
    }
    EXPECT_LT(previous, mesh.number_of_faces() / 8);
  }
}

// ---- thin features ----

TEST(Thin_features, a_needle_thinner_than_the_tolerance_stays)
{
  for (const Method& method : {on_surface_fast, on_surface, free_fast, free_standard}) {
    for (const double tolerance : {0.005, 0.02, 0.1}) {
      const Simplification s
          = simplified(needle_on_sphere(0.001, 1), tolerance, parameters_of(method));
      double tip = 0;
      for (const Vertex v : s.output.vertices())
        tip = std::max(tip, std::sqrt((s.output.point(v) - CGAL::ORIGIN).squared_length()));
      EXPECT_GE(tip, 2 - 1e-3 - tolerance) << method.name;
      expect_sound(s);
    }
  }
}

TEST(Thin_features, a_fin_thinner_than_the_tolerance_stays)
{
  const Mesh input = fin(0.001, 0.5);
  for (const Method& method : {on_surface_fast, on_surface, free_fast, free_standard}) {
    for (const double tolerance : {0.005, 0.02, 0.1}) {
      const Simplification s = simplified(input, tolerance, parameters_of(method));
      EXPECT_LE(sampled_distance_to(input, s.output, 1, 6), tolerance) << method.name;
      EXPECT_EQ(number_of_self_intersections(s.output), 0u) << method.name;
    }
  }
}

TEST(Thin_features, sheets_closer_than_the_tolerance_do_not_cross)
{
  for (const double gap : {1e-2, 1e-4}) {
    const Mesh bent = mapped(two_sheets(16, gap), [](const Point& p) {
      return Point(p.x(), p.y(), p.z() + 0.2 * std::sin(5 * p.x()) * std::cos(4 * p.y()));
    });
    for (const Method& method : {on_surface_fast, on_surface, free_fast, free_standard}) {
      SCOPED_TRACE(method.name);
      const Simplification s = simplified(bent, 0.03, parameters_of(method));
      EXPECT_EQ(number_of_self_intersections(s.output), 0u);
      EXPECT_LT(s.output.number_of_faces(), bent.number_of_faces());
      expect_sound(s);
    }
  }
}

// ---- scale, position, orientation, order ----

class Moved_shape : public testing::TestWithParam<std::tuple<Shape, Method>>
{
protected:
  const Mesh input = std::get<0>(GetParam()).make();
  const Method method = std::get<1>(GetParam());
  const double tolerance = 0.004 * diagonal(input);

  Simplification simplify(const Mesh& mesh) const
  {
    return simplified(mesh, tolerance, parameters_of(method));
  }
  double number_of_faces() const { return double(simplify(input).output.number_of_faces()); }

  /// Where vertices move, chance has more to say, and some where the order of the collapses follows
  /// a space-filling curve, which does not turn with the mesh.
  double share_of_chance() const
  {
    if (method.bound == Deviation_bound::accumulated) return 0.1;
    const bool moves = method.placement == Placement::free || method.effort != Effort::fast;
    return moves ? 0.2 : 0.15;
  }
};

TEST_P(Moved_shape, scaling_by_a_power_of_two_changes_nothing_else)
{
  const auto np = parameters_of(method).feature_angle(40);
  const Simplification unscaled = simplified(input, tolerance, np);
  for (const double factor : {1.0, 0x1p10, 0x1p-10}) {
    const Simplification s = simplified(scaled(input, factor), factor * tolerance, np);
    EXPECT_TRUE(is_identical(scaled(unscaled.output, factor), s.output)) << factor;
    EXPECT_EQ(s.certificate.bound(), factor * unscaled.certificate.bound()) << factor;
    expect_proof(s);
    if (factor != 1) continue;
    // The same again gives the same bits.
    EXPECT_TRUE(fingerprint(unscaled.output) == fingerprint(s.output));
    EXPECT_EQ(deviations(unscaled.output), deviations(s.output));
    if (!s.certificate.correspondence()) continue;
    std::ostringstream a, b;
    write_certificate(a, unscaled.certificate);
    write_certificate(b, s.certificate);
    EXPECT_EQ(a.str(), b.str());
  }
}

TEST_P(Moved_shape, translation_and_renumbering_hardly_change_the_count)
{
  const double here = number_of_faces();
  for (const Mesh& mesh : {translated(input, Vector(1e6, -1e6, 1e6)), renumbered(input, 1)}) {
    const Simplification s = simplify(mesh);
    expect_sound(s, 1);
    EXPECT_NEAR(double(s.output.number_of_faces()), here, share_of_chance() * here + 8);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Moved_shape,
    testing::Combine(
        testing::ValuesIn(shapes()),
        testing::Values(on_surface_fast, on_surface, free_fast, free_standard, accumulated)),
    name_of_shape_and_method);

/// More of the same, for fewer methods.
class Turned_shape : public Moved_shape
{};

TEST_P(Turned_shape, of_extreme_size_is_the_same)
{
  const auto np = parameters_of(method).feature_angle(40);
  const Simplification unscaled = simplified(input, tolerance, np);
  // These take the bounding box to about 1e-90 and 1e90.
  for (const double factor : {0x1p130, 0x1p-130, 0x1p300, 0x1p-300}) {
    const Simplification s = simplified(scaled(input, factor), factor * tolerance, np);
    EXPECT_TRUE(is_identical(scaled(unscaled.output, factor), s.output)) << factor;
    EXPECT_EQ(s.certificate.bound(), factor * unscaled.certificate.bound()) << factor;
    expect_proof(s);
  }
}

TEST_P(Turned_shape, is_sound_and_has_about_as_many_faces)
{
  const double here = number_of_faces();
  for (const Mesh& mesh :
       {rotated(input, 1), rotated(input, 2), renumbered(input, 2), reversed(input),
        translated(input, Vector(1, 2, -3)), translated(input, Vector(1e3, 0, 1e3))}) {
    const Simplification s = simplify(mesh);
    expect_sound(s, 1);
    EXPECT_NEAR(double(s.output.number_of_faces()), here, share_of_chance() * here + 8);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Turned_shape,
    testing::Combine(testing::ValuesIn(shapes()), testing::Values(on_surface_fast, accumulated)),
    name_of_shape_and_method);

class Small_turned_shape : public Turned_shape
{};

TEST_P(Small_turned_shape, is_sound_and_has_about_as_many_faces)
{
  const double here = number_of_faces();
  for (const Mesh& mesh : {rotated(input, 1), reversed(input)}) {
    const Simplification s = simplify(mesh);
    expect_sound(s, 1);
    EXPECT_NEAR(double(s.output.number_of_faces()), here, share_of_chance() * here + 8);
  }
}

TEST_P(Small_turned_shape, of_extreme_size_is_the_same)
{
  const Simplification unscaled = simplify(input);
  for (const double factor : {0x1p300, 0x1p-300}) {
    const Simplification s
        = simplified(scaled(input, factor), factor * tolerance, parameters_of(method));
    EXPECT_TRUE(is_identical(scaled(unscaled.output, factor), s.output)) << factor;
    expect_proof(s);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Small_turned_shape,
    testing::Combine(
        testing::Values(
            Shape{"sphere", [] { return jittered_sphere(2, 1); }},
            Shape{"torus", [] { return jittered(torus(20, 10), 0.01, 1); }},
            Shape{"saddle", [] { return saddle(12); }},
            Shape{"cylinder", [] { return cylinder(20, 5); }},
            Shape{"fin", [] { return fin(0.001, 0.5); }}),
        testing::Values(on_surface, free_fast, free_standard)),
    name_of_shape_and_method);

TEST(Far_from_the_origin, a_tolerance_below_the_rounding_is_still_kept)
{
  // At 2^40 neighbouring doubles are 2^-12 apart.
  const Mesh far = translated(grid(8), Vector(0x1p40, 0, 0));
  for (const double tolerance : {0x1p-6, 0x1p-10, 0x1p-14, 0x1p-20}) {
    for (const Method& method :
         {on_surface_fast, on_surface, free_fast, free_standard, accumulated}) {
      const Simplification s = simplified(far, tolerance, parameters_of(method));
      EXPECT_TRUE(s.certificate.holds()) << s.certificate.bound() << " for " << tolerance;
      expect_proof(s);
    }
  }
}

TEST(Extreme_tolerances, are_kept)
{
  const double smallest = std::numeric_limits<double>::denorm_min();
  const double largest = std::numeric_limits<double>::max();
  for (const double factor : {1.0, 0x1p300, 0x1p-300}) {
    const Mesh sphere = scaled(icosphere(2), factor);
    for (const Method& method :
         {on_surface_fast, on_surface, free_fast, free_standard, accumulated}) {
      SCOPED_TRACE(method.name);
      for (const double tolerance : {smallest, 1e-310, 1e-200, 1e-30 * factor}) {
        const Simplification s = simplified(sphere, tolerance, parameters_of(method));
        EXPECT_TRUE(have_same_faces(s.input, s.output)) << tolerance << " at " << factor;
        EXPECT_EQ(s.certificate.bound(), 0);
        expect_proof(s);
      }
      for (const double tolerance : {1e30 * factor, largest}) {
        const Simplification s = simplified(sphere, tolerance, parameters_of(method));
        expect_proof(s);
        // No point of a sphere is farther from another than the diameter.
        EXPECT_LE(s.certificate.bound(), 2.0001 * factor);
        EXPECT_LT(s.output.number_of_faces(), 100u);
      }
    }
  }
}

// ---- again ----

class Repeated : public testing::TestWithParam<std::tuple<Shape, Method>>
{
protected:
  const Mesh input = std::get<0>(GetParam()).make();
  const Method method = std::get<1>(GetParam());
};

TEST_P(Repeated, simplification_adds_at_most_the_bounds)
{
  const double tolerance = 0.003 * diagonal(input);
  Mesh mesh = input;
  double sum = 0;
  for (int pass = 0; pass < 3; ++pass) {
    const Simplification s = simplified(mesh, tolerance, parameters_of(method));
    EXPECT_LE(s.output.number_of_faces(), mesh.number_of_faces());
    EXPECT_GT(s.output.number_of_faces(), 0u);
    sum += s.certificate.bound();
    mesh = s.output;
    EXPECT_LE(sampled_distance(input, mesh, 1, 2), sum + sampling_error(input));
  }
}

TEST_P(Repeated, a_tiny_tolerance_leaves_a_rough_mesh_alone)
{
  const auto np = parameters_of(method);
  const Mesh rough = jittered(simplified(input, 0.01, np).output, 1e-5, 7);
  if (!is_sound(rough)) return;
  const Simplification s = simplified(rough, 1e-9, np);
  EXPECT_TRUE(have_same_faces(s.input, s.output));
  EXPECT_EQ(s.certificate.operations().collapses, 0u);
  EXPECT_EQ(s.certificate.operations().flips, 0u);
  EXPECT_EQ(s.certificate.operations().relocations, 0u);
  EXPECT_EQ(s.certificate.bound(), 0);
  expect_proof(s);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Repeated,
    testing::Combine(testing::ValuesIn(shapes()), testing::Values(on_surface, free_standard)),
    name_of_shape_and_method);

// ---- at random ----

/// Random faces are gone, as long as the rest is a surface.
Mesh perforated(const Mesh& mesh, std::size_t holes, std::uint64_t seed)
{
  Random random(seed);
  Soup soup = to_soup(mesh);
  std::vector<bool> touched(soup.points.size(), false);
  for (std::size_t v = 0; v < touched.size(); ++v)
    touched[v] = mesh.is_border(Vertex(Mesh::size_type(v)));
  for (; holes > 0 && soup.triangles.size() > 8; --holes) {
    const std::size_t f = random.below(soup.triangles.size());
    const auto t = soup.triangles[f];
    // Holes that share no vertex, nor an edge's ends, leave no vertex pinched.
    if (touched[t[0]] || touched[t[1]] || touched[t[2]]) continue;
    for (const auto v : t) touched[v] = true;
    soup.triangles.erase(soup.triangles.begin() + std::ptrdiff_t(f));
  }
  return to_mesh(soup);
}

class Random_case : public testing::TestWithParam<unsigned>
{};

TEST_P(Random_case, keeps_every_promise)
{
  const std::vector<Method> methods
      = {on_surface_fast, on_surface, free_fast, free_standard, accumulated};
  for (unsigned i = 0; i < 8; ++i) {
    const std::uint64_t seed = 8 * GetParam() + i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Mesh input = random_shape(seed);
    // The best effort takes its time.
    if (i == 0 && input.number_of_faces() > 600) continue;
    if (random.below(2) == 0) input = flipped_at_random(input, input.number_of_edges(), seed);
    if (random.below(3) == 0) input = perforated(input, 1 + random.below(10), seed);
    if (random.below(4) == 0) input = joined({input, translated(icosphere(1, 0.01), {0, 0, 3})});
    if (random.below(3) == 0) input = renumbered(input, seed);
    if (!is_sound(input)) continue; // flips may leave faces without area
    const double tolerance = std::pow(10, random.between(-5, -1)) * diagonal(input);
    const Method& method = i == 0 ? (GetParam() % 2 == 0 ? on_surface_best : free_best)
                                  : methods[random.below(methods.size())];
    const Simplification s = simplified(
        input, tolerance,
        parameters_of(method)
            .feature_angle(random.below(2) == 0 ? 180 : random.between(10, 90))
            .single_precision(random.below(4) == 0)
            .target_faces(random.below(8) == 0 ? random.below(input.number_of_faces()) : 0)
            .shape_floor(std::pow(10, random.between(0, 3)))
            .shape_ratio(random.between(1, 2))
            .roughness_angle(random.between(5, 180))
            .corner_angle(random.between(0, 180))
            .flip_rounds(unsigned(random.below(5))));
    expect_sound(s, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Random_case, testing::Range(0u, 40u));

} // namespace
