// SPDX-License-Identifier: GPL-3.0-or-later
//
// What does gradation cost? Layers in the plane: CPU time, and how many more triangles a mesh needs
// after the gradation is limited, next to the law that MMG 5.8 applies (in its words: along an edge
// the size grows by at most hgrad times the length; where it grows faster, the eigenvalue whose
// direction is closest to the edge is raised; repeated until nothing changes).
#include "program.h"
#include "stopwatch.h"
#include "table.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <surety/gradation.h>
#include <surety/metric.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace surety::benchmark;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vector = Eigen::Vector3d;
using Tensor = Eigen::Matrix3d;
using Plane = Eigen::Matrix2d;
using surety::Metric_field;
using surety::Metric_kind;
namespace with = surety::parameters;

struct Settings {
  double beta = 1.3;
  unsigned cells = 316;
  unsigned sweeps = 100;
};

/// The unit square in n x n cells of two triangles.
Mesh grid(unsigned n)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> at;
  for (unsigned i = 0; i <= n; ++i) {
    for (unsigned j = 0; j <= n; ++j)
      at.push_back(mesh.add_vertex(Point(double(i) / n, double(j) / n, 0)));
  }
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < n; ++j) {
      const auto a = at[i * (n + 1) + j], b = at[(i + 1) * (n + 1) + j];
      const auto c = at[(i + 1) * (n + 1) + j + 1], d = at[i * (n + 1) + j + 1];
      const bool other = (i + j) % 2 == 1;
      mesh.add_face(a, b, other ? d : c);
      mesh.add_face(other ? b : a, c, d);
    }
  }
  return mesh;
}

/// Small sizes across a line or a circle, 0.2 along it.
struct Field {
  std::string name;
  std::function<double(double)> across; ///< by the distance
  bool is_ring;

  Tensor operator()(const Point& p) const
  {
    const Vector x(p.x() - 0.5, p.y() - 0.5, 0);
    Vector normal(-0.479425538604203, 0.8775825618903728, 0); // turned by half a radian
    double distance = std::abs(normal.dot(x));
    if (is_ring) {
      normal = x.norm() > 0 ? x.normalized() : Vector(Vector::UnitX());
      distance = std::abs(x.norm() - 0.3);
    }
    return surety::internal::metric::tangential(Vector::UnitZ(), normal, across(distance), 0.2);
  }
};

std::vector<Field> fields()
{
  const auto jump = [](double d) { return d < 0.05 ? 0.01 : 0.2; };
  const auto gentle = [](double d) { return std::min(0.01 + 0.3 * d, 0.2); };
  const auto steep = [](double d) { return std::min(0.005 + d, 0.2); };
  return {
      {"gentle layer", gentle, false},
      {"steep layer", steep, false},
      {"jump at a layer", jump, false},
      {"gentle ring", gentle, true},
      {"steep ring", steep, true}};
}

double unit_triangles(const Mesh& mesh, const std::vector<Plane>& tensors)
{
  double sum = 0;
  for (const auto f : mesh.faces()) {
    const auto first = mesh.halfedge(f);
    const double area = std::sqrt(CGAL::squared_area(
        mesh.point(mesh.source(first)), mesh.point(mesh.target(first)),
        mesh.point(mesh.target(mesh.next(first)))));
    for (const auto v : mesh.vertices_around_face(first)) {
      sum += area / 3 * std::sqrt(tensors[v].determinant());
    }
  }
  return sum / (std::sqrt(3.) / 4);
}

std::vector<Plane> plane_tensors(const Mesh& mesh, const Metric_field& metric)
{
  std::vector<Plane> result;
  for (const auto v : mesh.vertices())
    result.push_back(metric.tensor_at_vertex(v).topLeftCorner<2, 2>());
  return result;
}

/// One edge of MMG's law: whether the metric of one of its ends had to change.
bool limit_edge(
    std::vector<Plane>& tensors, unsigned p, unsigned q, const Eigen::Vector2d& e, double slope)
{
  const double length = e.norm();
  const Eigen::Vector2d t = e / length;
  const double at_p = std::sqrt(t.dot(tensors[p] * t)), at_q = std::sqrt(t.dot(tensors[q] * t));
  const unsigned changed = at_q > at_p ? p : q;
  const double smaller = std::min(at_p, at_q), larger = std::max(at_p, at_q);
  const double wanted = larger / (1 + slope * length * larger);
  if (smaller >= wanted - 1e-6) return false;
  const Eigen::SelfAdjointEigenSolver<Plane> solver(tensors[changed]);
  const Eigen::Vector2d along = solver.eigenvectors().transpose() * t;
  Eigen::Vector2d lambda = solver.eigenvalues();
  const int closest = std::abs(along[1]) > std::abs(along[0]) ? 1 : 0;
  lambda[closest] += (wanted * wanted - smaller * smaller) / (along[closest] * along[closest]);
  tensors[changed]
      = solver.eigenvectors() * lambda.asDiagonal() * solver.eigenvectors().transpose();
  return true;
}

