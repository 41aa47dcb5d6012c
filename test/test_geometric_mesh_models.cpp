// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geometric mesh of CAD parts, generated and real, and of scans. The real models come with
// Debian's libcgal-demo; SURETY_DATA_DIR names their folder, and without it their tests are
// skipped.
#include <surety/geometric_mesh.h>

#include "cad_meshes.h"
#include "simplification.h"

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <cstdlib>
#include <functional>
#include <optional>

namespace {

using namespace surety::test;
using surety::Deviation_bound;
using surety::make_geometric_mesh;
namespace with = surety::parameters;
using Edge = Mesh::Edge_index;

constexpr double ridge_angle = 40;

// ---- ridges of CAD parts ----

/// A simplification that keeps the ridges, and where they went: edges keep their properties.
struct With_ridges {
  Simplification s;
  Curves before, after;
};

With_ridges simplified_with_ridges(Mesh input, double tolerance, const Method& method)
{
  const auto is_ridge = input.add_property_map<Edge, bool>("e:ridge_of_test", false).first;
  for (const Edge e : input.edges()) is_ridge[e] = dihedral_turn(input, e) > ridge_angle;
  With_ridges result{
      simplified(input, tolerance, parameters_of(method).feature_angle(ridge_angle)), {}, {}};
  const Mesh& output = result.s.output;
  const auto is_kept = output.property_map<Edge, bool>("e:ridge_of_test").first;
  result.before = curves_where(input, [&](Edge e) { return is_ridge[e]; });
  result.after = curves_where(output, [&](Edge e) { return is_kept[e]; });
  return result;
}

/// The points where ridges and borders end, branch or turn by more than the angle (in degrees).
std::vector<Point> corners(const Mesh& mesh, double angle = 60)
{
  std::vector<Point> result;
  for (const Vertex v : mesh.vertices()) {
    std::vector<Vector> ways;
    for (const auto h : CGAL::halfedges_around_target(v, mesh)) {
      const Edge e = mesh.edge(h);
      if (!mesh.is_border(e) && dihedral_turn(mesh, e) <= ridge_angle) continue;
      const Vector way = mesh.point(mesh.source(h)) - mesh.point(v);
      ways.push_back(way / std::sqrt(way.squared_length()));
    }
    // Two ways that go on straight make 180 degrees.
    const bool turns = ways.size() == 2
        && std::acos(std::clamp(-ways[0] * ways[1], -1.0, 1.0)) * 180 / pi > angle + 1e-9;
    if (turns || (!ways.empty() && ways.size() != 2)) result.push_back(mesh.point(v));
  }
  return result;
}

void expect_ridges_kept(const Mesh& input, double tolerance, const Method& method)
{
  const With_ridges r = simplified_with_ridges(input, tolerance, method);
  expect_sound(r.s, 1);
  EXPECT_LE(curve_distance(r.before, r.after), tolerance + sampling_error(input));
  for (const Point& p : corners(input)) EXPECT_TRUE(has_vertex_at(r.s.output, p)) << p;
  if (!r.s.certificate.correspondence()) return;
  EXPECT_EQ(r.s.certificate.correspondence()->ridges.size(), r.before.size());
}

struct Part {
  const char* name;
  std::function<Mesh()> make;
};

void PrintTo(const Part& part, std::ostream* out) { *out << part.name; }

class Cad_part : public testing::TestWithParam<std::tuple<Part, double, Method>>
{};

TEST_P(Cad_part, keeps_its_ridges)
{
  const auto& [part, relative, method] = GetParam();
  const Mesh input = part.make();
  expect_ridges_kept(input, relative * diagonal(input), method);
}

INSTANTIATE_TEST_SUITE_P(
    Parts, Cad_part,
    testing::Combine(
        testing::Values(
            Part{"coarse_part", [] { return cad_part(); }},
            Part{"part", [] { return remeshed(cad_part(), 0.15); }},
            Part{"rotated_part", [] { return rotated(remeshed(cad_part(40), 0.15), 1); }},
            Part{"crossed_blocks", [] { return rotated(remeshed(crossed_blocks(), 0.2), 1); }},
            Part{"cube", [] { return rotated(cube(10), 1); }},
            Part{"cylinder", [] { return rotated(cylinder(60, 15), 1); }},
            Part{"plate", [] { return rotated(subdivided(plate_with_holes(2), 2), 1); }}),
        testing::Values(0.02, 0.002),
        testing::Values(on_surface_fast, on_surface, free_fast, free_standard, accumulated)),
    [](const auto& info) {
      return std::string(std::get<0>(info.param).name)
          + (std::get<1>(info.param) == 0.02 ? "_coarse_" : "_fine_")
          + std::get<2>(info.param).name;
    });

TEST(Flat_parts, end_with_their_corners)
{
  // Only the corners of the solid remain, so that Euler's formula gives the count.
  const auto ideal = [](const Mesh& mesh) {
    return 2 * (long(corners(mesh).size()) - euler_characteristic(mesh));
  };
  for (const Mesh& mesh :
       {crossed_blocks(),
        difference(brick(4, 2, 1), translated(scaled(cube(), 1, 1, 3), Vector(1.3, 0.4, -1)))}) {
    const Mesh input = rotated(remeshed(mesh, 0.2), 1);
    const double tolerance = 1e-4 * diagonal(input);
    for (const double angle : {180.0, ridge_angle}) {
      const Simplification s
          = simplified(input, tolerance, with::feature_angle(angle).shape_floor(1e3));
      EXPECT_LE(s.output.number_of_faces(), 1.05 * double(ideal(mesh))) << angle;
      expect_sound(s, 1);
    }
  }
}

// ---- real models ----

std::optional<Mesh> model(const std::string& name)
{
  const char* folder = std::getenv("SURETY_DATA_DIR");
  Mesh mesh;
  if (folder == nullptr || std::string(folder).empty()) return std::nullopt;
  if (!CGAL::IO::read_polygon_mesh(std::string(folder) + '/' + name + ".off", mesh))
    throw std::runtime_error("cannot read the model " + name);
  return mesh;
}

class Real_model : public testing::TestWithParam<const char*>
{};

TEST_P(Real_model, keeps_every_promise)
{
  const auto input = model(GetParam());
  if (!input) GTEST_SKIP() << "SURETY_DATA_DIR is not set";
  std::size_t previous = 0;
  for (const double relative : {1e-2, 1e-3, 1e-4}) {
    const double tolerance = relative * diagonal(*input);
    const Simplification s = simplified(*input, tolerance);
    expect_sound(s, 1);
    expect_verified_distance(s);
    EXPECT_LE(
        curve_distance(border_curves(*input), border_curves(s.output)),
        tolerance + sampling_error(*input));
    EXPECT_GE(s.output.number_of_faces(), previous);
    previous = s.output.number_of_faces();
  }
}

TEST_P(Real_model, keeps_every_promise_by_other_methods)
{
  const auto input = model(GetParam());
  if (!input) GTEST_SKIP() << "SURETY_DATA_DIR is not set";
  for (const Method& method : {on_surface_fast, free_fast, free_standard, accumulated}) {
    SCOPED_TRACE(method.name);
    const Simplification s = simplified(*input, 1e-3 * diagonal(*input), parameters_of(method));
    expect_sound(s, 1);
    expect_verified_distance(s);
  }
}

TEST_P(Real_model, keeps_its_ridges)
{
  const auto input = model(GetParam());
  if (!input) GTEST_SKIP() << "SURETY_DATA_DIR is not set";
  for (const Method& method : {on_surface, free_standard})
    expect_ridges_kept(*input, 2e-3 * diagonal(*input), method);
}

INSTANTIATE_TEST_SUITE_P(
    Libcgal_demo, Real_model,
    testing::Values(
        "elephant", "fandisk", "rotor_small", "couplingdown", "holes", "knot1", "pig", "joint",
        "part", "eight"),
    [](const auto& info) { return std::string(info.param); });

struct Ceiling {
  const char* model;
  double relative, feature_angle;
  std::size_t faces;
  Method method = on_surface_fast;
};

void PrintTo(const Ceiling& c, std::ostream* out)
{
  *out << c.model << " within " << c.relative << " at " << c.feature_angle << " degrees, "
       << c.method.name;
}

class Face_count : public testing::TestWithParam<Ceiling>
{};

// Figures that this method is known to reach. A change that exceeds one has lost something.
TEST_P(Face_count, stays_below_what_is_known_to_be_reachable)
{
  const auto& [name, relative, angle, faces, method] = GetParam();
  const auto input = model(name);
  if (!input) GTEST_SKIP() << "SURETY_DATA_DIR is not set";
  const Simplification s
      = simplified(*input, relative * diagonal(*input), parameters_of(method).feature_angle(angle));
  EXPECT_LE(s.output.number_of_faces(), faces);
  RecordProperty("faces", int(s.output.number_of_faces()));
  expect_proof(s);
}

INSTANTIATE_TEST_SUITE_P(
    Libcgal_demo, Face_count,
    testing::Values(
        Ceiling{"elephant", 1e-3, 180, 3970}, Ceiling{"fandisk", 1e-3, 180, 530},
        Ceiling{"couplingdown", 1e-3, 180, 3140}, Ceiling{"rotor_small", 1e-3, 180, 940},
        Ceiling{"turbine", 1e-3, 180, 2990}, Ceiling{"holes", 1e-3, 180, 1220},
        Ceiling{"mech-holes-shark", 1e-3, 180, 2320}, Ceiling{"fandisk", 1e-3, 40, 515},
        Ceiling{"anchor_dense", 1e-3, 40, 995}, Ceiling{"fandisk", 1e-2, 180, 140},
        Ceiling{"fandisk", 1e-4, 180, 2260}, Ceiling{"fandisk", 1e-3, 40, 490, on_surface},
        Ceiling{"fandisk", 1e-3, 180, 412, on_surface},
        Ceiling{"couplingdown", 1e-3, 180, 2529, on_surface},
        Ceiling{"rotor_small", 1e-3, 180, 807, on_surface},
        Ceiling{"elephant", 1e-3, 180, 3655, on_surface},
        Ceiling{"fandisk", 1e-3, 180, 348, free_standard},
        Ceiling{"couplingdown", 1e-3, 180, 1882, free_standard},
        Ceiling{"rotor_small", 1e-3, 180, 709, free_standard},
        Ceiling{"elephant", 1e-3, 180, 3094, free_standard}),
    [](const auto& info) {
      std::string name = info.param.model;
      std::replace(name.begin(), name.end(), '-', '_');
      return name + "_within_1_in_" + std::to_string(std::lround(1 / info.param.relative)) + '_'
          + info.param.method.name + (info.param.feature_angle < 180 ? "_with_ridges" : "");
    });

TEST(Blade, that_is_open_and_full_of_slivers_is_no_obstacle)
{
  const auto input = model("blade");
  if (!input) GTEST_SKIP() << "SURETY_DATA_DIR is not set";
  const Simplification s = simplified(*input, 1e-3 * diagonal(*input));
  expect_sound(s, 1);
  expect_verified_distance(s);
  EXPECT_LT(s.output.number_of_faces(), 1000u);
}

TEST(Rotated_model, has_about_as_many_faces)
{
  const auto input = model("rotor_small");
  if (!input) GTEST_SKIP() << "SURETY_DATA_DIR is not set";
  const double tolerance = 1e-3 * diagonal(*input);
  const double here = double(simplified(*input, tolerance).output.number_of_faces());
  for (const Mesh& moved :
       {rotated(*input, 1), rotated(*input, 2), renumbered(*input, 1),
        translated(*input, Vector(1e5, 0, -1e5) * tolerance)}) {
    const Simplification s = simplified(moved, tolerance);
    EXPECT_NEAR(double(s.output.number_of_faces()), here, 0.1 * here);
    expect_proof(s);
  }
}

} // namespace
