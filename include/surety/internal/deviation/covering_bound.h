// SPDX-License-Identifier: GPL-3.0-or-later
//
// The covering bound: every point of T is near to a face of M and every point of M near to a face
// of T, cell by cell, without a map, a link condition or a pin. It serves operations of any kind,
// and meshes that are finer than T.
//
// Theorem. Let T be divided into convex cells, and M likewise, each with all its corners within
// delta of one triangle of the other. Then H(M,T) <= delta. For the distance to a convex set is
// convex, and so it is largest at a corner of the cell.
#ifndef SURETY_INTERNAL_DEVIATION_COVERING_BOUND_H
#define SURETY_INTERNAL_DEVIATION_COVERING_BOUND_H

#include <surety/internal/covering/cover_maker.h>
#include <surety/internal/covering/forest.h>
#include <surety/internal/covering/projection.h>
#include <surety/internal/deviation/policy.h>
#include <surety/internal/deviation/reference.h>
#include <surety/internal/deviation/rounding.h>
#include <surety/internal/slot_table.h>
#include <surety/internal/working_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace surety::internal {

class Covering_bound final : public Deviation_policy
{
public:
  /// M must be T as yet, with the same numbering of its faces.
  Covering_bound(const Reference& reference, const Working_mesh& mesh, double tolerance)
    : reference_(reference),
      mesh_(mesh),
      rounding_(covering::rounding_factor * (reference.largest_coordinate() + 2 * tolerance)),
      tolerance_(tolerance),
      squared_limit_(rounding_.squared_limit(working_share * tolerance)),
      forest_(reference.number_of_faces()),
      projection_(reference),
      seed_(reference.number_of_faces()),
      bound_(reference.number_of_faces(), 0)
  {
    for (Index f = 0; f < seed_.size(); ++f) seed_[f] = f;
  }

  Verdict check(const Disc& disc) override
  {
    set_faces(disc);
    return covers_mesh(disc) && covers_reference(disc) ? Verdict::accept : Verdict::deviation;
  }

  void commit(const Disc& disc) override
  {
    for (const Index f : disc.old_face) forest_.clear_leaves_of(f);
    for (const auto& [node, root] : planted_)
      forest_.plant(node, nodes_, root, [&](Index i) { return candidates_[i].face; });
    for (std::size_t i = 0; i < new_faces_.size(); ++i) {
      const Index f = new_faces_[i].face;
      if (f >= seed_.size()) {
        seed_.resize(f + 1, none);
        bound_.resize(f + 1, 0);
      }
      seed_[f] = new_seed_[i];
      bound_[f] = new_bound_[i];
    }
  }

  void set_stage(double share) override
  {
    squared_limit_ = rounding_.squared_limit(working_share * share * tolerance_);
  }

  std::vector<double> face_bounds() override
  {
    std::vector<double> bounds(mesh_.number_of_real_faces(), 0);
    for (Index f = 0; f < bounds.size(); ++f) {
      if (!mesh_.is_live_face(f)) continue;
      double squared = bound_[f];
      const covering::Triangle triangle = face(f);
      forest_.for_each_leaf_of(f, [&](Index leaf) {
        for_each_corner(leaf, [&](const Vector& p) {
          squared = std::max(squared, triangle.squared_distance(p));
        });
      });
      bounds[f] = rounding_.upper_bound(squared);
    }
    return bounds;
  }

  double tolerance() const { return tolerance_; }

  /// A triangle of T next to the middle of a face.
  Index seed_of(Index face) const { return seed_[face]; }

private:
  /// So that who covers the result anew, with another choice of cells, is never undecided.
  static constexpr double working_share = 0.999;

  /// Where T is finer than this under a face, cells are slow and seldom find what a projection does
  /// not; but where its triangles are much larger than the face, they do.
  static constexpr std::size_t worth_cells = 8, worth_cells_where_large = 48;
  bool are_cells_worth_it() const
  {
    return projection_.visited().size()
        <= (projection_.has_gone_far() ? worth_cells_where_large : worth_cells);
  }

