// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values as colours.
#ifndef SURETY_TOOL_COLORS_H
#define SURETY_TOOL_COLORS_H

#include <CGAL/IO/Color.h>

namespace surety::tool {

/// The colour of a value in [0, 1]: dark violet, blue, green, yellow, of even brightness steps
/// and readable by everyone (samples of the map "viridis").
CGAL::IO::Color heat(double value);

/// The colour of a value in [-1, 1]: blue, grey at 0, red (samples of the map "cool to warm").
CGAL::IO::Color diverging(double value);

} // namespace surety::tool

#endif // SURETY_TOOL_COLORS_H
