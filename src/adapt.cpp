// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety adapt: read a mesh and a field, remesh for both, verify independently, write. Nothing
// appears on disk before everything has succeeded.
#include "commands.h"
#include "controls.h"
#include "library_adaptation.h"
#include "library_description.h"
#include "mesh_command.h"
#include "report.h"

#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace surety::tool {
namespace {

const Names<Metric_kind>& names_of_metrics()
{
  static const Names<Metric_kind> names
      = {{"isotropic", Metric_kind::isotropic}, {"anisotropic", Metric_kind::anisotropic}};
  return names;
}

struct Adapt final : Mesh_command {
  std::string solution, background, minimum_size, maximum_size;
  std::optional<double> feature_angle;
  double corner_angle = internal::defaults::corner_angle;
  Adaptation_controls controls;

  void run();

private:
  Features features_of(const Mesh& mesh) const;
  void read_values();
  void adapt_input();
  void report_problem(const Invalid_input& error) const;
  Json describe() const override;
  void print() const;

  Mesh background_mesh_;
  std::vector<double> values_;
  std::size_t ridges_ = 0, corners_ = 0;
  std::optional<Adaptation> result_;
};

void Adapt::run()
{
  if (controls.target_vertices.has_value() == controls.target_error.has_value())
    throw Failure(usage, "give either --target-vertices or --target-error");
  std::vector<std::string> inputs{input, solution};
  if (!background.empty()) inputs.push_back(background);
  announce_outputs(inputs, Report_kind::json_or_html);
  read();
  if (!background.empty()) background_mesh_ = read_mesh(background, reading);
  read_values();
  adapt_input();
  if (!result_->unit_mesh.certificate.holds())
    throw Failure(not_certified, "the tolerance was not reached; nothing was written");
  if (!controls.remeshing.allow_self_intersections) require_no_new_intersections();
  verify(length_);
  write(length_);
  if (!is_quiet) print();
}

Features Adapt::features_of(const Mesh& mesh) const
{
  if (feature_angle) return find_features(mesh, feature_parameters(*feature_angle, corner_angle));
  return find_features_by_need(mesh, length_, need_parameters(corner_angle));
}

void Adapt::read_values()
{
  try {
    values_ = read_medit_scalars(solution);
  } catch (const Invalid_input& error) {
    throw Bad_file(
        solution,
        error.argument() == "path" ? error.problem() : error.argument() + ": " + error.problem(),
        error.remedy());
  }
  const std::size_t number
      = (background.empty() ? input_mesh_ : background_mesh_).number_of_vertices();
  if (values_.size() == number) return;
  throw Bad_file(
      solution,
      "it has " + std::to_string(values_.size()) + " values, the mesh "
          + (background.empty() ? input : background) + " has " + std::to_string(number)
          + " vertices",
      "name the mesh that the solution belongs to with --background");
}

void Adapt::report_problem(const Invalid_input& error) const
{
  if (error.argument() == "mesh" && error.function() == "make_solution_metric")
    throw Bad_file(background.empty() ? input : background, error.problem(), error.remedy());
  if (error.argument() == "mesh") throw Bad_file(input, error.problem(), error.remedy());
  throw Failure(usage, error.argument() + ": " + error.problem());
}

void Adapt::adapt_input()
{
  Progress_bar bar(is_quiet);
  output_mesh_ = input_mesh_;
  controls.remeshing.minimum_size = in_units(minimum_size, "--min-size");
  controls.remeshing.maximum_size = in_units(maximum_size, "--max-size");
  try {
    const Features features = features_of(input_mesh_);
    ridges_ = features.ridges, corners_ = features.corners;
    const bool is_same = background.empty();
    const Features behind = is_same ? features : features_of(background_mesh_);
    watch_.lap("features");
    result_ = adapt(
        output_mesh_, features, length_,
        Carried_field{is_same ? input_mesh_ : background_mesh_, behind, values_}, controls,
        Visitor(bar));
    carry();
  } catch (const Invalid_input& error) {
    report_problem(error);
  }
  watch_.lap("adapt");
  finish_output();
}

Json Adapt::describe() const
{
  const Unit_mesh_result& made = result_->unit_mesh;
  Json json = new_report("adapt");
  describe_input(json);
  json["features"] = {{"ridges", ridges_}, {"corners", corners_}};
  json["field"]
      = {{"vertices_asked_for", result_->vertices_for_field},
         {"vertices_after_gradation", result_->vertices_for_graded_field}};
  json["output"] = to_json(output, after_);
  if (!carried_.is_empty()) json["output"]["attributes"] = names_of(carried_);
  json["output"]["unit_edges"] = made.fit.unit_edges;
  json["output"]["efficiency_index"] = made.fit.efficiency_index;
  json["output"]["metric"] = to_json(made.fit);
  json["output"]["given_metric"] = to_json(made.fit_of_given);
  Json& certificate = json["certificate"];
  certificate["tolerance"] = length_;
  certificate["bound"] = made.certificate.bound();
  certificate["holds"] = made.certificate.holds();
  certificate["policy"] = "covering";
  if (distance_)
    certificate["distance_check"]
        = {{"bound", distance_->upper_bound()}, {"holds", distance_->holds()}};
  json["seconds"] = watch_.seconds();
  const Remesh_controls& sizes = controls.remeshing;
  json["parameters"]
      = {{"metric", name_of(sizes.kind, names_of_metrics())},
         {"norm", controls.norm_exponent},
         {"gradation", sizes.gradation},
         {"minimum_size", sizes.minimum_size},
         {"maximum_size", sizes.maximum_size},
         {"maximum_aspect_ratio", sizes.maximum_aspect_ratio},
         {"iterations", sizes.iterations},
         {"corner_angle", corner_angle}};
  if (controls.target_vertices) json["parameters"]["target_vertices"] = *controls.target_vertices;
  if (controls.target_error) json["parameters"]["target_error"] = *controls.target_error;
  if (feature_angle) json["parameters"]["feature_angle"] = *feature_angle;
  json["iterations"] = made.iterations;
  json["operations"] = to_json(made.certificate.operations());
  return json;
}

void Adapt::print() const
{
  const Unit_mesh_result& made = result_->unit_mesh;
  std::cout << input << '\n'
            << to_text(before_, "  ") << "  features: " << to_text(ridges_) << " ridge edges, "
            << to_text(corners_) << " corners\n"
            << solution << "\n  asks for " << std::llround(result_->vertices_for_field)
            << " vertices, " << std::llround(result_->vertices_for_graded_field)
            << " with its gradation limited\n"
            << output << '\n'
            << to_text(after_, "  ") << to_text(attributes_, carried_, "  ")
            << "  unit edges: " << made.fit.unit_edges
            << " %\n  efficiency index: " << made.fit.efficiency_index << '\n'
            << "certificate\n  tolerance " << length_ << " (" << 100 * length_ / before_.diagonal
            << " % of the diagonal)\n  proven: no point of either surface is farther than "
            << made.certificate.bound() << " from the other\n"
            << (skips_verification ? "  not checked independently\n"
                                   : "  checked by measuring both meshes: holds\n")
            << "seconds\n ";
  for (const auto& [step, seconds] : watch_.seconds().items())
    std::cout << ' ' << step << ' ' << seconds.get<double>();
  std::cout << '\n';
}

void add_field_options(CLI::App& command, Adapt& adapt)
{
  command
      .add_option(
          "--solution", adapt.solution,
          "Medit .sol file with a value for each vertex of the input, or of --background")
      ->required();
  command.add_option(
      "--background", adapt.background,
      "another mesh of the same surface, that the solution belongs to");
  command
      .add_option(
          "--target-vertices", adapt.controls.target_vertices,
          "number of vertices that the solution may cost; its gradation and the surface add some")
      ->check(between(1, 1e9));
  command
      .add_option(
          "--target-error", adapt.controls.target_error,
          "interpolation error of the solution in the norm of --norm; instead of "
          "--target-vertices")
      ->check(between(0, std::numeric_limits<double>::infinity()));
  command
      .add_option(
          "--norm", adapt.controls.norm_exponent,
          "p of the L^p norm of the error; inf: the largest error; small p see weak features")
      ->check(between(1, std::numeric_limits<double>::infinity()))
      ->capture_default_str();
}

void add_size_options(CLI::App& command, Adapt& adapt)
{
  Remesh_controls& sizes = adapt.controls.remeshing;
  sizes.kind = Metric_kind::anisotropic;
  command.add_option("--metric", sizes.kind, "whether sizes depend on the direction")
      ->transform(CLI::CheckedTransformer(names_of_metrics()).description("isotropic|anisotropic"))
      ->default_str("anisotropic");
  command
      .add_option(
          "--gradation", sizes.gradation,
          "by which factor sizes may grow from edge to edge; 0: 1.3")
      ->check(between(0, std::numeric_limits<double>::infinity()))
      ->capture_default_str();
  command.add_option(
      "--min-size", adapt.minimum_size,
      "least edge length; default: 0.1% of the diagonal for the solution, for the surface as "
      "remesh has it");
  command.add_option(
      "--max-size", adapt.maximum_size, "largest edge length; default: 10% of the diagonal");
  command
      .add_option(
          "--max-aspect", sizes.maximum_aspect_ratio, "largest ratio of the two sizes at one place")
      ->check(between(1, 1e6))
      ->capture_default_str();
}

} // namespace