  struct Planted {
    Index node, root;
  };

  covering::Triangle face(Index f) const
  {
    const auto v = mesh_.vertices_of(f);
    return {mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), f};
  }

  /// All new faces, each of which is to be proven; and the candidates to cover T: these, and those
  /// across the link.
  void set_faces(const Disc& disc)
  {
    new_faces_.clear();
    predecessors_.clear();
    outer_faces_.clear();
    candidates_.clear();
    disc.for_each_new_face([&](Index i) {
      if (mesh_.is_ghost_face(disc.face[i])) return;
      new_faces_.emplace_back(
          disc.apex_point, mesh_.point(disc.ring[i]), mesh_.point(disc.ring[disc.after(i)]),
          disc.face[i]);
      candidates_.add(new_faces_.back());
      predecessors_.push_back(mesh_.face(disc.inner[i]));
    });
    for (const Index h : disc.inner) {
      const Index f = mesh_.face(Working_mesh::opposite(h));
      if (mesh_.is_ghost_face(f) || disc.position_of_old_face(f) != none) continue;
      outer_faces_.push_back(f);
      candidates_.add(face(f));
    }
  }

  /// Whether every new face is near to T.
  bool covers_mesh(const Disc& disc)
  {
    seeds_.clear();
    for (const Index f : disc.old_face)
      if (!mesh_.is_ghost_face(f)) seeds_.push_back(seed_[f]);
    for (const Index f : outer_faces_) seeds_.push_back(seed_[f]);
    new_seed_.clear();
    new_bound_.clear();
    for (std::size_t i = 0; i < new_faces_.size(); ++i) {
      const covering::Triangle& face = new_faces_[i];
      auto proof = projection_.prove(face, seeds_, squared_limit_);
      if (!proof && are_cells_worth_it()) proof = prove_by_cells(face, disc);
      if (!proof && disc.kind == Disc::Kind::split)
        proof = prove_by_predecessor(face, predecessors_[i]);
      if (!proof) return false;
      new_seed_.push_back(proof->seed);
      new_bound_.push_back(proof->squared_distance);
    }
    return true;
  }

  /// Every point of a new face is as near to an old one as its farthest corner, which may leave
  /// enough of what the old one was away from T.
  std::optional<covering::Projection::Proof> prove_by_predecessor(
      const covering::Triangle& face, Index old) const
  {
    if (old == none || mesh_.is_ghost_face(old)) return std::nullopt;
    const covering::Triangle before = this->face(old);
    double squared = 0;
    for (const Vector& p : face.corners()) squared = std::max(squared, before.squared_distance(p));
    if (squared > squared_limit_) return std::nullopt;
    const double sum = rounding_.upper_bound(bound_[old]) + rounding_.upper_bound(squared);
    if (sum * sum > squared_limit_) return std::nullopt;
    return covering::Projection::Proof{seed_[old], sum * sum};
  }

  /// The general way: cells of the face, each near to a triangle of T nearby.
  std::optional<covering::Projection::Proof> prove_by_cells(
      const covering::Triangle& face, const Disc& disc)
  {
    gather_nearby(disc);
    covering::Cell cell = covering::Cover_maker::triangle_cell(face.corners());
    for (unsigned i = 0; i < 3; ++i) cell[i].known = nearby_.around(cell[i].point, squared_limit_);
    face_cells_.clear();
    if (!maker_.cover(cell, 0, nearby_, squared_limit_, face_cells_)) return std::nullopt;
    double squared = 0;
    Index seed = none;
    for (const auto& node : face_cells_) {
      if (node.child != none) continue;
      const covering::Triangle& triangle = nearby_[node.triangle];
      if (seed == none) seed = triangle.face;
      for (unsigned i = 0; i < node.cell.size(); ++i)
        squared = std::max(squared, triangle.squared_distance(node.cell[i].point));
    }
    return covering::Projection::Proof{seed, squared};
  }

  /// Triangles of T that the disc has to do with: next to the middles of its faces, seen on the way
  /// of the last projection, covered by its faces, and the neighbours of all these.
  void gather_nearby(const Disc& disc)
  {
    nearby_.clear();
    nearby_slots_.clear();
    std::vector<Index>& list = nearby_list_;
    list.clear();
    const auto add = [&](Index t) {
      if (t != none && nearby_slots_.insert_if_new(t, 0)) list.push_back(t);
    };
    for (const Index t : projection_.visited()) add(t);
    for (const Index t : seeds_) add(t);
    for (const Index f : disc.old_face)
      forest_.for_each_leaf_of(f, [&](Index leaf) { add(forest_.triangle_of(leaf)); });
    const std::size_t inner = list.size();
    for (std::size_t i = 0; i < inner; ++i)
      for (const Index e : reference_.edges_of_face(list[i]))
        for (const Index t : reference_.faces_of_edge(e)) add(t);
    for (const Index t : list) nearby_.add(projection_.triangle(t));
  }

  template <class Visit>
  void for_each_corner(Index node, Visit visit) const
  {
    if (forest_.is_whole(node)) {
      for (const Index v : projection_.corners_of(node)) visit(reference_.point(v));
    } else {
      for (const Vector& p : forest_.corners(node)) visit(p);
    }
  }

  /// Whether what the old faces covered is near to the new ones, or to their neighbours.
  bool covers_reference(const Disc& disc)
  {
    forest_.gather(disc.old_face, roots_);
    nodes_.clear();
    planted_.clear();
    at_vertex_.clear();
    vertex_slots_.clear();
    for (const Index node : roots_) {
      const auto root = static_cast<Index>(nodes_.size());
      if (!maker_.cover(cell_of(node), forest_.depth(node), candidates_, squared_limit_, nodes_))
        return false;
      planted_.push_back({node, root});
    }
    return true;
  }

  covering::Cell cell_of(Index node)
  {
    covering::Cell cell;
    if (forest_.is_whole(node)) {
      for (const Index v : projection_.corners_of(node))
        cell.append({reference_.point(v), nearness_of_vertex(v)});
    } else {
      for (const Vector& p : forest_.corners(node))
        cell.append({p, candidates_.around(p, squared_limit_)});
    }
    return cell;
  }

  /// Several triangles of T share a vertex: measured once.
  covering::Nearness nearness_of_vertex(Index v)
  {
    const Index slot = vertex_slots_.find(v);
    if (slot != none) return at_vertex_[slot];
    vertex_slots_.insert(v, static_cast<Index>(at_vertex_.size()));
    at_vertex_.push_back(candidates_.around(reference_.point(v), squared_limit_));
    return at_vertex_.back();
  }

  const Reference& reference_;
  const Working_mesh& mesh_;
  Rounding rounding_;
  double tolerance_, squared_limit_;
  covering::Forest forest_;
  covering::Projection projection_;
  covering::Cover_maker maker_;
  std::vector<Index> seed_;   ///< a triangle of T next to the middle of each face of M
  std::vector<double> bound_; ///< squared distance of each face of M to T, as computed

  covering::Candidates candidates_, nearby_;
  std::vector<covering::Triangle> new_faces_;
  std::vector<Index> predecessors_; ///< of each new face: the old one at the same edge of the ring
  std::vector<Index> outer_faces_, seeds_, new_seed_, roots_, nearby_list_;
  std::vector<double> new_bound_;
  std::vector<covering::Cover_node> nodes_, face_cells_;
  std::vector<Planted> planted_;
  std::vector<covering::Nearness> at_vertex_;
  Slot_table vertex_slots_, nearby_slots_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_COVERING_BOUND_H
