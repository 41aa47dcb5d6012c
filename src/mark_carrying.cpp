// SPDX-License-Identifier: GPL-3.0-or-later
//
// Marks for a mesh that was made anew. Vertices that stay are recognised by their coordinates,
// which are the same to the last bit; regions are what feature edges leave of the faces, in the new
// mesh as in the old one.
#include "marks.h"

#include "faces.h"
#include "failure.h"

#include <surety/internal/metric/face_locator.h>

#include <CGAL/AABB_halfedge_graph_segment_primitive.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace surety::tool {
namespace {

using Vertex = Mesh::Vertex_index;
using Edge = Mesh::Edge_index;
using Face = Mesh::Face_index;
using surety::internal::Vector;
using surety::internal::metric::Face_locator;
using surety::internal::metric::Located_face;

Vector to_vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

std::array<Vector, 3> places(const Mesh& mesh, Face f)
{
  const auto [a, b, c] = corners(mesh, f);
  return {to_vector(mesh.point(a)), to_vector(mesh.point(b)), to_vector(mesh.point(c))};
}

/// The vertices of another mesh by their place.
class Vertex_finder
{
public:
  explicit Vertex_finder(const Mesh& mesh)
  {
    for (const Vertex v : mesh.vertices()) at_.emplace(mesh.point(v), v);
  }

  Vertex find(const Point& p) const
  {
    const auto [first, last] = at_.equal_range(p);
    return first == last ? Mesh::null_vertex() : first->second;
  }

  /// The first halfedge from one point to another that is accepted: sheets that touch have several
  /// vertices in one place.
  template <class Accept>
  Mesh::Halfedge_index find_halfedge(
      const Mesh& mesh, const Point& p, const Point& q, const Accept& accept) const
  {
    const auto [first, last] = at_.equal_range(p);
    for (auto v = first; v != last; ++v)
      for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v->second)))
        if (mesh.point(mesh.source(h)) == q && accept(mesh.opposite(h))) return mesh.opposite(h);
    return Mesh::null_halfedge();
  }

private:
  std::multimap<Point, Vertex> at_;
};

/// The feature edge nearest to a point.
class Curve_finder
{
  using Primitive = CGAL::AABB_halfedge_graph_segment_primitive<Mesh>;
#if __has_include(<CGAL/AABB_traits_3.h>)
  using Traits = CGAL::AABB_traits_3<Kernel, Primitive>;
#else
  using Traits = CGAL::AABB_traits<Kernel, Primitive>;
#endif

public:
  Curve_finder(const Mesh& mesh, const Features& features)
  {
    std::vector<Edge> edges;
    for (const Edge e : mesh.edges())
      if (features.edge[e]) edges.push_back(e);
    tree_.insert(edges.begin(), edges.end(), mesh);
    if (!tree_.empty()) tree_.build();
  }

  bool is_empty() const { return tree_.empty(); }
  Edge nearest(const Point& p) const { return tree_.closest_point_and_primitive(p).second; }

private:
  CGAL::AABB_tree<Traits> tree_;
};

void carry_vertices(const Mesh& from, const Marks& old, Mesh& to, Marks& marks)
{
  const Vertex_finder finder(from);
  for (const Vertex v : to.vertices()) {
    const Vertex same = finder.find(to.point(v));
    if (same == Mesh::null_vertex()) continue;
    marks.vertex_reference[v] = old.vertex_reference[same];
    marks.is_corner[v] = bool(old.is_corner[same]);
    marks.is_required_vertex[v] = bool(old.is_required_vertex[same]);
  }
}

void carry_edges(
    const Mesh& from, const Features& features, const Marks& old,
    const Mesh::Property_map<Edge, bool>& is_feature, Mesh& to, Marks& marks)
{
  const Curve_finder finder(from, features);
  if (finder.is_empty()) return;
  for (const Edge e : to.edges()) {
    if (!is_feature[e]) continue;
    const Edge near
        = finder.nearest(CGAL::midpoint(to.point(to.vertex(e, 0)), to.point(to.vertex(e, 1))));
    marks.edge_reference[e] = old.edge_reference[near];
    marks.is_listed[e] = bool(old.is_listed[near]);
    marks.is_ridge[e] = bool(old.is_ridge[near]);
  }
}

