// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good is the geometric support, and how fast are its answers? On analytic surfaces: order of
// convergence and error, next to PN triangles. On models: what of the area is smooth, saturated or
// refused, and microseconds a query. Steps of a table's rows: "surface" or a model.
#include "models.h"
#include "program.h"
#include "stopwatch.h"
#include "table.h"

#include "support_surfaces.h"

#include <surety/curvature_field.h>
#include <surety/features_by_need.h>
#include <surety/geometric_support.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace surety::benchmark;
namespace shapes = surety::test;
using shapes::Vec;
using surety::Geometric_support;

struct Settings {
  std::vector<std::string> models
      = {"fandisk", "anchor_dense", "couplingdown", "elephant", "bunny00", "armadillo"};
  std::vector<double> tolerances = {1, 0.1};
  std::size_t queries = 20000;
};

std::string text(double value)
{
  std::ostringstream stream;
  stream.precision(4);
  stream << value;
  return stream.str();
}

/// A surface with meshes of growing fineness.
struct Surface {
  std::string name;
  shapes::Analytic exact;
  std::function<shapes::Mesh(int)> mesh;
};

std::vector<Surface> surfaces()
{
  return {
      {"sphere, regular", shapes::unit_sphere(), [](int k) { return shapes::icosphere(k + 2); }},
      {"sphere, jittered", shapes::unit_sphere(),
       [](int k) { return shapes::jittered_sphere(k + 2, 1); }},
      {"torus, regular", shapes::analytic_torus(),
       [](int k) { return shapes::torus(32u << k, 16u << k); }},
      {"torus, jittered", shapes::analytic_torus(),
       [](int k) { return shapes::jittered_torus(32u << k, 1); }}};
}

void measure_order(const Surface& surface, const Table& table)
{
  shapes::Errors coarser{0, 0};
  for (int k = 0; k < 4; ++k) {
    const shapes::Mesh mesh = surface.mesh(k);
    const auto ours = shapes::support_errors(mesh, surface.exact);
    const auto pn = shapes::pn_errors(mesh, surface.exact);
    Record record
        = {{"case", surface.name},
           {"faces", std::to_string(mesh.number_of_faces())},
           {"error_max", text(ours.largest)},
           {"error_median", text(ours.median)},
           {"error_median_pn", text(pn.median)},
           {"pn_over_ours", text(pn.median / ours.median)}};
    if (k > 0) {
      record["order_max"] = text(std::log2(coarser.largest / ours.largest));
      record["order_median"] = text(std::log2(coarser.median / ours.median));
    }
    coarser = ours;
    table.add(record);
  }
}

/// CPU microseconds a query, for points up to some edge lengths away.
template <class Query>
double microseconds(
    const Geometric_support& support, double far, std::size_t number, const Query& query)
{
  shapes::Random random(1);
  std::vector<Vec> targets;
  while (targets.size() < number)
    targets.push_back(shapes::random_point_near(support, far, random));
  double sum = 0;
  const double seconds = seconds_of([&] {
    for (const Vec& target : targets) sum += query(target);
  });
  if (!std::isfinite(sum)) throw std::runtime_error("a distance is not finite");
  return 1e6 * seconds / double(number);
}

void measure_model(
    const std::string& path, double per_cent, const Settings& settings, const Table& table)
{
  const Mesh mesh = surety::tool::read_mesh(path, {});
  const double tolerance = per_cent / 100 * diagonal(mesh);
  surety::Features features;
  const double seconds_features
      = seconds_of([&] { features = surety::find_features_by_need(mesh, tolerance); });
  const Stopwatch stopwatch;
  const auto support = surety::make_geometric_support(mesh, tolerance, features);
  const double seconds = stopwatch.seconds();
  const auto& report = support.report();
  Record record
      = {{"case", model_name(path)},
         {"faces", std::to_string(report.faces)},
         {"tolerance_per_cent", text(per_cent)},
         {"ridges", std::to_string(features.ridges)},
         {"seconds_features", text(seconds_features)},
         {"seconds_support", text(seconds)},
         {"deviation_over_tolerance", text(report.deviation / tolerance)},
         {"smooth_share", text(report.tangent_share)},
         {"saturated_share", text(report.saturated_share)},
         {"saturated_share_sampled", text(report.sampled_saturated_share)},
         {"refused_share", text(report.refused_share)}};
  const double h = shapes::mean_edge(mesh);
  for (const double far : {0.02, 0.3, 1.0, 3.0}) {
    record["us_fast_" + text(far) + "h"]
        = text(microseconds(support, far * h, settings.queries, [&](const Vec& p) {
            return support.closest_point(p).squared_distance;
          }));
    record["us_sure_" + text(far) + "h"]
        = text(microseconds(support, far * h, settings.queries / 20, [&](const Vec& p) {
            return support.guaranteed_closest_point(p).squared_distance;
          }));
  }
  table.add(record);
}

int run(int argc, char* argv[])
{
  CLI::App program(
      "Prints the errors and orders of the geometric support on analytic surfaces, next to PN "
      "triangles, and on models its smooth share and CPU microseconds a closest point.");
  Settings settings;
  const Models models(program);
  add_models(program, settings.models);
  add_tolerances(program, settings.tolerances);
  program.add_option("--queries", settings.queries, "Fast closest points to time")
      ->capture_default_str();
  parse_or_exit(program, argc, argv);

  const Table table(
      {"case",
       "faces",
       "error_max",
       "error_median",
       "order_max",
       "order_median",
       "error_median_pn",
       "pn_over_ours",
       "tolerance_per_cent",
       "ridges",
       "seconds_features",
       "seconds_support",
       "deviation_over_tolerance",
       "smooth_share",
       "saturated_share",
       "saturated_share_sampled",
       "refused_share",
       "us_fast_0.02h",
       "us_fast_0.3h",
       "us_fast_1h",
       "us_fast_3h",
       "us_sure_0.02h",
       "us_sure_0.3h",
       "us_sure_1h",
       "us_sure_3h"});
  for (const Surface& surface : surfaces()) measure_order(surface, table);
  for (const auto& model : settings.models) {
    for (const double tolerance : settings.tolerances)
      measure_model(models.path(model), tolerance, settings, table);
  }
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
