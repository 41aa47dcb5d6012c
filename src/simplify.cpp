// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety simplify: read, simplify, verify independently, write. Nothing appears on disk before
// everything has succeeded.
#include "attributes.h"
#include "commands.h"
#include "controls.h"
#include "html_report.h"
#include "library_checks.h"
#include "library_description.h"
#include "library_simplification.h"
#include "interruption.h"
#include "length.h"
#include "marks.h"
#include "mesh_reading.h"
#include "mesh_writing.h"
#include "output_files.h"
#include "report.h"
#include "soup_reading.h"
#include "threads.h"
#include "tolerance_field.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <map>
#include <optional>

namespace surety::tool {
namespace {

struct Arguments {
  std::string input, output, tolerance, tolerance_field, certificate, report;
  unsigned threads = 0;
  Reading reading;
  Controls controls;
  bool is_quiet = false, skips_verification = false;
};

/// What the two independent checks say.
struct Verification {
  std::optional<Certificate_check> certificate;
  std::optional<Distance_certificate> distance;
};

class Simplify
{
public:
  explicit Simplify(const Arguments& arguments)
    : arguments_(arguments), controls_(arguments.controls), files_({arguments.input})
  {}

  void run()
  {
    if (arguments_.tolerance.empty() && arguments_.controls.target_faces == 0)
      throw Failure(usage, "--tolerance is required unless --target-faces is given");
    const Length length = Length::parse(
        arguments_.tolerance.empty() ? "100%" : arguments_.tolerance, "--tolerance");
    const Thread_limit thread_limit(arguments_.threads);
    announce_outputs();
    require_compatible(arguments_.controls);
    require_uniform_tolerance_if_accumulated();
    watch_for_interruption();
    read();
    tolerance_ = length.in_units(diagonal(input_));
    simplify();
    verify();
    write();
    if (!arguments_.is_quiet) print();
  }

private:
  void announce_outputs();
  void require_uniform_tolerance_if_accumulated() const;
  void read();
  void mark_output(const Constraints& constraints);
  void simplify();
  void verify();
  void require_no_new_intersection() const;
  [[noreturn]] static void fail_verification(const std::string& how);
  void write();
  Json report() const;
  void print() const;

  /// Ends a step.
  void lap(const char* step)
  {
    watch_.lap(step);
    stop_if_interrupted();
  }

