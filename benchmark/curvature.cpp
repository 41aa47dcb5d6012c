// SPDX-License-Identifier: GPL-3.0-or-later
//
// How accurate is curvature, and how fast? On meshes of analytic surfaces, clean and noisy: median
// and 95 % quantile of the error relative to the largest curvature, the geometric mean over the
// surfaces, the order of convergence, and CPU microseconds a vertex, next to CGAL's jets and, where
// CGAL has them, its corrected curvatures. On models: microseconds a vertex, and how often a poorer
// fit had to serve.
#include "models.h"
#include "program.h"
#include "stopwatch.h"
#include "table.h"

#include "curvature_errors.h"

#if __has_include(<CGAL/Polygon_mesh_processing/interpolated_corrected_curvatures.h>)
#include <CGAL/Polygon_mesh_processing/interpolated_corrected_curvatures.h>
#define SURETY_HAS_CORRECTED_CURVATURES
#endif

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace surety::benchmark;
namespace shapes = surety::test;
using shapes::Layout;
using surety::Curvature_method;

struct Settings {
  std::vector<std::string> models
      = {"fandisk", "rotor_small", "elephant", "bunny00", "armadillo", "refined_elephant"};
  std::vector<double> noises = {0, 0.1, 1, 5};
  int cells = 48;
  std::uint64_t seed = 1;
  bool skip_slow = false;
};

using Method = std::pair<std::string, shapes::Estimator>;

#ifdef SURETY_HAS_CORRECTED_CURVATURES
/// Balls of a radius in mean edges; 0: the first ring. Its signs are the opposite of ours.
shapes::Estimator by_corrected_measures(double radius)
{
  return [=](const shapes::Mesh& mesh, const std::vector<shapes::Vertex>& wanted) {
    namespace PMP = CGAL::Polygon_mesh_processing;
    using Curvatures = PMP::Principal_curvatures_and_directions<shapes::Kernel>;
    shapes::Mesh copy = mesh;
    const auto map = copy.add_property_map<shapes::Vertex, Curvatures>("v:curvature").first;
    PMP::interpolated_corrected_curvatures(
        copy,
        CGAL::parameters::vertex_principal_curvatures_and_directions_map(map).ball_radius(
            radius > 0 ? radius * shapes::mean_edge_length(mesh) : -1));
    std::vector<shapes::Two_curvatures> result;
    for (const auto v : wanted) result.push_back({-map[v].max_curvature, -map[v].min_curvature});
    return result;
  };
}
#endif

std::vector<Method> methods(bool skip_slow)
{
  std::vector<Method> result
      = {{"adaptive", shapes::by_method(Curvature_method::adaptive)},
         {"five_coefficients", shapes::by_method(Curvature_method::five_coefficients)},
         {"three_coefficients", shapes::by_method(Curvature_method::three_coefficients)}};
  for (const int degree : {2, 3, 4})
    for (const int rings : {2, 3, 5, 8})
      if (!skip_slow || rings <= 3)
        result.emplace_back(
            "jet_" + std::to_string(degree) + "_rings_" + std::to_string(rings),
            shapes::by_jets(degree, rings));
#ifdef SURETY_HAS_CORRECTED_CURVATURES
  for (const double radius : {0.0, 1.5, 3.0})
    result.emplace_back("corrected_" + to_text(radius), by_corrected_measures(radius));
#endif
  return result;
}

/// The geometric means over all surfaces of the errors, and the microseconds a vertex.
struct Result {
  double median, tail, microseconds;
};

Result measure(const Method& method, Layout layout, int cells, double noise, std::uint64_t seed)
{
  const auto surfaces = shapes::analytic_surfaces();
  std::size_t vertices = 0;
  double seconds = 0, median = 0, tail = 0;
  const shapes::Estimator timed
      = [&](const shapes::Mesh& mesh, const std::vector<shapes::Vertex>& wanted) {
          const Stopwatch stopwatch;
          auto result = method.second(mesh, wanted);
          seconds += stopwatch.seconds();
          // The library's methods work on the whole mesh, the jets on what is wanted.
          const bool is_jet = method.first.rfind("jet", 0) == 0;
          vertices += is_jet ? wanted.size() : mesh.number_of_vertices();
          return result;
        };
  for (const auto& surface : surfaces) {
    const auto errors = shapes::errors_on(surface, layout, cells, noise, timed, seed);
    median += std::log(errors.median) / double(surfaces.size());
    tail += std::log(errors.tail) / double(surfaces.size());
  }
  return {std::exp(median), std::exp(tail), 1e6 * seconds / double(vertices)};
}

void compare_on_surfaces(const Settings& settings, const Table& table)
{
  for (const Layout layout : {Layout::regular, Layout::jittered, Layout::random, Layout::stretched})
    for (const double noise : settings.noises)
      for (const Method& method : methods(settings.skip_slow)) {
        const Result result = measure(method, layout, settings.cells, noise / 100, settings.seed);
        Record record
            = {{"mesh", shapes::to_string(layout)},
               {"noise_per_cent_of_edge", to_text(noise)},
               {"method", method.first},
               {"median_error", to_text(result.median)},
               {"error_of_95_per_cent", to_text(result.tail)},
               {"microseconds_a_vertex", to_text(result.microseconds)}};
        if (noise == 0) {
          const Result finer = measure(method, layout, 2 * settings.cells, 0, settings.seed);
          record["order"] = to_text(std::log2(result.median / finer.median));
        }
        table.add(record);
      }
}

void run_model(const std::string& path, const Table& table)
{
  const Mesh mesh = surety::tool::read_mesh(path, {});
  const Stopwatch stopwatch;
  const auto field = surety::estimate_curvatures(mesh, surety::parameters::feature_angle(40));
  const double seconds = stopwatch.seconds();
  table.add(
      {{"mesh", model_name(path)},
       {"method", "adaptive"},
       {"microseconds_a_vertex", to_text(1e6 * seconds / double(mesh.number_of_vertices()))},
       {"fallbacks", std::to_string(field.fallbacks)}});
}

int run(int argc, char* argv[])
{
  CLI::App program("Prints the errors and the time of curvature estimators.");
  Settings settings;
  const Models models(program);
  add_models(program, settings.models);
  program
      .add_option(
          "--noise", settings.noises,
          "Standard deviations, in per cent of the mean edge, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  program.add_option("--cells", settings.cells, "Of a patch, along each side")
      ->check(CLI::Range(8, 1000))
      ->capture_default_str();
  program.add_option("--seed", settings.seed, "Of meshes and noise")->capture_default_str();
  program.add_flag("--skip-slow", settings.skip_slow, "Leave out jets of five rings and more");
  parse_or_exit(program, argc, argv);

  const Table table(
      {"mesh", "noise_per_cent_of_edge", "method", "median_error", "error_of_95_per_cent", "order",
       "microseconds_a_vertex", "fallbacks"});
  compare_on_surfaces(settings, table);
  for (const auto& model : settings.models) run_model(models.path(model), table);
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
