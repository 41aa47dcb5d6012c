// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the parser knows about the program, for the shell and for man: neither can forget an option.
#ifndef SURETY_TOOL_SELF_DESCRIPTION_H
#define SURETY_TOOL_SELF_DESCRIPTION_H

#include <CLI/CLI.hpp>

#include <string>

namespace surety::tool {

/// The manual page of section 1, in the language of troff's man macros.
std::string manual_page(const CLI::App& program);

/// A script that teaches bash to complete commands, options and their values.
std::string bash_completion(const CLI::App& program);

} // namespace surety::tool

#endif // SURETY_TOOL_SELF_DESCRIPTION_H
