// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far from the least number of faces that theory allows? On a strictly convex surface a regular
// triangulation with its vertices on the surface and gap delta has
//
//   integral of sqrt(K) dA / (1.5 sqrt(3) delta)
//
// faces, K being the Gaussian curvature; half as many where vertices may lie as far outside as the
// faces lie inside. No triangulation of a general surface has as few, so the limit is an indication
// and not a bound for models that are not as round as these.
#include "distances.h"
#include "program.h"
#include "refinement.h"
#include "simplification.h"
#include "stopwatch.h"
#include "table.h"

#include <CGAL/Surface_mesh.h>

#include <CGAL/boost/graph/generators.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace surety::benchmark;

struct Shape {
  std::string name;
  std::array<double, 3> axes;
};

struct Settings {
  std::vector<double> tolerances = {0.1};
  unsigned subdivisions = 6;
  bool with_best = false;
};

/// An icosahedron that is split and pushed out to the unit sphere, then stretched.
Mesh ellipsoid(const Shape& shape, unsigned subdivisions)
{
  Mesh mesh;
  CGAL::make_icosahedron<Mesh, Point>(mesh);
  const auto push_out = [&] {
    for (const auto v : mesh.vertices()) {
      const Kernel::Vector_3 x = mesh.point(v) - CGAL::ORIGIN;
      mesh.point(v) = CGAL::ORIGIN + x / std::sqrt(x.squared_length());
    }
  };
  push_out();
  for (unsigned i = 0; i < subdivisions; ++i) {
    mesh = split_in_four(mesh);
    push_out();
  }
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    mesh.point(v) = Point(shape.axes[0] * p.x(), shape.axes[1] * p.y(), shape.axes[2] * p.z());
  }
  return mesh;
}

/// The integral of sqrt(K) over x^2/a^2 + y^2/b^2 + z^2/c^2 = 1, by the midpoints of the faces:
/// K = 1 / (a b c (x^2/a^4 + y^2/b^4 + z^2/c^4))^2.
double integral_of_curvature(const Mesh& mesh, const Shape& shape)
{
  const auto [a, b, c] = shape.axes;
  double sum = 0;
  for (const auto f : mesh.faces()) {
    std::array<Point, 3> p;
    std::size_t i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) p[i++] = mesh.point(v);
    const Point m = CGAL::centroid(p[0], p[1], p[2]);
    const double q = m.x() * m.x() / std::pow(a, 4) + m.y() * m.y() / std::pow(b, 4)
        + m.z() * m.z() / std::pow(c, 4);
    sum += std::sqrt(CGAL::squared_area(p[0], p[1], p[2])) / (a * b * c * q);
  }
  return sum;
}

void run_shape(const Shape& shape, const Settings& settings, const Table& table)
{
  using surety::Effort;
  using surety::Placement;
  const Mesh input = ellipsoid(shape, settings.subdivisions);
  const double integral = integral_of_curvature(input, shape);
  for (const double per_cent : settings.tolerances)
    for (const Placement placement : {Placement::on_surface, Placement::free})
      for (const Effort effort : {Effort::fast, Effort::standard, Effort::best}) {
        if (effort == Effort::best && !settings.with_best) continue;
        const bool is_free = placement == Placement::free;
        const double tolerance = per_cent / 100 * diagonal(input);
        const double limit = integral / (1.5 * std::sqrt(3) * tolerance) / (is_free ? 2 : 1);
        Mesh output = input;
        Controls controls;
        controls.placement = placement;
        controls.effort = effort;
        const Stopwatch stopwatch;
        const auto certificate = simplify(output, tolerance, controls);
        const double seconds = stopwatch.seconds();
        const Distance distance = measure_distance(input, output, tolerance);
        const auto faces = static_cast<double>(output.number_of_faces());
        table.add(
            {{"shape", shape.name},
             {"input_faces", std::to_string(input.number_of_faces())},
             {"tolerance_per_cent", to_text(per_cent)},
             {"placement", is_free ? "free" : "on-surface"},
             {"effort", name_of(effort)},
             {"faces", std::to_string(output.number_of_faces())},
             {"limit", to_text(limit)},
             {"faces_over_limit", to_text(faces / limit)},
             {"seconds", to_text(seconds)},
             {"certified_over_tolerance", to_text(certificate.bound() / tolerance)},
             {"distance_over_tolerance", to_text(distance.upper / tolerance)}});
      }
}

int run(int argc, char* argv[])
{
  CLI::App program(
      "Prints the number of faces on sphere and ellipsoids next to the least that theory allows.");
  Settings settings;
  add_tolerances(program, settings.tolerances);
  program
      .add_option("--subdivisions", settings.subdivisions, "Of the icosahedron: 20 4^n input faces")
      ->check(CLI::Range(1, 9))
      ->capture_default_str();
  program.add_flag("--best", settings.with_best, "Run the best effort too: minutes");
  parse_or_exit(program, argc, argv);

  const Table table(
      {"shape", "input_faces", "tolerance_per_cent", "placement", "effort", "faces", "limit",
       "faces_over_limit", "seconds", "certified_over_tolerance", "distance_over_tolerance"});
  for (const Shape& shape :
       {Shape{"sphere", {1, 1, 1}}, Shape{"ellipsoid", {1, 0.7, 0.5}},
        Shape{"long_ellipsoid", {1, 0.4, 0.4}}})
    run_shape(shape, settings, table);
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
