// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_command.h"

#include "failure.h"
#include "html_report.h"
#include "interruption.h"
#include "length.h"
#include "library_checks.h"
#include "library_description.h"
#include "mesh_writing.h"

namespace surety::tool {

void Mesh_command::announce_outputs(const std::vector<std::string>& inputs, Report_kind kind)
{
  files_.emplace(inputs);
  if (!is_writable(extension_of(output))) {
    throw Failure(
        usage,
        output + ": the format '" + extension_of(output)
            + "' cannot be written; give a name that ends in .off, .obj, .ply, .stl, .vtp, .mesh "
              "or .meshb");
  }
  files_->announce(output);
  if (report.empty()) return;
  if (kind == Report_kind::json)
    require_json_report(report);
  else
    require_possible_report(report);
  files_->announce(report);
}

void Mesh_command::read()
{
  const Length length = Length::parse(tolerance, "--tolerance");
  watch_for_interruption();
  input_mesh_ = read_mesh(input, reading, repairs_, attributes_);
  watch_.lap("read");
  try {
    before_ = mesh_statistics(input_mesh_);
  } catch (const Invalid_input& error) {
    throw Bad_file(input, error.problem(), error.remedy());
  }
  watch_.lap("input_statistics");
  stop_if_interrupted();
  length_ = length.in_units(diagonal(input_mesh_));
}

double Mesh_command::in_units(const std::string& text, const char* option) const
{
  return text.empty() ? 0 : Length::parse(text, option).in_units(diagonal(input_mesh_));
}

void Mesh_command::carry()
{
  if (holds_attributes(extension_of(output)))
    carried_ = carry_attributes(attributes_, input_mesh_, output_mesh_);
}

void Mesh_command::finish_output()
{
  stop_if_interrupted();
  after_ = mesh_statistics(output_mesh_);
  watch_.lap("output_statistics");
}

void Mesh_command::require_no_new_intersections() const
{
  if (after_.self_intersections <= before_.self_intersections) return;
  throw Failure(
      not_certified,
      "the result has " + to_text(after_.self_intersections) + " self-intersections, the input has "
          + to_text(before_.self_intersections)
          + "; nothing was written; lower the tolerance, or admit this with "
            "--allow-self-intersections");
}

void Mesh_command::verify(double bound)
{
  if (skips_verification) return;
  distance_ = certify_distance(input_mesh_, output_mesh_, bound);
  watch_.lap("verify");
  stop_if_interrupted();
  if (!distance_->holds())
    throw Failure(
        not_certified, "the check of the distance failed; nothing was written; please report this");
}

void Mesh_command::write(double largest)
{
  const Deviation deviation{
      output_mesh_.add_property_map<Mesh::Face_index, double>("f:deviation", 0).first, largest};
  files_->write(output, [&](std::ostream& stream) {
    write_mesh(stream, extension_of(output), output_mesh_, deviation, carried_);
  });
  watch_.lap("write");
  if (!report.empty())
    files_->write(report, [&](std::ostream& stream) {
      write_report(stream, report, describe(), {input_mesh_, output_mesh_, deviation});
    });
  stop_if_interrupted();
  files_->commit();
}

void Mesh_command::describe_input(Json& json) const
{
  json["input"] = to_json(input, before_);
  if (reading.repair) json["input"]["repairs"] = to_json(repairs_);
}

} // namespace surety::tool
