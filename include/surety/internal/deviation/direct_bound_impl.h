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

inline Verdict Direct_bound::check(const Disc& disc)
{
  forget_disc();
  disc_ = &disc;
  squared_growth_needed_ = 1;
  if (!apex_is_in_range() || !move_vertices()) return Verdict::deviation;
  disc_edges_.assign(disc);
  gather_edges();
  const Verdict verdict = route_edges();
  if (verdict != Verdict::accept) return verdict;
  return extends_over_faces() ? Verdict::accept : Verdict::correspondence;
}

inline Direct_bound::Side Direct_bound::faces_at_spoke(Index spoke) const
{
  if (disc_->is_closed()) return {disc_->before(spoke), 2};
  const Index low = std::max(spoke == 0 ? 0 : spoke - 1, disc_->first);
  return {low, std::min(spoke, disc_->last) + 1 - low};
}

inline double Direct_bound::nearest_face(
    const Disc& disc, const Vector& p, Side side, Index& face) const
{
  const Vector& apex = disc.apex_point;
  double best = std::numeric_limits<double>::infinity();
  Index i = side.low;
  Vector ab = mesh_.point(disc.ring[i]) - apex;
  for (Index left = side.count; left > 0; --left) {
    const Index next = disc.after(i);
    const Vector ac = mesh_.point(disc.ring[next]) - apex;
    const double squared = squared_distance_to_triangle(p, apex, ab, ac);
    if (squared < best) best = squared, face = i;
    ab = ac;
    i = next;
  }
  return best;
}

inline bool Direct_bound::is_blocked(const Disc& disc)
{
  if (disc.removed == none) return false;
  const Index v = blocker_[disc.removed];
  if (v == none || map_.image(v).kind() != Element::Kind::face) return false;
  const Index i = disc.position_of_old_face(map_.image(v).id());
  if (i == none) return false;
  Index face = none;
  return !is_within(
      nearest_face(disc, reference_.point(v), disc.side_of_place(disc.old_place[i]), face),
      tolerance_.squared_limit(v));
}

/// Whether a placed apex lies where rounding is accounted for, and near enough to its pin.
inline bool Direct_bound::apex_is_in_range() const
{
  if (!disc_->is_closed()) return true;
  const double farthest = largest_coordinate(reference_, tolerance_.largest());
  if (!(disc_->apex_point.cwiseAbs().maxCoeff() <= farthest)) return false;
  if (!disc_->keeps_pin) return true;
  const Index v = map_.pin(disc_->apex);
  return (reference_.point(v) - disc_->apex_point).squaredNorm() <= tolerance_.squared_limit(v);
}

inline bool Direct_bound::move_to_faces(Index v, Side side)
{
  Index face = none;
  if (!is_within(
          nearest_face(*disc_, reference_.point(v), side, face), tolerance_.squared_limit(v))) {
    if (disc_->removed != none) blocker_[disc_->removed] = v;
    return false;
  }
  slot_of_vertex_.insert(v, static_cast<Index>(vertices_.size()));
  vertices_.push_back({v, Element(Element::Kind::face, disc_->face[face]), face, 1});
  return true;
}

inline bool Direct_bound::move_to_ridge(Index v, Index spoke)
{
  const Vector along = mesh_.point(disc_->ring[spoke]) - disc_->apex_point;
  if (!is_within(
          squared_distance_to_segment(reference_.point(v), disc_->apex_point, along),
          tolerance_.squared_limit(v)))
    return false;
  const Side at_spoke = faces_at_spoke(spoke);
  slot_of_vertex_.insert(v, static_cast<Index>(vertices_.size()));
  vertices_.push_back(
      {v, Element(Element::Kind::edge, disc_->spoke[spoke]), at_spoke.low, at_spoke.count});
  return true;
}

/// The vertices on a ridge through the disc stay on it: each new ridge edge takes over old ones,
/// and the vertex that went to P goes to the one that takes over PQ.
inline bool Direct_bound::move_vertices_to_ridges()
{
  const Disc& disc = *disc_;
  bool admissible = true;
  for (int k = 0; k < 2 && disc.ridge[k] != none; ++k)
    for (const Index old : disc.old_ridge[k]) {
      if (old == none) continue;
      map_.for_each_vertex_on_edge(
          old, [&](Index v) { admissible = admissible && move_to_ridge(v, disc.ridge[k]); });
      if (admissible && disc.removed != none && old == mesh_.edge(disc.halfedge))
        admissible = move_to_ridge(map_.pin(disc.removed), disc.ridge[k]);
    }
  return admissible;
}

