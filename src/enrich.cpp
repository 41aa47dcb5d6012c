// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety enrich: read, refine towards the smooth surface through the vertices, measure how far that
// went, write. Nothing appears on disk before everything has succeeded.
#include "commands.h"
#include "interruption.h"
#include "length.h"
#include "library_description.h"
#include "library_enrichment.h"
#include "marks.h"
#include "mesh_command.h"
#include "mesh_writing.h"
#include "report.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

namespace surety::tool {
namespace {

/// Beyond the proven bound, so that the check need not split faces for ever.
constexpr double slack_of_check = 1.01;

struct Enrich final : Mesh_command {
  std::string maximum_size;
  double feature_angle = 60;
  double corner_angle = internal::defaults::corner_angle;
  Enrichment_controls controls;

  void run();

private:
  void enrich_input();
  void require_goals() const;
  Json describe() const override;
  void print() const;

  Features features_;
  Enrichment result_;
};

void Enrich::run()
{
  announce_outputs({input}, Report_kind::json);
  read();
  enrich_input();
  require_goals();
  verify(std::max(slack_of_check * result_.deviation, 1e-9 * diagonal(input_mesh_)));
  write(result_.deviation);
  if (!is_quiet) print();
}

void Enrich::enrich_input()
{
  controls.maximum_size = maximum_size.empty() ? std::numeric_limits<double>::infinity()
                                               : in_units(maximum_size, "--max-size");
  output_mesh_ = input_mesh_;
  features_ = find_features(
      input_mesh_, feature_parameters(feature_angle, corner_angle, constraints_of(input_mesh_)));
  watch_.lap("features");
  const Curvature_field curvature
      = estimate_curvatures<Concurrency>(input_mesh_, features_, curvature_parameters(0));
  watch_.lap("curvature");
  const Geometric_support support = make_geometric_support(
      input_mesh_, std::numeric_limits<double>::infinity(), features_, curvature, No_parameters());
  watch_.lap("support");
  stop_if_interrupted();
  result_ = enrich(output_mesh_, features_, length_, enrichment_parameters(controls, support));
  watch_.lap("enrich");
  if (is_medit(extension_of(output))) {
    mark_features(input_mesh_, features_);
    carry_marks(input_mesh_, features_, output_mesh_);
  }
  finish_output();
}

void Enrich::require_goals() const
{
  const Enrichment_goals& goals = result_.enforced;
  if (goals.hold()) return;
  std::string problem;
  if (!goals.is_fine)
    problem += "edges are too long after " + to_text(std::size_t(result_.rounds))
        + " rounds; give more --rounds or a larger tolerance; ";
  if (goals.folded_faces > 0) problem += to_text(goals.folded_faces) + " faces fold; ";
  if (goals.intersections > 0)
    problem += to_text(goals.intersections) + " pairs of faces meet that did not; ";
  throw Failure(not_certified, problem + "nothing was written");
}

Json Enrich::describe() const
{
  Json json = new_report("enrich");
  describe_input(json);
  json["features"] = {{"ridges", features_.ridges}, {"corners", features_.corners}};
  json["output"] = to_json(output, after_);
  json["enforced"]
      = {{"tolerance", length_},
         {"is_fine", result_.enforced.is_fine},
         {"vertices_kept", before_.vertices},
         {"folded_faces", result_.enforced.folded_faces},
         {"new_intersections", result_.enforced.intersections}};
  json["reported"]
      = {{"deviation", result_.deviation},
         {"damped_faces", result_.damped_faces},
         {"rounds", result_.rounds}};
  if (distance_)
    json["reported"]["distance_check"]
        = {{"bound", distance_->upper_bound()}, {"holds", distance_->holds()}};
  json["seconds"] = watch_.seconds();
  json["parameters"]
      = {{"feature_angle", feature_angle},
         {"corner_angle", corner_angle},
         {"rounds", controls.rounds},
         {"allow_self_intersections", controls.allow_self_intersections}};
  if (!maximum_size.empty()) json["parameters"]["maximum_size"] = controls.maximum_size;
  return json;
}

void Enrich::print() const
{
  std::cout << input << '\n'
            << to_text(repairs_, "  ") << to_text(before_, "  ")
            << "  features: " << to_text(features_.ridges) << " ridge edges, "
            << to_text(features_.corners) << " corners\n"
            << output << '\n'
            << to_text(after_, "  ")
            << "enforced\n  the vertices of the input are kept, no face folds"
            << (controls.allow_self_intersections ? "\n" : ", none meets another one anew\n")
            << "  gap to the smooth surface: at most " << length_
            << " where it is measured, at quarters of edges and middles of faces\n"
            << "reported\n  the result leaves the input by at most " << result_.deviation << " ("
            << 100 * result_.deviation / before_.diagonal << " % of the diagonal), proven\n"
            << (skips_verification ? "  not checked independently\n"
                                   : "  checked by measuring both meshes: holds\n")
            << "  faces of the input that could not follow the smooth surface all the way: "
            << to_text(result_.damped_faces) << "\nseconds\n ";
  for (const auto& [step, seconds] : watch_.seconds().items())
    std::cout << ' ' << step << ' ' << seconds.get<double>();
  std::cout << '\n';
}

} // namespace

void add_enrich(CLI::App& program, Exit_status&)
{
  const auto command = program.add_subcommand(
      "enrich", "Refines a coarse model towards the smooth surface through its vertices");
  const auto enrich = std::make_shared<Enrich>();
  command->add_option("IN", enrich->input, "mesh to refine: off, obj, ply, stl, mesh or meshb")
      ->required();
  command
      ->add_option(
          "-o,--output", enrich->output,
          "new mesh: off, obj, ply, stl, vtp, mesh or meshb; ply and vtp show how far each face "
          "left the input")
      ->required();
  command
      ->add_option(
          "-t,--tolerance", enrich->tolerance,
          "largest gap between the result and the smooth surface: a length (0.5) or a per cent of "
          "the bounding-box diagonal (0.1%)")
      ->required();
  command->add_option(
      "--max-size", enrich->maximum_size, "halve longer edges: a length or a per cent");
  command
      ->add_option(
          "--feature-angle", enrich->feature_angle,
          "keep edges that turn by more, in degrees, as ridges; 180: none")
      ->check(between(0, 180))
      ->capture_default_str();
  command
      ->add_option(
          "--corner-angle", enrich->corner_angle,
          "let ridges and borders turn at vertices by more, in degrees")
      ->check(between(0, 180))
      ->capture_default_str();
  command->add_option("--rounds", enrich->controls.rounds, "largest number of halvings of an edge")
      ->check(between(0, 1000))
      ->capture_default_str();
  command->add_flag(
      "--allow-self-intersections", enrich->controls.allow_self_intersections,
      "do not prevent new self-intersections");
  add_reading_options(*command, enrich->reading);
  command->add_option("--report", enrich->report, "write all figures to this JSON file");
  command->add_flag("--no-verify", enrich->skips_verification, "leave the independent check out");
  command->add_flag("--quiet", enrich->is_quiet, "print nothing but errors");
  command->footer("Example: surety enrich part.stl -o fine.off -t 0.1% --report fine.json");
  command->callback([enrich] { enrich->run(); });
}

} // namespace surety::tool
