// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety hierarchy: levels of detail, one file each, and an index that tells a viewer when to
// switch. All of it appears at once, as a folder, or not at all.
#include "commands.h"
#include "controls.h"
#include "glb.h"
#include "html_report.h"
#include "library_checks.h"
#include "library_description.h"
#include "library_simplification.h"
#include "interruption.h"
#include "length.h"
#include "mesh_reading.h"
#include "mesh_writing.h"
#include "output_files.h"
#include "report.h"
#include "soup_reading.h"

#include <surety/hierarchy.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>

#include <sys/stat.h>
#include <unistd.h>

namespace surety::tool {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string input, folder, tolerances, report, format = "glb";
  Reading reading;
  Controls controls;
  double viewport_height = 1080, field_of_view = 60, pixel_error = 1;
  bool with_certificates = false, is_quiet = false, skips_verification = false;
};

/// A folder that takes its name when everything in it has been written.
class Output_folder
{
public:
  explicit Output_folder(const std::string& name) : name_(name)
  {
    fs::path target = fs::absolute(name).lexically_normal();
    if (target.filename().empty()) target = target.parent_path();
    target_ = target;
    std::error_code error;
    if (fs::exists(target_, error) && !(fs::is_directory(target_, error) && is_empty()))
      refuse("it exists already; give the name of a new or empty folder");
    const fs::path parent = target_.parent_path();
    if (!fs::is_directory(parent, error)) refuse("there is no folder " + parent.string());
    if (access(parent.c_str(), W_OK | X_OK) != 0)
      refuse("the folder " + parent.string() + " cannot be written to");
  }
  Output_folder(const Output_folder&) = delete;
  Output_folder& operator=(const Output_folder&) = delete;
  /// Removes what was not committed.
  ~Output_folder()
  {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
  }

  void write(const std::string& file, const std::function<void(std::ostream&)>& content)
  {
    if (temporary_.empty()) make_temporary();
    std::ofstream stream(temporary_ / file, std::ios::binary);
    content(stream);
    stream.close();
    if (!stream) throw Failure(not_certified, file + ": writing failed; is the disk full?");
  }

  void commit()
  {
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) throw Failure(not_certified, name_ + ": " + error.message());
    temporary_.clear();
  }

private:
  [[noreturn]] void refuse(const std::string& problem) const
  {
    throw Failure(usage, name_ + ": " + problem);
  }
  bool is_empty() const
  {
    std::error_code error;
    return fs::is_empty(target_, error) && !error;
  }
  void make_temporary()
  {
    std::string path
        = (target_.parent_path() / ("." + target_.filename().string() + ".XXXXXX")).string();
    if (mkdtemp(path.data()) == nullptr) refuse("its folder cannot be written to");
    temporary_ = path;
    // mkdtemp makes private folders; outputs get the usual permissions.
    const mode_t mask = umask(0);
    umask(mask);
    if (chmod(path.c_str(), 0777 & ~mask) != 0) refuse("its permissions cannot be set");
  }

  std::string name_;
  fs::path target_, temporary_;
};

class Make_hierarchy
{
public:
  explicit Make_hierarchy(const Arguments& arguments)
    : arguments_(arguments),
      controls_(arguments.controls),
      folder_(arguments.folder),
      report_({arguments.input})
  {}

  void run()
  {
    const std::vector<Length> lengths = parse_tolerances();
    require_json_report(arguments_.report);
    if (!arguments_.report.empty()) report_.announce(arguments_.report);
    require_compatible(arguments_.controls);
    require_numbered_vertices();
    watch_for_interruption();
    read();
    for (const Length& length : lengths) tolerances_.push_back(length.in_units(diagonal(input_)));
    simplify();
    verify();
    write();
    if (!arguments_.is_quiet) print();
  }

private:
  bool is_single_precision() const { return arguments_.format == "glb"; }
  const std::vector<Hierarchy_level<Mesh>>& levels() const { return hierarchy_->levels(); }

  std::vector<Length> parse_tolerances() const
  {
    std::vector<Length> lengths;
    std::istringstream list(arguments_.tolerances + ',');
    for (std::string text; std::getline(list, text, ',');)
      lengths.push_back(Length::parse(text, "--tolerances"));
    return lengths;
  }

  void require_numbered_vertices() const
  {
    if (arguments_.with_certificates && (is_single_precision() || arguments_.format == "stl"))
      throw Failure(
          usage,
          "--certificates: a file of format '" + arguments_.format
              + "' does not give the vertices back as they were; write off, obj or ply");
    if (arguments_.with_certificates
        && arguments_.controls.deviation_bound == Deviation_bound::accumulated)
      throw Failure(
          usage,
          "--certificates: the accumulated bound keeps no record that could be written; leave one "
          "of the two options out");
  }

