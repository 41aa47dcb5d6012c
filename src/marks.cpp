// SPDX-License-Identifier: GPL-3.0-or-later
#include "marks.h"

#include "failure.h"

#include <array>
#include <map>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace surety::tool {
namespace {

using Vertex = Mesh::Vertex_index;
using Edge = Mesh::Edge_index;
using Face = Mesh::Face_index;

/// CGAL 5 returns a pair, CGAL 6 an optional.
template <class Key, class Value, class Any_mesh>
std::optional<Mesh::Property_map<Key, Value>> find_map(const Any_mesh& mesh, const char* name)
{
  using Map = Mesh::Property_map<Key, Value>;
  const auto found = mesh.template property_map<Key, Value>(name);
  if constexpr (std::is_same_v<std::decay_t<decltype(found)>, std::pair<Map, bool>>) {
    return found.second ? std::optional<Map>(found.first) : std::nullopt;
  } else {
    return found;
  }
}

constexpr const char* names[]
    = {"v:reference", "v:is_corner",   "v:is_required", "e:reference",  "e:is_listed",
       "e:is_ridge",  "e:is_required", "f:reference",   "f:is_required"};

/// Edges of the same kind go on in each other; where the kind changes a vertex must stay.
auto kind(const Marks& marks, Edge e)
{
  return std::tuple(marks.edge_reference[e], bool(marks.is_listed[e]), bool(marks.is_ridge[e]));
}

bool separates_references(const Mesh& mesh, const Marks& marks, Edge e)
{
  if (mesh.is_border(e)) return false;
  const auto h = mesh.halfedge(e);
  return marks.face_reference[mesh.face(h)] != marks.face_reference[mesh.face(mesh.opposite(h))];
}

/// Required, or of a required face.
std::vector<bool> whole_edges(const Mesh& mesh, const Marks& marks)
{
  std::vector<bool> result(mesh.number_of_edges());
  for (const Edge e : mesh.edges()) result[e] = marks.is_required_edge[e];
  for (const Face f : mesh.faces()) {
    if (!marks.is_required_face[f]) continue;
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) result[mesh.edge(h)] = true;
  }
  return result;
}

std::vector<bool> kept_vertices(
    const Mesh& mesh, const Marks& marks, const std::vector<bool>& is_feature,
    const std::vector<bool>& is_whole)
{
  std::vector<bool> result(mesh.number_of_vertices());
  for (const Vertex v : mesh.vertices()) {
    bool keep = marks.is_corner[v] || marks.is_required_vertex[v];
    std::optional<Edge> first;
    for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
      const Edge e = mesh.edge(h);
      keep = keep || is_whole[e];
      if (!is_feature[e] && !mesh.is_border(e)) continue;
      keep = keep || (first && kind(marks, *first) != kind(marks, e));
      first = e;
    }
    result[v] = keep;
  }
  return result;
}

} // namespace

Marks add_marks(Mesh& mesh)
{
  return {
      mesh.add_property_map<Vertex, int>(names[0], 0).first,
      mesh.add_property_map<Vertex, bool>(names[1], false).first,
      mesh.add_property_map<Vertex, bool>(names[2], false).first,
      mesh.add_property_map<Edge, int>(names[3], 0).first,
      mesh.add_property_map<Edge, bool>(names[4], false).first,
      mesh.add_property_map<Edge, bool>(names[5], false).first,
      mesh.add_property_map<Edge, bool>(names[6], false).first,
      mesh.add_property_map<Face, int>(names[7], 0).first,
      mesh.add_property_map<Face, bool>(names[8], false).first};
}

std::optional<Marks> find_marks(const Mesh& mesh)
{
  if (!find_map<Vertex, int>(mesh, names[0])) return std::nullopt;
  return Marks{*find_map<Vertex, int>(mesh, names[0]),  *find_map<Vertex, bool>(mesh, names[1]),
               *find_map<Vertex, bool>(mesh, names[2]), *find_map<Edge, int>(mesh, names[3]),
               *find_map<Edge, bool>(mesh, names[4]),   *find_map<Edge, bool>(mesh, names[5]),
               *find_map<Edge, bool>(mesh, names[6]),   *find_map<Face, int>(mesh, names[7]),
               *find_map<Face, bool>(mesh, names[8])};
}

