// SPDX-License-Identifier: GPL-3.0-or-later
//
// The subcommands. Each declares its arguments to the parser, which runs it when it is called for;
// a command that fails throws Failure, and one that answers "no" sets the exit status.
#ifndef SURETY_TOOL_COMMANDS_H
#define SURETY_TOOL_COMMANDS_H

#include "failure.h"

#include <CLI/CLI.hpp>

namespace surety::tool {

void add_simplify(CLI::App& program, Exit_status& status);
void add_compare(CLI::App& program, Exit_status& status);
void add_verify(CLI::App& program, Exit_status& status);
void add_info(CLI::App& program, Exit_status& status);
void add_hierarchy(CLI::App& program, Exit_status& status);
void add_remesh(CLI::App& program, Exit_status& status);
void add_adapt(CLI::App& program, Exit_status& status);
void add_enrich(CLI::App& program, Exit_status& status);

struct Reading;
/// The options of commands that change a mesh.
void add_reading_options(CLI::App& command, Reading& reading);

/// Admits the numbers from `low` to `high` (which may be infinite), and nothing that is no number.
CLI::Validator between(double low, double high);

} // namespace surety::tool

#endif // SURETY_TOOL_COMMANDS_H
