// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps of the direct bound: move the vertices, route the edges, extend over the faces, commit.
#ifndef SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_IMPL_H
#define SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_IMPL_H

namespace surety::internal {

/// The faces of M as they are once the disc is retriangulated.
class After_disc
{
public:
  After_disc(const Working_mesh& mesh, const Disc& disc) : mesh_(mesh), disc_(disc) {}

  bool has_vertex(Index f, Index v) const
  {
    const Index i = disc_.position_of_new_face(f);
    if (i == none) return mesh_.has_vertex(f, v);
    return v == disc_.apex() || v == disc_.ring[i] || v == disc_.ring[i + 1];
  }

  Index face_of(Index u, Index v, Index w) const
  {
    for (Index i = disc_.first; i <= disc_.last; ++i)
      if (has_vertex(disc_.face[i], u) && has_vertex(disc_.face[i], v)
          && has_vertex(disc_.face[i], w))
        return disc_.face[i];
    Index found = none;
    mesh_.for_each_outgoing(u, [&](Index h) {
      const Index f = mesh_.face(h);
      if (disc_.position_of_old_face(f) == none && mesh_.has_vertex(f, v) && mesh_.has_vertex(f, w))
        found = f;
    });
    return found;
  }

private:
  const Working_mesh& mesh_;
  const Disc& disc_;
};

inline std::array<Index, 2> Direct_bound::side_of_old_face(Index i) const
{
  if (disc_->ridge == 0) return {disc_->first, disc_->last};
  if (i < disc_->ridge) return {disc_->first, disc_->ridge - 1};
  return {disc_->ridge, disc_->last};
}

inline double Direct_bound::nearest_face(
    const Disc& disc, const Vector& p, Index low, Index high, Index& face) const
{
  const Vector& apex = point(disc.apex());
  double best = std::numeric_limits<double>::infinity();
  Vector ab = point(disc.ring[low]) - apex;
  for (Index i = low; i <= high; ++i) {
    const Vector ac = point(disc.ring[i + 1]) - apex;
    const double squared = squared_distance_to_triangle(p, apex, ab, ac);
    if (squared < best) best = squared, face = i;
    ab = ac;
  }
  return best;
}

inline bool Direct_bound::is_blocked() const
{
  if (disc_->removed == none) return false;
  const Index v = blocker_[disc_->removed];
  if (v == none || map_.image(v).kind() != Element::Kind::face) return false;
  const Index i = disc_->position_of_old_face(map_.image(v).id());
  if (i == none) return false;
  const auto [low, high] = side_of_old_face(i);
  Index face = none;
  return !(nearest_face(*disc_, reference_.point(v), low, high, face) <= squared_limit_);
}

inline bool Direct_bound::move_to_faces(Index v, Index low, Index high)
{
  Index face = none;
  if (!(nearest_face(*disc_, reference_.point(v), low, high, face) <= squared_limit_)) {
    if (disc_->removed != none) blocker_[disc_->removed] = v;
    return false;
  }
  slot_of_vertex_[v] = static_cast<Index>(vertices_.size());
  vertices_.push_back({v, Element(Element::Kind::face, disc_->face[face]), face, face});
  return true;
}

inline bool Direct_bound::move_to_ridge(Index v)
{
  const Index m = disc_->ridge;
  const Vector& apex = point(disc_->apex());
  if (!(squared_distance_to_segment(reference_.point(v), apex, point(disc_->ring[m]) - apex)
        <= squared_limit_))
    return false;
  slot_of_vertex_[v] = static_cast<Index>(vertices_.size());
  vertices_.push_back(
      {v, Element(Element::Kind::edge, disc_->spoke[m]), std::max(m - 1, disc_->first),
       std::min(m, disc_->last)});
  return true;
}

inline bool Direct_bound::move_vertices()
{
  const Disc& disc = *disc_;
  bool admissible = true;
  const auto move_along_ridge = [&](Index v) { admissible = admissible && move_to_ridge(v); };
  if (disc.removed != none) {
    if (disc.ridge != 0) {
      move_along_ridge(disc.removed);
      map_.for_each_vertex_on_edge(disc.old_spoke[0], move_along_ridge);
      map_.for_each_vertex_on_edge(disc.old_spoke[disc.ridge], move_along_ridge);
    } else {
      admissible = move_to_faces(disc.removed, disc.first, disc.last);
    }
  }
  for (Index i = 0; admissible && i < disc.old_face.size(); ++i) {
    if (mesh_.is_ghost_face(disc.old_face[i])) continue;
    const auto [low, high] = side_of_old_face(i);
    map_.for_each_vertex_on_face(disc.old_face[i], [&, low = low, high = high](Index v) {
      admissible = admissible && move_to_faces(v, low, high);
    });
  }
  return admissible;
}

inline void Direct_bound::gather_edges()
{
  for (const Moved_vertex& moved : vertices_)
    for (const Index e : reference_.edges_at(moved.vertex)) gather_edge(e);
  for (const Index spoke : disc_->old_spoke)
    map_.for_each_node_on_m(spoke, [&](Index n) { gather_edge(map_.node(n).t_edge); });
  if (disc_->removed == none) gather_edges_of_flip();
}

// Each face of a flip has two link edges: a T edge may run through a face from one to the other
// without a crossing of the old diagonal, or along the diagonal without any crossing.
inline void Direct_bound::gather_edges_of_flip()
{
  for (const Index link : disc_->link) {
    map_.for_each_node_on_m(link, [&](Index n) { gather_edge(map_.node(n).t_edge); });
    map_.for_each_vertex_on_edge(link, [&](Index v) {
      for (const Index e : reference_.edges_at(v)) gather_edge(e);
    });
  }
  const Index a = disc_->ring[1], b = disc_->ring[3];
  if (!map_.image(a).is(Element::Kind::vertex, a)) return;
  for (const Index e : reference_.edges_at(a))
    if (reference_.other_end(e, a) == b) gather_edge(e);
}

inline bool Direct_bound::stop_at_vertex(Index v, double lambda, Stop& stop) const
{
  const Index slot = slot_of_vertex(v);
  if (slot != none) {
    stop = {vertices_[slot].low, vertices_[slot].high, lambda};
    return true;
  }
  const Element element = map_.image(v);
  if (element.kind() == Element::Kind::vertex) {
    const Index j = disc_->position_in_ring(element.id());
    if (j == none) return false;
    stop = j == 0 ? Stop{disc_->first, disc_->last, lambda}
                  : Stop{std::max(j - 1, disc_->first), std::min(j, disc_->last), lambda};
    return true;
  }
  if (element.kind() == Element::Kind::face) return false;
  return stop_at_node({none, element.id(), lambda}, stop);
}

inline bool Direct_bound::stop_at_node(const Pending_node& node, Stop& stop) const
{
  const Index i = disc_->position_in_link(node.m_edge);
  if (i == none) return false;
  const Index face = disc_->fan_face_at_link(i);
  stop = {face, face, node.lambda};
  return true;
}

inline Verdict Direct_bound::route_edges()
{
  for (Index slot = 0; slot < edges_.size(); ++slot) {
    edges_[slot].first = static_cast<Index>(nodes_.size());
    const Verdict verdict = route(edges_[slot].edge);
    if (verdict != Verdict::accept) return verdict;
    edges_[slot].last = static_cast<Index>(nodes_.size());
  }
  return Verdict::accept;
}

/// Walks along T edge e, drops its nodes on old spokes, and joins what remains across the new ones
/// wherever it ran through the disc.
inline Verdict Direct_bound::route(Index e)
{
  const auto [s, t] = reference_.vertices_of_edge(e);
  bool through_disc = slot_of_vertex(s) != none;
  Index previous = none; // the node before, none: vertex s
  const auto join = [&](Index next, double lambda_of_next) {
    if (!through_disc && (disc_->removed != none || !runs_inside(e, previous, next)))
      return Verdict::accept;
    Stop from, to;
    const bool known
        = (previous == none
               ? stop_at_vertex(s, 0, from)
               : stop_at_node(
                   {previous, map_.node(previous).m_edge, map_.node(previous).lambda}, from))
        && (next == none ? stop_at_vertex(t, 1, to)
                         : stop_at_node({next, map_.node(next).m_edge, lambda_of_next}, to));
    return known ? connect(e, from, to) : Verdict::correspondence;
  };

  const std::size_t first = nodes_.size();
  for (Index n = map_.first_node_of_t(e); n != none; n = map_.node(n).next_on_t) {
    const Node& node = map_.node(n);
    if (disc_->position_of_old_spoke(node.m_edge) != none) {
      through_disc = true;
      continue;
    }
    const Verdict verdict = join(n, node.lambda);
    if (verdict != Verdict::accept) return verdict;
    // Two successive crossings of one edge are none.
    if (nodes_.size() > first && nodes_.back().m_edge == node.m_edge)
      nodes_.pop_back();
    else
      nodes_.push_back({n, node.m_edge, node.lambda});
    previous = n;
    through_disc = false;
  }
  through_disc = through_disc || slot_of_vertex(t) != none;
  return join(none, 1);
}

/// For a flip: whether the stretch between two successive places of T edge e, neither on the old
/// diagonal nor on a moved vertex, lies inside one of the two faces rather than on their link.
inline bool Direct_bound::runs_inside(Index e, Index previous, Index next) const
{
  const auto [s, t] = reference_.vertices_of_edge(e);
  const auto places = [&](Index node, Index end) {
    // Bit i: on link edge i (closed).
    const Element element
        = node != none ? Element(Element::Kind::edge, map_.node(node).m_edge) : map_.image(end);
    unsigned links = 0;
    if (element.kind() == Element::Kind::vertex) {
      const Index j = disc_->position_in_ring(element.id());
      if (j != none) links = 1u << j | 1u << (j + 3) % 4;
    } else if (element.kind() == Element::Kind::edge) {
      const Index i = disc_->position_in_link(element.id());
      if (i != none) links = 1u << i;
    }
    return links;
  };
  const unsigned a = places(previous, s), b = places(next, t);
  if (a == 0 || b == 0 || (a & b) != 0) return false;
  // The old faces are (a, b, c) with link edges 0 and 3, and (b, a, d) with 1 and 2.
  constexpr unsigned left = 1u << 0 | 1u << 3, right = 1u << 1 | 1u << 2;
  return ((a & left) != 0 && (b & left) != 0) || ((a & right) != 0 && (b & right) != 0);
}

inline Verdict Direct_bound::connect(Index e, const Stop& from, const Stop& to)
{
  double lambda = from.lambda;
  const auto step = [&](Index spoke) {
    if (spoke == disc_->ridge) return Verdict::correspondence;
    if (!cross(e, spoke, lambda, to.lambda)) return Verdict::deviation;
    lambda = nodes_.back().lambda;
    return Verdict::accept;
  };
  for (Index spoke = from.high + 1; from.high < to.low && spoke <= to.low; ++spoke) {
    const Verdict verdict = step(spoke);
    if (verdict != Verdict::accept) return verdict;
  }
  for (Index spoke = from.low; to.high < from.low && spoke > to.high; --spoke) {
    const Verdict verdict = step(spoke);
    if (verdict != Verdict::accept) return verdict;
  }
  return Verdict::accept;
}

inline bool Direct_bound::cross(Index e, Index spoke, double low, double high)
{
  const auto [s, t] = reference_.vertices_of_edge(e);
  const Vector& a = reference_.point(s);
  const Vector d = reference_.point(t) - a;
  const Vector& apex = point(disc_->apex());
  const Vector along = point(disc_->ring[spoke]) - apex;
  const double lambda = closest_parameter(a, d, low, high, apex, along);
  if (!(squared_distance_to_segment(a + lambda * d, apex, along) <= squared_limit_)) return false;
  nodes_.push_back({none, disc_->spoke[spoke], lambda});
  return true;
}

inline bool Direct_bound::extends_over_faces()
{
  for (Index slot = 0; slot < edges_.size(); ++slot)
    for (const Index f : reference_.faces_of_edge(edges_[slot].edge)) {
      if (f == none) continue;
      // Each face once, from the first of its routed edges.
      bool first = true;
      for (const Index e : reference_.edges_of_face(f)) first = first && slot_of_edge(e) >= slot;
      if (first && !extends_over(f)) return false;
    }
  return true;
}

inline bool Direct_bound::extends_over(Index face)
{
  const auto& edges = reference_.edges_of_face(face);
  const auto corners = reference_.vertices_of_face(face);
  items_.clear();
  for (int i = 0; i < 3; ++i) {
    items_.push_back(item_at_vertex(corners[i]));
    append_nodes(edges[i], reference_.vertices_of_edge(edges[i])[0] == corners[i]);
  }
  if (items_.size() == 3 && items_[0].element == items_[1].element
      && items_[0].element == items_[2].element)
    return true;
  return cells_.triangulates(items_, After_disc(mesh_, *disc_));
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
  Item item{Element(Element::Kind::edge, m_edge), {none, none}};
  const Index spoke = disc_->position_of_new_spoke(m_edge);
  if (spoke != none) {
    item.face[0] = disc_->face[spoke - 1];
    item.face[1] = disc_->face[spoke];
  } else {
    const Index link = disc_->position_in_link(m_edge);
    for (int side = 0; side < 2; ++side) {
      const Index f = mesh_.face(mesh_.halfedge(m_edge) + static_cast<Index>(side));
      const bool inner = link != none && disc_->position_of_old_face(f) != none;
      item.face[side] = inner ? disc_->face[disc_->fan_face_at_link(link)] : f;
    }
  }
  for (Index& f : item.face)
    if (f != none && mesh_.is_ghost_face(f)) f = none;
  return item;
}

inline void Direct_bound::commit(const Disc& disc)
{
  for (const Index f : disc.old_face)
    if (!mesh_.is_ghost_face(f)) map_.clear_face(f);
  if (disc.ridge != 0) {
    map_.clear_edge(disc.old_spoke[0]);
    map_.clear_edge(disc.old_spoke[disc.ridge]);
  }
  for (const Moved_vertex& moved : vertices_) map_.assign(moved.vertex, moved.image);

  for (const Routed_edge& routed : edges_) {
    // Kept nodes appear in both lists in the same order: what is missing from the new one goes.
    Index kept = routed.first;
    const auto next_kept = [&] {
      while (kept < routed.last && nodes_[kept].node == none) ++kept;
      return kept < routed.last ? nodes_[kept].node : none;
    };
    for (Index n = map_.first_node_of_t(routed.edge); n != none;) {
      const Index next = map_.node(n).next_on_t;
      if (next_kept() == n)
        ++kept;
      else
        map_.remove_node(n);
      n = next;
    }
    Index last = none;
    for (Index i = routed.first; i < routed.last; ++i) {
      Pending_node& node = nodes_[i];
      if (node.node == none) node.node = map_.add_node(routed.edge, node.m_edge, node.lambda);
      if (last == none)
        map_.set_first_node(routed.edge, node.node);
      else
        map_.set_next_node(last, node.node);
      last = node.node;
    }
    if (last == none)
      map_.set_first_node(routed.edge, none);
    else
      map_.set_next_node(last, none);
  }
}

/// Looks at the T vertices on the disc and at the nodes on its old spokes. What lies below a
/// sixteenth of the tolerance is all the same.
inline Deviation_policy::Forecast Direct_bound::forecast(const Disc& disc) const
{
  const double negligible = squared_limit_ / 256;
  Forecast result{negligible, negligible};
  Index face = none;
  for (const Index f : disc.old_face) {
    if (mesh_.is_ghost_face(f)) continue;
    const auto corner = mesh_.vertices_of(f);
    const Vector& a = point(corner[0]);
    const Vector ab = point(corner[1]) - a, ac = point(corner[2]) - a;
    map_.for_each_vertex_on_face(f, [&](Index v) {
      const Vector& p = reference_.point(v);
      result.before = std::max(result.before, squared_distance_to_triangle(p, a, ab, ac));
      result.after = std::max(result.after, nearest_face(disc, p, disc.first, disc.last, face));
    });
  }
  for (const Index spoke : disc.old_spoke) {
    const Index h = mesh_.halfedge(spoke);
    const Vector& a = point(mesh_.source(h));
    const Vector along = point(mesh_.target(h)) - a;
    map_.for_each_node_on_m(spoke, [&](Index n) {
      const auto [s, t] = reference_.vertices_of_edge(map_.node(n).t_edge);
      const Vector& x = reference_.point(s);
      const Vector p = x + map_.node(n).lambda * (reference_.point(t) - x);
      result.before = std::max(result.before, squared_distance_to_segment(p, a, along));
      result.after = std::max(result.after, nearest_face(disc, p, disc.first, disc.last, face));
    });
  }
  return result;
}

inline std::vector<double> Direct_bound::face_bounds() const
{
  std::vector<double> squared(mesh_.number_of_real_faces(), -1);
  const auto raise = [&](Index f, double value) {
    if (!mesh_.is_ghost_face(f)) squared[f] = std::max(squared[f], value);
  };
  const auto raise_edge = [&](const Vector& p, Index e) {
    const Index h = mesh_.halfedge(e);
    const Vector& a = point(mesh_.source(h));
    const double value = squared_distance_to_segment(p, a, point(mesh_.target(h)) - a);
    raise(mesh_.face(h), value);
    raise(mesh_.face(mesh_.opposite(h)), value);
  };
  for (Index v = 0; v < reference_.number_of_vertices(); ++v) {
    const Element element = map_.image(v);
    if (element.kind() == Element::Kind::edge) raise_edge(reference_.point(v), element.id());
    if (element.kind() != Element::Kind::face) continue;
    const auto corner = mesh_.vertices_of(element.id());
    const Vector& a = point(corner[0]);
    raise(
        element.id(),
        squared_distance_to_triangle(
            reference_.point(v), a, point(corner[1]) - a, point(corner[2]) - a));
  }
  for (Index e = 0; e < reference_.number_of_edges(); ++e) {
    const auto [s, t] = reference_.vertices_of_edge(e);
    const Vector& a = reference_.point(s);
    for (Index n = map_.first_node_of_t(e); n != none; n = map_.node(n).next_on_t)
      raise_edge(a + map_.node(n).lambda * (reference_.point(t) - a), map_.node(n).m_edge);
  }
  // A face that only pinned vertices map to coincides with T.
  for (double& value : squared) value = value < 0 ? 0 : rounding_.upper_bound(value);
  return squared;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_IMPL_H
