// SPDX-License-Identifier: GPL-3.0-or-later
//
// The direct bound: an operation is admissible when the map phi : T -> M can be redrawn on its disc
// with every node within the tolerance of its image.
//
// Invariants after every commit:
//   I1  consecutive nodes along a T edge share a closed face of M;
//   I2  every node lies within the tolerance of its image;
//   I3  the image of every T triangle's boundary extends over the triangle (cells.h);
//   I4  phi has degree one: it changes on the preimage of a disc only, and not on its boundary;
//   I5  a T ridge or border path between live vertices maps to the M edge that joins them.
// Hence every point of T has one of M within the tolerance (a cell maps linearly into one face, and
// the largest displacement is at a corner), and, phi being onto, every point of M one of T.
//
// A vertex of M may lie anywhere. One that was never moved is *pinned*: the T vertex that it was
// goes to it. A ridge vertex stays pinned when it moves, with an offset. About any other vertex W
// the boundary of one T triangle winds, and the point of the triangle that is closest to W goes to
// W: it is worked out anew whenever an edge of that triangle is routed, and so whenever anything
// about W changes.
#ifndef SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_H
#define SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_H

#include <surety/internal/deviation/cells.h>
#include <surety/internal/deviation/closest_point.h>
#include <surety/internal/deviation/map.h>
#include <surety/internal/deviation/policy.h>
#include <surety/internal/deviation/reference.h>
#include <surety/internal/deviation/tolerance.h>
#include <surety/internal/operators/disc_edges.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace surety::internal {

/// A point inside a T triangle that goes to a vertex of M: x_a + v (x_b - x_a) + w (x_c - x_a),
/// where a, b, c are the triangle's vertices in the order of the user's mesh.
struct Inner_item {
  Index face, m_vertex;
  Triangle_weights weights;
  double squared_distance;
};

class After_disc;

class Direct_bound final : public Deviation_policy
{
public:
  /// `normal_cosine` bounds the angle between the normals of a face of M and of a T triangle with a
  /// cell in it; -1: it does not.
  Direct_bound(
      const Reference& reference, const Working_mesh& mesh, Tolerance tolerance, Journal& journal,
      double normal_cosine = -1)
    : reference_(reference),
      mesh_(mesh),
      tolerance_(std::move(tolerance)),
      journal_(journal),
      normal_cosine_(normal_cosine),
      map_(
          reference.number_of_vertices(), reference.number_of_edges(), mesh.number_of_edges(),
          mesh.number_of_real_faces(), journal),
      blocker_(reference.number_of_vertices(), none)
  {}

  /// Coordinates of M's vertices that the rounding errors are derived for: outside T by the
  /// tolerance, and by a few times that for a while, but never far beyond the size of T.
  static double largest_coordinate(const Reference& reference, double tolerance)
  {
    return reference.largest_coordinate() + 4 * std::min(tolerance, reference.largest_coordinate());
  }

  Verdict check(const Disc& disc) override;
  void commit(const Disc& disc) override;
  bool is_blocked(const Disc& disc) override;
  double growth_needed() const override { return std::sqrt(squared_growth_needed_); }
  Forecast forecast(const Disc& disc) const override;
  void set_stage(double share) override { tolerance_.set_stage(share); }
  std::vector<double> face_bounds() override;

  const Map& map() const { return map_; }
  /// For phi as it was worked out elsewhere.
  Map& map() { return map_; }
  const Tolerance& tolerance() const { return tolerance_; }
  /// Checks against a multiple of the tolerance until the next call. What is committed meanwhile
  /// must come to be within the tolerance, or be undone, before a result is made of it.
  void overshoot(double factor) { tolerance_.overshoot(factor); }

  /// The largest ratio of a squared distance and its limit among what maps to a vertex, an edge or
  /// a face.
  double largest_ratio_at_vertex(Index m_vertex) const;
  double largest_ratio_on_face(Index m_face) const;
  double largest_ratio_on_edge(Index m_edge) const;
  /// The same for the inner items of the T triangles at the edges routed since the journal began.
  double largest_inner_ratio_of_transaction();
  void begin_transaction() { touched_edges_.clear(), nodes_before_ = map_.number_of_nodes(); }
  /// To be called when the journal has undone the transaction.
  void forget_transaction() { map_.forget_nodes_from(nodes_before_); }

  /// The inner items of all T triangles, by triangle.
  std::vector<Inner_item> inner_items();

private:
  struct Moved_vertex {
    Index vertex;
    Element image;
    Index low, count; ///< the fan faces that contain the image
  };
  struct Routed_edge {
    Index edge, first, last; ///< range of nodes_
  };
  struct Pending_node {
    Index node; ///< `none` while it is not stored
    Index m_edge;
    float lambda;
  };
  /// A place on a T edge and the fan faces that contain its image, consecutive ones.
  struct Stop {
    Index low, count;
    double lambda;
  };
  using Side = Disc::Side;

  // Step 1: the T vertices on the disc.
  bool apex_is_in_range() const;
  bool move_vertices();
  bool slide_along_ridge();
  bool move_vertices_to_ridges();
  bool move_to_faces(Index v, Side side);
  bool move_to_ridge(Index v, Index spoke);
  double nearest_face(const Disc& disc, const Vector& p, Side side, Index& face) const;
  Side faces_at_spoke(Index spoke) const;

