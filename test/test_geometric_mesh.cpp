// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric mesh of generated shapes: what it promises holds for every shape, tolerance, bound
// and feature angle, wherever the shape lies, however large it is and in whatever order it comes.
#include <surety/geometric_mesh.h>

#include "simplification.h"

#include <functional>
#include <sstream>
#include <tuple>

namespace {

using namespace surety::test;
using surety::Deviation_bound;
using surety::make_geometric_mesh;
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

// ---- every shape at every tolerance under every bound ----

class Any_shape : public testing::TestWithParam<std::tuple<Shape, double, Deviation_bound, double>>
{};

TEST_P(Any_shape, keeps_every_promise)
{
  const auto& [shape, relative, bound, angle] = GetParam();
  const Mesh input = shape.make();
  const double tolerance = relative * diagonal(input);
  const Simplification s
      = simplified(input, tolerance, with::deviation_bound(bound).feature_angle(angle));
  EXPECT_EQ(s.certificate.tolerance(), tolerance);
  EXPECT_FALSE(s.certificate.is_cancelled());
  EXPECT_EQ(s.certificate.correspondence().has_value(), bound == Deviation_bound::direct);
  expect_sound(s);
  expect_verified_distance(s);
  EXPECT_LE(
      curve_distance(border_curves(s.output), border_curves(input)),
      tolerance + sampling_error(input));
}

std::string name_of(const testing::TestParamInfo<Any_shape::ParamType>& info)
{
  const auto& [shape, relative, bound, angle] = info.param;
  std::ostringstream name;
  name << shape.name << "_within_1_in_" << std::lround(1 / relative)
       << (bound == Deviation_bound::direct ? "_direct" : "_accumulated")
       << (angle < 180 ? "_with_ridges" : "");
  return name.str();
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Any_shape,
    testing::Combine(
        testing::ValuesIn(shapes()), testing::Values(0.03, 0.003, 0.0003),
        testing::Values(Deviation_bound::direct, Deviation_bound::accumulated),
        testing::Values(180.0, 40.0)),
    name_of);

// ---- how few faces remain ----

TEST(Fewest_faces, a_flat_square_ends_with_two)
{
  // No shape limit stands in the way: both triangles have Q = 2.09.
  for (const double tolerance : {1e-6, 1e-2}) {
    EXPECT_EQ(simplified(grid(20), tolerance).output.number_of_faces(), 2u);
    EXPECT_EQ(simplified(rotated(grid(20), 1), tolerance).output.number_of_faces(), 2u);
  }
}

TEST(Fewest_faces, a_polyhedron_ends_with_its_corners)
{
  // Only corners remain, so that Euler's formula gives the count: F = 2 (V - chi).
  const auto faces = [](const Mesh& mesh, double angle) {
    return simplified(mesh, 1e-6, with::feature_angle(angle).shape_floor(100))
        .output.number_of_faces();
  };
  for (const double angle : {180.0, 40.0}) {
    EXPECT_EQ(faces(cube(8), angle), 12u);
    EXPECT_EQ(faces(rotated(cube(8), 1), angle), 12u);
    EXPECT_EQ(faces(rotated(subdivided(brick(4, 2, 1), 2), 1), angle), 12u);
    EXPECT_LE(faces(rotated(split_at_random(cube(), 500, 1), 1), angle), 14u);
    for (int holes = 1; holes <= 3; ++holes) {
      const auto ideal = unsigned(2 * (8 + 8 * holes - (2 - 2 * holes)));
      EXPECT_LE(faces(subdivided(plate_with_holes(holes), 2), angle), 1.1 * ideal);
    }
  }
}

TEST(Fewest_faces, a_polyhedron_of_corners_only_stays_as_it_is)
{
  for (const Mesh& mesh : {cube(), rotated(cube(), 1)}) {
    for (const double tolerance : {1e-6, 0.01, 0.1}) {
      const Simplification s = simplified(mesh, tolerance);
      EXPECT_TRUE(have_same_faces(s.input, s.output));
      EXPECT_EQ(s.certificate.bound(), 0);
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
  std::size_t previous = 0;
  for (const double delta : {0.08, 0.04, 0.02, 0.01}) {
    const Simplification s = simplified(jittered_sphere(5, 1), delta);
    const double limit = 4 * pi / (1.5 * std::sqrt(3) * delta);
    EXPECT_LE(double(s.output.number_of_faces()), 2 * limit) << delta;
    EXPECT_GE(double(s.output.number_of_faces()), limit) << delta;
    // Halving the tolerance doubles the count.
    const double growth = double(s.output.number_of_faces()) / double(previous);
    EXPECT_TRUE(previous == 0 || (growth > 1.7 && growth < 2.3)) << growth;
    previous = s.output.number_of_faces();
  }
}

TEST(Fewest_faces, a_component_within_the_tolerance_shrinks_but_stays)
{
  for (const Deviation_bound bound : {Deviation_bound::direct, Deviation_bound::accumulated}) {
    const Simplification s = simplified(
        spheres_at_scales(6), 0.01,
        with::deviation_bound(bound).roughness_angle(180).shape_floor(1e9));
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
  for (const double tolerance : {0.005, 0.02, 0.1}) {
    const Simplification s = simplified(needle_on_sphere(0.001, 1), tolerance);
    double tip = 0;
    for (const Vertex v : s.output.vertices())
      tip = std::max(tip, std::sqrt((s.output.point(v) - CGAL::ORIGIN).squared_length()));
    EXPECT_GE(tip, 2 - 1e-3 - tolerance);
    expect_sound(s);
  }
}

TEST(Thin_features, a_fin_thinner_than_the_tolerance_stays)
{
  const Mesh input = fin(0.001, 0.5);
  for (const double tolerance : {0.005, 0.02, 0.1}) {
    const Simplification s = simplified(input, tolerance);
    EXPECT_LE(sampled_distance_to(input, s.output, 1, 6), tolerance);
    EXPECT_EQ(number_of_self_intersections(s.output), 0u);
  }
}

TEST(Thin_features, sheets_closer_than_the_tolerance_do_not_cross)
{
  for (const double gap : {1e-2, 1e-4}) {
    const Mesh bent = mapped(two_sheets(16, gap), [](const Point& p) {
      return Point(p.x(), p.y(), p.z() + 0.2 * std::sin(5 * p.x()) * std::cos(4 * p.y()));
    });
    const Simplification s = simplified(bent, 0.03);
    EXPECT_EQ(number_of_self_intersections(s.output), 0u);
    EXPECT_LT(s.output.number_of_faces(), bent.number_of_faces());
    expect_sound(s);
  }
}

// ---- scale, position, orientation, order ----

class Moved_shape : public testing::TestWithParam<Shape>
{
protected:
  const Mesh input = GetParam().make();
  const double tolerance = 0.004 * diagonal(input);
};

TEST_P(Moved_shape, scaling_by_a_power_of_two_changes_nothing_else)
{
  for (const Deviation_bound bound : {Deviation_bound::direct, Deviation_bound::accumulated}) {
    const auto np = with::deviation_bound(bound).feature_angle(40);
    const Simplification unscaled = simplified(input, tolerance, np);
    // The extreme ones take the bounding box to about 1e-90 and 1e90.
    for (const double factor : {0x1p10, 0x1p-10, 0x1p130, 0x1p-130, 0x1p300, 0x1p-300}) {
      const Simplification s = simplified(scaled(input, factor), factor * tolerance, np);
      EXPECT_TRUE(is_identical(scaled(unscaled.output, factor), s.output)) << factor;
      EXPECT_EQ(s.certificate.bound(), factor * unscaled.certificate.bound()) << factor;
      expect_proof(s);
    }
  }
}

TEST_P(Moved_shape, translation_keeps_it_sound)
{
  const std::size_t here = simplified(input, tolerance).output.number_of_faces();
  for (const Vector& move : {Vector(1, 2, -3), Vector(1e3, 0, 1e3), Vector(1e6, -1e6, 1e6)}) {
    const Simplification s = simplified(translated(input, move), tolerance);
    expect_sound(s, 1);
    const double there = double(s.output.number_of_faces());
    EXPECT_NEAR(there, double(here), 0.1 * double(here) + 8) << move;
  }
}

TEST_P(Moved_shape, rotation_hardly_changes_the_count)
{
  const double here = double(simplified(input, tolerance).output.number_of_faces());
  for (const unsigned seed : {1u, 2u}) {
    const Simplification s = simplified(rotated(input, seed), tolerance);
    expect_sound(s, 1);
    EXPECT_NEAR(double(s.output.number_of_faces()), here, 0.1 * here + 8) << seed;
  }
}

TEST_P(Moved_shape, renumbering_hardly_changes_the_count)
{
  const double here = double(simplified(input, tolerance).output.number_of_faces());
  for (const unsigned seed : {1u, 2u}) {
    const Simplification s = simplified(renumbered(input, seed), tolerance);
    expect_sound(s, 1);
    EXPECT_NEAR(double(s.output.number_of_faces()), here, 0.1 * here + 8) << seed;
  }
}

TEST_P(Moved_shape, reversal_hardly_changes_the_count)
{
  const double here = double(simplified(input, tolerance).output.number_of_faces());
  const Simplification s = simplified(reversed(input), tolerance);
  expect_sound(s, 1);
  EXPECT_NEAR(double(s.output.number_of_faces()), here, 0.1 * here + 8);
}

TEST_P(Moved_shape, two_runs_give_the_same_bits)
{
  const auto np = with::feature_angle(40);
  const Simplification first = simplified(input, tolerance, np),
                       second = simplified(input, tolerance, np);
  EXPECT_TRUE(fingerprint(first.output) == fingerprint(second.output));
  std::ostringstream a, b;
  write_certificate(a, first.certificate);
  write_certificate(b, second.certificate);
  EXPECT_EQ(a.str(), b.str());
  EXPECT_EQ(deviations(first.output), deviations(second.output));
}

INSTANTIATE_TEST_SUITE_P(Shapes, Moved_shape, testing::ValuesIn(shapes()), [](const auto& info) {
  return std::string(info.param.name);
});

TEST(Far_from_the_origin, a_tolerance_below_the_rounding_is_still_kept)
{
  // At 2^40 neighbouring doubles are 2^-12 apart.
  const Mesh far = translated(grid(8), Vector(0x1p40, 0, 0));
  for (const double tolerance : {0x1p-6, 0x1p-10, 0x1p-14, 0x1p-20}) {
    for (const Deviation_bound bound : {Deviation_bound::direct, Deviation_bound::accumulated}) {
      const Simplification s = simplified(far, tolerance, with::deviation_bound(bound));
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
    for (const Deviation_bound bound : {Deviation_bound::direct, Deviation_bound::accumulated}) {
      for (const double tolerance : {smallest, 1e-310, 1e-200, 1e-30 * factor}) {
        const Simplification s = simplified(sphere, tolerance, with::deviation_bound(bound));
        EXPECT_TRUE(have_same_faces(s.input, s.output)) << tolerance << " at " << factor;
        EXPECT_EQ(s.certificate.bound(), 0);
        expect_proof(s);
      }
      for (const double tolerance : {1e30 * factor, largest}) {
        const Simplification s = simplified(sphere, tolerance, with::deviation_bound(bound));
        expect_proof(s);
        // No point of a sphere is farther from another than the diameter.
        EXPECT_LE(s.certificate.bound(), 2.0001 * factor);
        EXPECT_LT(s.output.number_of_faces(), 100u);
      }
    }
  }
}

// ---- again ----

class Repeated : public testing::TestWithParam<Shape>
{};

TEST_P(Repeated, simplification_adds_at_most_the_bounds)
{
  const Mesh input = GetParam().make();
  const double tolerance = 0.003 * diagonal(input);
  Mesh mesh = input;
  double sum = 0;
  std::size_t faces = 0;
  for (int pass = 0; pass < 3; ++pass) {
    const Simplification s = simplified(mesh, tolerance);
    sum += s.certificate.bound();
    mesh = s.output;
    faces = s.output.number_of_faces();
    EXPECT_LE(sampled_distance(input, mesh, 1, 2), sum + sampling_error(input));
  }
  EXPECT_GT(faces, 0u);
}

TEST_P(Repeated, a_tiny_tolerance_leaves_a_rough_mesh_alone)
{
  const Mesh rough = jittered(simplified(GetParam().make(), 0.01).output, 1e-5, 7);
  if (!is_sound(rough)) return;
  const Simplification s = simplified(rough, 1e-9);
  EXPECT_TRUE(have_same_faces(s.input, s.output));
  EXPECT_EQ(s.certificate.operations().collapses, 0u);
  EXPECT_EQ(s.certificate.operations().flips, 0u);
  EXPECT_EQ(s.certificate.bound(), 0);
  expect_proof(s);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Repeated, testing::ValuesIn(shapes()), [](const auto& info) {
  return std::string(info.param.name);
});

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
  for (unsigned i = 0; i < 8; ++i) {
    const std::uint64_t seed = 8 * GetParam() + i;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Mesh input = random_shape(seed);
    if (random.below(2) == 0) input = flipped_at_random(input, input.number_of_edges(), seed);
    if (random.below(3) == 0) input = perforated(input, 1 + random.below(10), seed);
    if (random.below(4) == 0) input = joined({input, translated(icosphere(1, 0.01), {0, 0, 3})});
    if (random.below(3) == 0) input = renumbered(input, seed);
    if (!is_sound(input)) continue; // flips may leave faces without area
    const double tolerance = std::pow(10, random.between(-5, -1)) * diagonal(input);
    const Simplification s = simplified(
        input, tolerance,
        with::feature_angle(random.below(2) == 0 ? 180 : random.between(10, 90))
            .deviation_bound(
                random.below(3) == 0 ? Deviation_bound::accumulated : Deviation_bound::direct)
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
