// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety info: is this file good input, and what is in it?
#include "commands.h"
#include "instantiations.h"
#include "mesh_reading.h"
#include "output_files.h"
#include "report.h"

#include <iostream>

namespace surety::tool {
namespace {

struct Info {
  std::string input, report;
  Reading reading;
  double feature_angle = 40, corner_angle = internal::defaults::corner_angle;
  bool is_quiet = false;

  void run() const;
  void print(const Mesh_statistics& statistics, const Features& features) const;
};

void Info::run() const
{
  Output_files files({input});
  if (!report.empty()) files.announce(report);
  Stopwatch watch;
  const Mesh mesh = read_mesh(input, reading);
  watch.lap("read");
  const Mesh_statistics statistics = mesh_statistics(mesh);
  watch.lap("statistics");
  const Features features = find_features(mesh, feature_parameters(feature_angle, corner_angle));
  watch.lap("features");

  Json json = new_report("info");
  json["input"] = to_json(input, statistics);
  json["features"]
      = {{"feature_angle", feature_angle},
         {"corner_angle", corner_angle},
         {"ridge_edges", features.ridges},
         {"border_edges", features.borders},
         {"corners", features.corners}};
  json["seconds"] = watch.seconds();
  if (!report.empty()) {
    files.write(report, [&](std::ostream& stream) { stream << to_text(json); });
    files.commit();
  }
  if (!is_quiet) print(statistics, features);
}

void Info::print(const Mesh_statistics& statistics, const Features& features) const
{
  std::cout << input << ": a valid triangle mesh\n"
            << to_text(statistics, "  ")
            << "  diagonal of the bounding box: " << statistics.diagonal
            << ", area: " << statistics.area << '\n'
            << "  features: " << features.ridges << " ridge edges above " << feature_angle
            << " degrees, " << features.borders << " border edges, " << features.corners
            << " corners\n";
}

} // namespace

void add_info(CLI::App& program, Exit_status&)
{
  const auto command
      = program.add_subcommand("info", "Validity, features and statistics of a mesh");
  const auto info = std::make_shared<Info>();
  command->add_option("IN", info->input, "mesh to look at: off, obj, ply or stl")->required();
  command
      ->add_option(
          "--feature-angle", info->feature_angle,
          "count edges that turn by more, in degrees, as ridges")
      ->check(between(0, 180))
      ->capture_default_str();
  command
      ->add_option(
          "--corner-angle", info->corner_angle,
          "ridges and borders that turn by more have a corner")
      ->check(between(0, 180))
      ->capture_default_str();
  command->add_flag("--triangulate", info->reading.triangulate, "split faces with more corners");
  command->add_option("--report", info->report, "write all figures to this JSON file");
  command->add_flag("--quiet", info->is_quiet, "print nothing but errors");
  command->footer("Example: surety info part.stl --report part.json");
  command->callback([info] { info->run(); });
}

} // namespace surety::tool