  void read()
  {
    input_ = read_mesh(arguments_.input, arguments_.reading, repairs_);
    lap("read");
    try {
      input_statistics_ = mesh_statistics(input_);
    } catch (const Invalid_input& error) {
      throw Bad_file(arguments_.input, error.problem(), error.remedy());
    }
    lap("input_statistics");
  }

  void simplify();
  bool is_certificate_confirmed(const Mesh& mesh, const Certificate& certificate) const;
  void verify();
  void write();
  void write_level(std::ostream& stream, std::size_t level) const;
  Json index() const;
  void print() const;

  std::string file_of(std::size_t level) const
  {
    return "level_" + std::to_string(level) + '.' + arguments_.format;
  }
  /// What is proven for the file: the certificate's bound, and the rounding of its coordinates.
  double bound_of_file(std::size_t level) const
  {
    const double bound = levels()[level].certificate.bound();
    const double error = is_single_precision() ? single_precision_error(levels()[level].mesh) : 0;
    return error == 0 ? bound
                      : std::nextafter(bound + error, std::numeric_limits<double>::infinity());
  }
  /// Ends a step.
  void lap(const char* step)
  {
    watch_.lap(step);
    stop_if_interrupted();
  }

  const Arguments& arguments_;
  Controls controls_;
  Output_folder folder_;
  Output_files report_;
  Stopwatch watch_;
  Mesh input_;
  Repairs repairs_;
  Mesh_statistics input_statistics_;
  std::vector<double> tolerances_;
  std::optional<Hierarchy<Mesh>> hierarchy_;
};

void Make_hierarchy::simplify()
{
  // Vertices that stay are rounded when they are written, and the tolerance must pay for that.
  const double error = is_single_precision() ? single_precision_error(input_) : 0;
  const auto make_room = [error](double& tolerance, const std::string& option) {
    if (error > 0) tolerance = tolerance * (1 - 0x1p-40) - error;
    if (!(tolerance > 0))
      throw Failure(
          usage,
          option + ": rounding to single precision alone moves vertices by " + to_text(error)
              + "; write ply");
  };
  std::vector<double> tolerances = tolerances_;
  for (double& tolerance : tolerances) make_room(tolerance, "--tolerances");
  Controls& controls = controls_;
  set_ridge_length(controls, tolerances_.back(), diagonal(input_));
  make_room(controls.ridge_length, "--ridge-tolerance");
  controls.single_precision = is_single_precision();
  Progress_bar bar(arguments_.is_quiet);
  try {
    hierarchy_ = make_hierarchy(input_, tolerances, control_parameters(controls, Visitor(bar)));
  } catch (const Invalid_input& error) {
    if (error.argument() == "mesh")
      throw Bad_file(arguments_.input, error.problem(), error.remedy());
    throw Failure(usage, error.argument() + ": " + error.problem());
  }
  lap("hierarchy");
}

/// The accumulated bound has no record to be checked.
bool Make_hierarchy::is_certificate_confirmed(
    const Mesh& mesh, const Certificate& certificate) const
{
  if (!certificate.correspondence()) return true;
  const auto check = check_certificate(input_, mesh, certificate);
  stop_if_interrupted();
  return check.holds && check.largest_normal_deviation <= controls_.normal_tolerance
      && check.curve_bound <= controls_.ridge_length;
}

void Make_hierarchy::verify()
{
  for (std::size_t i = 0; i < levels().size(); ++i) {
    const auto& [mesh, certificate] = levels()[i];
    const std::string name = "level " + std::to_string(i);
    if (!(certificate.holds() && bound_of_file(i) <= tolerances_[i]))
      throw Failure(not_certified, name + " is not within its tolerance; nothing was written");
    if (arguments_.skips_verification) continue;
    if (!is_certificate_confirmed(mesh, certificate)
        || !certify_distance(input_, mesh, certificate.tolerance()).holds())
      throw Failure(
          not_certified,
          "the check of " + name + " failed; nothing was written; please report this");
    stop_if_interrupted();
  }
  lap("verify");
}

void Make_hierarchy::write_level(std::ostream& stream, std::size_t level) const
{
  Mesh mesh = levels()[level].mesh;
  if (is_single_precision()) return write_glb(stream, mesh);
  const Deviation deviation{
      mesh.add_property_map<Mesh::Face_index, double>("f:deviation", 0).first, tolerances_[level]};
  write_mesh(stream, arguments_.format, mesh, deviation);
}

