// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ctrl-C. The first one asks the running command to stop at the next safe point, where nothing has
// been written; a second one ends the program at once.
#ifndef SURETY_TOOL_INTERRUPTION_H
#define SURETY_TOOL_INTERRUPTION_H

namespace surety::tool {

/// Watches for Ctrl-C from now on.
void watch_for_interruption();

/// Whether the user has asked us to stop.
bool is_interrupted();

/// \throws Failure (interrupted) if so.
void stop_if_interrupted();

} // namespace surety::tool

#endif // SURETY_TOOL_INTERRUPTION_H
