// SPDX-License-Identifier: GPL-3.0-or-later
//
// The consumer of a source tree: headers, kernel and flags come from the one target. What the
// library can do is the other consumer's question.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/features.h>
#include <surety/version.h>

#include <CGAL/boost/graph/generators.h>
#include <iostream>

int main()
{
  using Point = CGAL::Epick::Point_3;
  CGAL::Surface_mesh<Point> mesh;
  CGAL::make_tetrahedron(Point(0, 0, 0), Point(1, 0, 0), Point(0, 1, 0), Point(0, 0, 1), mesh);
  const auto features = surety::find_features(mesh, surety::parameters::feature_angle(40));
  std::cout << "surety " SURETY_VERSION_STRING ": " << features.ridges << " ridges\n";
  return features.ridges == 6 ? EXIT_SUCCESS : EXIT_FAILURE;
}