void Make_hierarchy::write()
{
  for (std::size_t i = 0; i < levels().size(); ++i) {
    folder_.write(file_of(i), [&](std::ostream& stream) { write_level(stream, i); });
    if (arguments_.with_certificates)
      folder_.write("level_" + std::to_string(i) + ".cert", [&](std::ostream& stream) {
        write_certificate(stream, levels()[i].certificate);
      });
  }
  folder_.write("operations.txt", [&](std::ostream& stream) {
    write_hierarchy_record(stream, hierarchy_->record());
  });
  folder_.write("index.json", [&](std::ostream& stream) { stream << to_text(index()); });
  lap("write");
  if (!arguments_.report.empty()) {
    report_.write(arguments_.report, [&](std::ostream& stream) {
      Json report = index();
      report["seconds"] = watch_.seconds();
      report["parameters"] = describe(controls_);
      report["operations"] = to_json(hierarchy_->operations());
      stream << to_text(report);
    });
  }
  stop_if_interrupted();
  folder_.commit();
  report_.commit();
}

Json Make_hierarchy::index() const
{
  constexpr double radians_per_degree = 3.14159265358979323846 / 180;
  const double pixels = arguments_.viewport_height
      / (2 * std::tan(arguments_.field_of_view / 2 * radians_per_degree) * arguments_.pixel_error);
  Json json = new_report("hierarchy");
  json["input"] = to_json(arguments_.input, input_statistics_);
  if (arguments_.reading.repair) json["input"]["repairs"] = to_json(repairs_);
  json["record"] = "operations.txt";
  json["viewport_height"] = arguments_.viewport_height;
  json["field_of_view"] = arguments_.field_of_view;
  json["pixel_error"] = arguments_.pixel_error;
  json["levels"] = Json::array();
  for (std::size_t i = 0; i < levels().size(); ++i) {
    const Mesh& mesh = levels()[i].mesh;
    const double bound = bound_of_file(i);
    Json level
        = {{"file", file_of(i)},
           {"vertices", mesh.number_of_vertices()},
           {"faces", mesh.number_of_faces()},
           {"tolerance", tolerances_[i]},
           {"bound", bound},
           {"certified", bound <= tolerances_[i]},
           {"switching_distance", bound * pixels}};
    if (arguments_.with_certificates) level["certificate"] = "level_" + std::to_string(i) + ".cert";
    json["levels"].push_back(level);
  }
  return json;
}

void Make_hierarchy::print() const
{
  std::cout << arguments_.input << '\n'
            << to_text(repairs_, "  ") << to_text(input_statistics_, "  ");
  std::cout << arguments_.folder << '\n';
  for (std::size_t i = 0; i < levels().size(); ++i)
    std::cout << "  " << file_of(i) << ": "
              << to_text(std::size_t(levels()[i].mesh.number_of_faces()))
              << " faces, proven to lie within " << bound_of_file(i) << " of the input\n";
  if (arguments_.skips_verification) std::cout << "  not checked independently\n";
}

void add_view(CLI::App& command, Arguments& arguments)
{
  const auto number
      = [&](const char* name, auto& value, const char* text, double low, double high) {
          command.add_option(name, value, text)->check(between(low, high))->capture_default_str();
        };
  number(
      "--viewport-height", arguments.viewport_height,
      "height of the view in pixels, for the switching distances", 1, 1e6);
  number(
      "--field-of-view", arguments.field_of_view,
      "vertical angle of the view in degrees, for the switching distances", 1, 179);
  number(
      "--pixel-error", arguments.pixel_error,
      "deviation in pixels that may be seen, for the switching distances", 1e-3, 1e6);
}

} // namespace

void add_hierarchy(CLI::App& program, Exit_status&)
{
  const auto command = program.add_subcommand(
      "hierarchy", "Makes levels of detail, each within its own proven distance");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("IN", arguments->input, "mesh to simplify: off, obj, ply or stl")->required();
  command->add_option("-o,--output", arguments->folder, "new or empty folder for the levels")
      ->required();
  command
      ->add_option(
          "-t,--tolerances", arguments->tolerances,
          "largest distances to the input, increasing, with commas between: lengths or per cents "
          "of the bounding-box diagonal (0.05%,0.2%,1%)")
      ->required();
  command->add_option("--format", arguments->format, "format of the levels")
      ->check(CLI::IsMember({"glb", "off", "obj", "ply", "stl"}))
      ->capture_default_str();
  // Effort is spent in the last level only.
  arguments->controls.effort = Effort::fast;
  add_controls(*command, arguments->controls);
  add_view(*command, *arguments);
  add_reading_options(*command, arguments->reading);
  command->add_flag(
      "--certificates", arguments->with_certificates,
      "write the proof of each level too, for surety verify");
  command->add_option("--report", arguments->report, "write all figures to this JSON file");
  command->add_flag(
      "--no-verify", arguments->skips_verification, "leave the independent checks out");
  command->add_flag("--quiet", arguments->is_quiet, "print nothing but errors");
  command->footer("Example: surety hierarchy part.stl -o levels -t 0.05%,0.2%,1%");
  command->callback([arguments] { Make_hierarchy(*arguments).run(); });
}

} // namespace surety::tool
