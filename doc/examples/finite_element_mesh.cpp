// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a CAD part to a mesh for simulation: ridges by angle, sizes between two limits, and what to
// look at before it goes to the solver.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/surety.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <iostream>

int main(int argc, char* argv[])
{
  CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> mesh;
  if (argc != 4 || !CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: finite_element_mesh input.off output.off tolerance\n";
    return EXIT_FAILURE;
  }
  const auto original = mesh;
  const double tolerance = std::stod(argv[3]);
  const auto made = surety::remesh(
      mesh, tolerance,
      surety::parameters::feature_angle(40).maximum_size(50 * tolerance).gradation(1.2));

  const auto statistics = surety::mesh_statistics(mesh);
  const auto proof = surety::certify_distance(original, mesh, tolerance);
  std::cout << made.features.ridges << " ridge edges, " << made.features.corners << " corners\n"
            << statistics.faces << " faces, least angle " << statistics.angle_min << " degrees, "
            << made.unit_mesh.fit.unit_edges << " % of the edges unit\n"
            << "bound " << made.unit_mesh.certificate.bound() << ", measured at most "
            << proof.upper_bound() << '\n';
  const bool is_good
      = made.unit_mesh.certificate.holds() && proof.holds() && statistics.self_intersections == 0;
  const auto exactly = CGAL::parameters::stream_precision(17);
  const bool is_written = CGAL::IO::write_polygon_mesh(argv[2], mesh, exactly);
  return is_written && is_good ? EXIT_SUCCESS : EXIT_FAILURE;
}
