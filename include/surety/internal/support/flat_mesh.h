// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the support keeps of a mesh: flat arrays that a query reads without touching the mesh again.
// Corner i of a face and its edge i, from corner i to corner i + 1, are a "place", numbered
// 3 face + i; corner 0 is the source of the face's halfedge, as in CGAL's face locations.
#ifndef SURETY_INTERNAL_SUPPORT_FLAT_MESH_H
#define SURETY_INTERNAL_SUPPORT_FLAT_MESH_H

#include <surety/features.h>
#include <surety/internal/linear.h>

#include <array>
#include <cstddef>
#include <vector>

namespace surety::internal {

using Corners = std::array<Index, 3>;

constexpr int next_corner(int i) { return i == 2 ? 0 : i + 1; }
constexpr int previous_corner(int i) { return i == 0 ? 2 : i - 1; }

struct Flat_mesh {
  std::vector<Vector> point;                ///< by vertex
  std::vector<Corners> corner;              ///< by face; `none` where there is no face
  std::vector<Corners> edge;                ///< by face: of edge i
  std::vector<Corners> neighbour;           ///< by face: the place across edge i, none on a border
  std::vector<Corners> side;                ///< by face: of corner i
  std::vector<std::array<Index, 2>> ends;   ///< by edge: its vertices, in the edge's direction
  std::vector<std::array<Index, 2>> places; ///< by edge: where it is; the second may be none
  std::vector<bool> is_feature;             ///< by edge
  std::vector<bool> is_corner;              ///< by vertex
  std::vector<Index> side_vertex;           ///< by side

  std::size_t faces() const { return corner.size(); }
  std::size_t edges() const { return ends.size(); }
  bool is_face(Index f) const { return corner[f][0] != none; }
  const Vector& position(Index f, int i) const { return point[corner[f][i]]; }
  Vector chord(Index f, int i) const { return position(f, next_corner(i)) - position(f, i); }
  /// Whether the face runs along its edge i in the edge's own direction.
  bool is_along(Index f, int i) const { return ends[edge[f][i]][0] == corner[f][i]; }
};

/// The faces and edges of a mesh; the features and sides come later.
template <class Mesh, class Points>
Flat_mesh flatten(const Mesh& mesh, const Points& points)
{
  Flat_mesh flat;
  flat.point.assign(num_vertices(mesh), Vector::Zero());
  for (const auto v : vertices(mesh)) flat.point[v] = to_vector(get(points, v));
  flat.corner.assign(num_faces(mesh), {none, none, none});
  flat.edge = flat.neighbour = flat.side = flat.corner;
  flat.ends.assign(num_edges(mesh), {none, none});
  flat.places = flat.ends;
  for (const auto e : edges(mesh)) {
    const auto h = halfedge(e, mesh);
    flat.ends[e] = {Index(source(h, mesh)), Index(target(h, mesh))};
  }
  for (const auto f : faces(mesh)) {
    auto h = halfedge(f, mesh);
    for (int i = 0; i < 3; ++i, h = next(h, mesh)) {
      const Index e = Index(edge(h, mesh));
      flat.corner[f][i] = Index(source(h, mesh));
      flat.edge[f][i] = e;
      auto& places = flat.places[e];
      places[places[0] == none ? 0 : 1] = 3 * Index(f) + Index(i);
    }
  }
  for (const auto& [one, other] : flat.places) {
    if (one == none || other == none) continue;
    flat.neighbour[one / 3][one % 3] = other;
    flat.neighbour[other / 3][other % 3] = one;
  }
  return flat;
}

template <class Mesh>
void add_features(const Mesh& mesh, const Features& features, const Sides& sides, Flat_mesh& flat)
{
  flat.is_feature = features.edge;
  flat.is_corner = features.corner;
  flat.side_vertex = sides.vertex;
  for (const auto f : faces(mesh)) {
    auto h = halfedge(f, mesh);
    for (int i = 0; i < 3; ++i, h = next(h, mesh)) {
      flat.side[f][next_corner(i)] = sides.of_corner[h];
    }
  }
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_FLAT_MESH_H