inline bool Direct_bound::move_vertices()
{
  const Disc& disc = *disc_;
  bool admissible = move_vertices_to_ridges();
  const auto release = [&](Index m_vertex) {
    const Index v = map_.pin(m_vertex);
    if (admissible && v != none) admissible = move_to_faces(v, disc.side_of_place(0));
  };
  if (disc.removed != none && disc.ridge[0] == none) release(disc.removed);
  if (disc.is_closed() && !disc.keeps_pin) release(disc.apex);
  for (Index i = 0; admissible && i < disc.old_face.size(); ++i) {
    if (mesh_.is_ghost_face(disc.old_face[i])) continue;
    const Side side = disc.side_of_place(disc.old_place[i]);
    map_.for_each_vertex_on_face(
        disc.old_face[i], [&](Index v) { admissible = admissible && move_to_faces(v, side); });
  }
  return admissible;
}

/// An edge without crossings whose ends go to one face stays what it is, and so does a triangle of
/// such edges: with few faces left in M these are most.
inline void Direct_bound::gather_edges()
{
  for (const Moved_vertex& moved : vertices_)
    for (const Index e : reference_.edges_at(moved.vertex))
      if (bounds_normals() || map_.first_node_of_t(e) != none
          || !(image(reference_.other_end(e, moved.vertex)) == moved.image))
        gather_edge(e);
  for (const Index spoke : disc_->old_spoke)
    map_.for_each_node_on_m(spoke, [&](Index n) { gather_edge(map_.node(n).t_edge); });
  if (disc_->kind == Disc::Kind::flip) gather_edges_of_flip();
  // Faces about a pin that stays turn with it, and T triangles at it have cells in them.
  if (bounds_normals() && disc_->is_closed() && disc_->keeps_pin)
    for (const Index e : reference_.edges_at(map_.pin(disc_->apex))) gather_edge(e);
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
  const Index a = map_.pin(disc_->ring[1]), b = map_.pin(disc_->ring[3]);
  if (a == none || b == none) return;
  for (const Index e : reference_.edges_at(a))
    if (reference_.other_end(e, a) == b) gather_edge(e);
}

inline bool Direct_bound::stop_at_vertex(Index v, float lambda, Stop& stop) const
{
  const Index slot = slot_of_vertex(v);
  if (slot != none) {
    stop = {vertices_[slot].low, vertices_[slot].count, lambda};
    return true;
  }
  const Element element = map_.image(v);
  if (element.kind() == Element::Kind::vertex) {
    if (element.id() == disc_->apex) {
      if (disc_->is_closed())
        stop = {0, disc_->size(), lambda};
      else
        stop = {disc_->first, disc_->last + 1 - disc_->first, lambda};
      return true;
    }
    const Index j = disc_->position_in_ring(element.id());
    if (j == none) return false;
    const Side at_spoke = faces_at_spoke(j);
    stop = {at_spoke.low, at_spoke.count, lambda};
    return true;
  }
  if (element.kind() == Element::Kind::face) return false;
  return stop_at_node({none, element.id(), lambda}, stop);
}

inline bool Direct_bound::stop_at_node(const Pending_node& node, Stop& stop) const
{
  const Index i = disc_edges_[node.m_edge].link;
  if (i == none) return false;
  stop = {disc_->fan_face_at_link(i), 1, node.lambda};
  return true;
}

