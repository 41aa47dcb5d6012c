// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh for simulation, whose sizes follow the curvature, within a proven distance.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/remesh.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <iostream>

int main(int argc, char* argv[])
{
  CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> mesh;
  if (argc != 4 || !CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: remesh input.off output.off tolerance\n";
    return EXIT_FAILURE;
  }
  const auto made = surety::remesh(mesh, std::stod(argv[3]));
  const auto& [certificate, fit, fit_of_given, iterations] = made.unit_mesh;
  std::cout << mesh.number_of_faces() << " faces, " << fit.unit_edges << " % of the edges unit, Q "
            << fit.Q_avg << " on average and " << fit.Q_max << " at worst\n"
            << "proven to lie within " << certificate.bound() << " of the input\n";
  const auto exactly = CGAL::parameters::stream_precision(17);
  const bool is_written = CGAL::IO::write_polygon_mesh(argv[2], mesh, exactly);
  return is_written && certificate.holds() ? EXIT_SUCCESS : EXIT_FAILURE;
}