void require_kept(bool is_kept, const char* what)
{
  if (is_kept) return;
  throw Failure(
      not_certified,
      std::string("a required ") + what
          + " of the input was not kept; nothing was written; please report this");
}

/// Required elements are there as they were.
void carry_required(const Mesh& from, const Marks& old, Mesh& to, Marks& marks)
{
  const Vertex_finder finder(to);
  const auto any = [](Mesh::Halfedge_index) { return true; };
  for (const Edge e : from.edges()) {
    if (!old.is_required_edge[e]) continue;
    const Point &p = from.point(from.vertex(e, 0)), &q = from.point(from.vertex(e, 1));
    const auto h = finder.find_halfedge(to, p, q, any);
    require_kept(h != Mesh::null_halfedge(), "edge");
    marks.is_required_edge[to.edge(h)] = true;
  }
  for (const Face f : from.faces()) {
    if (!old.is_required_face[f]) continue;
    const auto [a, b, c] = corners(from, f);
    const Point& apex = from.point(c);
    const auto h
        = finder.find_halfedge(to, from.point(a), from.point(b), [&](Mesh::Halfedge_index k) {
            return !to.is_border(k) && to.point(to.target(to.next(k))) == apex;
          });
    require_kept(h != Mesh::null_halfedge(), "triangle");
    marks.is_required_face[to.face(h)] = true;
  }
  for (const Vertex v : from.vertices())
    if (old.is_required_vertex[v])
      require_kept(finder.find(from.point(v)) != Mesh::null_vertex(), "vertex");
}

/// The faces that are connected to one without crossing a feature edge.
std::vector<Face> region(
    const Mesh& mesh, const Mesh::Property_map<Edge, bool>& is_feature, Face seed,
    std::vector<bool>& is_known)
{
  std::vector<Face> result = {seed};
  is_known[seed] = true;
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(result[i]))) {
      const Face other = mesh.face(mesh.opposite(h));
      if (other == Mesh::null_face() || is_feature[mesh.edge(h)] || is_known[other]) continue;
      is_known[other] = true;
      result.push_back(other);
    }
  }
  return result;
}

Face_locator locator_of(const Mesh& mesh)
{
  std::vector<Located_face> faces;
  for (const Face f : mesh.faces()) {
    Located_face face;
    face.corner = places(mesh, f);
    face.id = f;
    faces.push_back(face);
  }
  return Face_locator(std::move(faces));
}

/// Each region gets the reference that most of its area lies next to.
void carry_faces(
    const Mesh& from, const Marks& old, const Mesh::Property_map<Edge, bool>& is_feature, Mesh& to,
    Marks& marks)
{
  const Face_locator locator = locator_of(from);
  std::vector<bool> is_known(to.number_of_faces(), false);
  for (const Face seed : to.faces()) {
    if (is_known[seed]) continue;
    const std::vector<Face> faces = region(to, is_feature, seed, is_known);
    std::map<int, double> area;
    for (const Face f : faces) {
      const auto [a, b, c] = places(to, f);
      const Vector normal = (b - a).cross(c - a);
      const Face near(locator.nearest((a + b + c) / 3, normal).face);
      area[old.face_reference[near]] += normal.norm();
    }
    auto most = area.begin();
    for (auto next = area.begin(); next != area.end(); ++next)
      if (next->second > most->second) most = next;
    for (const Face f : faces) marks.face_reference[f] = most->first;
  }
}

} // namespace

void carry_marks(const Mesh& from, const Features& features, Mesh& to)
{
  const Marks old = *find_marks(from);
  Marks marks = add_marks(to);
  const auto is_feature = to.add_property_map<Edge, bool>("e:is_feature", false).first;
  carry_vertices(from, old, to, marks);
  carry_edges(from, features, old, is_feature, to, marks);
  carry_required(from, old, to, marks);
  carry_faces(from, old, is_feature, to, marks);
}

} // namespace surety::tool