inline Verdict Direct_bound::route_edges()
{
  if (disc_->is_closed()) {
    fan_normal_ = Vector::Zero();
    disc_->for_each_new_face([&](Index i) {
      if (mesh_.is_ghost_face(disc_->face[i])) return;
      const Vector a = mesh_.point(disc_->ring[i]) - disc_->apex_point;
      fan_normal_ += a.cross(mesh_.point(disc_->ring[disc_->after(i)]) - disc_->apex_point);
    });
  }
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
  const auto join = [&](Index next, float lambda_of_next) {
    if (!through_disc && (disc_->kind != Disc::Kind::flip || !runs_inside(e, previous, next)))
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
    if (disc_edges_[node.m_edge].is_old_spoke) {
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
      const Index i = disc_edges_[element.id()].link;
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
  return disc_->is_closed() ? connect_in_closed_fan(e, from, to) : connect_in_open_fan(e, from, to);
}

inline Verdict Direct_bound::connect_in_open_fan(Index e, const Stop& from, const Stop& to)
{
  if (from.low + from.count <= to.low) return cross_all(e, from, to, true);
  if (to.low + to.count <= from.low) return cross_all(e, from, to, false);
  return Verdict::accept;
}

/// There are two ways round the apex. The one on which the T edge passes it is tried first.
inline Verdict Direct_bound::connect_in_closed_fan(Index e, const Stop& from, const Stop& to)
{
  const Index n = disc_->size();
  const auto holds
      = [n](const Stop& stop, Index face) { return (face + n - stop.low) % n < stop.count; };
  if (holds(from, to.low) || holds(to, from.low)) return Verdict::accept;
  const bool counter_clockwise = passes_apex_on_left(e, from.lambda, to.lambda);
  const std::size_t before = nodes_.size();
  const Verdict verdict = cross_all(e, from, to, counter_clockwise);
  if (verdict == Verdict::accept) return verdict;
  nodes_.resize(before);
  const double needed = squared_growth_needed_;
  const Verdict other = cross_all(e, from, to, !counter_clockwise);
  squared_growth_needed_ = std::min(needed, squared_growth_needed_);
  return other;
}

inline bool Direct_bound::passes_apex_on_left(Index e, double from, double to) const
{
  const Vector a = point_on_edge(e, from) - disc_->apex_point;
  const Vector b = point_on_edge(e, to) - disc_->apex_point;
  return a.cross(b).dot(fan_normal_) > 0;
}

/// Crosses the spokes between two places, from face to face in one sense of rotation.
inline Verdict Direct_bound::cross_all(
    Index e, const Stop& from, const Stop& to, bool counter_clockwise)
{
  const Index n = disc_->size();
  double lambda = from.lambda;
  Index spoke = counter_clockwise ? (from.low + from.count) % n : from.low;
  const Index last = counter_clockwise ? to.low : (to.low + to.count) % n;
  for (;;) {
    const Verdict verdict = cross(e, spoke, lambda, to.lambda);
    if (verdict != Verdict::accept || spoke == last) return verdict;
    lambda = nodes_.back().lambda;
    spoke = counter_clockwise ? disc_->after(spoke) : disc_->before(spoke);
  }
}

inline Verdict Direct_bound::cross(Index e, Index spoke, double low, double high)
{
  if (disc_->is_ridge_spoke(spoke) || mesh_.is_ghost_vertex(disc_->ring[spoke]))
    return Verdict::correspondence;
  const auto [s, t] = reference_.vertices_of_edge(e);
  const Vector& a = reference_.point(s);
  const Vector d = reference_.point(t) - a;
  const Vector& apex = disc_->apex_point;
  const Vector along = mesh_.point(disc_->ring[spoke]) - apex;
  // Between low and high, which are floats, whichever way it is rounded.
  const auto lambda = static_cast<float>(closest_parameter(a, d, low, high, apex, along));
  if (!is_within(
          squared_distance_to_segment(a + lambda * d, apex, along),
          tolerance_.squared_limit(s, t, lambda)))
    return Verdict::deviation;
  nodes_.push_back({none, disc_->spoke[spoke], lambda});
  return Verdict::accept;
}

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

inline void Direct_bound::commit(const Disc& disc)
{
  for (const Index f : disc.old_face)
    if (!mesh_.is_ghost_face(f)) map_.clear_face(f);
  for (int k = 0; k < 2 && disc.ridge[k] != none; ++k)
    for (const Index old : disc.old_ridge[k])
      if (old != none) map_.clear_edge(old);
  if (disc.removed != none) map_.clear_pin(disc.removed);
  if (!disc.keeps_pin) map_.clear_pin(disc.apex);
  for (const Moved_vertex& moved : vertices_) map_.assign(moved.vertex, moved.image);
  if (journal_.is_recording())
    for (const Routed_edge& routed : edges_) touched_edges_.push_back(routed.edge);

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
  const double negligible = tolerance_.squared_limit_of_largest() / 256;
  Forecast result{negligible, negligible};
  Index face = none;
  for (Index i = 0; i < disc.old_face.size(); ++i) {
    const Index f = disc.old_face[i];
    if (mesh_.is_ghost_face(f)) continue;
    const Side side = disc.side_of_place(disc.old_place[i]);
    const auto corner = mesh_.vertices_of(f);
    const Vector& a = mesh_.point(corner[0]);
    const Vector ab = mesh_.point(corner[1]) - a, ac = mesh_.point(corner[2]) - a;
    map_.for_each_vertex_on_face(f, [&](Index v) {
      const Vector& p = reference_.point(v);
      result.before = std::max(result.before, squared_distance_to_triangle(p, a, ab, ac));
      result.after = std::max(result.after, nearest_face(disc, p, side, face));
    });
  }
  for (const Index spoke : disc.old_spoke)
    map_.for_each_node_on_m(spoke, [&](Index n) {
      const Vector p = point_on_edge(map_.node(n).t_edge, map_.node(n).lambda);
      result.before = std::max(result.before, squared_distance_to_m_edge(p, spoke));
      const Side all
          = disc.is_closed() ? Side{0, disc.size()} : Side{disc.first, disc.last + 1 - disc.first};
      result.after = std::max(result.after, nearest_face(disc, p, all, face));
    });
  return result;
}

inline double Direct_bound::largest_ratio_at_vertex(Index m_vertex) const
{
  const Index v = map_.pin(m_vertex);
  if (v == none) return 0;
  return ratio(
      (reference_.point(v) - mesh_.point(m_vertex)).squaredNorm(), tolerance_.squared_limit(v));
}

inline double Direct_bound::largest_ratio_on_face(Index m_face) const
{
  double largest = 0;
  map_.for_each_vertex_on_face(m_face, [&](Index v) {
    const double squared = squared_distance_to_m_face(reference_.point(v), m_face);
    largest = std::max(largest, ratio(squared, tolerance_.squared_limit(v)));
  });
  return largest;
}

inline double Direct_bound::largest_ratio_on_edge(Index m_edge) const
{
  double largest = 0;
  map_.for_each_vertex_on_edge(m_edge, [&](Index v) {
    const double squared = squared_distance_to_m_edge(reference_.point(v), m_edge);
    largest = std::max(largest, ratio(squared, tolerance_.squared_limit(v)));
  });
  map_.for_each_node_on_m(m_edge, [&](Index n) {
    const Node& node = map_.node(n);
    const double squared
        = squared_distance_to_m_edge(point_on_edge(node.t_edge, node.lambda), m_edge);
    largest = std::max(largest, ratio(squared, limit_on_edge(node.t_edge, node.lambda)));
  });
  return largest;
}

inline double Direct_bound::largest_inner_ratio_of_transaction()
{
  forget_disc();
  double largest = 0;
  for (const Index e : touched_edges_)
    for (const Index f : reference_.faces_of_edge(e)) {
      if (f == none || !collect_items(f) || cells_.triangulates(items_, after_disc(f))) continue;
      const auto inner = inner_item(f);
      if (!inner) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, ratio(inner->squared_distance, limit_at(*inner)));
    }
  return largest;
}

inline std::vector<Inner_item> Direct_bound::inner_items()
{
  forget_disc();
  std::vector<Inner_item> result;
  for (Index f = 0; f < reference_.number_of_faces(); ++f) {
    if (!collect_items(f) || cells_.triangulates(items_, after_disc(f))) continue;
    if (const auto inner = inner_item(f)) result.push_back(*inner);
  }
  return result;
}

inline std::vector<double> Direct_bound::face_bounds()
{
  std::vector<double> squared(mesh_.number_of_real_faces(), -1);
  const auto raise = [&](Index f, double value) {
    if (!mesh_.is_ghost_face(f)) squared[f] = std::max(squared[f], value);
  };
  const auto raise_edge = [&](const Vector& p, Index e) {
    const double value = squared_distance_to_m_edge(p, e);
    raise(mesh_.face(mesh_.halfedge(e)), value);
    raise(mesh_.face(mesh_.opposite(mesh_.halfedge(e))), value);
  };
  const auto raise_star = [&](Index m_vertex, double value) {
    mesh_.for_each_outgoing(m_vertex, [&](Index h) { raise(mesh_.face(h), value); });
  };
  for (Index v = 0; v < reference_.number_of_vertices(); ++v) {
    const Element element = map_.image(v);
    const Vector& p = reference_.point(v);
    if (element.kind() == Element::Kind::edge)
      raise_edge(p, element.id());
    else if (element.kind() == Element::Kind::face)
      raise(element.id(), squared_distance_to_m_face(p, element.id()));
    else if (p != mesh_.point(element.id()))
      raise_star(element.id(), (p - mesh_.point(element.id())).squaredNorm());
  }
  for (Index e = 0; e < reference_.number_of_edges(); ++e)
    for (Index n = map_.first_node_of_t(e); n != none; n = map_.node(n).next_on_t)
      raise_edge(point_on_edge(e, map_.node(n).lambda), map_.node(n).m_edge);
  for (const Inner_item& inner : inner_items()) raise_star(inner.m_vertex, inner.squared_distance);
  double largest_coordinate = reference_.largest_coordinate();
  for (Index v = 0; v < mesh_.number_of_real_vertices(); ++v)
    if (mesh_.is_live_vertex(v))
      largest_coordinate = std::max(largest_coordinate, mesh_.point(v).cwiseAbs().maxCoeff());
  const Rounding rounding(largest_coordinate);
  // A face that only pinned vertices map to coincides with T.
  for (double& value : squared) value = value < 0 ? 0 : rounding.upper_bound(value);
  return squared;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_IMPL_H