/// Returns the number of sweeps.
unsigned limit_as_mmg(const Mesh& mesh, std::vector<Plane>& tensors, double slope, unsigned most)
{
  for (unsigned sweep = 1; sweep <= most; ++sweep) {
    bool has_changed = false;
    for (const auto e : mesh.edges()) {
      const auto h = mesh.halfedge(e);
      const auto d = mesh.point(mesh.target(h)) - mesh.point(mesh.source(h));
      has_changed |= limit_edge(
          tensors, mesh.source(h), mesh.target(h), Eigen::Vector2d(d.x(), d.y()), slope);
    }
    if (!has_changed) return sweep;
  }
  return most;
}

double median_aspect(const std::vector<Plane>& tensors)
{
  std::vector<double> ratios;
  for (const Plane& m : tensors) {
    const Eigen::SelfAdjointEigenSolver<Plane> solver(m, Eigen::EigenvaluesOnly);
    ratios.push_back(std::sqrt(solver.eigenvalues()[1] / solver.eigenvalues()[0]));
  }
  return median(ratios);
}

void compare(
    const Mesh& mesh, const surety::Sides& sides, const Field& field, const Settings& settings,
    const Table& table)
{
  Metric_field metric = make_metric(mesh, sides, field);
  std::vector<Plane> given = plane_tensors(mesh, metric), as_mmg = given;
  const double before = unit_triangles(mesh, given);
  const auto row = [&](const std::string& method, double seconds, unsigned sweeps,
                       const std::vector<Plane>& tensors) {
    table.add(
        {{"field", field.name},
         {"vertices", std::to_string(mesh.number_of_vertices())},
         {"method", method},
         {"seconds", std::to_string(seconds)},
         {"sweeps", std::to_string(sweeps)},
         {"triangles", std::to_string(unit_triangles(mesh, tensors))},
         {"over_ungraded", std::to_string(unit_triangles(mesh, tensors) / before)},
         {"median_aspect_ratio", std::to_string(median_aspect(tensors))}});
  };
  row("none", 0, 0, given);
  const double seconds
      = seconds_of([&] { limit_gradation(mesh, metric, with::gradation(settings.beta)); });
  row("limit_gradation", seconds, 0, plane_tensors(mesh, metric));
  unsigned sweeps = 0;
  const double mmg_seconds = seconds_of(
      [&] { sweeps = limit_as_mmg(mesh, as_mmg, std::log(settings.beta), settings.sweeps); });
  row("law_of_mmg", mmg_seconds, sweeps, as_mmg);
}

/// Sizes that break the law nearly everywhere, which is the most expensive case.
void time_isotropic(
    const Mesh& mesh, const surety::Sides& sides, const Settings& settings, const Table& table)
{
  const auto size = [](const Point& p) {
    return 0.002 + 0.05 * std::abs(std::sin(20 * p.x()) * std::sin(15 * p.y()));
  };
  Metric_field metric = make_metric(mesh, sides, size, with::metric_kind(Metric_kind::isotropic));
  const double before = unit_triangles(mesh, plane_tensors(mesh, metric));
  const double seconds
      = seconds_of([&] { limit_gradation(mesh, metric, with::gradation(settings.beta)); });
  const double after = unit_triangles(mesh, plane_tensors(mesh, metric));
  table.add(
      {{"field", "isotropic waves"},
       {"vertices", std::to_string(mesh.number_of_vertices())},
       {"method", "limit_gradation"},
       {"seconds", std::to_string(seconds)},
       {"triangles", std::to_string(after)},
       {"over_ungraded", std::to_string(after / before)}});
}

int run(int argc, char* argv[])
{
  CLI::App program(
      "Prints what it costs to limit the gradation of metrics on a grid, in CPU seconds and in "
      "triangles, and what MMG's law costs there.");
  Settings settings;
  program.add_option("--gradation", settings.beta, "Limit")->capture_default_str();
  program.add_option("--cells", settings.cells, "A side of the grid")->capture_default_str();
  program.add_option("--sweeps", settings.sweeps, "Of MMG's law, at most")->capture_default_str();
  parse_or_exit(program, argc, argv);

  const Table table(
      {"field", "vertices", "method", "seconds", "sweeps", "triangles", "over_ungraded",
       "median_aspect_ratio"});
  const Mesh mesh = grid(settings.cells);
  const auto sides = find_sides(mesh, surety::find_features(mesh));
  for (const Field& field : fields()) compare(mesh, sides, field, settings, table);
  time_isotropic(mesh, sides, settings, table);
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
