// SPDX-License-Identifier: GPL-3.0-or-later
//
// The direct bound, step 3: the T triangles at those edges, cell by cell.
#ifndef SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_CELLS_H
#define SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_CELLS_H

namespace surety::internal {

/// The faces of M as they are once the disc is retriangulated.
class After_disc
{
public:
  After_disc(const Working_mesh& mesh, const Disc& disc) : mesh_(mesh), disc_(disc) {}
  /// For a T triangle with this normal, whose cells may lie in faces that do not turn farther away
  /// from it.
  After_disc(const Working_mesh& mesh, const Disc& disc, const Vector& normal, double cosine)
    : mesh_(mesh), disc_(disc), normal_(normal), cosine_(cosine)
  {}

  bool admits(Index f) const
  {
    if (cosine_ <= -1) return true;
    const auto corner = vertices_of(f);
    const Vector a = disc_.point(mesh_, corner[0]);
    const Vector n
        = unit((disc_.point(mesh_, corner[1]) - a).cross(disc_.point(mesh_, corner[2]) - a));
    return n.dot(normal_) >= cosine_;
  }

  std::array<Index, 3> vertices_of(Index f) const
  {
    const Index i = disc_.position_of_new_face(f);
    if (i == none) return mesh_.vertices_of(f);
    return {disc_.apex, disc_.ring[i], disc_.ring[disc_.after(i)]};
  }
  bool has_vertex(Index f, Index v) const
  {
    const auto corner = vertices_of(f);
    return corner[0] == v || corner[1] == v || corner[2] == v;
  }
  template <class Visit>
  void for_each_face_at(Index u, Visit visit) const
  {
    disc_.for_each_new_face([&](Index i) {
      const bool at_u = disc_.apex == u || disc_.ring[i] == u || disc_.ring[disc_.after(i)] == u;
      if (at_u && !mesh_.is_ghost_face(disc_.face[i])) visit(disc_.face[i]);
    });
    mesh_.for_each_outgoing(u, [&](Index h) {
      const Index f = mesh_.face(h);
      if (!mesh_.is_ghost_face(f) && disc_.position_of_old_face(f) == none) visit(f);
    });
  }
  Index face_of(Index u, Index v, Index w) const
  {
    Index found = none;
    for_each_face_at(u, [&](Index f) {
      if (found == none && has_vertex(f, v) && has_vertex(f, w) && admits(f)) found = f;
    });
    return found;
  }

private:
  const Working_mesh& mesh_;
  const Disc& disc_;
  Vector normal_ = Vector::Zero();
  double cosine_ = -1;
};

inline bool Direct_bound::extends_over_faces()
{
  seen_faces_.clear();
  for (const Routed_edge& routed : edges_)
    for (const Index f : reference_.faces_of_edge(routed.edge))
      if (f != none && seen_faces_.insert_if_new(f, 0) && !extends_over(f)) return false;
  return true;
}

/// Whether there is anything to cut: not so where all corners lie in one face, and every face will
/// do.
inline bool Direct_bound::collect_items(Index face)
{
  const auto& edges = reference_.edges_of_face(face);
  const auto corners = reference_.vertices_of_face(face);
  items_.clear();
  for (int i = 0; i < 3; ++i) {
    items_.push_back(item_at_vertex(corners[i]));
    append_nodes(edges[i], reference_.vertices_of_edge(edges[i])[0] == corners[i]);
  }
  return bounds_normals() || items_.size() > 3 || !(items_[0].element == items_[1].element)
      || !(items_[0].element == items_[2].element);
}

inline After_disc Direct_bound::after_disc(Index face) const
{
  if (!bounds_normals()) return After_disc(mesh_, *disc_);
  return After_disc(mesh_, *disc_, reference_.normal_of_face(face), normal_cosine_);
}

inline bool Direct_bound::extends_over(Index face)
{
  if (!collect_items(face) || cells_.triangulates(items_, after_disc(face))) return true;
  const auto inner = inner_item(face);
  return inner && inner->squared_distance <= limit_at(*inner);
}

/// The inner item of a triangle whose items triangulates() could not cut.
inline std::optional<Inner_item> Direct_bound::inner_item(Index face)
{
  const Index vertex = Cell_search::winding_vertex(items_, after_disc(face));
  if (vertex == none || mesh_.is_ghost_vertex(vertex)) return std::nullopt;
  const auto corner = reference_.sorted_vertices_of_face(face);
  const Vector& a = reference_.point(corner[0]);
  const Vector ab = reference_.point(corner[1]) - a, ac = reference_.point(corner[2]) - a;
  const Triangle_weights weights = closest_weights(point(vertex), a, ab, ac);
  const double squared = (point(vertex) - a - weights.v * ab - weights.w * ac).squaredNorm();
  return Inner_item{face, vertex, weights, squared};
}

inline double Direct_bound::limit_at(const Inner_item& inner) const
{
  const auto corner = reference_.sorted_vertices_of_face(inner.face);
  return tolerance_.squared_limit(
      corner[0], corner[1], corner[2], inner.weights.v, inner.weights.w);
}

inline void Direct_bound::append_nodes(Index e, bool forward)
{
  const std::size_t before = items_.size();
  const Index slot = slot_of_edge(e);
  if (slot != none) {
    for (Index i = edges_[slot].first; i < edges_[slot].last; ++i)
      items_.push_back(item_on_edge(nodes_[i].m_edge));
  } else {
    for (Index n = map_.first_node_of_t(e); n != none; n = map_.node(n).next_on_t)
      items_.push_back(item_on_edge(map_.node(n).m_edge));
  }
  if (!forward) std::reverse(items_.begin() + static_cast<std::ptrdiff_t>(before), items_.end());
}

inline Item Direct_bound::item_at_vertex(Index v) const
{
  const Element element = image(v);
  if (element.kind() == Element::Kind::vertex) return {element, {none, none}};
  if (element.kind() == Element::Kind::face) return {element, {element.id(), none}};
  return item_on_edge(element.id());
}

inline Item Direct_bound::item_on_edge(Index m_edge) const
{
  const Disc_edges::Role& role = disc_edges_[m_edge];
  const Index h = mesh_.halfedge(m_edge);
  Item item{Element(Element::Kind::edge, m_edge), {mesh_.face(h), mesh_.face(mesh_.opposite(h))}};
  if (role.new_spoke != none) {
    item.face[0] = disc_->face[disc_->before(role.new_spoke)];
    item.face[1] = disc_->face[role.new_spoke];
  } else if (role.link != none) {
    item.face[disc_->inner[role.link] - h] = disc_->face[disc_->fan_face_at_link(role.link)];
  }
  for (Index& f : item.face)
    if (f != none && mesh_.is_ghost_face(f)) f = none;
  return item;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_CELLS_H
