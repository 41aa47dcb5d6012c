// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that hold no manifold surface, made one by CGAL's repair functions, on request.
#ifndef SURETY_TOOL_REPAIR_H
#define SURETY_TOOL_REPAIR_H

#include "mesh.h"
#include "report.h"
#include "soup.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace surety::tool {

/// What was done, as reports say it, and to how many elements.
using Repairs = std::vector<std::pair<std::string, std::size_t>>;

/// Makes a soup of sound polygons one that a half-edge mesh can hold.
///
/// Equal points are merged; polygons that have a corner twice, that are there twice, and points
/// that no polygon uses are removed; polygons are turned round to agree with their neighbours.
/// Where that cannot be, at edges of three faces and more, at points that parts of the surface have
/// in common, and along a cut through a surface with one side, the parts get points of their own.
/// Edges of three faces and more become required edges in the annotations, so that the sheets that
/// meet there still do so to the last bit, whatever is done to them.
/// \pre The soup has no annotations: they refer to elements by number.
void repair(Soup& soup, Repairs& done);

/// Splits what vertices have in common, and removes faces without area, where that is possible.
void repair(Mesh& mesh, Repairs& done);

Json to_json(const Repairs& repairs);

/// A line for each repair.
std::string to_text(const Repairs& repairs, const std::string& indentation);

} // namespace surety::tool

#endif // SURETY_TOOL_REPAIR_H
