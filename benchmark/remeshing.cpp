// SPDX-License-Identifier: GPL-3.0-or-later
//
// How good are remeshed surfaces, and how far from their inputs? Remeshes models with the library,
// isotropic, for fewest faces and anisotropic, and with CGAL's isotropic_remeshing, which knows no
// tolerance and is given the number of faces that our defaults reached.
#include "child.h"
#include "distances.h"
#include "models.h"
#include "program.h"
#include "stopwatch.h"
#include "table.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <surety/remesh.h>
#include <surety/statistics.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace surety::benchmark;
namespace with = surety::parameters;

struct Settings {
  std::vector<std::string> models
      = {"fandisk", "anchor_dense", "anchor", "couplingdown", "bear", "elephant", "bunny00"};
  std::vector<double> tolerances = {0.1};
  double feature_angle = 40;
  unsigned iterations = 10;
  unsigned cpu_limit = 600;
};

/// One model at one tolerance.
class Comparison
{
public:
  Comparison(const std::string& path, double per_cent, const Settings& settings, const Table& table)
    : settings_(settings),
      table_(table),
      name_(model_name(path)),
      per_cent_(per_cent),
      input_(surety::tool::read_mesh(path, {})),
      tolerance_(per_cent / 100 * diagonal(input_))
  {}

  void run()
  {
    const double faces = run_ours("surety", surety::Metric_kind::isotropic, false);
    run_ours("surety_fewest", surety::Metric_kind::isotropic, true);
    run_ours("surety_anisotropic", surety::Metric_kind::anisotropic, false);
    if (faces > 0) run_cgal(faces);
  }

private:
  /// The number of faces; 0 where there is no result.
  double run_ours(const std::string& method, surety::Metric_kind kind, bool is_for_fewest)
  {
    return run_method(method, [&](Mesh& mesh, const Report& report) {
      const Stopwatch stopwatch;
      const auto made
          = surety::remesh(mesh, tolerance_, with::metric_kind(kind).fewest_faces(is_for_fewest));
      const auto& unit = made.unit_mesh;
      report.set("seconds", stopwatch.seconds());
      report.set("certified_over_tolerance", unit.certificate.bound() / tolerance_);
      report.set("unit_edges", unit.fit.unit_edges);
      report.set("unit_edges_of_given", unit.fit_of_given.unit_edges);
      report.set("efficiency_index", unit.fit.efficiency_index);
      report.set("Q_avg_in_metric", unit.fit.Q_avg);
    });
  }

  /// With the size that makes as many equilateral faces.
  void run_cgal(double faces)
  {
    run_method("cgal_isotropic_remeshing", [&](Mesh& mesh, const Report& report) {
      namespace PMP = CGAL::Polygon_mesh_processing;
      const double size = std::sqrt(PMP::area(mesh) / faces * 4 / std::sqrt(3.));
      const Stopwatch stopwatch;
      auto is_feature = mesh.add_property_map<Mesh::Edge_index, bool>("e:ridge", false).first;
      const auto features
          = surety::find_features(mesh, with::feature_angle(settings_.feature_angle));
      for (const auto e : mesh.edges()) is_feature[e] = features.edge[e];
      PMP::split_long_edges(
          mesh.edges(), 4. / 3 * size, mesh, CGAL::parameters::edge_is_constrained_map(is_feature));
      PMP::isotropic_remeshing(
          mesh.faces(), size, mesh,
          CGAL::parameters::number_of_iterations(settings_.iterations)
              .protect_constraints(false)
              .edge_is_constrained_map(is_feature));
      mesh.collect_garbage();
      report.set("seconds", stopwatch.seconds());
      report.set("unit_edges", share_of_length(mesh, size));
    });
  }

  /// Per cent of the edges that are unit for a constant size.
  static double share_of_length(const Mesh& mesh, double size)
  {
    std::size_t number = 0;
    for (const auto e : mesh.edges()) {
      const double length = CGAL::Polygon_mesh_processing::edge_length(mesh.halfedge(e), mesh);
      if (length >= size / std::sqrt(2.) && length <= size * std::sqrt(2.)) ++number;
    }
    return 100 * double(number) / double(mesh.number_of_edges());
  }

  template <class Method>
  double run_method(const std::string& name, const Method& method)
  {
    auto [ending, record, message] = run_in_child(
        [&](const Report& report) {
          Mesh output = input_;
          method(output, report);
          const auto statistics = surety::mesh_statistics(output);
          report.set("faces", output.number_of_faces());
          report.set("Q_avg", statistics.Q_avg);
          report.set("Q_max", statistics.Q_max);
          report.set("angle_min", statistics.angle_min);
          report.set("self_intersections", statistics.self_intersections);
          const Distance distance = measure_distance(input_, output, tolerance_);
          report.set("distance_lower_over_tolerance", distance.lower / tolerance_);
          report.set("distance_upper_over_tolerance", distance.upper / tolerance_);
          report.set("within_tolerance", distance.is_within);
        },
        settings_.cpu_limit);
    record["model"] = name_;
    record["input_faces"] = std::to_string(input_.number_of_faces());
    record["tolerance_per_cent"] = to_text(per_cent_);
    record["method"] = name;
    if (ending != Ending::finished) record["message"] = to_string(ending) + ": " + message;
    table_.add(record);
    return record.count("faces") == 0 ? 0 : std::stod(record["faces"]);
  }

  const Settings& settings_;
  const Table& table_;
  std::string name_;
  double per_cent_;
  Mesh input_;
  double tolerance_;
};

int compare(int argc, char* argv[])
{
  CLI::App program("Remeshes models for simulation, with the library and with CGAL.");
  Settings settings;
  const Models models(program);
  add_models(program, settings.models);
  add_tolerances(program, settings.tolerances);
  add_cpu_limit(program, settings.cpu_limit);
  program.add_option("--feature-angle", settings.feature_angle, "Of the ridges that CGAL keeps")
      ->capture_default_str();
  program.add_option("--iterations", settings.iterations, "Of CGAL")->capture_default_str();
  parse_or_exit(program, argc, argv);

  const Table table(
      {"model", "input_faces", "tolerance_per_cent", "method", "faces", "unit_edges",
       "unit_edges_of_given", "efficiency_index", "Q_avg_in_metric", "Q_avg", "Q_max", "angle_min",
       "self_intersections", "certified_over_tolerance", "distance_lower_over_tolerance",
       "distance_upper_over_tolerance", "within_tolerance", "seconds", "message"});
  for (const std::string& name : settings.models) {
    for (const double per_cent : settings.tolerances)
      Comparison(models.path(name), per_cent, settings, table).run();
  }
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return surety::benchmark::run_program([&] { return compare(argc, argv); });
}
