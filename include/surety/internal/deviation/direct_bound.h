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
#ifndef SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_H
#define SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_H

#include <surety/internal/deviation/cells.h>
#include <surety/internal/deviation/closest_point.h>
#include <surety/internal/deviation/map.h>
#include <surety/internal/deviation/policy.h>
#include <surety/internal/deviation/reference.h>
#include <surety/internal/deviation/rounding.h>

#include <array>
#include <vector>

namespace surety::internal {

class Direct_bound final : public Deviation_policy
{
public:
  Direct_bound(const Reference& reference, const Working_mesh& mesh, double tolerance)
    : reference_(reference),
      mesh_(mesh),
      rounding_(reference.largest_coordinate()),
      squared_limit_(rounding_.squared_limit(tolerance)),
      map_(
          reference.number_of_vertices(), reference.number_of_edges(), mesh.number_of_edges(),
          mesh.number_of_real_faces()),
      slot_of_vertex_(reference.number_of_vertices(), 0),
      slot_of_edge_(reference.number_of_edges(), 0),
      blocker_(reference.number_of_vertices(), none)
  {}

  Verdict check(const Disc& disc) override
  {
    disc_ = &disc;
    vertices_.clear();
    edges_.clear();
    nodes_.clear();
    if (is_blocked()) return Verdict::deviation;
    if (!move_vertices()) return Verdict::deviation;
    gather_edges();
    const Verdict verdict = route_edges();
    if (verdict != Verdict::accept) return verdict;
    return extends_over_faces() ? Verdict::accept : Verdict::correspondence;
  }

  void commit(const Disc& disc) override;
  Forecast forecast(const Disc& disc) const override;
  std::vector<double> face_bounds() const override;
  const Map& map() const { return map_; }

private:
  struct Moved_vertex {
    Index vertex;
    Element image;
    Index low, high; ///< the fan faces that contain the image
  };
  struct Routed_edge {
    Index edge, first, last; ///< range of nodes_
  };
  struct Pending_node {
    Index node; ///< `none` while it is not stored
    Index m_edge;
    double lambda;
  };
  /// A place on a T edge and the fan faces that contain its image.
  struct Stop {
    Index low, high;
    double lambda;
  };

  // Step 1: the T vertices on the disc.
  bool is_blocked() const;
  bool move_vertices();
  bool move_to_faces(Index v, Index low, Index high);
  bool move_to_ridge(Index v);
  double nearest_face(const Disc& disc, const Vector& p, Index low, Index high, Index& face) const;
  std::array<Index, 2> side_of_old_face(Index i) const;

  // Step 2: the T edges that meet the disc, and their new crossings.
  void gather_edges();
  void gather_edges_of_flip();
  void gather_edge(Index e)
  {
    if (slot_of_edge(e) != none) return;
    slot_of_edge_[e] = static_cast<Index>(edges_.size());
    edges_.push_back({e, 0, 0});
  }
  Verdict route_edges();
  Verdict route(Index e);
  Verdict connect(Index e, const Stop& from, const Stop& to);
  bool cross(Index e, Index spoke, double low, double high);
  bool stop_at_vertex(Index v, double lambda, Stop& stop) const;
  bool stop_at_node(const Pending_node& node, Stop& stop) const;
  bool runs_inside(Index e, Index previous, Index next) const;
  Element item_element(Index e, Index item) const;

  // Step 3: invariant I3 over the T triangles at those edges.
  bool extends_over_faces();
  bool extends_over(Index face);
  void append_nodes(Index e, bool forward);
  Item item_at_vertex(Index v) const;
  Item item_on_edge(Index m_edge) const;

  Index slot_of_vertex(Index v) const
  {
    const Index slot = slot_of_vertex_[v];
    return slot < vertices_.size() && vertices_[slot].vertex == v ? slot : none;
  }
  Index slot_of_edge(Index e) const
  {
    const Index slot = slot_of_edge_[e];
    return slot < edges_.size() && edges_[slot].edge == e ? slot : none;
  }
  Element image(Index v) const
  {
    const Index slot = slot_of_vertex(v);
    return slot != none ? vertices_[slot].image : map_.image(v);
  }
  const Vector& point(Index m_vertex) const { return reference_.point(m_vertex); }

  const Reference& reference_;
  const Working_mesh& mesh_;
  Rounding rounding_;
  double squared_limit_;
  Map map_;

  // What check() worked out, kept for commit().
  const Disc* disc_ = nullptr;
  std::vector<Moved_vertex> vertices_;
  std::vector<Routed_edge> edges_;
  std::vector<Pending_node> nodes_;

  // Sparse sets: element -> slot, valid if the slot names the element.
  std::vector<Index> slot_of_vertex_, slot_of_edge_;
  // The T vertex that last refused the removal of an M vertex: asked first the next time.
  std::vector<Index> blocker_;
  std::vector<Item> items_;
  Cell_search cells_;

  friend class After_disc;
};

} // namespace surety::internal

#include <surety/internal/deviation/direct_bound_impl.h>

#endif // SURETY_INTERNAL_DEVIATION_DIRECT_BOUND_H
