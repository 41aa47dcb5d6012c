// SPDX-License-Identifier: GPL-3.0-or-later
//
// The items of a record, resolved: every image, crossing and inner item with the element of M that
// it lies in, by index. Items of vertices come first, then those of crossings, then the inner ones,
// in the order of the record.
#ifndef SURETY_INTERNAL_CERTIFICATE_ITEMS_H
#define SURETY_INTERNAL_CERTIFICATE_ITEMS_H

#include <surety/internal/certificate/triangle_table.h>

namespace surety::internal::checker {

using Kind = Correspondence::Kind;

struct Item {
  Kind kind;
  Index id; ///< of a vertex, edge or face of M
};

/// The items and the mesh M that they lie in.
class Items
{
public:
  explicit Items(const Triangle_table& output) : output_(output) {}

  const Triangle_table& output() const { return output_; }
  const Item& operator[](Index i) const { return items_[i]; }
  Index size() const { return static_cast<Index>(items_.size()); }
  void reserve(std::size_t number) { items_.reserve(number); }

  /// Returns false if M has no such element.
  bool add(const Correspondence::Image& image)
  {
    switch (image.kind) {
    case Kind::vertex:
      return add(Kind::vertex, image.a, image.a < output_.number_of_vertices());
    case Kind::face:
      return add(Kind::face, image.a, image.a < output_.number_of_faces());
    case Kind::edge:
      break;
    }
    return add_on_edge(image.a, image.b);
  }
  bool add(const Correspondence::Crossing& crossing) { return add_on_edge(crossing.a, crossing.b); }
  bool add(const Correspondence::Inner& inner)
  {
    return add(Kind::vertex, inner.vertex, inner.vertex < output_.number_of_vertices());
  }

  bool is_at_vertex(Index i) const { return items_[i].kind == Kind::vertex; }

  /// The position in a face: 0 to 2 at a corner, 3 to 5 on a side, 6 inside; 7 if not in it.
  unsigned position_in_face(Index i, Index face) const
  {
    const Item& item = items_[i];
    if (item.kind == Kind::face) return item.id == face ? 6 : 7;
    const auto& parts = item.kind == Kind::vertex ? output_.corners(face) : output_.sides(face);
    const unsigned first = item.kind == Kind::vertex ? 0 : 3;
    for (unsigned k = 0; k < 3; ++k) {
      if (parts[k] == item.id) return first + k;
    }
    return 7;
  }

  bool is_in_face(Index i, Index face) const { return position_in_face(i, face) < 7; }

  /// A closed face that holds all three, or none.
  Index common_face(Index i, Index j, Index k) const
  {
    const std::array<Index, 3> all = {i, j, k};
    for (const Kind kind : {Kind::face, Kind::edge}) {
      for (const Index one : all) {
        if (items_[one].kind != kind) continue;
        if (kind == Kind::face) return holds_all(items_[one].id, all);
        return one_that_holds_all(output_.edges()[items_[one].id].faces, all);
      }
    }
    return face_at_vertices(all);
  }

private:
  bool add(Kind kind, Index id, bool exists)
  {
    items_.push_back({kind, id});
    return exists;
  }
  bool add_on_edge(Index a, Index b)
  {
    const Index edge = output_.find_edge(a, b);
    return add(Kind::edge, edge, edge != none);
  }

  Index holds_all(Index face, const std::array<Index, 3>& all) const
  {
    if (face == none) return none;
    for (const Index i : all) {
      if (!is_in_face(i, face)) return none;
    }
    return face;
  }
  Index one_that_holds_all(const std::array<Index, 2>& faces, const std::array<Index, 3>& all) const
  {
    const Index first = holds_all(faces[0], all);
    return first != none ? first : holds_all(faces[1], all);
  }

  Index face_at_vertices(const std::array<Index, 3>& all) const
  {
    const Index u = items_[all[0]].id, v = items_[all[1]].id, w = items_[all[2]].id;
    if (u == v && v == w) return output_.face_at(u);
    const Index edge = output_.find_edge(u, u == v ? w : v);
    return edge == none ? none : one_that_holds_all(output_.edges()[edge].faces, all);
  }

  const Triangle_table& output_;
  std::vector<Item> items_;
};

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_ITEMS_H
