// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a mesh to the sizes that a mesh generator needs to follow its surface.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/curvature.h>
#include <surety/gradation.h>
#include <surety/medit_sol.h>
#include <surety/metric.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <fstream>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
namespace parameters = surety::parameters;

int main(int argc, char* argv[])
{
  Mesh mesh;
  if (argc != 4 || !CGAL::IO::read_polygon_mesh(argv[1], mesh) || mesh.is_empty()) {
    std::cerr << "usage: metric input.off output.sol tolerance\n";
    return EXIT_FAILURE;
  }
  const double tolerance = std::stod(argv[3]);
  const auto curvature
      = surety::estimate_curvatures(mesh, parameters::feature_angle(40).noise_floor(tolerance / 3));
  auto metric
      = surety::make_geometric_metric(mesh, curvature, parameters::metric_tolerance(tolerance));
  const auto changed = surety::limit_gradation(mesh, metric, parameters::gradation(1.3));
  std::cout << curvature.fallbacks << " of " << curvature.side.size()
            << " curvatures from a poorer fit, " << changed << " sizes lowered by gradation\n";

  std::ofstream file(argv[2]);
  surety::write_medit_sol(file, surety::to_medit_sol(mesh, metric));
  file.close();
  return file ? EXIT_SUCCESS : EXIT_FAILURE;
}