void mark(Mesh& mesh, const Annotations& notes, const std::string& file)
{
  Marks marks = add_marks(mesh);
  for (const Vertex v : mesh.vertices()) marks.vertex_reference[v] = notes.point_references[v];
  for (const Face f : mesh.faces()) marks.face_reference[f] = notes.polygon_references[f];
  std::vector<Edge> edges;
  for (const Annotations::Edge& edge : notes.edges) {
    const auto h
        = mesh.halfedge(Vertex(Mesh::size_type(edge.from)), Vertex(Mesh::size_type(edge.to)));
    if (h == Mesh::null_halfedge()) {
      throw Bad_file(
          file,
          "edge " + std::to_string(edges.size() + 1) + ", from vertex "
              + std::to_string(edge.from + 1) + " to vertex " + std::to_string(edge.to + 1)
              + ", is the side of no triangle",
          "remove it");
    }
    edges.push_back(mesh.edge(h));
    marks.is_listed[edges.back()] = true;
    marks.edge_reference[edges.back()] = edge.reference;
  }
  for (const std::size_t i : notes.ridges) marks.is_ridge[edges[i]] = true;
  for (const std::size_t i : notes.required_edges) marks.is_required_edge[edges[i]] = true;
  for (const std::size_t v : notes.corners) marks.is_corner[Vertex(Mesh::size_type(v))] = true;
  for (const std::size_t v : notes.required_points)
    marks.is_required_vertex[Vertex(Mesh::size_type(v))] = true;
  for (const std::size_t f : notes.required_polygons)
    marks.is_required_face[Face(Mesh::size_type(f))] = true;
}

Constraints constraints_of(const Mesh& mesh)
{
  const auto marks = find_marks(mesh);
  if (!marks) return {};
  std::vector<bool> whole = whole_edges(mesh, *marks);
  std::vector<bool> features = whole;
  for (const Edge e : mesh.edges()) {
    features[e] = features[e] || marks->is_listed[e] || separates_references(mesh, *marks, e);
  }
  std::vector<bool> vertices = kept_vertices(mesh, *marks, features, whole);
  return {
      Chosen<Edge>(std::move(features)), Chosen<Vertex>(std::move(vertices)),
      Chosen<Edge>(std::move(whole))};
}

void mark_features(Mesh& mesh, const Features& features)
{
  const Constraints known = constraints_of(mesh);
  Marks marks = add_marks(mesh);
  for (const Edge e : mesh.edges()) {
    if (!features.edge[e] || known.edges[e] || mesh.is_border(e)) continue;
    marks.is_listed[e] = marks.is_ridge[e] = true;
  }
  for (const Vertex v : mesh.vertices())
    if (features.corner[v] && !known.vertices[v]) marks.is_corner[v] = true;
}

Soup to_soup(const Mesh& mesh)
{
  Soup soup;
  for (const Vertex v : mesh.vertices()) soup.points.push_back(mesh.point(v));
  for (const Face f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    soup.polygons.push_back({mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))});
  }
  const auto marks = find_marks(mesh);
  if (!marks) return soup;

  Annotations& notes = soup.annotations.emplace();
  for (const Vertex v : mesh.vertices()) {
    notes.point_references.push_back(marks->vertex_reference[v]);
    if (marks->is_corner[v]) notes.corners.push_back(v);
    if (marks->is_required_vertex[v]) notes.required_points.push_back(v);
  }
  for (const Face f : mesh.faces()) {
    notes.polygon_references.push_back(marks->face_reference[f]);
    if (marks->is_required_face[f]) notes.required_polygons.push_back(f);
  }
  for (const Edge e : mesh.edges()) {
    if (!marks->is_listed[e]) continue;
    if (marks->is_ridge[e]) notes.ridges.push_back(notes.edges.size());
    if (marks->is_required_edge[e]) notes.required_edges.push_back(notes.edges.size());
    notes.edges.push_back({mesh.vertex(e, 0), mesh.vertex(e, 1), marks->edge_reference[e]});
  }
  return soup;
}

} // namespace surety::tool
