// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the direct bound measures: forecasts, ratios to the tolerance, b(K) of each face.
#ifndef SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_MEASURES_H
#define SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_MEASURES_H

namespace surety::internal {

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
  // Only vertices of curves stay pinned when they move.
  return ratio(
      (reference_.point(v) - mesh_.point(m_vertex)).squaredNorm(),
      tolerance_.squared_limit_on_curve(v));
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
    largest = std::max(largest, ratio(squared, tolerance_.squared_limit_on_curve(v)));
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

#endif // SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_MEASURES_H
