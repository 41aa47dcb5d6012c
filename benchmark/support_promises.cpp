// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does the geometric support keep its promises? Makes it of every mesh of a folder, at several
// tolerances and with several normals, and checks what it says of itself: tangent planes that
// agree, interpolation, and the distance by proof of another program and by dense sampling. A mesh
// that is refused is a row with the message.
#include "models.h"
#include "program.h"
#include "stopwatch.h"
#include "table.h"

#include <surety/curvature.h>
#include <surety/distance.h>
#include <surety/features_by_need.h>
#include <surety/geometric_support.h>
#include <surety/support_tessellation.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace surety::benchmark;
using surety::Features;
using surety::Geometric_support;
using surety::Support_location;
using Vector = Eigen::Vector3d;

struct Settings {
  std::vector<std::string> models;
  std::vector<double> tolerances = {1, 0.1};
  std::vector<std::string> normals = {"fitted"};
  std::size_t subdivisions = 2, samples = 12;
};

/// One support of one model.
struct Case {
  const Mesh& mesh;
  const Features& features;
  double tolerance;
  Geometric_support support;
};

Geometric_support make_support(
    const Mesh& mesh, double tolerance, const Features& features, const std::string& kind)
{
  if (kind == "max") return surety::make_geometric_support(mesh, tolerance, features);
  const double floor = kind == "smoothed" ? tolerance / 3 : 0;
  const auto curvature
      = surety::estimate_curvatures(mesh, features, surety::parameters::noise_floor(floor));
  return surety::make_geometric_support(mesh, tolerance, features, curvature);
}

double angle(const Vector& a, const Vector& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

Vector point_of(const Mesh& mesh, std::uint32_t v)
{
  const Point& p = mesh.point(Mesh::Vertex_index(v));
  return {p.x(), p.y(), p.z()};
}

Vector flat_point(const Case& c, const Support_location& at)
{
  const auto corner = c.support.corners(at.face);
  Vector sum = Vector::Zero();
  for (int i = 0; i < 3; ++i) sum += at.barycentric[i] * point_of(c.mesh, corner[i]);
  return sum;
}

/// What is seen along the edges that are no features.
struct Tangents {
  std::size_t points = 0, smooth_points = 0;
  double worst_angle = 0, worst_gap = 0;
};

/// A point of an edge is smooth by promise where both faces are tangent to their normals and the
/// displacement does not saturate.
Tangents tangents(const Case& c)
{
  constexpr std::array<double, 5> parameters = {0.03, 0.25, 0.5, 0.71, 0.96};
  // Of half the tolerance, less 2^-20 of it.
  const double start = 0.75 * c.tolerance / 2 * (1 - 0x1p-19);
  Tangents result;
  for (const auto e : c.mesh.edges()) {
    if (c.support.is_feature(e)) continue;
    for (const double t : parameters) {
      const auto here = c.support.location_on_edge(e, t);
      int zero = 0;
      here.barycentric.minCoeff(&zero);
      const auto there = c.support.across(here, (zero + 1) % 3);
      const Vector point = c.support.position(here);
      ++result.points;
      result.worst_gap = (std::max)(result.worst_gap, (point - c.support.position(there)).norm());
      const bool is_smooth = c.support.patch_state(here.face).is_tangent
          && c.support.patch_state(there.face).is_tangent
          && (point - flat_point(c, here)).norm() <= start;
      if (!is_smooth) continue;
      ++result.smooth_points;
      result.worst_angle
          = (std::max)(result.worst_angle, angle(c.support.normal(here), c.support.normal(there)));
    }
  }
  return result;
}

/// How far a dense lattice of points goes beyond what is promised for each face and for all.
struct Excess {
  double largest = 0;       ///< displacement
  double beyond_face = -1;  ///< the bound of the face
  double from_vertices = 0; ///< of the support from the vertices that it interpolates
};

Excess excess(const Case& c, std::size_t samples)
{
  Excess result;
  for (const auto& at : surety::tessellate(c.support, samples).location) {
    const double moved = (c.support.position(at) - flat_point(c, at)).norm();
    result.largest = (std::max)(result.largest, moved);
    result.beyond_face
        = (std::max)(result.beyond_face, moved - c.support.displacement_bound(at.face));
    if (at.barycentric.maxCoeff() == 1)
      result.from_vertices = (std::max)(result.from_vertices, moved);
  }
  return result;
}

/// Proven by `certify_distance()`, which knows nothing of supports.
double certified_distance(const Case& c, std::size_t subdivisions)
{
  const auto pieces = surety::tessellate(c.support, subdivisions);
  Mesh drawn;
  for (const auto& at : pieces.location) {
    const Vector p = c.support.position(at);
    drawn.add_vertex(Point(p.x(), p.y(), p.z()));
  }
  for (const auto& [a, b, d] : pieces.triangle)
    drawn.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(d));
  return surety::certify_distance(c.mesh, drawn, c.tolerance * 0.51).upper_bound();
}

