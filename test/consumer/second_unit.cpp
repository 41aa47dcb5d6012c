// SPDX-License-Identifier: GPL-3.0-or-later
//
// A second translation unit, with all of the library: what a header defines twice would not link.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/surety.h>

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

bool lie_within(const Mesh& a, const Mesh& b, double tolerance)
{
  return surety::certify_distance(a, b, tolerance).holds();
}
