// SPDX-License-Identifier: GPL-3.0-or-later
//
// Generated CAD parts: solids made by Boolean operations, as a modeller exports them (long faces)
// and cut fine between their sharp edges (something to simplify). Apart from meshes.h because
// Booleans take long to compile.
#ifndef SURETY_TEST_CAD_MESHES_H
#define SURETY_TEST_CAD_MESHES_H

#include "meshes.h"

#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <stdexcept>

namespace surety::test {

/// The points that one solid has and the other has not.
inline Mesh difference(Mesh a, Mesh b)
{
  Mesh result;
  if (!CGAL::Polygon_mesh_processing::corefine_and_compute_difference(a, b, result)) {
    throw std::logic_error("the difference is not manifold");
  }
  result.collect_garbage();
  return result;
}

/// The points that at least one of the two solids has.
inline Mesh united(Mesh a, Mesh b)
{
  Mesh result;
  if (!CGAL::Polygon_mesh_processing::corefine_and_compute_union(a, b, result)) {
    throw std::logic_error("the union is not manifold");
  }
  result.collect_garbage();
  return result;
}

/// Faces of about the given edge length between the edges that are sharper than 30 degrees; the
/// solid is the same up to rounding where its faces are flat.
inline Mesh remeshed(Mesh mesh, double length)
{
  namespace pmp = CGAL::Polygon_mesh_processing;
  auto sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(mesh, 30, sharp);
  std::vector<Mesh::Edge_index> curves;
  for (const auto e : mesh.edges()) {
    if (sharp[e]) curves.push_back(e);
  }
  const auto np = CGAL::parameters::edge_is_constrained_map(sharp);
  pmp::split_long_edges(curves, length, mesh, np);
  pmp::isotropic_remeshing(
      mesh.faces(), length, mesh, np.protect_constraints(true).number_of_iterations(3));
  mesh.remove_property_map(sharp);
  mesh.collect_garbage();
  return mesh;
}

/// A block with two round holes through it, one of them crossing its side, and a round boss: one
/// handle and an open notch. `facets` a cylinder.
inline Mesh cad_part(std::size_t facets = 24)
{
  const Mesh block = brick(4, 2, 1);
  const auto drill = [&](double x, double y, double radius) {
    return translated(cylinder(facets, 1, radius, 3), Vector(x, y, 0.5));
  };
  const Mesh bored = difference(difference(block, drill(1, 0.93, 0.5)), drill(4.1, 1.07, 0.6));
  return united(bored, translated(cylinder(facets, 1, 0.4, 1), Vector(2.55, 0.98, 0.9)));
}

/// Two blocks that cross, with all their edges sharp.
inline Mesh crossed_blocks()
{
  const Mesh bar = scaled(cube(), 4, 1, 1);
  return united(bar, translated(scaled(cube(), 0.7, 3, 0.6), Vector(1.55, -1.05, 0.65)));
}

} // namespace surety::test

#endif // SURETY_TEST_CAD_MESHES_H