/// Whether all promises were kept.
bool measure(
    const std::string& name, const Mesh& mesh, double per_cent, const std::string& kind,
    const Settings& settings, const Table& table)
{
  const double size = diagonal(mesh), tolerance = per_cent / 100 * size;
  const Features features = surety::find_features_by_need(mesh, tolerance);
  const Stopwatch stopwatch;
  const Case c{mesh, features, tolerance, make_support(mesh, tolerance, features, kind)};
  const double seconds = stopwatch.seconds();
  const auto& report = c.support.report();
  const Tangents seen = tangents(c);
  const Excess sampled = excess(c, settings.samples);
  const double certified = certified_distance(c, settings.subdivisions);
  double reach = size; // of coordinates, which may lie far from the origin
  for (const auto v : mesh.vertices())
    reach = (std::max)(reach, point_of(mesh, v).cwiseAbs().maxCoeff());
  const double rounding = 1e-14 * reach;

  std::string problems;
  const auto require = [&](bool condition, const char* problem) {
    if (!condition) problems += (problems.empty() ? "" : "; ") + std::string(problem);
  };
  require(seen.worst_angle <= 1e-8, "normals disagree");
  require(seen.worst_gap <= rounding, "patches do not meet");
  require(sampled.from_vertices <= rounding, "a vertex is not interpolated");
  require(sampled.largest <= report.deviation + rounding, "farther than the deviation");
  require(sampled.beyond_face <= rounding, "farther than the bound of a face");
  require(report.deviation <= tolerance, "outside the tolerance");
  require(certified <= tolerance, "not certified");
  table.add(
      {{"model", name},
       {"faces", std::to_string(report.faces)},
       {"tolerance_per_cent", to_text(per_cent)},
       {"normals", kind},
       {"ridges", std::to_string(features.ridges)},
       {"seconds", to_text(seconds)},
       {"g1_share_of_edges",
        to_text(seen.points == 0 ? 1 : double(seen.smooth_points) / double(seen.points))},
       {"worst_angle", to_text(seen.worst_angle)},
       {"smooth_share", to_text(report.tangent_share)},
       {"smooth_share_sampled", to_text(report.sampled_tangent_share)},
       {"saturated_share", to_text(report.saturated_share)},
       {"saturated_share_sampled", to_text(report.sampled_saturated_share)},
       {"refused_share", to_text(report.refused_share)},
       {"misaligned_sides", std::to_string(report.misaligned_sides)},
       {"deviation_over_tolerance", to_text(report.deviation / tolerance)},
       {"certified_over_tolerance", to_text(certified / tolerance)},
       {"sampled_over_deviation",
        to_text(report.deviation > 0 ? sampled.largest / report.deviation : 0)},
       {"problems", problems}});
  return problems.empty();
}

int run(int argc, char* argv[])
{
  CLI::App program("Makes the geometric support of meshes, all of the folder by default, and "
                   "checks its promises: "
                   "tangent planes, interpolation, distance. Ends with status 1 if one is broken.");
  Settings settings;
  const Models models(program);
  add_models(program, settings.models);
  add_tolerances(program, settings.tolerances);
  program
      .add_option(
          "--normals", settings.normals,
          "max: of the faces; fitted: of the curvature; smoothed: fitted with a noise floor of a "
          "third of the tolerance")
      ->delimiter(',')
      ->check(CLI::IsMember({"max", "fitted", "smoothed"}))
      ->capture_default_str();
  parse_or_exit(program, argc, argv);

  const Table table(
      {"model", "faces", "tolerance_per_cent", "normals", "ridges", "seconds", "g1_share_of_edges",
       "worst_angle", "smooth_share", "smooth_share_sampled", "saturated_share",
       "saturated_share_sampled", "refused_share", "misaligned_sides", "deviation_over_tolerance",
       "certified_over_tolerance", "sampled_over_deviation", "problems"});
  std::vector<std::string> paths;
  for (const auto& model : settings.models) paths.push_back(models.path(model));
  if (paths.empty()) paths = models.all();
  bool is_kept = true;
  for (const auto& path : paths) {
    try {
      const Mesh mesh = surety::tool::read_mesh(path, {});
      for (const double tolerance : settings.tolerances) {
        for (const auto& kind : settings.normals)
          is_kept &= measure(model_name(path), mesh, tolerance, kind, settings, table);
      }
    } catch (const std::exception& error) {
      table.add(
          {{"model", model_name(path)}, {"problems", std::string("refused: ") + error.what()}});
    }
  }
  return is_kept ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
