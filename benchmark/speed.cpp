// SPDX-License-Identifier: GPL-3.0-or-later
//
// How fast? CPU time of the certified simplification next to CGAL's plain edge collapse to the same
// number of faces. The programs take turns, so that whatever slows the machine slows them all; the
// ratios are medians over the turns.
#include "child.h"
#include "distances.h"
#include "models.h"
#include "peers.h"
#include "program.h"
#include "simplification.h"
#include "stopwatch.h"
#include "table.h"

#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace surety::benchmark;

struct Settings {
  std::vector<std::string> models = {"bunny00", "armadillo", "refined_elephant"};
  std::vector<double> tolerances = {0.1};
  Controls controls;
  unsigned runs = 5;
  unsigned cpu_limit = 600;
};

/// One way of simplifying: the times of its runs, and its last result.
struct Method {
  std::string name;
  std::vector<double> seconds;
  Mesh result;
};

void report_method(
    const Method& method, const std::string& prefix, const Mesh& input, double tolerance,
    const Report& report)
{
  report.set(prefix + "seconds", median(method.seconds));
  report.set(prefix + "faces", method.result.number_of_faces());
  const Distance distance = measure_distance(input, method.result, tolerance);
  report.set(prefix + "distance_over_tolerance", distance.upper / tolerance);
}

void run_case(const Mesh& input, double per_cent, const Settings& settings, const Report& report)
{
  const double tolerance = per_cent / 100 * diagonal(input);
  const std::vector<Peer> peers = {cgal_lindstrom_turk(), cgal_garland_heckbert()};
  Method ours{"surety", {}, {}};
  std::vector<Method> theirs = {{"lindstrom_turk", {}, {}}, {"garland_heckbert", {}, {}}};
  for (unsigned run = 0; run < settings.runs; ++run) {
    ours.result = input;
    ours.seconds.push_back(seconds_of([&] {
      const auto certificate = simplify(ours.result, tolerance, settings.controls);
      report.set("certified_over_tolerance", certificate.bound() / tolerance);
    }));
    for (std::size_t i = 0; i < peers.size(); ++i) {
      theirs[i].result = input;
      theirs[i].seconds.push_back(
          peers[i].simplify(theirs[i].result, {tolerance, ours.result.number_of_faces()}));
    }
  }
  report_method(ours, "", input, tolerance, report);
  for (const Method& method : theirs) {
    report_method(method, method.name + "_", input, tolerance, report);
    std::vector<double> ratios;
    for (std::size_t run = 0; run < ours.seconds.size(); ++run)
      ratios.push_back(ours.seconds[run] / method.seconds[run]);
    report.set("over_" + method.name, median(ratios));
  }
}

int run(int argc, char* argv[])
{
  CLI::App program(
      "Prints medians of the CPU seconds of the library and of CGAL's plain edge collapse "
      "(Lindstrom and Turk, Garland and Heckbert) to the same number of faces, and the ratios.");
  Settings settings;
  const Models models(program);
  add_models(program, settings.models);
  add_tolerances(program, settings.tolerances);
  add_options(program, settings.controls);
  add_cpu_limit(program, settings.cpu_limit);
  program.add_option("--runs", settings.runs, "Number of runs of each")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  parse_or_exit(program, argc, argv);

  const Table table(
      {"model", "input_faces", "tolerance_per_cent", "faces", "seconds", "over_lindstrom_turk",
       "over_garland_heckbert", "certified_over_tolerance", "distance_over_tolerance",
       "lindstrom_turk_seconds", "lindstrom_turk_faces", "lindstrom_turk_distance_over_tolerance",
       "garland_heckbert_seconds", "garland_heckbert_faces",
       "garland_heckbert_distance_over_tolerance", "message"});
  for (const auto& model : settings.models) {
    const std::string path = models.path(model);
    const Mesh input = surety::tool::read_mesh(path, {});
    for (const double per_cent : settings.tolerances) {
      auto [ending, record, message] = run_in_child(
          [&](const Report& report) {
            report.set("model", model_name(path));
            report.set("input_faces", input.number_of_faces());
            report.set("tolerance_per_cent", per_cent);
            run_case(input, per_cent, settings, report);
          },
          settings.cpu_limit);
      if (ending != Ending::finished) record["message"] = to_string(ending) + ": " + message;
      table.add(record);
    }
  }
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
