// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an operation must keep, computed by CGAL alone and nothing of the library under test.
#ifndef SURETY_TEST_INVARIANTS_H
#define SURETY_TEST_INVARIANTS_H

#include "meshes.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>

#include <algorithm>
#include <iterator>
#include <ostream>
#include <utility>
#include <vector>

namespace surety::test {

namespace pmp = CGAL::Polygon_mesh_processing;

inline long euler_characteristic(const Mesh& mesh)
{
  return long(mesh.number_of_vertices()) - long(mesh.number_of_edges())
      + long(mesh.number_of_faces());
}

inline std::size_t border_loops(const Mesh& mesh)
{
  std::vector<Mesh::Halfedge_index> loops;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(loops));
  return loops.size();
}

inline bool is_closed(const Mesh& mesh) { return CGAL::is_closed(mesh); }

inline std::vector<Mesh> components(const Mesh& mesh)
{
  Mesh copy;
  CGAL::copy_face_graph(mesh, copy);
  std::vector<Mesh> parts;
  pmp::split_connected_components(copy, parts);
  return parts;
}

inline std::size_t number_of_components(const Mesh& mesh)
{
  Mesh copy = mesh;
  const auto component = copy.add_property_map<Face, std::size_t>("f:component_of_test").first;
  return pmp::connected_components(copy, component);
}

/// What tells surfaces apart: the Euler characteristic and the border loops of each component.
struct Topological_type {
  std::vector<std::pair<long, std::size_t>> components; ///< sorted

  friend bool operator==(const Topological_type& a, const Topological_type& b)
  {
    return a.components == b.components;
  }
  friend std::ostream& operator<<(std::ostream& out, const Topological_type& type)
  {
    for (const auto& [euler, loops] : type.components) out << '(' << euler << ", " << loops << ") ";
    return out;
  }
};

inline Topological_type topological_type(const Mesh& mesh)
{
  Topological_type type;
  for (const Mesh& part : components(mesh)) {
    type.components.emplace_back(euler_characteristic(part), border_loops(part));
  }
  std::sort(type.components.begin(), type.components.end());
  return type;
}

inline bool have_same_topology(const Mesh& a, const Mesh& b)
{
  return topological_type(a) == topological_type(b);
}

inline bool has_degenerate_face(const Mesh& mesh)
{
  return std::any_of(mesh.faces_begin(), mesh.faces_end(), [&](Face f) {
    return pmp::is_degenerate_triangle_face(f, mesh);
  });
}

inline bool is_manifold(const Mesh& mesh)
{
  std::vector<Mesh::Halfedge_index> bad;
  pmp::non_manifold_vertices(mesh, std::back_inserter(bad));
  return bad.empty();
}

/// A manifold triangle mesh in good order, without degenerate faces.
inline bool is_sound(const Mesh& mesh)
{
  return mesh.number_of_faces() > 0 && CGAL::is_valid_polygon_mesh(mesh)
      && CGAL::is_triangle_mesh(mesh) && is_manifold(mesh) && !has_degenerate_face(mesh);
}

inline std::size_t number_of_self_intersections(const Mesh& mesh)
{
  std::vector<std::pair<Face, Face>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

} // namespace surety::test

#endif // SURETY_TEST_INVARIANTS_H
