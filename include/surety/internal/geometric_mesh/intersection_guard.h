// SPDX-License-Identifier: GPL-3.0-or-later
//
// No operation may make a face that meets another one outside the vertices and edges they share.
// Decided by exact predicates among the faces that a box tree finds nearby.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_INTERSECTION_GUARD_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_INTERSECTION_GUARD_H

#include <surety/internal/geometric_mesh/box_tree.h>
#include <surety/internal/geometric_mesh/space_filling_order.h>
#include <surety/internal/operators/disc.h>
#include <surety/internal/working_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <array>
#include <vector>

namespace surety::internal {

class Intersection_guard
{
public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;
  using Corners = std::array<Index, 3>;

  explicit Intersection_guard(const Working_mesh& mesh) : mesh_(mesh), origin_(mesh.point(0))
  {
    build_tree();
  }

  /// Whether no two faces of M meet where they should not.
  bool finds_none() const
  {
    for (Index f = 0; f < mesh_.number_of_real_faces(); ++f) {
      if (!mesh_.is_live_face(f)) continue;
      const Corners corners = mesh_.vertices_of(f);
      bool meets = CGAL::collinear(point(corners[0]), point(corners[1]), point(corners[2]));
      tree_.for_each_meeting(box_of(corners), [&](Index g) {
        meets = meets || (g > f && meet(corners, mesh_.vertices_of(g)));
      });
      if (meets) return false;
    }
    return true;
  }

  /// Whether no new face of the disc meets any other face.
  bool admits(const Disc& disc)
  {
    disc_ = &disc;
    const bool result = admits_fan(disc);
    disc_ = nullptr;
    return result;
  }

  /// Follows M after it has taken the disc.
  void commit(const Disc& disc)
  {
    refresh(disc.old_face);
    if (disc.kind != Disc::Kind::split) return;
    misplaced_ += 2;
    refresh(disc.face);
  }
  /// Follows M where some faces have changed.
  void refresh(const std::vector<Index>& faces)
  {
    for (const Index f : faces) {
      if (mesh_.is_ghost_face(f)) continue;
      if (!tree_.has(f) && !tree_.add(f)) {
        build_tree();
        return;
      }
      tree_.set(f, mesh_.is_live_face(f) ? box_of(mesh_.vertices_of(f)) : Float_box());
    }
  }
  /// To be called between operations, when none can be undone: what died is left behind, and what
  /// came after the tree was built is put where it belongs.
  void clean_up()
  {
    if (mesh_.number_of_live_faces() < tree_.size() / 2 || misplaced_ > tree_.size() / 8)
      build_tree();
  }

private:
  struct Fan_face {
    Corners corners;
    Float_box box;
  };

  bool admits_fan(const Disc& disc)
  {
    Float_box all;
    fan_.clear();
    bool degenerate = false;
    disc.for_each_new_face([&](Index i) {
      if (mesh_.is_ghost_face(disc.face[i])) return;
      const Corners corners{disc.apex, disc.ring[i], disc.ring[disc.after(i)]};
      degenerate
          = degenerate || CGAL::collinear(point(corners[0]), point(corners[1]), point(corners[2]));
      fan_.push_back({corners, box_of(corners)});
      all.add(fan_.back().box);
    });
    if (degenerate) return false;
    for (std::size_t i = 0; i < fan_.size(); ++i)
      for (std::size_t j = i + 1; j < fan_.size(); ++j)
        if (meet(fan_[i].corners, fan_[j].corners)) return false;

    bool admissible = true;
    tree_.for_each_meeting(all, [&](Index f) {
      if (!admissible || disc.position_of_old_face(f) != none) return;
      const Corners corners = mesh_.vertices_of(f);
      const Float_box box = box_of(corners);
      for (const Fan_face& face : fan_)
        if (face.box.meets(box) && meet(face.corners, corners)) {
          admissible = false;
          return;
        }
    });
    return admissible;
  }

