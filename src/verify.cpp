// SPDX-License-Identifier: GPL-3.0-or-later
//
// surety verify: checks a certificate file against the two meshes, and trusts neither.
#include "commands.h"
#include "html_report.h"
#include "library_checks.h"
#include "library_description.h"
#include "mesh_reading.h"
#include "output_files.h"
#include "report.h"

#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

namespace surety::tool {
namespace {

/// What the check of a certificate of either kind says.
struct Answer {
  std::string kind;
  bool holds;
  std::string reason;
  double tolerance, bound;
  std::optional<double> curve_bound; ///< a covering says nothing of curves
};

struct Verify {
  std::string input, output, certificate, report;
  Reading reading;
  bool is_quiet = false;

  Exit_status run() const;
  void print(const Answer& answer) const;
};

bool is_covering(std::istream& stream)
{
  std::string word;
  stream >> word;
  stream.clear(); // an empty file is not one, and is reported by who reads it
  stream.seekg(0);
  return word == "surety-covering";
}

/// Reads the file, whichever kind of proof it holds, and checks it.
Answer check_file(
    const std::string& file, const Mesh& original, const Mesh& result, Stopwatch& watch)
{
  std::ifstream stream(file);
  if (!stream) throw Bad_file(file, "the file cannot be read", "");
  try {
    if (is_covering(stream)) {
      const Covering claim = read_covering(stream);
      watch.lap("read");
      Covering_check check = check_covering(original, result, claim);
      return {"covering", check.holds, std::move(check.reason), claim.tolerance, check.bound, {}};
    }
    const Certificate claim = read_certificate(stream);
    watch.lap("read");
    Certificate_check check = check_certificate(original, result, claim);
    return {"map",       check.holds,      std::move(check.reason), claim.tolerance(),
            check.bound, check.curve_bound};
  } catch (const Invalid_input& error) {
    throw Bad_file(file, error.problem(), error.remedy());
  }
}

Exit_status Verify::run() const
{
  Output_files files({input, output, certificate});
  require_json_report(report);
  if (!report.empty()) files.announce(report);
  Stopwatch watch;
  const Mesh original = read_mesh(input, reading);
  // The output is what the certificate is about: vertex by vertex, as it was written.
  const Mesh result = read_mesh(output, {false, false});
  const Answer answer = check_file(certificate, original, result, watch);
  watch.lap("verify");

  Json json = new_report("verify");
  json["files"] = {{"input", input}, {"output", output}, {"certificate", certificate}};
  json["certificate"]
      = {{"kind", answer.kind},
         {"tolerance", answer.tolerance},
         {"bound", answer.bound},
         {"holds", answer.holds},
         {"reason", answer.reason}};
  if (answer.curve_bound) json["certificate"]["curve_bound"] = *answer.curve_bound;
  json["seconds"] = watch.seconds();
  if (!report.empty()) {
    files.write(report, [&](std::ostream& stream) { stream << to_text(json); });
    files.commit();
  }
  if (!is_quiet) print(answer);
  return answer.holds ? done : not_certified;
}

void Verify::print(const Answer& answer) const
{
  if (answer.holds) {
    std::cout << "the certificate holds: " << input << " and " << output << " lie within "
              << answer.bound << " of each other (tolerance " << answer.tolerance << ")\n";
  } else {
    std::cout << "the certificate does not hold: " << answer.reason << '\n';
  }
}

} // namespace

void add_verify(CLI::App& program, Exit_status& status)
{
  const auto command = program.add_subcommand("verify", "Checks a certificate file");
  const auto verify = std::make_shared<Verify>();
  command->add_option("IN", verify->input, "the original mesh")->required();
  command->add_option("OUT", verify->output, "the simplified mesh, as it was written")->required();
  command->add_option("CERTIFICATE", verify->certificate, "the certificate file")->required();
  command->add_flag(
      "--triangulate", verify->reading.triangulate,
      "split faces of the original mesh with more corners, as when it was simplified");
  command->add_flag(
      "--repair", verify->reading.repair, "repair the original mesh, as when it was simplified");
  command->add_option("--report", verify->report, "write the answer to this JSON file");
  command->add_flag("--quiet", verify->is_quiet, "print nothing but errors");
  command->footer("The exit status is 0 if the certificate holds, and 4 if it does not.\n"
                  "Example: surety verify part.stl part.off part.cert");
  command->callback([verify, &status] { status = verify->run(); });
}

} // namespace surety::tool