  const Arguments& arguments_;
  Controls controls_;
  Output_files files_;
  Stopwatch watch_;
  Mesh input_, output_;
  Repairs repairs_;
  Attributes attributes_, carried_;
  Mesh_statistics input_statistics_, output_statistics_;
  double tolerance_ = 0;
  std::optional<Certificate> certificate_;
  Verification verification_;
};

void Simplify::announce_outputs()
{
  const std::string extension = extension_of(arguments_.output);
  if (!is_writable(extension)) {
    throw Failure(
        usage,
        arguments_.output + ": the format '" + extension
            + "' cannot be written; give a name that ends in .off, .obj, .ply, .stl, .vtp, .mesh "
              "or .meshb");
  }
  files_.announce(arguments_.output);
  if (!arguments_.report.empty()) {
    require_possible_report(arguments_.report);
    files_.announce(arguments_.report);
  }
  if (arguments_.certificate.empty()) return;
  if (arguments_.controls.deviation_bound == Deviation_bound::accumulated) {
    throw Failure(
        usage,
        "--certificate: the accumulated bound keeps no record that could be written; leave one of "
        "the two options out");
  }
  if (extension == "stl" || extension == "vtp") {
    throw Failure(
        usage,
        "--certificate: a certificate refers to vertices by number, which a file of format '"
            + extension + "' does not give back; write off, obj, ply, mesh or meshb");
  }
  files_.announce(arguments_.certificate);
}

void Simplify::require_uniform_tolerance_if_accumulated() const
{
  if (arguments_.controls.deviation_bound == Deviation_bound::accumulated
      && !arguments_.tolerance_field.empty())
    throw Failure(
        usage,
        "--bound: the accumulated bound knows no tolerance that varies; leave --tolerance-field "
        "out");
}

void Simplify::read()
{
  input_ = read_mesh(arguments_.input, arguments_.reading, repairs_, attributes_);
  lap("read");
  try {
    input_statistics_ = mesh_statistics(input_);
  } catch (const Invalid_input& error) {
    throw Bad_file(arguments_.input, error.problem(), error.remedy());
  }
  lap("input_statistics");
}

/// Where the output can tell them, ridges and corners that are kept are marked beside those that
/// the input has; marks stay with the elements that stay.
void Simplify::mark_output(const Constraints& constraints)
{
  if (!is_medit(extension_of(arguments_.output))) return;
  const auto parameters
      = feature_parameters(controls_.feature_angle, controls_.corner_angle, constraints);
  mark_features(output_, find_features(input_, parameters));
}

void Simplify::simplify()
{
  Progress_bar bar(arguments_.is_quiet);
  output_ = input_;
  const Constraints constraints = constraints_of(input_);
  mark_output(constraints);
  const Tolerances tolerances = add_tolerances(output_, tolerance_, arguments_.tolerance_field);
  Controls& controls = controls_;
  set_ridge_length(controls, tolerance_, diagonal(input_));
  // So that STL, which is binary for such coordinates only, stays binary and small.
  controls.single_precision
      = extension_of(arguments_.output) == "stl" && has_float_coordinates(input_);
  try {
    certificate_ = make_geometric_mesh<Concurrency>(
        output_, tolerance_, simplify_parameters(controls, tolerances, constraints, Visitor(bar)));
  } catch (const Invalid_input& error) {
    if (error.argument() == "mesh")
      throw Bad_file(arguments_.input, error.problem(), error.remedy());
    throw Failure(usage, error.argument() + ": " + error.problem());
  }
  lap("geometric_mesh");
  if (holds_attributes(extension_of(arguments_.output)))
    carried_ = carry_attributes(attributes_, input_, output_, certificate_->correspondence());
  output_statistics_ = mesh_statistics(output_);
  lap("output_statistics");
}

void Simplify::verify()
{
  if (!certificate_->holds()) {
    throw Failure(
        not_certified,
        "the tolerance is " + to_text(tolerance_) + ", but only " + to_text(certificate_->bound())
            + " was reached; nothing was written");
  }
  require_no_new_intersection();
  if (arguments_.skips_verification) return;
  if (certificate_->correspondence()) {
    verification_.certificate = check_certificate(input_, output_, *certificate_);
    stop_if_interrupted();
    if (!verification_.certificate->holds) {
      fail_verification("of the certificate failed: " + verification_.certificate->reason);
    }
    if (verification_.certificate->largest_normal_deviation > arguments_.controls.normal_tolerance)
      fail_verification(
          "of normals proves only " + to_text(verification_.certificate->largest_normal_deviation)
          + " degrees");
    if (verification_.certificate->curve_bound > controls_.ridge_length)
      fail_verification("of ridges proves only " + to_text(verification_.certificate->curve_bound));
  }
  verification_.distance = certify_distance(input_, output_, tolerance_);
  lap("verify");
  if (verification_.distance->refuted()) fail_verification("of the distance failed");
  if (!verification_.distance->holds()) fail_verification("of the distance came to no decision");
}

void Simplify::fail_verification(const std::string& how)
{
  throw Failure(not_certified, "the check " + how + "; nothing was written; please report this");
}

void Simplify::require_no_new_intersection() const
{
  const auto before = input_statistics_.self_intersections;
  const auto after = output_statistics_.self_intersections;
  if (arguments_.controls.allow_self_intersections || after <= before) return;
  throw Failure(
      not_certified,
      "the result has " + to_text(after) + " self-intersections, the input has " + to_text(before)
          + "; nothing was written; lower the tolerance, or admit this with "
            "--allow-self-intersections");
}

void Simplify::write()
{
  const Deviation deviation{
      output_.add_property_map<Mesh::Face_index, double>("f:deviation", 0).first, tolerance_};
  files_.write(arguments_.output, [&](std::ostream& stream) {
    write_mesh(stream, extension_of(arguments_.output), output_, deviation, carried_);
  });
  if (!arguments_.certificate.empty()) {
    files_.write(arguments_.certificate, [&](std::ostream& stream) {
      write_certificate(stream, *certificate_);
    });
  }
  lap("write");
  if (!arguments_.report.empty()) {
    files_.write(arguments_.report, [&](std::ostream& stream) {
      write_report(stream, arguments_.report, report(), {input_, output_, deviation});
    });
  }
  stop_if_interrupted();
  files_.commit();
}

Json Simplify::report() const
{
  Json json = new_report("simplify");
  json["input"] = to_json(arguments_.input, input_statistics_);
  if (arguments_.reading.repair) json["input"]["repairs"] = to_json(repairs_);
  json["output"] = to_json(arguments_.output, output_statistics_);
  if (!carried_.is_empty()) json["output"]["attributes"] = names_of(carried_);
  Json& certificate = json["certificate"];
  certificate["tolerance"] = tolerance_;
  certificate["bound"] = certificate_->bound();
  certificate["holds"] = certificate_->holds();
  certificate["policy"] = name_of(arguments_.controls.deviation_bound, names_of_bounds());
  if (verification_.certificate) {
    certificate["certificate_check"]
        = {{"bound", verification_.certificate->bound},
           {"holds", verification_.certificate->holds},
           {"curve_bound", verification_.certificate->curve_bound},
           {"largest_normal_deviation", verification_.certificate->largest_normal_deviation}};
  }
  if (verification_.distance) {
    certificate["distance_check"]
        = {{"bound", verification_.distance->upper_bound()},
           {"holds", verification_.distance->holds()}};
  }
  json["seconds"] = watch_.seconds();
  json["parameters"] = describe(controls_);
  json["operations"] = to_json(certificate_->operations());
  return json;
}

/// What is proven of ridges and borders, where there are any that moved.
std::string to_text_of_curves(const Certificate_check& check)
{
  if (check.curve_bound == 0) return {};
  return "; ridges and borders lie within " + to_text(check.curve_bound);
}

void Simplify::print() const
{
  const double per_cent = 100. * double(output_statistics_.faces) / double(input_statistics_.faces);
  std::cout << arguments_.input << '\n'
            << to_text(repairs_, "  ") << to_text(input_statistics_, "  ") << arguments_.output
            << " (" << to_text(per_cent) << " % of the faces)\n"
            << to_text(output_statistics_, "  ") << to_text(attributes_, carried_, "  ")
            << "certificate\n  tolerance " << tolerance_ << " ("
            << 100 * tolerance_ / diagonal(input_) << " % of the diagonal)\n  proven: no point of "
            << "either surface is farther than " << certificate_->bound() << " from the other\n";
  if (verification_.certificate)
    std::cout << "  checked from its record: holds; normals turn by at most "
              << verification_.certificate->largest_normal_deviation << " degrees"
              << to_text_of_curves(*verification_.certificate) << '\n';
  if (verification_.distance) std::cout << "  checked by measuring both meshes: holds\n";
  if (arguments_.skips_verification) std::cout << "  not checked independently\n";
  std::cout << "seconds\n ";
  for (const auto& [step, seconds] : watch_.seconds().items()) {
    std::cout << ' ' << step << ' ' << seconds.get<double>();
  }
  std::cout << '\n';
}

} // namespace

void add_simplify(CLI::App& program, Exit_status&)
{
  const auto command = program.add_subcommand(
      "simplify", "Makes a mesh with far fewer faces within a proven distance");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("IN", arguments->input, "mesh to simplify: off, obj, ply, stl, mesh or meshb")
      ->required();
  command
      ->add_option(
          "-o,--output", arguments->output,
          "simplified mesh: off, obj, ply, stl, vtp, mesh or meshb; ply and vtp show the deviation "
          "of "
          "each face")
      ->required();
  command->add_option(
      "-t,--tolerance", arguments->tolerance,
      "largest distance between the two, either way: a length (0.5) or a per cent of the "
      "bounding-box diagonal (0.1%); may be left out with --target-faces");
  command->add_option(
      "--tolerance-field", arguments->tolerance_field,
      "text file with a tolerance for each vertex or for each face, where it is less");
  command->add_option("--threads", arguments->threads, "threads for large meshes; 0: all there are")
      ->check(between(0, 4096))
      ->capture_default_str();
  add_controls(*command, arguments->controls);
  add_reading_options(*command, arguments->reading);
  command->add_option(
      "--certificate", arguments->certificate, "write the proof to this file, for surety verify");
  command->add_option(
      "--report", arguments->report,
      "write all figures to this JSON file, or with pictures to this .html file");
  command->add_flag(
      "--no-verify", arguments->skips_verification, "leave the independent checks out");
  command->add_flag("--quiet", arguments->is_quiet, "print nothing but errors");
  command->footer("Example: surety simplify part.stl -o part.off -t 0.1% --certificate part.cert");
  command->callback([arguments] { Simplify(*arguments).run(); });
}

} // namespace surety::tool
