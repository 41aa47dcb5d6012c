// SPDX-License-Identifier: GPL-3.0-or-later
//
// Between the user's Surface_mesh and the flat structures: T and M are read from it, and the result
// is written back over it, element by element, so that the user's property maps stay where they are.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_EXCHANGE_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_EXCHANGE_H

#include <surety/features.h>
#include <surety/internal/deviation/reference.h>
#include <surety/internal/working_mesh.h>

#include <vector>

namespace surety::internal {

/// The elements of a mesh in iteration order, and the way back from their raw index to it.
template <class Mesh>
struct Elements {
  using Vertex = typename Mesh::Vertex_index;
  using Edge = typename Mesh::Edge_index;
  using Face = typename Mesh::Face_index;

  explicit Elements(const Mesh& mesh)
    : vertices(mesh.vertices().begin(), mesh.vertices().end()),
      edges(mesh.edges().begin(), mesh.edges().end()),
      faces(mesh.faces().begin(), mesh.faces().end()), vertex_position(mesh.num_vertices(), none),
      edge_position(mesh.num_edges(), none), face_position(mesh.num_faces(), none)
  {
    for (Index i = 0; i < vertices.size(); ++i) vertex_position[vertices[i]] = i;
    for (Index i = 0; i < edges.size(); ++i) edge_position[edges[i]] = i;
    for (Index i = 0; i < faces.size(); ++i) face_position[faces[i]] = i;
  }

  typename Mesh::Halfedge_index halfedge(const Mesh& mesh, Index h) const
  {
    const auto first = mesh.halfedge(edges[h / 2]);
    return h % 2 == 0 ? first : mesh.opposite(first);
  }
  Index position(const Mesh& mesh, typename Mesh::Halfedge_index h) const
  {
    // An edge descriptor remembers which half-edge it was made from: ask the index instead.
    return 2 * edge_position[mesh.edge(h)] + static_cast<Index>(h) % 2;
  }

  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
  std::vector<Face> faces;
  std::vector<Index> vertex_position, edge_position, face_position;
};

template <class Mesh>
Working_mesh::Connectivity read_connectivity(const Mesh& mesh, const Elements<Mesh>& elements)
{
  Working_mesh::Connectivity result;
  result.vertices = static_cast<Index>(elements.vertices.size());
  result.faces = static_cast<Index>(elements.faces.size());
  const auto halfedges = static_cast<Index>(2 * elements.edges.size());
  result.next.resize(halfedges);
  result.target.resize(halfedges);
  result.face.resize(halfedges);
  for (Index i = 0; i < halfedges; ++i) {
    const auto h = elements.halfedge(mesh, i);
    result.next[i] = elements.position(mesh, mesh.next(h));
    result.target[i] = elements.vertex_position[mesh.target(h)];
    result.face[i] = mesh.is_border(h) ? none : elements.face_position[mesh.face(h)];
  }
  return result;
}

template <class Mesh, class Points>
Reference make_reference(const Elements<Mesh>& elements, const Points& points,
                         const Working_mesh::Connectivity& connectivity)
{
  std::vector<Vector> coordinates;
  coordinates.reserve(elements.vertices.size());
  for (const auto v : elements.vertices) coordinates.push_back(to_vector(get(points, v)));
  return Reference(std::move(coordinates), connectivity.next, connectivity.target,
                   connectivity.face, connectivity.faces);
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
Working_mesh make_working_mesh(const Elements<Mesh>& elements, const Features& features,
                               Working_mesh::Connectivity connectivity)
{
  std::vector<bool> fixed(elements.vertices.size());
  for (Index v = 0; v < fixed.size(); ++v) fixed[v] = features.corner[elements.vertices[v]];
  return Working_mesh(std::move(connectivity), features_in_order(elements, features),
                      std::move(fixed));
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
  for (Index f = 0; f < elements.faces.size(); ++f) {
    if (!result.is_live_face(f)) mesh.remove_face(elements.faces[f]);
    else mesh.set_halfedge(elements.faces[f], elements.halfedge(mesh, result.halfedge_in(f)));
  }
  for (Index e = 0; e < elements.edges.size(); ++e)
    if (!result.is_live_edge(e)) mesh.remove_edge(elements.edges[e]);
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
      "v:surety_position", none).first;
  auto face_name = mesh.template add_property_map<typename Mesh::Face_index, Index>(
      "f:surety_position", none).first;
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
