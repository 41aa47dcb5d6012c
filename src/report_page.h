// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the HTML report that are the same for all, as they were when the program was built.
#ifndef SURETY_TOOL_REPORT_PAGE_H
#define SURETY_TOOL_REPORT_PAGE_H

#include <string_view>

namespace surety::tool {

struct Report_page {
  std::string_view page, style, script; ///< ours
  std::string_view viewer, controls;    ///< three.js and its OrbitControls
};

/// The page; null if three.js was not there when the program was built.
const Report_page* report_page();

} // namespace surety::tool

#endif // SURETY_TOOL_REPORT_PAGE_H