void add_adapt(CLI::App& program, Exit_status&)
{
  const auto command = program.add_subcommand(
      "adapt",
      "Makes a mesh for a solution within a proven distance: sizes follow its derivatives");
  const auto adapt = std::make_shared<Adapt>();
  command->add_option("IN", adapt->input, "mesh of the surface: off, obj, ply or stl")->required();
  command
      ->add_option(
          "-o,--output", adapt->output,
          "new mesh: off, obj, ply, stl or vtp; ply and vtp show the deviation of each face")
      ->required();
  command
      ->add_option(
          "-t,--tolerance", adapt->tolerance,
          "largest distance between the two, either way: a length (0.5) or a per cent of the "
          "bounding-box diagonal (0.1%)")
      ->required();
  add_field_options(*command, *adapt);
  add_size_options(*command, *adapt);
  command
      ->add_option(
          "--feature-angle", adapt->feature_angle,
          "keep edges that turn by more, in degrees, as ridges; 180: none; default: those where a "
          "smooth surface would leave the tolerance")
      ->check(between(0, 180));
  command
      ->add_option(
          "--corner-angle", adapt->corner_angle,
          "keep vertices where ridges or borders turn by more, in degrees")
      ->check(between(0, 180))
      ->capture_default_str();
  command
      ->add_option("--iterations", adapt->controls.remeshing.iterations, "largest number of passes")
      ->check(between(0, 1000))
      ->capture_default_str();
  command->add_flag(
      "--allow-self-intersections", adapt->controls.remeshing.allow_self_intersections,
      "do not prevent new self-intersections");
  command->add_flag(
      "--triangulate", adapt->reading.triangulate, "split faces with more than three corners");
  command->add_option(
      "--report", adapt->report,
      "write all figures to this JSON file, or with pictures to this .html file");
  command->add_flag("--no-verify", adapt->skips_verification, "leave the independent check out");
  command->add_flag("--quiet", adapt->is_quiet, "print nothing but errors");
  command->footer(
      "Example: surety adapt part.off -o next.off -t 0.1% --solution u.sol --target-vertices 5000");
  command->callback([adapt] { adapt->run(); });
}

} // namespace surety::tool
