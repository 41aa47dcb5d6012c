// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety compare: how far apart are two meshes? A certified interval each way, with the places
// where the distance occurs; or, given a tolerance, a proof or a counter-example.
#include "commands.h"
#include "html_report.h"
#include "library_checks.h"
#include "length.h"
#include "mesh_reading.h"
#include "output_files.h"
#include "report.h"

#include <iostream>
#include <optional>

namespace surety::tool {
namespace {

struct Compare {
  std::string first, second, tolerance, accuracy, certificate, report;
  Reading reading;
  bool is_quiet = false;

  Exit_status run() const;

private:
  Exit_status measure(const Mesh& a, const Mesh& b, double accuracy_in_units, Json& json) const;
  Exit_status decide(const Mesh& a, const Mesh& b, double tolerance_in_units, Json& json) const;
  Exit_status prove(
      const Mesh& a, const Mesh& b, double tolerance_in_units, Output_files& files,
      Json& json) const;
  void print(const char* name, const Distance_interval& interval) const;
};

Json to_json(const Witness& witness)
{
  return {
      {"point", witness.point},
      {"mesh", witness.is_on_first ? "A" : "B"},
      {"face", witness.face},
      {"distance_lower_bound", witness.distance_lower_bound}};
}

Json to_json(const Distance_interval& interval)
{
  return {
      {"lower", interval.lower}, {"upper", interval.upper}, {"witness", to_json(interval.witness)}};
}

std::string describe(const Witness& witness)
{
  return "(" + to_text(witness.point[0]) + ", " + to_text(witness.point[1]) + ", "
      + to_text(witness.point[2]) + ") on face " + std::to_string(witness.face)
      + (witness.is_on_first ? " of A" : " of B");
}

Exit_status Compare::run() const
{
  std::optional<Length> bound, eps;
  if (!tolerance.empty()) bound = Length::parse(tolerance, "--tolerance");
  if (!accuracy.empty()) eps = Length::parse(accuracy, "--accuracy");
  if (!certificate.empty() && !bound)
    throw CLI::ValidationError("--certificate", "a proof is of a tolerance: give --tolerance");
  Output_files files({first, second});
  require_json_report(report);
  for (const std::string& file : {report, certificate})
    if (!file.empty()) files.announce(file);
  Stopwatch watch;
  const Mesh a = read_triangles(first, reading), b = read_triangles(second, reading);
  watch.lap("read");

  Json json = new_report("compare");
  json["files"] = {{"A", first}, {"B", second}};
  Exit_status status = done;
  const double length = diagonal(a);
  if (bound) status = decide(a, b, bound->in_units(length), json);
  watch.lap("decide");
  if (!certificate.empty() && status == done) {
    status = prove(a, b, bound->in_units(length), files, json);
    watch.lap("prove");
  }
  if (!bound || eps) {
    const auto measured = measure(a, b, eps ? eps->in_units(length) : 1e-4 * length, json);
    if (status == done) status = measured;
  }
  watch.lap("measure");
  json["seconds"] = watch.seconds();
  if (!report.empty()) files.write(report, [&](std::ostream& stream) { stream << to_text(json); });
  files.commit();
  return status;
}

/// Writes what anyone can check, with `surety verify`.
Exit_status Compare::prove(
    const Mesh& a, const Mesh& b, double tolerance_in_units, Output_files& files, Json& json) const
{
  const auto covering = make_covering(a, b, tolerance_in_units);
  json["certificate"]["written"] = covering.has_value();
  if (!covering) {
    std::cerr << "surety: the distance is so near to the tolerance that no certificate was found; "
                 "none is written\n";
    return not_certified;
  }
  files.write(certificate, [&](std::ostream& stream) { write_covering(stream, *covering); });
  return done;
}

Exit_status Compare::measure(
    const Mesh& a, const Mesh& b, double accuracy_in_units, Json& json) const
{
  const Hausdorff_distance distance = hausdorff_distance(a, b, accuracy_in_units);
  json["distance"]
      = {{"accuracy", accuracy_in_units},
         {"lower", distance.lower()},
         {"upper", distance.upper()},
         {"A_to_B", to_json(distance.forward)},
         {"B_to_A", to_json(distance.backward)}};
  const Exit_status status = distance.is_accurate() ? done : not_certified;
  if (is_quiet) return status;
  print("from A to B", distance.forward);
  print("from B to A", distance.backward);
  std::cout << "Hausdorff distance: between " << distance.lower() << " and " << distance.upper()
            << '\n';
  if (status != done) std::cout << "the accuracy asked for was not reached\n";
  return status;
}

void Compare::print(const char* name, const Distance_interval& interval) const
{
  std::cout << name << ": between " << interval.lower << " and " << interval.upper << ", at "
            << describe(interval.witness) << '\n';
}

Exit_status Compare::decide(
    const Mesh& a, const Mesh& b, double tolerance_in_units, Json& json) const
{
  const Distance_certificate proof = certify_distance(a, b, tolerance_in_units);
  json["certificate"]
      = {{"tolerance", tolerance_in_units},
         {"bound", proof.upper_bound()},
         {"holds", proof.holds()},
         {"refuted", proof.refuted()}};
  if (proof.witness()) json["certificate"]["witness"] = to_json(*proof.witness());
  if (is_quiet) return proof.holds() ? done : not_certified;
  if (proof.holds()) {
    std::cout << "proven: within " << tolerance_in_units << " of each other\n";
  } else if (proof.refuted()) {
    std::cout << "refuted: farther than " << tolerance_in_units << " from each other, at "
              << describe(*proof.witness()) << '\n';
  } else {
    std::cout << "undecided: neither proven nor refuted within " << tolerance_in_units << '\n';
  }
  return proof.holds() ? done : not_certified;
}

} // namespace

void add_compare(CLI::App& program, Exit_status& status)
{
  const auto command = program.add_subcommand(
      "compare", "Certified interval of the Hausdorff distance of two meshes");
  const auto compare = std::make_shared<Compare>();
  command->add_option("A", compare->first, "a mesh: off, obj, ply or stl")->required();
  command->add_option("B", compare->second, "another mesh")->required();
  command->add_option(
      "-t,--tolerance", compare->tolerance,
      "prove or refute that they lie within this distance: a length (0.5) or a per cent of A's "
      "bounding-box diagonal (0.1%)");
  command->add_option(
      "--accuracy", compare->accuracy,
      "width of the interval, a length or a per cent; without it 0.01%, or none with a tolerance");
  command->add_option(
      "--certificate", compare->certificate,
      "write a proof that they lie within the tolerance to this file, for surety verify");
  command->add_flag("--triangulate", compare->reading.triangulate, "split faces with more corners");
  command->add_option("--report", compare->report, "write all figures to this JSON file");
  command->add_flag("--quiet", compare->is_quiet, "print nothing but errors");
  command->footer("With a tolerance the exit status is 0 if it is proven, and 4 if not.\n"
                  "Example: surety compare part.stl part.off -t 0.1%");
  command->callback([compare, &status] { status = compare->run(); });
}

} // namespace surety::tool
