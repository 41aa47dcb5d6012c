// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tells the range of the principal curvatures of a mesh.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <surety/curvature.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

int main(int argc, char* argv[])
{
  Mesh mesh;
  if (argc != 2 || !CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: curvature input.off\n";
    return EXIT_FAILURE;
  }

  // Ridges separate sides, each of which has a curvature of its own.
  const auto field = surety::estimate_curvatures(mesh, surety::parameters::feature_angle(40));
  double least = 0, largest = 0;
  for (const auto& side : field.side) {
    least = (std::min)(least, side.min_curvature);
    largest = (std::max)(largest, side.max_curvature);
  }
  std::cout << field.side.size() << " sides, curvatures from " << least << " to " << largest << ", "
            << field.fallbacks << " from poorer fits\n";
  return field.side.empty() ? EXIT_FAILURE : EXIT_SUCCESS;
}
