// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command line: finds the subcommand, runs it, and turns what it throws into a message and an
// exit status.
#include "commands.h"
#include "mesh_reading.h"
#include "self_description.h"

#include <surety/errors.h>
#include <surety/version.h>

#include <exception>
#include <iostream>
#include <new>

namespace surety::tool {

void add_reading_options(CLI::App& command, Reading& reading)
{
  command.add_flag(
      "--triangulate", reading.triangulate, "split faces with more than three corners");
  command.add_flag(
      "--repair", reading.repair,
      "make a manifold surface of a file that holds none; the proof is about the repaired one");
}

CLI::Validator between(double low, double high)
{
  const auto check = [low, high](const std::string& text) -> std::string {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return "";
    std::ostringstream message;
    message << "'" << text << "' is not a number from " << low << " to " << high;
    return message.str();
  };
  return CLI::Validator(check, "");
}

namespace {

int fail(Exit_status status, const std::string& message)
{
  std::cerr << "surety: " << message << '\n';
  return status;
}

/// A flag that prints what the parser itself knows, and ends the program.
void add_description(
    CLI::App& program, const char* flag, std::string (*describe)(const CLI::App&), const char* text)
{
  // The parser prints what this exception says, as it does for --version.
  program.add_flag_callback(
      flag, [&program, describe] { throw CLI::CallForVersion(describe(program), done); }, text);
}

int run(int argc, char* argv[])
{
  Exit_status status = done;
  CLI::App program("Simplifies and remeshes triangle meshes, and proves how far the result lies "
                   "from the input.");
  program.set_version_flag("--version", "surety " SURETY_VERSION_STRING);
  add_description(program, "--man-page", manual_page, "Print the manual page, for man");
  add_description(
      program, "--bash-completion", bash_completion, "Print the script of completion for bash");
  program.require_subcommand(1);
  program.footer(
      "Tolerances are lengths in mesh units (0.5) or per cent of the bounding-box diagonal "
      "(0.1%).\n"
      "Exit status: 0 done and certified, 2 wrong usage, 3 bad input, 4 goal not reached or\n"
      "certificate does not hold, 130 interrupted. Unless it is 0, no file is written.\n"
      "Example: surety simplify part.stl -o part.off -t 0.1%");
  add_simplify(program, status);
  add_remesh(program, status);
  add_adapt(program, status);
  add_enrich(program, status);
  add_compare(program, status);
  add_verify(program, status);
  add_info(program, status);
  add_hierarchy(program, status);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? done : usage;
  }
  return status;
}

} // namespace
} // namespace surety::tool

int main(int argc, char* argv[])
{
  using namespace surety::tool;
  try {
    return run(argc, argv);
  } catch (const Failure& failure) {
    return fail(failure.status(), failure.what());
  } catch (const surety::Invalid_input& error) {
    return fail(bad_input, error.what());
  } catch (const std::bad_alloc&) {
    return fail(bad_input, "there is not enough memory for this mesh");
  } catch (const std::exception& error) {
    return fail(not_certified, std::string("internal error, please report it: ") + error.what());
  }
}
