// SPDX-License-Identifier: GPL-3.0-or-later
//
// The direct bound, step 2: the T edges that meet the disc, and their crossings of its new spokes.
#ifndef SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_ROUTES_H
#define SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_ROUTES_H

namespace surety::internal {

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
  gather_winding_edges();
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

/// The T triangle that winds about a vertex W of M without a preimage meets every spoke of W: it
/// crosses the spoke, or has a corner that is pinned to its other end. Where such a vertex stays in
/// a disc and one of its spokes is changed, the triangle must be looked at again.
inline void Direct_bound::gather_winding_edges()
{
  const auto gather_at = [&](Index w, Index end, Index spoke) {
    if (map_.pin(w) != none || map_.first_node_of_m(spoke) != none || map_.pin(end) == none) return;
    for (const Index e : reference_.edges_at(map_.pin(end))) gather_edge(e);
  };
  if (disc_->kind == Disc::Kind::flip) {
    gather_at(disc_->ring[1], disc_->ring[3], disc_->old_spoke[0]);
    gather_at(disc_->ring[3], disc_->ring[1], disc_->old_spoke[0]);
  }
  if (disc_->kind == Disc::Kind::relocation && !mesh_.is_ghost_vertex(disc_->ring[0]))
    gather_at(disc_->apex, disc_->ring[0], disc_->old_spoke[0]);
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

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_ROUTES_H
