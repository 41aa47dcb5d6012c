// SPDX-License-Identifier: GPL-3.0-or-later
//
// Between the user's Surface_mesh and the flat structures: T and M are read from it, and the result
// is written back over it, element by element, so that the user's property maps stay where they
// are.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_EXCHANGE_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_EXCHANGE_H

#include <surety/features.h>
#include <surety/internal/deviation/reference.h>
#include <surety/internal/geometric_mesh/space_filling_order.h>
#include <surety/internal/working_mesh.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surety::internal {

/// The elements of a mesh in the order that the flat structures keep them: along a space-filling
/// curve, so that what is near in space is near in memory.
template <class Mesh>
struct Elements {
  using Vertex = typename Mesh::Vertex_index;
  using Edge = typename Mesh::Edge_index;
  using Face = typename Mesh::Face_index;

  template <class Points>
  Elements(const Mesh& mesh, const Points& points)
  {
    std::vector<Vertex> in_order(mesh.vertices().begin(), mesh.vertices().end());
    std::vector<Vector> coordinates;
    coordinates.reserve(in_order.size());
    for (const Vertex v : in_order) coordinates.push_back(to_vector(get(points, v)));
    input_position = space_filling_order(coordinates);

    vertices.reserve(in_order.size());
    edges.reserve(mesh.number_of_edges());
    faces.reserve(mesh.number_of_faces());
    std::vector<bool> has_edge(mesh.num_edges()), has_face(mesh.num_faces());
    for (const Index position : input_position) {
      vertices.push_back(in_order[position]);
      append_elements_at(mesh, vertices.back(), has_edge, has_face);
    }
  }

  typename Mesh::Halfedge_index halfedge(const Mesh& mesh, Index h) const
  {
    const auto first = mesh.halfedge(edges[h / 2]);
    return h % 2 == 0 ? first : mesh.opposite(first);
  }

  std::vector<Vertex> vertices;
  std::vector<Edge> edges; ///< each with its even half-edge, which becomes half-edge 2e
  std::vector<Face> faces;
  std::vector<Index> input_position; ///< of each vertex, in the iteration order of the mesh

private:
  // Edges and faces follow the first of their vertices.
  void append_elements_at(
      const Mesh& mesh, Vertex v, std::vector<bool>& has_edge, std::vector<bool>& has_face)
  {
    for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
      const Edge e(typename Mesh::Halfedge_index(static_cast<Index>(h) & ~1u));
      if (!has_edge[e]) edges.push_back(e);
      has_edge[e] = true;
      if (mesh.is_border(h)) continue;
      const Face f = mesh.face(h);
      if (!has_face[f]) faces.push_back(f);
      has_face[f] = true;
    }
  }
};

template <class Mesh>
Working_mesh::Connectivity read_connectivity(const Mesh& mesh, const Elements<Mesh>& elements)
{
  std::vector<Index> vertex(mesh.num_vertices()), edge(mesh.num_edges()), face(mesh.num_faces());
  for (Index i = 0; i < elements.vertices.size(); ++i) vertex[elements.vertices[i]] = i;
  for (Index i = 0; i < elements.edges.size(); ++i) edge[elements.edges[i]] = i;
  for (Index i = 0; i < elements.faces.size(); ++i) face[elements.faces[i]] = i;

  Working_mesh::Connectivity result;
  result.vertices = static_cast<Index>(elements.vertices.size());
  result.faces = static_cast<Index>(elements.faces.size());
  const auto halfedges = static_cast<Index>(2 * elements.edges.size());
  // Ghosts come on top: one edge a border edge.
  std::size_t borders = 0;
  for (Index i = 0; i < halfedges; ++i) borders += mesh.is_border(elements.halfedge(mesh, i));
  for (auto* array : {&result.next, &result.target, &result.face})
    array->reserve(halfedges + 2 * borders);
  for (Index i = 0; i < halfedges; ++i) {
    const auto h = elements.halfedge(mesh, i), next = mesh.next(h);
    result.next.push_back(2 * edge[mesh.edge(next)] + static_cast<Index>(next) % 2);
    result.target.push_back(vertex[mesh.target(h)]);
    result.face.push_back(mesh.is_border(h) ? none : face[mesh.face(h)]);
  }
  return result;
}

/// The power of two that brings the largest coordinate of a mesh into [1/2, 1). T and the tolerance
/// are scaled by it: exactly, and no square over- or underflows at any size of mesh.
template <class Mesh, class Points>
double normalising_scale(const Mesh& mesh, const Points& points)
{
  double largest = 0;
  for (const auto v : mesh.vertices())
    largest = std::max(largest, to_vector(get(points, v)).cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, -exponent);
}

/// The points by position, scaled.
template <class Mesh, class Points>
std::vector<Vector> points_in_order(
    const Elements<Mesh>& elements, const Points& points, double scale)
{
  std::vector<Vector> coordinates;
  coordinates.reserve(elements.vertices.size());
  for (const auto v : elements.vertices) coordinates.push_back(scale * to_vector(get(points, v)));
  return coordinates;
}

template <class Mesh>
Reference make_reference(
    const Elements<Mesh>& elements, std::vector<Vector> coordinates,
    const Working_mesh::Connectivity& connectivity)
{
  return Reference(
      std::move(coordinates), connectivity.next, connectivity.target, connectivity.face,
      connectivity.faces, elements.input_position);
}

