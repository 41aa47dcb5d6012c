// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does it always work? Simplifies every mesh of a folder at several tolerances and checks whatever
// the library promises: both independent proofs of the distance, the topology, no new
// self-intersections. A mesh that is refused is a row with the message.
#include "child.h"
#include "failure.h"
#include "models.h"
#include "program.h"
#include "simplification.h"
#include "stopwatch.h"
#include "table.h"

#include <surety/certificate.h>
#include <surety/statistics.h>

#include <CGAL/boost/graph/helpers.h>

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace surety::benchmark;

struct Settings {
  std::vector<std::string> models;
  std::vector<double> tolerances = {1, 0.1, 0.01};
  Controls controls;
  bool triangulate = false;
  unsigned cpu_limit = 120;
};

/// The problems of one result, in words; empty if there are none.
class Problems
{
public:
  void require(bool condition, const std::string& problem)
  {
    if (condition) return;
    text_ += (text_.empty() ? "" : "; ") + problem;
  }

  const std::string& text() const { return text_; }

private:
  std::string text_;
};

void compare_statistics(
    const surety::Mesh_statistics& before, const surety::Mesh_statistics& after,
    const Report& report, Problems& problems)
{
  report.set("input_faces", before.faces);
  report.set("output_faces", after.faces);
  const auto compare = [&](const char* name, auto member) {
    report.set(std::string(name) + "_before", before.*member);
    report.set(std::string(name) + "_after", after.*member);
    problems.require(before.*member == after.*member, std::string(name) + " changed");
  };
  compare("euler", &surety::Mesh_statistics::euler);
  compare("components", &surety::Mesh_statistics::components);
  compare("border_loops", &surety::Mesh_statistics::border_loops);
  report.set("self_intersections_before", before.self_intersections);
  report.set("self_intersections_after", after.self_intersections);
  problems.require(after.self_intersections <= before.self_intersections, "new self-intersections");
}

void check_deviation_map(
    const Mesh& mesh, const surety::Certificate& certificate, Problems& problems)
{
  const auto deviation = mesh.property_map<Mesh::Face_index, double>("f:deviation");
  if (!deviation.second) return problems.require(false, "there is no f:deviation");
  double largest = 0;
  for (const auto f : mesh.faces()) largest = std::max(largest, deviation.first[f]);
  problems.require(largest <= certificate.bound(), "f:deviation exceeds the certified bound");
}

void check_proofs(
    const Mesh& input, const Mesh& output, const surety::Certificate& certificate,
    const Report& report, Problems& problems)
{
  const double tolerance = certificate.tolerance();
  report.set("certified_over_tolerance", certificate.bound() / tolerance);
  problems.require(certificate.holds(), "the certificate does not hold");
  check_deviation_map(output, certificate, problems);
  if (certificate.correspondence()) {
    report.set("stage", "check_certificate");
    const Stopwatch stopwatch;
    const auto check = surety::check_certificate(input, output, certificate);
    report.set("check_seconds", stopwatch.seconds());
    report.set("checked_over_tolerance", check.bound / tolerance);
    problems.require(check.holds, "check_certificate: " + check.reason);
  }
  report.set("stage", "certify_distance");
  const Stopwatch stopwatch;
  const auto proof
      = surety::certify_distance(input, output, tolerance, surety::parameters::relative_slack(1));
  report.set("verify_seconds", stopwatch.seconds());
  problems.require(
      proof.holds(),
      proof.refuted() ? "certify_distance refutes it" : "certify_distance is undecided");
}

/// One mesh at one tolerance, in per cent of the diagonal.
void run_case(
    const std::string& path, double per_cent, const Settings& settings, const Report& report)
{
  report.set("stage", "read");
  const Mesh input = surety::tool::read_mesh(path, {settings.triangulate});
  const double tolerance = per_cent / 100 * diagonal(input);

  report.set("stage", "simplify");
  report.set("input_faces", input.number_of_faces());
  Mesh output = input;
  const Stopwatch stopwatch;
  const auto certificate = simplify(output, tolerance, settings.controls);
  report.set("simplify_seconds", stopwatch.seconds());

  Problems problems;
  problems.require(
      CGAL::is_valid_polygon_mesh(output) && CGAL::is_triangle_mesh(output),
      "the result is not a valid triangle mesh");
  report.set("stage", "statistics");
  compare_statistics(
      surety::mesh_statistics(input), surety::mesh_statistics(output), report, problems);
  check_proofs(input, output, certificate, report, problems);
  report.set("stage", "end");
  report.set("status", problems.text().empty() ? "ok" : "FAILED");
  report.set("message", problems.text());
}

/// A refusal is an answer, where the input is at fault.
void run_or_refuse(
    const std::string& path, double per_cent, const Settings& settings, const Report& report)
{
  const auto refuse = [&](const std::exception& error) {
    report.set("status", "refused");
    report.set("message", error.what());
  };
  try {
    run_case(path, per_cent, settings, report);
  } catch (const surety::tool::Bad_file& error) {
    refuse(error);
  } catch (const surety::Invalid_input& error) {
    refuse(error);
  }
}

Record sweep(const std::string& path, double per_cent, const Settings& settings)
{
  auto [ending, record, message] = run_in_child(
      [&](const Report& report) { run_or_refuse(path, per_cent, settings, report); },
      settings.cpu_limit);
  record["mesh"] = model_name(path) + path.substr(path.rfind('.'));
  std::ostringstream text;
  text << per_cent << '%';
  record["tolerance"] = text.str();
  if (ending != Ending::finished) {
    record["status"] = "FAILED";
    record["message"] = to_string(ending) + ": " + message;
  }
  return record;
}

Settings parse(int argc, char* argv[])
{
  CLI::App program(
      "Simplifies meshes at several tolerances and checks every promise of the library. Prints a "
      "row a mesh and tolerance, in CPU seconds. Exit status 1 if a promise was broken.");
  Settings settings;
  const Models models(program);
  bool accumulated = false;
  program.add_option("models", settings.models, "Names of models, or files; default: all");
  add_tolerances(program, settings.tolerances);
  add_options(program, settings.controls);
  add_cpu_limit(program, settings.cpu_limit);
  program.add_flag("--accumulated", accumulated, "Use the accumulated bound");
  program.add_flag("--triangulate", settings.triangulate, "Split faces of more than three corners");
  parse_or_exit(program, argc, argv);

  if (accumulated) settings.controls.bound = surety::Deviation_bound::accumulated;
  for (auto& model : settings.models) model = models.path(model);
  if (settings.models.empty()) settings.models = models.all();
  return settings;
}

int run(const Settings& settings)
{
  const Table table(
      {"mesh",
       "tolerance",
       "status",
       "stage",
       "input_faces",
       "output_faces",
       "simplify_seconds",
       "check_seconds",
       "verify_seconds",
       "certified_over_tolerance",
       "checked_over_tolerance",
       "self_intersections_before",
       "self_intersections_after",
       "euler_before",
       "euler_after",
       "components_before",
       "components_after",
       "border_loops_before",
       "border_loops_after",
       "message"});
  std::map<std::string, std::size_t> count;
  for (const auto& path : settings.models) {
    for (const double per_cent : settings.tolerances) {
      const Record record = sweep(path, per_cent, settings);
      table.add(record);
      ++count[record.at("status")];
    }
  }
  std::cerr << count["ok"] << " ok, " << count["refused"] << " refused, " << count["FAILED"]
            << " failed\n";
  return count["FAILED"] == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(parse(argc, argv)); });
}
