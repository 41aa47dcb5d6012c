// SPDX-License-Identifier: GPL-3.0-or-later
//
// What do threads bring? Simplifies finer versions of models on 1, 2, ... threads and prints the
// seconds on the clock, over those of one thread, and the number of faces, which must be the same.
#include "child.h"
#include "models.h"
#include "program.h"
#include "refinement.h"
#include "simplification.h"
#include "table.h"

#include <surety/geometric_mesh.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace surety::benchmark;

struct Settings {
  std::vector<std::string> models = {"bunny00"};
  double per_cent = 0.1;
  std::size_t smallest = 1000000;
  unsigned most_threads = std::max(1u, std::thread::hardware_concurrency());
  Controls controls;
};

void run_model(const std::string& path, const Settings& settings, const Table& table)
{
  Mesh input = surety::tool::read_mesh(path, {});
  const double tolerance = settings.per_cent / 100 * diagonal(input);
  while (input.number_of_faces() < settings.smallest) input = smoothed_in_four(input);
  double seconds_of_one = 0;
  for (unsigned threads = 1; threads <= settings.most_threads; ++threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Mesh output = input;
    const auto start = std::chrono::steady_clock::now();
    const auto certificate = surety::make_geometric_mesh<CGAL::Parallel_tag>(
        output, tolerance,
        surety::parameters::placement(settings.controls.placement)
            .effort(settings.controls.effort)
            .feature_angle(settings.controls.feature_angle)
            .allow_self_intersections(settings.controls.allow_self_intersections));
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (threads == 1) seconds_of_one = elapsed.count();
    table.add(
        {{"model", model_name(path)},
         {"input_faces", std::to_string(input.number_of_faces())},
         {"threads", std::to_string(threads)},
         {"faces", std::to_string(output.number_of_faces())},
         {"seconds_on_the_clock", to_text(elapsed.count())},
         {"speed_up", to_text(seconds_of_one / elapsed.count())},
         {"certified_over_tolerance", to_text(certificate.bound() / tolerance)}});
  }
}

int run(int argc, char* argv[])
{
  CLI::App program("Prints the time that models take on 1, 2, ... threads.");
  Settings settings;
  const Models models(program);
  add_models(program, settings.models);
  add_options(program, settings.controls);
  program.add_option("-t,--tolerance", settings.per_cent, "In per cent of the diagonal")
      ->capture_default_str();
  program
      .add_option(
          "--smallest", settings.smallest, "Models with fewer faces are subdivided until they have")
      ->capture_default_str();
  program.add_option("--threads", settings.most_threads, "Up to how many")->capture_default_str();
  parse_or_exit(program, argc, argv);

  const Table table(
      {"model", "input_faces", "threads", "faces", "seconds_on_the_clock", "speed_up",
       "certified_over_tolerance"});
  for (const auto& model : settings.models) run_model(models.path(model), settings, table);
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  return run_program([&] { return run(argc, argv); });
}
