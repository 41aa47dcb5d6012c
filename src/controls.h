// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options that set the controls of a simplification, for every command that simplifies.
#ifndef SURETY_TOOL_CONTROLS_H
#define SURETY_TOOL_CONTROLS_H

#include "parameter_chains.h"
#include "report.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <map>
#include <string>

namespace surety::tool {

template <class Value>
using Names = std::map<std::string, Value>;

const Names<Placement>& names_of_placements();
const Names<Effort>& names_of_efforts();
const Names<Deviation_bound>& names_of_bounds();

template <class Value>
std::string name_of(Value value, const Names<Value>& names)
{
  const auto found = std::find_if(
      names.begin(), names.end(), [&](const auto& named) { return named.second == value; });
  return found->first;
}

/// Adds the options of all the controls; what they hold is the default.
void add_controls(CLI::App& command, Controls& controls);

/// \throws Failure (usage) when one of the controls asks for what another one excludes.
void require_compatible(const Controls& controls);

/// Works out the tolerance of ridges in mesh units, for a mesh with this diagonal: that of the
/// surface unless a smaller one was given.
void set_ridge_length(Controls& controls, double tolerance, double diagonal);

/// The controls as a report shows them.
Json describe(const Controls& controls);

} // namespace surety::tool

#endif // SURETY_TOOL_CONTROLS_H
