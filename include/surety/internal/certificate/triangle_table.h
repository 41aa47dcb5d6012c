// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle mesh as the checker sees it: points and triples of indices, as in a file, and the
// edges rebuilt from them. Nothing but the triples is taken from the mesh's own connectivity, so
// that the check does not depend on it.
#ifndef SURETY_INTERNAL_CERTIFICATE_TRIANGLE_TABLE_H
#define SURETY_INTERNAL_CERTIFICATE_TRIANGLE_TABLE_H

#include <surety/errors.h>
#include <surety/internal/certificate/record.h>

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

namespace surety::internal::checker {

using Point = std::array<double, 3>;

struct Edge {
  Index a, b;                 ///< a < b
  std::array<Index, 2> faces; ///< the one that runs from a to b, the one that runs from b to a

  bool is_border() const { return faces[0] == none || faces[1] == none; }
  Vertex_pair name() const { return {a, b}; }
};

/// An oriented triangle mesh without edges of more than two faces. Sides: side k of a triangle runs
/// from corner k to corner k + 1.
class Triangle_table
{
public:
  Triangle_table(std::vector<Point> points, std::vector<std::array<Index, 3>> triangles)
    : points_(std::move(points)), triangles_(std::move(triangles))
  {
    defect_ = find_bad_entry();
    if (defect_.empty()) make_edges();
  }

  /// What is wrong with the mesh; if this is not empty, nothing else may be asked.
  const std::string& defect() const { return defect_; }

  Index number_of_vertices() const { return static_cast<Index>(points_.size()); }
  Index number_of_faces() const { return static_cast<Index>(triangles_.size()); }
  const Point& point(Index v) const { return points_[v]; }
  /// Multiplies all points by a power of two.
  void scale(double factor)
  {
    for (Point& p : points_)
      for (double& c : p) c *= factor;
  }
  const std::array<Index, 3>& corners(Index f) const { return triangles_[f]; }
  const std::array<Index, 3>& sides(Index f) const { return sides_[f]; }
  /// Sorted by the pair of their ends.
  const std::vector<Edge>& edges() const { return edges_; }
  /// A face at the vertex, or none.
  Index face_at(Index v) const { return face_at_[v]; }

  /// The edge with these ends, or none; the order of the ends does not matter.
  Index find_edge(Index u, Index v) const
  {
    const auto [a, b] = std::minmax(u, v);
    if (b >= number_of_vertices()) return none;
    const auto first = edges_.begin() + first_edge_[a], last = edges_.begin() + first_edge_[a + 1];
    const auto found = std::lower_bound(
        first, last, b, [](const Edge& edge, Index end) { return edge.b < end; });
    return found != last && found->b == b ? static_cast<Index>(found - edges_.begin()) : none;
  }

private:
  struct Side {
    Index larger; ///< of the two end vertices
    Index face;
    Index number;
  };

