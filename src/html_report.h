// SPDX-License-Identifier: GPL-3.0-or-later
//
// The report for people: one page with both meshes in 3D, which needs nothing but a browser.
#ifndef SURETY_TOOL_HTML_REPORT_H
#define SURETY_TOOL_HTML_REPORT_H

#include "mesh.h"
#include "mesh_writing.h"
#include "report.h"

#include <iosfwd>
#include <string>

namespace surety::tool {

/// Before and after.
struct Compared_meshes {
  const Mesh& input;
  const Mesh& output;
  Deviation deviation; ///< of the faces of the output
};

/// Whether a report of this name is a page: it ends in .html or .htm.
bool is_html(const std::string& file);

/// \throws Failure (usage) if the report of this name is a page, and this program was built without
/// the viewer.
void require_possible_report(const std::string& file);

/// For commands that do not have two meshes to show. \throws Failure (usage) if the name asks for a
/// page.
void require_json_report(const std::string& file);

/// Writes the report to a stream: a page if its name says so, JSON otherwise. Where a mesh is
/// large the page shows it simplified, and says so.
void write_report(
    std::ostream& stream, const std::string& file, const Json& report,
    const Compared_meshes& meshes);

} // namespace surety::tool

#endif // SURETY_TOOL_HTML_REPORT_H
