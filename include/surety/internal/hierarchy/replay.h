// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the operations of a record again, on M alone: no bound, no quadric, no search. What the
// record says is not trusted: an operation that would not leave a surface is refused.
#ifndef SURETY_INTERNAL_HIERARCHY_REPLAY_H
#define SURETY_INTERNAL_HIERARCHY_REPLAY_H

#include <surety/errors.h>
#include <surety/hierarchy_record.h>
#include <surety/internal/geometric_mesh/exchange.h>
#include <surety/internal/hierarchy/text_format.h>

#include <cstring>
#include <string>
#include <vector>

namespace surety::internal {

/// Tells meshes apart by their points and faces: FNV-1a of all coordinates and, each from its
/// smallest vertex on, of all faces. Signs of zeros do not count.
template <class Mesh, class Points>
std::uint64_t fingerprint_of(const Mesh& mesh, const Points& points)
{
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](std::uint64_t word) {
    for (int i = 0; i < 8; ++i, word >>= 8) hash = (hash ^ (word & 0xff)) * 0x100000001b3;
  };
  std::vector<Index> position(mesh.num_vertices());
  Index next = 0;
  for (const auto v : mesh.vertices()) {
    position[v] = next++;
    const Vector p = to_vector(get(points, v));
    for (int i = 0; i < 3; ++i) {
      const double coordinate = p[i] + 0.0;
      std::uint64_t bits;
      static_assert(sizeof bits == sizeof coordinate);
      std::memcpy(&bits, &coordinate, sizeof bits);
      add(bits);
    }
  }
  for (const auto f : mesh.faces()) {
    std::array<Index, 3> corner;
    auto h = mesh.halfedge(f);
    for (Index& c : corner) c = position[mesh.target(h)], h = mesh.next(h);
    std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
    for (const Index c : corner) add(c);
  }
  return hash;
}

/// Gives a copy of the mesh that M was read from the faces and points of M, and compacts it.
template <class Mesh>
Compaction write_level(
    const Working_mesh& result, const Elements<Mesh>& elements, double scale, Mesh& copy)
{
  write_connectivity(result, elements, copy);
  for (Index v = 0; v < elements.vertices.size(); ++v) {
    auto& point = copy.point(elements.vertices[v]);
    if (!result.is_live_vertex(v) || Vector(scale * to_vector(point)) == result.point(v)) continue;
    const Vector p = result.point(v) / scale;
    point = typename Mesh::Point(p.x(), p.y(), p.z());
  }
  return compact(elements, copy);
}

template <class Mesh>
class Replay
{
public:
  /// `mesh` holds the points itself.
  Replay(const Mesh& mesh, const Hierarchy_record& record, const char* function)
    : mesh_(mesh),
      record_(record),
      function_(function),
      scale_(normalising_scale(mesh, mesh.points())),
      elements_(mesh, mesh.points()),
      vertex_at_(elements_.vertices.size()),
      working_(
          read_connectivity(mesh, elements_), points_in_order(elements_, mesh.points(), scale_),
          std::vector<bool>(elements_.edges.size()), std::vector<bool>(elements_.vertices.size()),
          journal_),
      next_point_(record.points.begin())
  {
    for (Index v = 0; v < vertex_at_.size(); ++v) vertex_at_[elements_.input_position[v]] = v;
  }

  std::size_t made() const { return made_; }
  bool is_at_end() const { return made_ == record_.operations.size(); }
  /// Whether M is within the tolerance.
  bool is_at_boundary() const { return made_ == 0 || record_.operations[made_ - 1].is_boundary; }
  std::size_t faces() const { return working_.number_of_live_faces(); }

  /// Of the level that M belongs to.
  double tolerance() const
  {
    if (made_ == 0) return 0;
    std::size_t level = 0;
    while (record_.levels[level].operations < made_) ++level;
    return record_.levels[level].tolerance;
  }

  /// Makes the next operation.
  void advance()
  {
    const auto& operation = record_.operations[made_];
    const Index s = vertex_at_[operation.source], t = vertex_at_[operation.target];
    if (!working_.is_live_vertex(s)) refuse("a vertex is gone");
    switch (operation.kind) {
    case Hierarchy_record::Kind::flip:
      working_.flip(flippable(s, t));
      break;
    case Hierarchy_record::Kind::collapse:
      working_.collapse(collapsible(s, t));
      break;
    case Hierarchy_record::Kind::placement:
      working_.collapse(collapsible(s, t));
      move(t);
      break;
    case Hierarchy_record::Kind::relocation:
      move(s);
      break;
    }
    ++made_;
  }

  /// M as a mesh of the user's.
  Mesh mesh() const
  {
    Mesh result = mesh_;
    write_level(working_, elements_, scale_, result);
    return result;
  }

private:
  [[noreturn]] void refuse(const char* problem) const
  {
    throw Invalid_input(
        function_, "record", "operation " + std::to_string(made_) + " cannot be made: " + problem,
        "use the record and the input as they were written");
  }

  void move(Index v)
  {
    const auto [x, y, z] = *next_point_++;
    working_.move(v, scale_ * Vector(x, y, z), v);
  }

  Index halfedge_between(Index s, Index t) const
  {
    Index result = none;
    working_.for_each_outgoing(s, [&](Index h) {
      if (working_.target(h) == t) result = h;
    });
    if (result == none) refuse("there is no such edge");
    return result;
  }

  /// The link condition. Ghosts close the borders, so that they need no case of their own.
  Index collapsible(Index s, Index t) const
  {
    const Index h = halfedge_between(s, t);
    Index common = 0, degree_of_s = 0, degree_of_t = 0;
    working_.for_each_outgoing(t, [&](Index) { ++degree_of_t; });
    working_.for_each_outgoing(s, [&](Index k) {
      ++degree_of_s;
      working_.for_each_outgoing(
          t, [&](Index l) { common += working_.target(k) == working_.target(l); });
    });
    if (common != 2 || (degree_of_s == 3 && degree_of_t == 3))
      refuse("the result would not be a surface");
    return h;
  }

  Index flippable(Index s, Index t) const
  {
    const Index h = halfedge_between(s, t);
    if (working_.is_border(Working_mesh::edge(h))) refuse("the edge is on the border");
    const Index c = working_.target(working_.next(h)),
                d = working_.target(working_.next(Working_mesh::opposite(h)));
    bool exists = c == d;
    working_.for_each_outgoing(c, [&](Index k) { exists = exists || working_.target(k) == d; });
    if (exists) refuse("the other diagonal exists already");
    return h;
  }

  const Mesh& mesh_;
  const Hierarchy_record& record_;
  const char* function_;
  double scale_;
  Elements<Mesh> elements_;
  std::vector<Index> vertex_at_; ///< by position in the input
  Journal journal_;
  Working_mesh working_;
  std::size_t made_ = 0;
  std::vector<std::array<double, 3>>::const_iterator next_point_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_HIERARCHY_REPLAY_H