  std::string find_bad_entry() const
  {
    for (std::size_t v = 0; v < points_.size(); ++v) {
      for (const double c : points_[v]) {
        if (!std::isfinite(c)) return "vertex " + std::to_string(v) + " is not finite";
      }
    }
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      const auto& t = triangles_[f];
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        return "face " + std::to_string(f) + " has a vertex twice";
      }
    }
    return "";
  }

  Index smaller_end(Index f, Index k) const
  {
    return (std::min)(triangles_[f][k], triangles_[f][(k + 1) % 3]);
  }

  /// Sorts all sides by their ends, in linear time but for the logarithm of a vertex's degree.
  void make_edges()
  {
    std::vector<Index> offsets(points_.size() + 1, 0);
    face_at_.assign(points_.size(), none);
    for (Index f = 0; f < number_of_faces(); ++f) {
      for (Index k = 0; k < 3; ++k) {
        ++offsets[smaller_end(f, k) + 1];
        face_at_[triangles_[f][k]] = f;
      }
    }
    for (std::size_t v = 0; v < points_.size(); ++v) offsets[v + 1] += offsets[v];

    std::vector<Side> sides(offsets.back());
    std::vector<Index> filled(offsets.begin(), offsets.end() - 1);
    for (Index f = 0; f < number_of_faces(); ++f) {
      for (Index k = 0; k < 3; ++k) {
        const Index larger = (std::max)(triangles_[f][k], triangles_[f][(k + 1) % 3]);
        sides[filled[smaller_end(f, k)]++] = {larger, f, k};
      }
    }
    sides_.resize(triangles_.size());
    first_edge_.resize(points_.size() + 1);
    edges_.reserve(sides.size() / 2 + 1);
    for (Index v = 0; v < number_of_vertices() && defect_.empty(); ++v) {
      first_edge_[v] = static_cast<Index>(edges_.size());
      merge_sides(v, sides.data() + offsets[v], sides.data() + offsets[v + 1]);
    }
    first_edge_.back() = static_cast<Index>(edges_.size());
  }

  void merge_sides(Index v, Side* first, Side* last)
  {
    std::sort(first, last, [](const Side& p, const Side& q) { return p.larger < q.larger; });
    for (const Side* side = first; side != last; ++side) {
      if (side == first || side->larger != edges_.back().b) {
        edges_.push_back({v, side->larger, {none, none}});
      }
      Index& face = edges_.back().faces[triangles_[side->face][side->number] == v ? 0 : 1];
      if (face != none) {
        defect_ = "edge " + to_string(edges_.back().name())
            + " has more than two faces, or two that are not oriented alike";
        return;
      }
      face = side->face;
      sides_[side->face][side->number] = static_cast<Index>(edges_.size() - 1);
    }
  }

  std::vector<Point> points_;
  std::vector<std::array<Index, 3>> triangles_, sides_;
  std::vector<Edge> edges_;
  std::vector<Index> first_edge_, face_at_;
  std::string defect_;
};

/// The two faces at an edge must have different third corners; then any two faces of the mesh have
/// nothing, a vertex or an edge in common: it is a simplicial complex.
inline std::string simplicial_defect(const Triangle_table& mesh)
{
  const auto apex = [&](Index f, const Edge& e) {
    const auto& t = mesh.corners(f);
    return t[0] ^ t[1] ^ t[2] ^ e.a ^ e.b;
  };
  for (const Edge& e : mesh.edges()) {
    if (!e.is_border() && apex(e.faces[0], e) == apex(e.faces[1], e)) {
      return "faces " + std::to_string(e.faces[0]) + " and " + std::to_string(e.faces[1])
          + " have the same vertices";
    }
  }
  return "";
}

/// Reads the triples of a mesh; indices are positions in iteration order.
template <class Mesh, class Vertex_point_map>
Triangle_table read_triangles(
    const Mesh& mesh, const Vertex_point_map& vertex_points, const char* argument)
{
  const auto number = get(boost::vertex_index, mesh);
  std::vector<Point> points;
  std::vector<Index> position;
  points.reserve(num_vertices(mesh));
  for (const auto v : vertices(mesh)) {
    const std::size_t id = get(number, v);
    if (id >= position.size()) position.resize((std::max)(id + 1, std::size_t(num_vertices(mesh))));
    position[id] = static_cast<Index>(points.size());
    const auto& p = get(vertex_points, v);
    static_assert(
        std::is_floating_point_v<std::decay_t<decltype(p.x())>> && sizeof(p.x()) <= sizeof(double),
        "an upper bound needs the exact coordinates: use a kernel with double coordinates");
    points.push_back({p.x(), p.y(), p.z()});
  }
  std::vector<std::array<Index, 3>> triangles;
  triangles.reserve(num_faces(mesh));
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh), second = next(h, mesh), third = next(second, mesh);
    if (next(third, mesh) != h) {
      throw Invalid_input(
          "check_certificate", argument,
          "face " + std::to_string(triangles.size()) + " is not a triangle",
          "triangulate with CGAL::Polygon_mesh_processing::triangulate_faces");
    }
    triangles.push_back(
        {position[get(number, target(third, mesh))], position[get(number, target(h, mesh))],
         position[get(number, target(second, mesh))]});
  }
  return Triangle_table(std::move(points), std::move(triangles));
}

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_TRIANGLE_TABLE_H