  Point point(Index v) const
  {
    const Vector& p = vector(v);
    return {p.x(), p.y(), p.z()};
  }
  const Vector& vector(Index v) const
  {
    return disc_ != nullptr ? disc_->point(mesh_, v) : mesh_.point(v);
  }
  Float_box box_of(const Corners& corners) const
  {
    Float_box box;
    for (const Index v : corners) box.add((vector(v) - origin_).cast<float>().array());
    return box;
  }
  void build_tree()
  {
    std::vector<Index> live;
    std::vector<Vector> places;
    live.reserve(mesh_.number_of_live_faces());
    for (Index f = 0; f < mesh_.number_of_real_faces(); ++f)
      if (mesh_.is_live_face(f)) live.push_back(f);
    // Elements that splits have made are numbered as they come.
    if (misplaced_ > 0) {
      for (const Index f : live) places.push_back(mesh_.point(mesh_.vertices_of(f)[0]));
      const std::vector<Index> order = space_filling_order(places);
      std::vector<Index> sorted;
      for (const Index i : order) sorted.push_back(live[i]);
      live = std::move(sorted);
      misplaced_ = 0;
    }
    tree_.build(std::move(live), mesh_.number_of_real_faces(), [this](Index f) {
      return box_of(mesh_.vertices_of(f));
    });
  }

  /// Whether two faces meet outside the vertices that they share.
  bool meet(Corners a, Corners b) const
  {
    const std::size_t shared = shared_first(a, b);
    if (shared == 0) return meet_apart(a, b);
    if (shared == 1) return meet_at_vertex(a, b);
    if (shared == 2) return meet_at_edge(a, b);
    return true;
  }

  /// Moves the vertices that both have to the front of both, in the same order.
  static std::size_t shared_first(Corners& a, Corners& b)
  {
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = shared; j < 3; ++j)
        if (a[i] == b[j]) {
          std::swap(a[shared], a[i]);
          std::swap(b[shared], b[j]);
          ++shared;
          break;
        }
    return shared;
  }

  /// Whether all of `others` lie strictly on one side of the plane of a.
  template <std::size_t n>
  bool on_one_side(const Corners& a, const std::array<Index, n>& others) const
  {
    const Point p = point(a[0]), q = point(a[1]), r = point(a[2]);
    const CGAL::Orientation side = CGAL::orientation(p, q, r, point(others[0]));
    if (side == CGAL::COPLANAR) return false;
    for (std::size_t i = 1; i < n; ++i)
      if (CGAL::orientation(p, q, r, point(others[i])) != side) return false;
    return true;
  }

  bool meet_apart(const Corners& a, const Corners& b) const
  {
    if (on_one_side(a, b) || on_one_side(b, a)) return false;
    return CGAL::do_intersect(triangle(a), triangle(b));
  }
  bool meet_at_vertex(const Corners& a, const Corners& b) const
  {
    if (on_one_side(a, std::array<Index, 2>{b[1], b[2]})
        || on_one_side(b, std::array<Index, 2>{a[1], a[2]}))
      return false;
    return CGAL::do_intersect(triangle(a), Kernel::Segment_3(point(b[1]), point(b[2])))
        || CGAL::do_intersect(triangle(b), Kernel::Segment_3(point(a[1]), point(a[2])));
  }
  bool meet_at_edge(const Corners& a, const Corners& b) const
  {
    const Point p = point(a[0]), q = point(a[1]), r = point(a[2]), s = point(b[2]);
    return CGAL::orientation(p, q, r, s) == CGAL::COPLANAR
        && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }
  Kernel::Triangle_3 triangle(const Corners& a) const
  {
    return {point(a[0]), point(a[1]), point(a[2])};
  }

  const Working_mesh& mesh_;
  const Disc* disc_ = nullptr; ///< the operation that is being looked at
  Vector origin_;
  Box_tree tree_;
  std::size_t misplaced_ = 0; ///< faces that took a place of the tree that is not near them
  std::vector<Fan_face> fan_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_INTERSECTION_GUARD_H