  // Step 2: the T edges that meet the disc, and their new crossings.
  void gather_edges();
  void gather_edges_of_flip();
  void gather_winding_edges();
  void gather_edge(Index e)
  {
    if (slot_of_edge_.insert_if_new(e, static_cast<Index>(edges_.size())))
      edges_.push_back({e, 0, 0});
  }
  Verdict route_edges();
  Verdict route(Index e);
  Verdict connect(Index e, const Stop& from, const Stop& to);
  Verdict connect_in_open_fan(Index e, const Stop& from, const Stop& to);
  Verdict connect_in_closed_fan(Index e, const Stop& from, const Stop& to);
  Verdict cross_all(Index e, const Stop& from, const Stop& to, bool counter_clockwise);
  bool passes_apex_on_left(Index e, double from, double to) const;
  Verdict cross(Index e, Index spoke, double low, double high);
  bool stop_at_vertex(Index v, float lambda, Stop& stop) const;
  bool stop_at_node(const Pending_node& node, Stop& stop) const;
  bool runs_inside(Index e, Index previous, Index next) const;

  // Step 3: invariant I3 over the T triangles at those edges.
  bool extends_over_faces();
  bool extends_over(Index face);
  bool bounds_normals() const { return normal_cosine_ > -1; }
  After_disc after_disc(Index face) const;
  bool collect_items(Index face);
  void append_nodes(Index e, bool forward);
  Item item_at_vertex(Index v) const;
  Item item_on_edge(Index m_edge) const;
  std::optional<Inner_item> inner_item(Index face);
  double limit_at(const Inner_item& inner) const;

  /// Whether a distance is within its limit; takes down by how much it is not.
  bool is_within(double squared_distance, double squared_limit)
  {
    if (squared_distance <= squared_limit) return true;
    squared_growth_needed_ = squared_limit > 0 ? squared_distance / squared_limit : 1;
    return false;
  }

  /// Infinite where rounding alone exceeds the tolerance, and the limit is negative.
  static double ratio(double squared_distance, double squared_limit)
  {
    return squared_limit > 0 ? squared_distance / squared_limit
                             : std::numeric_limits<double>::infinity();
  }
  Vector point_on_edge(Index e, double lambda) const
  {
    const auto [s, t] = reference_.vertices_of_edge(e);
    const Vector& a = reference_.point(s);
    return a + lambda * (reference_.point(t) - a);
  }
  double limit_on_edge(Index e, double lambda) const
  {
    const auto [s, t] = reference_.vertices_of_edge(e);
    return tolerance_.squared_limit(s, t, lambda);
  }
  double squared_distance_to_m_edge(const Vector& p, Index m_edge) const
  {
    const Index h = mesh_.halfedge(m_edge);
    const Vector& a = mesh_.point(mesh_.source(h));
    return squared_distance_to_segment(p, a, mesh_.point(mesh_.target(h)) - a);
  }
  double squared_distance_to_m_face(const Vector& p, Index m_face) const
  {
    const auto corner = mesh_.vertices_of(m_face);
    const Vector& a = mesh_.point(corner[0]);
    return squared_distance_to_triangle(
        p, a, mesh_.point(corner[1]) - a, mesh_.point(corner[2]) - a);
  }

  Index slot_of_vertex(Index v) const { return slot_of_vertex_.find(v); }
  Index slot_of_edge(Index e) const { return slot_of_edge_.find(e); }
  Element image(Index v) const
  {
    const Index slot = slot_of_vertex(v);
    return slot != none ? vertices_[slot].image : map_.image(v);
  }
  const Vector& point(Index m_vertex) const
  {
    return m_vertex == disc_->apex ? disc_->apex_point : mesh_.point(m_vertex);
  }
  void forget_disc()
  {
    disc_ = &no_disc_;
    disc_edges_.clear();
    slot_of_vertex_.clear();
    slot_of_edge_.clear();
    vertices_.clear();
    edges_.clear();
    nodes_.clear();
  }

  const Reference& reference_;
  const Working_mesh& mesh_;
  Tolerance tolerance_;
  Journal& journal_;
  double normal_cosine_;
  Map map_;

  // What check() worked out, kept for commit().
  Disc no_disc_;
  const Disc* disc_ = nullptr;
  Disc_edges disc_edges_;
  std::vector<Moved_vertex> vertices_;
  std::vector<Routed_edge> edges_;
  std::vector<Pending_node> nodes_;
  Vector fan_normal_; ///< of a closed fan

  Slot_table slot_of_vertex_, slot_of_edge_; ///< in vertices_ and edges_
  Slot_table seen_faces_;
  // The T vertex that last refused the removal of an M vertex: asked first the next time.
  std::vector<Index> blocker_;
  double squared_growth_needed_ = 1;
  std::vector<Item> items_;
  Cell_search cells_;

  // T edges routed since the transaction began, and the size of the pool of nodes then.
  std::vector<Index> touched_edges_;
  std::size_t nodes_before_ = 0;
};

} // namespace surety::internal

#include <surety/internal/deviation/direct_bound_cells.h>
#include <surety/internal/deviation/direct_bound_impl.h>
#include <surety/internal/deviation/direct_bound_measures.h>
#include <surety/internal/deviation/direct_bound_routes.h>

#endif // SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_H