/// The feature edges by position.
template <class Mesh>
std::vector<bool> features_in_order(const Elements<Mesh>& elements, const Features& features)
{
  std::vector<bool> result(elements.edges.size());
  for (Index e = 0; e < result.size(); ++e) result[e] = features.edge[elements.edges[e]];
  return result;
}

template <class Mesh>
Working_mesh make_working_mesh(
    const Elements<Mesh>& elements, const Features& features,
    Working_mesh::Connectivity connectivity, std::vector<Vector> points, Journal& journal)
{
  std::vector<bool> fixed(elements.vertices.size());
  for (Index v = 0; v < fixed.size(); ++v) fixed[v] = features.corner[elements.vertices[v]];
  return Working_mesh(
      std::move(connectivity), std::move(points), features_in_order(elements, features),
      std::move(fixed), journal);
}

/// Where each face stands in the iteration order of the mesh.
template <class Mesh>
std::vector<Index> face_positions(const Elements<Mesh>& elements, const Mesh& mesh)
{
  std::vector<Index> position_of(mesh.num_faces());
  Index position = 0;
  for (const auto f : mesh.faces()) position_of[f] = position++;
  std::vector<Index> result;
  result.reserve(elements.faces.size());
  for (const auto f : elements.faces) result.push_back(position_of[f]);
  return result;
}

/// Gives the mesh the connectivity of `result`, which was read from it. Allocates nothing, so that
/// it cannot fail half-way; what died is left as garbage.
template <class Mesh>
void write_connectivity(const Working_mesh& result, const Elements<Mesh>& elements, Mesh& mesh)
{
  for (Index h = 0; h < 2 * elements.edges.size(); ++h) {
    if (!result.is_live_edge(Working_mesh::edge(h))) continue;
    const auto target = elements.halfedge(mesh, h);
    const bool is_border = result.is_ghost_face(result.face(h));
    // Past a ghost face the border goes on in the next one round the ghost vertex.
    const Index next = is_border ? result.next(result.opposite(result.next(h))) : result.next(h);
    mesh.set_next(target, elements.halfedge(mesh, next));
    mesh.set_target(target, elements.vertices[result.target(h)]);
    mesh.set_face(target, is_border ? Mesh::null_face() : elements.faces[result.face(h)]);
  }
  for (Index v = 0; v < elements.vertices.size(); ++v) {
    if (!result.is_live_vertex(v)) {
      mesh.remove_vertex(elements.vertices[v]);
      continue;
    }
    Index incoming = result.halfedge_to(v);
    result.for_each_outgoing(v, [&](Index h) {
      if (result.is_ghost_vertex(result.target(h))) incoming = result.prev(h);
    });
    mesh.set_halfedge(elements.vertices[v], elements.halfedge(mesh, incoming));
  }
  for (Index e = 0; e < elements.edges.size(); ++e)
    if (!result.is_live_edge(e)) mesh.remove_edge(elements.edges[e]);
  for (Index f = 0; f < elements.faces.size(); ++f) {
    if (!result.is_live_face(f)) {
      mesh.remove_face(elements.faces[f]);
      continue;
    }
    // A face that keeps its first half-edge is written as it was read.
    const auto first = mesh.halfedge(elements.faces[f]);
    if (mesh.is_removed(mesh.edge(first)) || mesh.face(first) != elements.faces[f])
      mesh.set_halfedge(elements.faces[f], elements.halfedge(mesh, result.halfedge_in(f)));
  }
}

/// Writes the points of the vertices that were moved; as exact as `scale`, a power of two.
template <class Mesh, class Points>
void write_points(
    const Working_mesh& result, const Reference& reference, const Elements<Mesh>& elements,
    double scale, const Points& points)
{
  for (Index v = 0; v < elements.vertices.size(); ++v) {
    if (!result.is_live_vertex(v) || result.point(v) == reference.point(v)) continue;
    const Vector p = result.point(v) / scale;
    using Point = typename boost::property_traits<Points>::value_type;
    put(points, elements.vertices[v], Point(p.x(), p.y(), p.z()));
  }
}

/// Removes the garbage of a mesh, and tells where the elements went: position before (as in
/// `elements`) -> position after, `none` for what is gone.
struct Compaction {
  std::vector<Index> vertex, face;
};

template <class Mesh>
Compaction compact(const Elements<Mesh>& elements, Mesh& mesh)
{
  auto vertex_name = mesh.template add_property_map<typename Mesh::Vertex_index, Index>(
                             "v:surety_position", none)
                         .first;
  auto face_name
      = mesh.template add_property_map<typename Mesh::Face_index, Index>("f:surety_position", none)
            .first;
  for (Index v = 0; v < elements.vertices.size(); ++v) vertex_name[elements.vertices[v]] = v;
  for (Index f = 0; f < elements.faces.size(); ++f) face_name[elements.faces[f]] = f;
  mesh.collect_garbage();

  Compaction result;
  result.vertex.assign(elements.vertices.size(), none);
  result.face.assign(elements.faces.size(), none);
  Index position = 0;
  for (const auto v : mesh.vertices()) result.vertex[vertex_name[v]] = position++;
  position = 0;
  for (const auto f : mesh.faces()) result.face[face_name[f]] = position++;
  mesh.remove_property_map(vertex_name);
  mesh.remove_property_map(face_name);
  return result;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_EXCHANGE_H
