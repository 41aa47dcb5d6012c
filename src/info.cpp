// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety info: is this file good input, and what is in it? With curvature and metric on request.
#include "commands.h"
#include "field_writing.h"
#include "fields.h"
#include "instantiations.h"
#include "mesh_reading.h"
#include "output_files.h"
#include "report.h"
#include "soup_reading.h"

#include <iostream>
#include <optional>

namespace surety::tool {
namespace {

struct Info {
  std::string input, output, report;
  Field_request fields;
  Reading reading;
  double feature_angle = 40, corner_angle = internal::defaults::corner_angle;
  bool is_quiet = false;

  void run() const;

private:
  void write_field_file(Output_files& files, const Mesh& mesh, const Fields& found) const;
  void describe_fields(Json& json, const Mesh& mesh, const Fields& found) const;
  void print(const Mesh_statistics& statistics, const Features& features) const;
  void print(const Fields& found) const;
};

void Info::run() const
{
  check(fields);
  if (!output.empty()) require_field_format(output, extension_of(output), fields);
  Output_files files({input});
  if (!output.empty()) files.announce(output);
  if (!report.empty()) files.announce(report);
  Stopwatch watch;
  const Mesh mesh = read_mesh(input, reading);
  watch.lap("read");
  const Mesh_statistics statistics = mesh_statistics(mesh);
  watch.lap("statistics");
  const Features features = find_features(mesh, feature_parameters(feature_angle, corner_angle));
  watch.lap("features");
  std::optional<Fields> found;
  if (!fields.is_empty()) found = make_fields(mesh, features, fields, watch);

  Json json = new_report("info");
  json["input"] = to_json(input, statistics);
  json["features"]
      = {{"feature_angle", feature_angle},
         {"corner_angle", corner_angle},
         {"ridge_edges", features.ridges},
         {"border_edges", features.borders},
         {"corners", features.corners}};
  if (found) describe_fields(json, mesh, *found);
  if (!output.empty()) {
    write_field_file(files, mesh, *found);
    watch.lap("write");
  }
  json["seconds"] = watch.seconds();
  if (!report.empty()) {
    files.write(report, [&](std::ostream& stream) { stream << to_text(json); });
  }
  files.commit();
  if (is_quiet) return;
  print(statistics, features);
  if (found) print(*found);
}

void Info::write_field_file(Output_files& files, const Mesh& mesh, const Fields& found) const
{
  files.write(output, [&](std::ostream& stream) {
    write_fields(stream, extension_of(output), mesh, found, fields);
  });
}

void Info::describe_fields(Json& json, const Mesh& mesh, const Fields& found) const
{
  if (fields.curvature) json["curvature"] = describe(found.curvature);
  if (fields.metric) json["metric"] = describe(*found.metric);
  if (output.empty() || extension_of(output) != "ply") return;
  const Color_range range = color_range(mesh, found, fields);
  json["colors"] = {{"quantity", range.quantity}, {"range", {range.low, range.high}}};
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

void Info::print(const Fields& found) const
{
  if (fields.curvature) std::cout << to_text(found.curvature);
  if (fields.metric) std::cout << to_text(*found.metric);
  if (!output.empty()) std::cout << "  written to " << output << '\n';
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
  add_field_options(*command, info->fields);
  command->add_option(
      "-o,--output", info->output,
      "write the mesh with these fields: vtp; ply, coloured; or the metric as sol");
  command->add_option("--report", info->report, "write all figures to this JSON file");
  command->add_flag("--quiet", info->is_quiet, "print nothing but errors");
  command->footer(
      "Example: surety info part.stl --curvature --metric --tolerance 0.1% -o part.vtp");
  command->callback([info] { info->run(); });
}

} // namespace surety::tool
