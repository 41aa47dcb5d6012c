// SPDX-License-Identifier: GPL-3.0-or-later
//
// How fast is the verifier? Compares models with their own simplifications, by this library and by
// CGAL's bounded-error Hausdorff distance, which needs an accuracy well below the tolerance to
// decide anything and is given up after a time.
#include "child.h"
#include "models.h"
#include "program.h"
#include "simplification.h"
#include "stopwatch.h"
#include "table.h"

#include <surety/distance.h>

#include <CGAL/Polygon_mesh_processing/distance.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace surety::benchmark;

struct Settings {
  std::vector<std::string> models = {"bunny00", "fandisk"};
  std::vector<double> tolerances = {0.1};
  double accuracy = 1e-5;
  Controls controls;
  unsigned cpu_limit = 120;
};

/// Two meshes, and lengths in mesh units.
struct Question {
  const Mesh& input;
  const Mesh& output;
  double tolerance, accuracy;
};

struct Method {
  std::string name;
  std::function<void(const Question&, const Report&)> answer;
};

/// What is proven of the distance, and what that says of a bound.
void report_answer(
    double bound, double lower, double upper, const Question& question, const Report& report)
{
  report.set("bound_over_tolerance", bound / question.tolerance);
  report.set("lower_over_tolerance", lower / question.tolerance);
  report.set("upper_over_tolerance", upper / question.tolerance);
  report.set("is_within_bound", upper <= bound ? "yes" : lower > bound ? "no" : "undecided");
}

void decide(const Question& question, double bound, const Report& report)
{
  const auto proof = surety::certify_distance(
      question.input, question.output, bound, surety::parameters::relative_slack(1));
  report_answer(bound, proof.lower_bound(), proof.upper_bound(), question, report);
}

void certify(const Question& question, const Report& report)
{
  decide(question, question.tolerance, report);
}

/// A bound that does not hold, unless the result uses less than nine tenths of its tolerance.
void refute(const Question& question, const Report& report)
{
  decide(question, 0.9 * question.tolerance, report);
}

void enclose(const Question& question, const Report& report)
{
  const auto distance
      = surety::hausdorff_distance(question.input, question.output, question.accuracy);
  report_answer(question.tolerance, distance.lower(), distance.upper(), question, report);
}

/// Returns a lower bound that is at most the accuracy below the distance.
void ask_cgal(const Question& question, const Report& report)
{
  namespace PMP = CGAL::Polygon_mesh_processing;
  const double lower = PMP::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(
      question.input, question.output, question.accuracy);
  report_answer(question.tolerance, lower, lower + question.accuracy, question, report);
}

const std::vector<Method>& methods()
{
  static const std::vector<Method> all
      = {{"cgal_bounded_error", ask_cgal}, // the first is what the others are compared with
         {"certify_distance", certify},
         {"certify_distance", refute},
         {"hausdorff_distance", enclose}};
  return all;
}

void compare(const std::string& path, double per_cent, const Settings& settings, const Table& table)
{
  const Mesh input = surety::tool::read_mesh(path, {});
  const double size = diagonal(input), tolerance = per_cent / 100 * size;
  Mesh output = input;
  const auto certificate = simplify(output, tolerance, settings.controls);
  const Question question{input, output, tolerance, settings.accuracy * size};
  double cgal_seconds = 0;
  for (const Method& method : methods()) {
    auto [ending, record, message] = run_in_child(
        [&](const Report& report) {
          report.set("model", model_name(path));
          report.set("input_faces", input.number_of_faces());
          report.set("tolerance_per_cent", per_cent);
          report.set("faces", output.number_of_faces());
          report.set("certified_over_tolerance", certificate.bound() / tolerance);
          report.set("method", method.name);
          const Stopwatch stopwatch;
          method.answer(question, report);
          report.set("seconds", stopwatch.seconds());
        },
        settings.cpu_limit);
    if (ending != Ending::finished) record["message"] = to_string(ending) + ": " + message;
    if (ending == Ending::out_of_time) record["seconds"] = std::to_string(settings.cpu_limit);
    if (record.count("seconds") > 0) {
      const double seconds = std::stod(record["seconds"]);
      if (cgal_seconds == 0) cgal_seconds = seconds;
      record["over_cgal"] = std::to_string(seconds / cgal_seconds);
    }
    table.add(record);
  }
}

int run(int argc, char* argv[])
{
  CLI::App program(
      "Prints the CPU seconds that it takes to verify the distance of models to their own "
      "simplifications, by this library and by CGAL.");
  Settings settings;
  const Models models(program);
  add_models(program, settings.models);
  add_tolerances(program, settings.tolerances);
  add_options(program, settings.controls);
  add_cpu_limit(program, settings.cpu_limit);
  program
      .add_option("--accuracy", settings.accuracy, "Of an interval, as a fraction of the diagonal")
      ->capture_default_str();
  parse_or_exit(program, argc, argv);

  const Table table(
      {"model", "input_faces", "tolerance_per_cent", "faces", "certified_over_tolerance", "method",
       "seconds", "over_cgal", "bound_over_tolerance", "is_within_bound", "lower_over_tolerance",
       "upper_over_tolerance", "message"});
  for (const auto& model : settings.models) {
    for (const double tolerance : settings.tolerances)
      compare(models.path(model), tolerance, settings, table);
  }
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
