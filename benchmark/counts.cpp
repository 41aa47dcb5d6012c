// SPDX-License-Identifier: GPL-3.0-or-later
//
// How few faces? Simplifies models with the library, by each placement and effort, and with its
// peers and prints, for each result, the number of faces, the CPU time, what is certified and what
// the distance really is. Peers that know no tolerance are given the number of faces that our
// defaults reached.
#include "child.h"
#include "distances.h"
#include "models.h"
#include "peers.h"
#include "program.h"
#include "refinement.h"
#include "simplification.h"
#include "stopwatch.h"
#include "table.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace surety::benchmark;

struct Settings {
  std::vector<std::string> models
      = {"fandisk",  "anchor_dense", "couplingdown", "rotor_small",     "turbine",
         "elephant", "armadillo",    "bunny00",      "refined_elephant"};
  std::vector<double> tolerances = {0.1};
  Controls controls;
  unsigned cpu_limit = 600;
  bool skip_slow = false;
  bool with_best = false;
  std::vector<std::string> methods; ///< none: all
  unsigned rotations = 1;
};

/// One model at one tolerance; the methods are compared with the first, our defaults.
class Comparison
{
public:
  Comparison(const std::string& path, double per_cent, const Settings& settings, const Table& table)
    : settings_(settings),
      table_(table),
      name_(model_name(path)),
      input_(surety::tool::read_mesh(path, {})),
      per_cent_(per_cent),
      tolerance_(per_cent / 100 * diagonal(input_))
  {}

  void run()
  {
    using surety::Deviation_bound;
    using surety::Effort;
    using surety::Placement;
    run_ours("surety", Placement::on_surface, Effort::standard);
    run_ours("surety_fast", Placement::on_surface, Effort::fast);
    if (settings_.with_best) run_ours("surety_best", Placement::on_surface, Effort::best);
    run_ours("surety_free", Placement::free, Effort::standard);
    run_ours("surety_free_fast", Placement::free, Effort::fast);
    if (settings_.with_best) run_ours("surety_free_best", Placement::free, Effort::best);
    run_ours(
        "surety_accumulated", Placement::on_surface, Effort::fast, Deviation_bound::accumulated);
    for (const Peer& peer : all_peers()) {
      if (!(settings_.skip_slow && peer.is_slow)) run_peer(peer);
    }
  }

private:
  void run_ours(
      const std::string& method, surety::Placement placement, surety::Effort effort,
      surety::Deviation_bound bound = surety::Deviation_bound::direct)
  {
    Controls controls = settings_.controls;
    controls.placement = placement;
    controls.effort = effort;
    controls.bound = bound;
    run_method(method, [&](Mesh& mesh, const Report& report) {
      const Stopwatch stopwatch;
      const auto certificate = simplify(mesh, tolerance_, controls);
      report.set("placement", placement == surety::Placement::free ? "free" : "on-surface");
      report.set("effort", name_of(effort));
      report.set("seconds", stopwatch.seconds());
      report.set("certified_over_tolerance", certificate.bound() / tolerance_);
      if (settings_.rotations > 1)
        report.set("mean_faces", mean_faces(mesh.number_of_faces(), controls));
    });
  }

  /// Of the model as it is, and turned about axes that have nothing to do with it.
  double mean_faces(std::size_t faces, const Controls& controls) const
  {
    auto sum = static_cast<double>(faces);
    for (unsigned i = 1; i < settings_.rotations; ++i) {
      Mesh turned = rotated(input_, i);
      simplify(turned, tolerance_, controls);
      sum += static_cast<double>(turned.number_of_faces());
    }
    return sum / settings_.rotations;
  }

  void run_peer(const Peer& peer)
  {
    const Goal goal{tolerance_, static_cast<std::size_t>(our_faces_)};
    run_method(peer.name, [&](Mesh& mesh, const Report& report) {
      report.set("seconds", peer.simplify(mesh, goal));
    });
  }

  template <class Method>
  void run_method(const std::string& name, const Method& method)
  {
    // The first one is always run: the others are compared with it.
    const auto& wanted = settings_.methods;
    if (our_faces_ > 0 && !wanted.empty()
        && std::find(wanted.begin(), wanted.end(), name) == wanted.end())
      return;
    auto [ending, record, message] = run_in_child(
        [&](const Report& report) {
          Mesh output = input_;
          method(output, report);
          report.set("faces", output.number_of_faces());
          const Distance distance = measure_distance(input_, output, tolerance_);
          report.set("distance_lower_over_tolerance", distance.lower / tolerance_);
          report.set("distance_upper_over_tolerance", distance.upper / tolerance_);
          report.set("within_tolerance", distance.is_within);
        },
        settings_.cpu_limit);
    record["model"] = name_;
    record["input_faces"] = std::to_string(input_.number_of_faces());
    std::ostringstream per_cent;
    per_cent << per_cent_;
    record["tolerance_per_cent"] = per_cent.str();
    record["method"] = name;
    if (ending != Ending::finished) record["message"] = to_string(ending) + ": " + message;
    compare_with_ours(record);
    table_.add(record);
  }

  void compare_with_ours(Record& record)
  {
    if (record.count("faces") == 0 || record.count("seconds") == 0) return;
    const double faces = std::stod(record["faces"]), seconds = std::stod(record["seconds"]);
    if (our_faces_ == 0) {
      our_faces_ = faces;
      our_seconds_ = seconds;
    }
    record["our_faces_over_its"] = std::to_string(our_faces_ / faces);
    record["our_seconds_over_its"] = std::to_string(our_seconds_ / seconds);
  }

  const Settings& settings_;
  const Table& table_;
  std::string name_;
  Mesh input_;
  double per_cent_, tolerance_;
  double our_faces_ = 0, our_seconds_ = 0;
};

int run(int argc, char* argv[])
{
  CLI::App program(
      "Prints the number of faces that the library and its peers need within a tolerance, with "
      "CPU seconds, the certified bound and the true distance.");
  Settings settings;
  const Models models(program);
  add_models(program, settings.models);
  add_tolerances(program, settings.tolerances);
  add_quality_options(program, settings.controls);
  add_cpu_limit(program, settings.cpu_limit);
  program.add_flag("--best", settings.with_best, "Run ours with the best effort too: minutes");
  program.add_flag("--skip-slow", settings.skip_slow, "Leave out the peers that may take a minute");
  program
      .add_option(
          "--methods", settings.methods,
          "Names of methods, as in the table, separated by commas; default: all")
      ->delimiter(',');
  program
      .add_option(
          "--rotations", settings.rotations,
          "Run ours on this many turned copies, and give the mean number of faces: counts scatter "
          "by a per cent or two with any change")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  parse_or_exit(program, argc, argv);

  const Table table(
      {"model", "input_faces", "tolerance_per_cent", "method", "placement", "effort", "faces",
       "mean_faces", "our_faces_over_its", "seconds", "our_seconds_over_its",
       "certified_over_tolerance", "distance_lower_over_tolerance", "distance_upper_over_tolerance",
       "within_tolerance", "message"});
  for (const auto& model : settings.models) {
    for (const double tolerance : settings.tolerances)
      Comparison(models.path(model), tolerance, settings, table).run();
  }
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
