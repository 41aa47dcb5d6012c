// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps what matters to the user besides the distance: ridges, well shaped faces, and an edge of
// his own choice. Also shows how to follow the progress and where the tolerance is spent.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <surety/geometric_mesh.h>

#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <algorithm>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

struct Patience {
  bool on_progress(const surety::Progress& progress) { return progress.faces > 100; }
};

int main(int argc, char* argv[])
{
  Mesh mesh;
  if (argc != 3 || !CGAL::IO::read_polygon_mesh(argv[1], mesh) || mesh.is_empty()) {
    std::cerr << "usage: keep_features input.off tolerance\n";
    return EXIT_FAILURE;
  }
  auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained").first;
  put(is_constrained, *mesh.edges_begin(), true);

  const auto certificate = surety::make_geometric_mesh(
      mesh, std::stod(argv[2]),
      surety::parameters::feature_angle(40)
          .shape_floor(5)
          .edge_is_constrained_map(is_constrained)
          .visitor(Patience()));

  const auto deviation = mesh.add_property_map<Mesh::Face_index, double>("f:deviation").first;
  const auto spent = std::count_if(mesh.faces_begin(), mesh.faces_end(), [&](Mesh::Face_index f) {
    return get(deviation, f) > certificate.tolerance() / 2;
  });
  std::cout << mesh.number_of_faces() << " faces within " << certificate.bound() << "; " << spent
            << " of them use more than half of the tolerance\n";
  return certificate.holds() ? EXIT_SUCCESS : EXIT_FAILURE;
}
