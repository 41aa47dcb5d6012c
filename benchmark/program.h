// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the main functions of all benchmarks share.
#ifndef SURETY_BENCHMARK_PROGRAM_H
#define SURETY_BENCHMARK_PROGRAM_H

#include "table.h"

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace surety::benchmark {

/// Adds --csv and --json, parses a command line, and ends the program after --help or a mistake.
inline void parse_or_exit(CLI::App& program, int argc, char* argv[])
{
  bool as_json = false;
  const auto json = program.add_flag("--json", as_json, "Print an array of objects, one a row");
  program.add_flag("--csv", "Print comma-separated values, which is the default")->excludes(json);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(program.exit(error));
  }
  Table::format() = as_json ? Table::Format::json : Table::Format::csv;
}

inline void add_tolerances(CLI::App& program, std::vector<double>& tolerances)
{
  program
      .add_option("-t,--tolerance", tolerances, "In per cent of the diagonal, separated by commas")
      ->delimiter(',')
      ->capture_default_str();
}

inline void add_models(CLI::App& program, std::vector<std::string>& models)
{
  program.add_option("models", models, "Names of models, or files")->capture_default_str();
}

inline void add_cpu_limit(CLI::App& program, unsigned& seconds)
{
  program.add_option("--limit", seconds, "CPU seconds after which a case is given up")
      ->capture_default_str();
}

/// Runs a program; an exception becomes a message and an exit status.
template <class Run>
int run_program(const Run& run)
{
  try {
    return run();
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_PROGRAM_H
