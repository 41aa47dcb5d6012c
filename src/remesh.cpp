// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety remesh: makes a mesh for simulation.
#include "commands.h"
#include "controls.h"
#include "length.h"
#include "library_description.h"
#include "library_remeshing.h"
#include "marks.h"
#include "mesh_command.h"
#include "mesh_writing.h"
#include "report.h"

#include <iostream>
#include <limits>
#include <memory>
#include <optional>

namespace surety::tool {
namespace {

const Names<Metric_kind>& names_of_metrics()
{
  static const Names<Metric_kind> names
      = {{"isotropic", Metric_kind::isotropic}, {"anisotropic", Metric_kind::anisotropic}};
  return names;
}

struct Remesh final : Mesh_command {
  std::string minimum_size, maximum_size, size_field;
  std::optional<double> feature_angle;
  double corner_angle = internal::defaults::corner_angle;
  Remesh_controls controls;

  void run();

private:
  Features find_features_of_input() const;
  Medit_solution sizes() const;
  void remesh_input();
  Json describe() const override;
  Json describe_output() const;
  void print() const;

  std::size_t ridges_ = 0, corners_ = 0;
  std::optional<Unit_mesh_result> result_;
};

void Remesh::run()
{
  announce_outputs({input}, Report_kind::json_or_html);
  read();
  remesh_input();
  if (!result_->certificate.holds())
    throw Failure(not_certified, "the tolerance was not reached; nothing was written");
  if (!controls.allow_self_intersections) require_no_new_intersections();
  verify(length_);
  write(length_);
  if (!is_quiet) print();
}

Features Remesh::find_features_of_input() const
{
  const Constraints constraints = constraints_of(input_mesh_);
  Features features = feature_angle
      ? find_features(input_mesh_, feature_parameters(*feature_angle, corner_angle, constraints))
      : find_features_by_need(input_mesh_, length_, need_parameters(corner_angle, constraints));
  for (const auto e : input_mesh_.edges()) features.whole.push_back(constraints.whole_edges[e]);
  return features;
}

/// The user's sizes; without any, ones that are too large to matter.
Medit_solution Remesh::sizes() const
{
  if (!size_field.empty()) return read_medit_sol(size_field);
  Medit_solution result;
  result.sizes.assign(input_mesh_.number_of_vertices(), 10 * diagonal(input_mesh_));
  return result;
}

void Remesh::remesh_input()
{
  Progress_bar bar(is_quiet);
  output_mesh_ = input_mesh_;
  controls.minimum_size = in_units(minimum_size, "--min-size");
  controls.maximum_size = in_units(maximum_size, "--max-size");
  try {
    const Features features = find_features_of_input();
    ridges_ = features.ridges, corners_ = features.corners;
    watch_.lap("features");
    result_
        = remesh(
              output_mesh_, features, length_, remesh_parameters(controls, sizes(), Visitor(bar)))
              .unit_mesh;
    carry();
    if (is_medit(extension_of(output))) {
      mark_features(input_mesh_, features);
      carry_marks(input_mesh_, features, output_mesh_);
    }
  } catch (const Invalid_input& error) {
    if (error.argument() == "mesh") throw Bad_file(input, error.problem(), error.remedy());
    if (error.argument() == "size_field" || error.function() == "read_medit_sol")
      throw Bad_file(size_field, error.problem(), error.remedy());
    throw Failure(usage, error.argument() + ": " + error.problem());
  }
  watch_.lap("remesh");
  finish_output();
}

Json Remesh::describe_output() const
{
  Json json = to_json(output, after_);
  if (!carried_.is_empty()) json["attributes"] = names_of(carried_);
  json["unit_edges"] = result_->fit.unit_edges;
  json["efficiency_index"] = result_->fit.efficiency_index;
  json["metric"] = to_json(result_->fit);
  json["given_metric"] = to_json(result_->fit_of_given);
  return json;
}

Json Remesh::describe() const
{
  Json json = new_report("remesh");
  describe_input(json);
  json["features"] = {{"ridges", ridges_}, {"corners", corners_}};
  json["output"] = describe_output();
  Json& certificate = json["certificate"];
  certificate["tolerance"] = length_;
  certificate["bound"] = result_->certificate.bound();
  certificate["holds"] = result_->certificate.holds();
  certificate["policy"] = "covering";
  if (distance_)
    certificate["distance_check"]
        = {{"bound", distance_->upper_bound()}, {"holds", distance_->holds()}};
  json["seconds"] = watch_.seconds();
  json["parameters"]
      = {{"metric", name_of(controls.kind, names_of_metrics())},
         {"placement", name_of(controls.placement, names_of_placements())},
         {"fewest_faces", controls.fewest_faces},
         {"proximity", controls.limits_proximity && !controls.fewest_faces},
         {"gradation", controls.gradation},
         {"minimum_size", controls.minimum_size},
         {"maximum_size", controls.maximum_size},
         {"maximum_aspect_ratio", controls.maximum_aspect_ratio},
         {"iterations", controls.iterations},
         {"corner_angle", corner_angle},
         {"allow_self_intersections", controls.allow_self_intersections}};
  if (feature_angle) json["parameters"]["feature_angle"] = *feature_angle;
  json["iterations"] = result_->iterations;
  json["operations"] = to_json(result_->certificate.operations());
  return json;
}

void Remesh::print() const
{
  const Metric_fit &fit = result_->fit, &given = result_->fit_of_given;
  std::cout << input << '\n'
            << to_text(repairs_, "  ") << to_text(before_, "  ")
            << "  features: " << to_text(ridges_) << " ridge edges, " << to_text(corners_)
            << " corners\n"
            << output << '\n'
            << to_text(after_, "  ") << to_text(attributes_, carried_, "  ")
            << "  unit edges: " << fit.unit_edges << " % (" << given.unit_edges
            << " % in the metric before the tolerance made it smaller)\n"
            << "  efficiency index: " << fit.efficiency_index << '\n'
            << "certificate\n  tolerance " << length_ << " (" << 100 * length_ / before_.diagonal
            << " % of the diagonal)\n  proven: no point of either surface is farther than "
            << result_->certificate.bound() << " from the other\n"
            << (skips_verification ? "  not checked independently\n"
                                   : "  checked by measuring both meshes: holds\n");
  if (after_.faces > before_.faces)
    std::cout << "note\n  The result has more faces than the input, whose edges are long for this "
                 "tolerance.\n  Where few faces count, try --fewest, a --feature-angle, or surety "
                 "simplify.\n";
  std::cout << "seconds\n ";
  for (const auto& [step, seconds] : watch_.seconds().items())
    std::cout << ' ' << step << ' ' << seconds.get<double>();
  std::cout << '\n';
}

void add_size_options(CLI::App& command, Remesh& remesh)
{
  command
      .add_option(
          "--metric", remesh.controls.kind,
          "whether sizes depend on the direction: faces along edges and cylinders are long then")
      ->transform(CLI::CheckedTransformer(names_of_metrics()).description("isotropic|anisotropic"))
      ->default_str("isotropic");
  command.add_flag(
      "--fewest", remesh.controls.fewest_faces,
      "prefer few faces to a mesh that follows the curvature closely");
  command.add_flag(
      "!--no-proximity", remesh.controls.limits_proximity,
      "do not lower isotropic sizes where features are near to each other; --fewest implies it");
  command
      .add_option(
          "--gradation", remesh.controls.gradation,
          "by which factor sizes may grow from edge to edge; 0: 1.3, or 1.75 with --fewest")
      ->check(between(0, std::numeric_limits<double>::infinity()))
      ->capture_default_str();
  command.add_option(
      "--min-size", remesh.minimum_size,
      "least edge length; default: six times the tolerance, down to a third of that where the "
      "tolerance asks for it");
  command.add_option(
      "--max-size", remesh.maximum_size, "largest edge length; default: 10% of the diagonal");
  command
      .add_option(
          "--max-aspect", remesh.controls.maximum_aspect_ratio,
          "largest ratio of the two sizes at one place")
      ->check(between(1, 1e6))
      ->capture_default_str();
  command.add_option(
      "--size-field", remesh.size_field,
      "Medit .sol file with a size or a tensor for each vertex of the input");
}

} // namespace

void add_remesh(CLI::App& program, Exit_status&)
{
  const auto command = program.add_subcommand(
      "remesh", "Makes a mesh for simulation within a proven distance: sizes follow the curvature");
  const auto remesh = std::make_shared<Remesh>();
  command->add_option("IN", remesh->input, "mesh to remesh: off, obj, ply, stl, mesh or meshb")
      ->required();
  command
      ->add_option(
          "-o,--output", remesh->output,
          "new mesh: off, obj, ply, stl, vtp, mesh or meshb; ply and vtp show the deviation of "
          "each "
          "face")
      ->required();
  command
      ->add_option(
          "-t,--tolerance", remesh->tolerance,
          "largest distance between the two, either way: a length (0.5) or a per cent of the "
          "bounding-box diagonal (0.1%)")
      ->required();
  add_size_options(*command, *remesh);
  command
      ->add_option(
          "--feature-angle", remesh->feature_angle,
          "keep edges that turn by more, in degrees, as ridges; 180: none; default: those where a "
          "smooth surface would leave the tolerance")
      ->check(between(0, 180));
  command
      ->add_option(
          "--corner-angle", remesh->corner_angle,
          "keep vertices where ridges or borders turn by more, in degrees")
      ->check(between(0, 180))
      ->capture_default_str();
  command
      ->add_option(
          "--placement", remesh->controls.placement,
          "where vertices may go; on-surface: on the smooth surface through the input's vertices")
      ->transform(CLI::CheckedTransformer(names_of_placements()).description("on-surface|free"))
      ->default_str("free");
  command->add_option("--iterations", remesh->controls.iterations, "largest number of passes")
      ->check(between(0, 1000))
      ->capture_default_str();
  command->add_flag(
      "--allow-self-intersections", remesh->controls.allow_self_intersections,
      "do not prevent new self-intersections");
  add_reading_options(*command, remesh->reading);
  command->add_option(
      "--report", remesh->report,
      "write all figures to this JSON file, or with pictures to this .html file");
  command->add_flag("--no-verify", remesh->skips_verification, "leave the independent check out");
  command->add_flag("--quiet", remesh->is_quiet, "print nothing but errors");
  command->footer("Example: surety remesh part.stl -o fe.off -t 0.1% --report fe.json");
  command->callback([remesh] { remesh->run(); });
}

} // namespace surety::tool
