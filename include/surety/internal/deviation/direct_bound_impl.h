// SPDX-License-Identifier: GPL-3.0-or-later
//
// The direct bound: what happens in which order, step 1, the T vertices on the disc, and the
// commit.
#ifndef SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_IMPL_H
#define SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_IMPL_H

namespace surety::internal {

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
  const Index v = disc_->new_pin != none ? disc_->new_pin : map_.pin(disc_->apex);
  return (reference_.point(v) - disc_->apex_point).squaredNorm()
      <= tolerance_.squared_limit_on_curve(v);
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
          tolerance_.squared_limit_on_curve(v)))
    return false;
  const Side at_spoke = faces_at_spoke(spoke);
  slot_of_vertex_.insert(v, static_cast<Index>(vertices_.size()));
  vertices_.push_back(
      {v, Element(Element::Kind::edge, disc_->spoke[spoke]), at_spoke.low, at_spoke.count});
  return true;
}

/// Where the apex slides along a ridge: the vertices that it passes, and its pin before.
inline bool Direct_bound::slide_along_ridge()
{
  const Disc& disc = *disc_;
  const Index behind = disc.ridge[1 - disc.new_pin_side];
  for (const Index v : disc.passed)
    if (!move_to_ridge(v, behind)) return false;
  slot_of_vertex_.insert(disc.new_pin, static_cast<Index>(vertices_.size()));
  vertices_.push_back({disc.new_pin, Element(Element::Kind::vertex, disc.apex), 0, disc.size()});
  return true;
}

/// The vertices on a ridge through the disc stay on it: each new ridge edge takes over old ones,
/// and the vertex that went to P goes to the one that takes over PQ.
inline bool Direct_bound::move_vertices_to_ridges()
{
  const Disc& disc = *disc_;
  bool admissible = disc.new_pin == none || slide_along_ridge();
  for (int k = 0; k < 2 && disc.ridge[k] != none; ++k)
    for (const Index old : disc.old_ridge[k]) {
      if (old == none) continue;
      map_.for_each_vertex_on_edge(old, [&](Index v) {
        if (slot_of_vertex(v) != none) return; // slides
        admissible = admissible && move_to_ridge(v, disc.ridge[k]);
      });
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

inline void Direct_bound::commit(const Disc& disc)
{
  for (const Index f : disc.old_face)
    if (!mesh_.is_ghost_face(f)) map_.clear_face(f);
  for (int k = 0; k < 2 && disc.ridge[k] != none; ++k)
    for (const Index old : disc.old_ridge[k])
      if (old != none) map_.clear_edge(old);
  if (disc.removed != none) map_.clear_pin(disc.removed);
  if (!disc.keeps_pin || disc.new_pin != none) map_.clear_pin(disc.apex);
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

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_IMPL_H
