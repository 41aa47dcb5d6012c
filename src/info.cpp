// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety info: is this file good input, and what is in it? With curvature, metric and geometric
// support on request.
#include "commands.h"
#include "field_writing.h"
#include "fields.h"
#include "html_report.h"
#include "library_description.h"
#include "marks.h"
#include "mesh_reading.h"
#include "output_files.h"
#include "report.h"
#include "soup_reading.h"
#include "support.h"

#include <iostream>
#include <optional>

namespace surety::tool {
namespace {

struct Info {
  std::string input, output, report;
  Field_request fields;
  Support_request support;
  Reading reading;
  double feature_angle = 40, corner_angle = internal::defaults::corner_angle;
  bool is_quiet = false;

  void run() const;

private:
  void check_options() const;
  void write_output(
      Output_files& files, const Mesh& mesh, const std::optional<Fields>& found,
      const std::optional<Support>& surface) const;
  void describe_fields(Json& json, const Mesh& mesh, const Fields& found) const;
  void print(const Mesh_statistics& statistics, const Features& features) const;
  void print(const Fields& found) const;
};

void Info::check_options() const
{
  const bool needs_nothing = fields.is_empty() && !support.is_wanted;
  if (needs_nothing && !fields.noise_floor.empty())
    throw Failure(usage, "--noise-floor needs --curvature, --metric or --support");
  if (!fields.metric && !support.is_wanted && !fields.tolerance.empty())
    throw Failure(usage, "--tolerance needs --metric or --support");
  if (support.is_wanted && fields.tolerance.empty())
    throw Failure(usage, "--support needs --tolerance: how far may it be from the mesh?");
  check(fields);
  if (output.empty()) return;
  if (!support.is_wanted) return require_field_format(output, extension_of(output), fields);
  if (!fields.is_empty()) {
    throw Failure(
        usage,
        "--output: a support has points of its own; write --curvature and --metric to another "
        "file");
  }
  require_support_format(output, extension_of(output));
}

void Info::run() const
{
  check_options();
  Output_files files({input});
  if (!output.empty()) files.announce(output);
  require_json_report(report);
  if (!report.empty()) files.announce(report);
  Stopwatch watch;
  const Mesh mesh = read_mesh(input, reading);
  watch.lap("read");
  const Mesh_statistics statistics = mesh_statistics(mesh);
  watch.lap("statistics");
  // A Medit file says itself what is to stay a curve or a corner.
  const Features features
      = find_features(mesh, feature_parameters(feature_angle, corner_angle, constraints_of(mesh)));
  watch.lap("features");
  std::optional<Fields> found;
  if (!fields.is_empty()) found = make_fields(mesh, features, fields, watch);
  std::optional<Support> surface;
  if (support.is_wanted) surface = make_support(mesh, support, watch);

  Json json = new_report("info");
  json["input"] = to_json(input, statistics);
  json["features"] = {{"feature_angle", feature_angle},       {"corner_angle", corner_angle},
                      {"marked_edges", features.constrained}, {"ridge_edges", features.ridges},
                      {"border_edges", features.borders},     {"corners", features.corners}};
  if (found) describe_fields(json, mesh, *found);
  if (surface) json["support"] = describe(*surface);
  if (!output.empty()) {
    write_output(files, mesh, found, surface);
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
  if (surface) std::cout << to_text(*surface);
  if (!output.empty()) std::cout << "  written to " << output << '\n';
}

void Info::write_output(
    Output_files& files, const Mesh& mesh, const std::optional<Fields>& found,
    const std::optional<Support>& surface) const
{
  const std::string extension = extension_of(output);
  files.write(output, [&](std::ostream& stream) {
    if (surface) {
      write_support(stream, extension, mesh, surface->surface, support.subdivisions);
    } else {
      write_fields(stream, extension, mesh, *found, fields);
    }
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
  const std::string marked
      = features.constrained > 0 ? to_text(features.constrained) + " marked edges, " : "";
  std::cout << input << ": a valid triangle mesh\n"
            << to_text(statistics, "  ")
            << "  diagonal of the bounding box: " << statistics.diagonal
            << ", area: " << statistics.area << '\n'
            << "  features: " << marked << features.ridges << " ridge edges above " << feature_angle
            << " degrees, " << features.borders << " border edges, " << features.corners
            << " corners\n";
}

void Info::print(const Fields& found) const
{
  if (fields.curvature) std::cout << to_text(found.curvature);
  if (fields.metric) std::cout << to_text(*found.metric);
}

} // namespace

void add_info(CLI::App& program, Exit_status&)
{
  const auto command
      = program.add_subcommand("info", "Validity, features and statistics of a mesh");
  const auto info = std::make_shared<Info>();
  command->add_option("IN", info->input, "mesh to look at: off, obj, ply, stl, mesh or meshb")
      ->required();
  const auto feature_angle = command
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
  add_support_options(*command, info->support);
  command->add_option(
      "-t,--tolerance", info->fields.tolerance,
      "largest distance of a face of the metric to the surface, and of the support to the mesh: a "
      "length or per cent");
  command->add_option(
      "-o,--output", info->output,
      "write the mesh with these fields: vtp; ply, coloured; or the metric as sol. Or the support: "
      "vtp or ply");
  command->add_option("--report", info->report, "write all figures to this JSON file");
  command->add_flag("--quiet", info->is_quiet, "print nothing but errors");
  command->footer(
      "Example: surety info part.stl --curvature --metric --tolerance 0.1% -o part.vtp");
  command->callback([info, feature_angle] {
    Support_request& support = info->support;
    support.tolerance = info->fields.tolerance;
    support.noise_floor = info->fields.noise_floor;
    support.corner_angle = info->corner_angle;
    if (feature_angle->count() > 0) support.feature_angle = info->feature_angle;
    info->run();
  });
}

} // namespace surety::tool
