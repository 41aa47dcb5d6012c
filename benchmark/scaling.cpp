// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is it linear, and how much memory does it take? Simplifies finer and finer versions of a model,
// at one tolerance, so that the reduction grows with the size, or at a tolerance that keeps it.
// Prints CPU seconds, the exponent p of the law seconds ~ faces^p from row to row and fitted over
// all rows, and the largest memory in use while the library works, beside the mesh itself, in bytes
// a face: allocated by new, and as the growth of the resident size.
#include "child.h"
#include "counting_allocator.h"
#include "distances.h"
#include "models.h"
#include "peers.h"
#include "program.h"
#include "refinement.h"
#include "simplification.h"
#include "stopwatch.h"
#include "table.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <malloc.h>

namespace {

using namespace surety::benchmark;

struct Settings {
  std::vector<std::string> models = {"elephant", "fandisk"};
  double per_cent = 0.1;
  std::size_t smallest = 10000, largest = 1500000;
  bool flat = false;
  double noise = 0;
  unsigned seed = 1;
  bool verify = false;
  bool same_reduction = false;
  bool peer = false;
  Controls controls;
  unsigned cpu_limit = 1200;
};

/// A line of /proc/self/status, in bytes; 0 where there is none.
double status_bytes(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(name + ":", 0) == 0) return 1024 * std::stod(line.substr(name.size() + 1));
  }
  return 0;
}

/// Lets the highest resident size start anew, where the system can.
void reset_resident_peak()
{
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5\n";
}

void run_case(const Mesh& input, double tolerance, const Settings& settings, const Report& report)
{
  Mesh output = input;
  const auto faces = static_cast<double>(input.number_of_faces());
  reset_resident_peak();
  const double resident = status_bytes("VmRSS");
  reset_peak_bytes();
  const std::size_t live = live_bytes();

  const Stopwatch stopwatch;
  const auto certificate = simplify(output, tolerance, settings.controls);
  const double seconds = stopwatch.seconds();
  report.set("seconds", seconds);
  report.set("microseconds_a_face", 1e6 * seconds / faces);
  report.set("bytes_a_face", static_cast<double>(peak_bytes() - live) / faces);
  report.set("resident_bytes_a_face", (status_bytes("VmHWM") - resident) / faces);
  report.set("faces", output.number_of_faces());
  report.set("certified_over_tolerance", certificate.bound() / tolerance);
  if (settings.peer) {
    Mesh theirs = input;
    const double their_seconds
        = cgal_lindstrom_turk().simplify(theirs, {tolerance, output.number_of_faces()});
    report.set("lindstrom_turk_microseconds_a_face", 1e6 * their_seconds / faces);
    report.set("over_lindstrom_turk", seconds / their_seconds);
  }
  if (settings.verify) {
    const Distance distance = measure_distance(input, output, tolerance);
    report.set("distance_over_tolerance", distance.upper / tolerance);
  }
}

/// Least squares through the logarithms.
class Power_law
{
public:
  void add(double x, double y)
  {
    x_.push_back(std::log(x));
    y_.push_back(std::log(y));
  }

  /// Of a number of last rows.
  std::string exponent(std::size_t rows) const
  {
    if (rows < 2 || x_.size() < rows) return "";
    const auto n = static_cast<double>(rows);
    double x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = x_.size() - rows; i < x_.size(); ++i) {
      x += x_[i];
      y += y_[i];
      xx += x_[i] * x_[i];
      xy += x_[i] * y_[i];
    }
    std::ostringstream text;
    text << (n * xy - x * y) / (n * xx - x * x);
    return text.str();
  }

  std::size_t size() const { return x_.size(); }

private:
  std::vector<double> x_, y_;
};

class Series
{
public:
  Series(const std::string& path, const Settings& settings, const Table& table)
    : settings_(settings),
      table_(table),
      name_(model_name(path)),
      mesh_(surety::tool::read_mesh(path, {})),
      tolerance_(settings.per_cent / 100 * diagonal(mesh_))
  {}

  void run()
  {
    while (mesh_.number_of_faces() < settings_.smallest) refine();
    for (; mesh_.number_of_faces() <= settings_.largest; refine()) run_size();
  }

private:
  /// The gap of a face is as the square of its size.
  void refine()
  {
    mesh_ = settings_.flat ? split_in_four(mesh_) : smoothed_in_four(mesh_);
    if (settings_.same_reduction) tolerance_ /= 4;
  }

  void run_size()
  {
    Mesh mesh = mesh_;
    if (settings_.noise > 0) add_noise(mesh, settings_.noise * tolerance_, settings_.seed);
    auto [ending, record, message] = run_in_child(
        [&](const Report& report) { run_case(mesh, tolerance_, settings_, report); },
        settings_.cpu_limit);
    record["model"] = name_;
    record["input_faces"] = std::to_string(mesh.number_of_faces());
    if (ending == Ending::finished) {
      law_.add(static_cast<double>(mesh.number_of_faces()), std::stod(record["seconds"]));
      record["exponent_from_last"] = law_.exponent(2);
      record["exponent_so_far"] = law_.exponent(law_.size());
    } else {
      record["message"] = to_string(ending) + ": " + message;
    }
    table_.add(record);
  }

  const Settings& settings_;
  const Table& table_;
  std::string name_;
  Mesh mesh_;
  double tolerance_;
  Power_law law_;
};

int run(int argc, char* argv[])
{
  CLI::App program(
      "Prints CPU seconds and memory for finer and finer versions of models, at one tolerance.");
  Settings settings;
  const Models models(program);
  add_models(program, settings.models);
  add_options(program, settings.controls);
  add_cpu_limit(program, settings.cpu_limit);
  program.add_option("-t,--tolerance", settings.per_cent, "In per cent of the diagonal")
      ->capture_default_str();
  program.add_option("--smallest", settings.smallest, "Number of faces to start with")
      ->capture_default_str();
  program.add_option("--largest", settings.largest, "Number of faces not to exceed")
      ->capture_default_str();
  program.add_flag("--flat", settings.flat, "Split faces in their planes; default: Loop's scheme");
  program.add_option("--noise", settings.noise, "Random shifts, as a fraction of the tolerance")
      ->capture_default_str();
  program.add_option("--seed", settings.seed, "Of the random shifts")->capture_default_str();
  program.add_flag(
      "--same-reduction", settings.same_reduction,
      "Divide the tolerance by four whenever faces are split in four");
  program.add_flag("--peer", settings.peer, "Also run CGAL's plain edge collapse to our count");
  program.add_flag("--verify", settings.verify, "Also measure the true distance");
  parse_or_exit(program, argc, argv);

  const Table table(
      {"model", "input_faces", "faces", "seconds", "microseconds_a_face", "exponent_from_last",
       "exponent_so_far", "bytes_a_face", "resident_bytes_a_face", "certified_over_tolerance",
       "distance_over_tolerance", "lindstrom_turk_microseconds_a_face", "over_lindstrom_turk",
       "message"});
  for (const auto& model : settings.models) Series(models.path(model), settings, table).run();
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
