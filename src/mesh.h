// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one mesh type of the command line.
#ifndef SURETY_TOOL_MESH_H
#define SURETY_TOOL_MESH_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

namespace surety::tool {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

} // namespace surety::tool

#endif // SURETY_TOOL_MESH_H
