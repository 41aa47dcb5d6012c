// SPDX-License-Identifier: GPL-3.0-or-later
//
// The operators of the unit mesh (section 5 of the paper): each is tried in full, cheapest control
// first and the deviation last but one, and made only if all of them agree.
#ifndef SURETY_INTERNAL_UNIT_MESH_EDITOR_H
#define SURETY_INTERNAL_UNIT_MESH_EDITOR_H

#include <surety/internal/deviation/covering_bound.h>
#include <surety/internal/geometric_mesh/intersection_guard.h>
#include <surety/internal/operators/topology.h>
#include <surety/internal/unit_mesh/ground.h>
#include <surety/internal/unit_mesh/local_metric.h>
#include <surety/operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

namespace surety::internal::unit_mesh {

class Editor
{
public:
  Editor(
      const Ground& ground, Working_mesh& mesh, Covering_bound& bound,
      const std::vector<bool>& is_feature, bool guards_intersections, bool places_freely)
    : ground_(ground),
      mesh_(mesh),
      bound_(bound),
      measure_(ground.is_isotropic()),
      places_freely_(places_freely)
  {
    const Index vertices = mesh.number_of_real_vertices();
    for (Index v = 0; v < vertices; ++v) {
      stand_.push_back(mesh.is_on_feature(v) ? ground.on_curve_at(v) : ground.at_vertex(v));
      metric_.emplace_back();
      normal_.push_back(Vector::Zero());
      offset_.push_back(0);
      share_.push_back(1);
      take_ground(v);
    }
    for (Index e = 0; e < is_feature.size(); ++e) curve_.push_back(is_feature[e] ? e : none);
    if (guards_intersections) guard_.emplace(mesh);
  }

  const Working_mesh& mesh() const { return mesh_; }
  const Operations& operations() const { return operations_; }
  const Standpoint& standpoint(Index v) const { return stand_[v]; }

  /// To be called now and then.
  void clean_up()
  {
    if (guard_) guard_->clean_up();
  }

  /// Makes the sizes at some vertices smaller by a factor, and those around them so that shares
  /// grow by no more than `growth` along an edge of unit length; none of them smaller than the
  /// least. Tells whether it has done anything.
  bool lower_sizes(const std::vector<Index>& vertices, double factor, double least, double growth);
  /// Forgets that sizes have been lowered.
  void take_sizes_as_given()
  {
    for (Index v = 0; v < stand_.size(); ++v) set_share(v, 1);
  }

  bool is_real(Index e) const { return mesh_.is_live_edge(e) && !touches_ghost(e); }
  double length(Index e) const
  {
    const Index a = mesh_.source(2 * e), b = mesh_.target(2 * e);
    return measure_.length(mesh_.point(b) - mesh_.point(a), metric_[a], metric_[b]);
  }
  double quality(Index f) const
  {
    const auto v = mesh_.vertices_of(f);
    return measure_.quality(
        {mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2])},
        {&metric_[v[0]], &metric_[v[1]], &metric_[v[2]]});
  }

  /// The apex of the last operation that was made.
  Index apex() const { return disc_.apex; }

  /// Forbids to split the edge between two corners.
  void keep_whole(Index a, Index b) { whole_.insert(std::minmax(a, b)); }
  /// Puts a vertex in the metric middle of an edge.
  bool split(Index e);
  /// Removes one end of an edge, where no new edge is longer than `longest`; else, both being free
  /// to go, puts the other in a better place. Says why it could not.
  Verdict collapse(Index e, double longest);
  bool flip(Index e);
  enum class Aim { length, shape };
  /// Moves a vertex to where its faces are better and its edges nearer to one; with free placement
  /// also along the normal, towards where its faces are as far on one side of T as on the other.
  /// Tries the place that makes edges unit, and if asked for it that which makes faces equilateral.
  bool relocate(Index v, Aim aim);
  /// Makes the worst face around a bad one better, by the first operation that does: a flip, a
  /// relocation of a corner, a collapse.
  bool mend(Index f);
  /// Makes an edge nearer to unit by moving an end of it.
  bool mend_edge(Index e);

private:
  struct Apex {
    Vector point;
    Standpoint stand;
    Local_metric metric;
    double share = 1;               ///< of the sizes that the ground asks for
    Vector normal = Vector::Zero(); ///< zero on curves
    double offset = 0;              ///< of the point from the support, along the normal
  };

  bool is_whole(Index e) const
  {
    return !whole_.empty() && whole_.count(std::minmax({mesh_.source(2 * e), mesh_.target(2 * e)}));
  }

  bool touches_ghost(Index e) const
  {
    return mesh_.is_ghost_vertex(mesh_.source(2 * e)) || mesh_.is_ghost_vertex(mesh_.target(2 * e));
  }

  void take_ground(Index v)
  {
    if (mesh_.is_fixed(v)) {
      metric_[v] = ground_.metric_at_corner(v);
    } else {
      metric_[v] = ground_.metric(stand_[v]);
      if (stand_[v].edge == none) normal_[v] = ground_.normal(stand_[v]);
    }
  }

  /// Lowers or raises the sizes at a vertex of M to a share of what the ground asks for.
  void set_share(Index v, double share)
  {
    metric_[v].scale_sizes(share / share_[v]);
    share_[v] = share;
  }

  Apex apex_at(const Standpoint& stand, const Vector& point, double share) const
  {
    Apex result{point, stand, ground_.metric(stand), share, Vector::Zero(), 0};
    result.metric.scale_sizes(share);
    if (stand.edge == none) result.normal = ground_.normal(stand);
    return result;
  }
  /// At a distance from the support.
  Apex apex_above(const Standpoint& stand, double share, double offset) const
  {
    Apex result = apex_at(stand, ground_.support_point(stand), share);
    result.offset = offset;
    result.point += offset * result.normal;
    return result;
  }
  Apex apex_of(Index v) const
  {
    return {mesh_.point(v), stand_[v], metric_[v], share_[v], normal_[v], offset_[v]};
  }

  /// How far the new faces are below and above T, as far as samples show.
  std::pair<double, double> gaps(const Apex& apex) const
  {
    std::pair<double, double> result{0, 0};
    const auto look = [&](const Vector& p) {
      const Standpoint foot = ground_.nearest(p, apex.stand.face);
      const double gap = (p - ground_.point(foot)).dot(apex.normal);
      result.first = std::min(result.first, gap);
      result.second = std::max(result.second, gap);
    };
    look(apex.point);
    for_each_new_face([&](const std::array<Index, 3>& v) {
      look((apex.point + mesh_.point(v[1]) + mesh_.point(v[2])) / 3);
      look((apex.point + mesh_.point(v[1])) / 2);
    });
    return result;
  }
  void shift(Apex& apex, double share) const
  {
    const auto [low, high] = gaps(apex);
    const double step = -share * (low + high);
    apex.offset += step;
    apex.point += step * apex.normal;
  }

  const Vector& point(Index v, const Apex& apex) const
  {
    return v == disc_.apex ? apex.point : mesh_.point(v);
  }
  const Local_metric& metric(Index v, const Apex& apex) const
  {
    return v == disc_.apex ? apex.metric : metric_[v];
  }
  const Vector& normal(Index v, const Apex& apex) const
  {
    return v == disc_.apex ? apex.normal : normal_[v];
  }
  double length(Index v, const Apex& apex) const
  {
    return measure_.length(mesh_.point(v) - apex.point, apex.metric, metric_[v]);
  }

  /// Calls visit(corners) for each new face that is not a ghost.
  template <class Visit>
  void for_each_new_face(Visit visit) const
  {
    disc_.for_each_new_face([&](Index i) {
      if (!mesh_.is_ghost_face(disc_.face[i]))
        visit(std::array<Index, 3>{disc_.apex, disc_.ring[i], disc_.ring[disc_.after(i)]});
    });
  }
  template <class Visit>
  void for_each_old_face(Visit visit) const
  {
    for (const Index f : disc_.old_face)
      if (!mesh_.is_ghost_face(f)) visit(f);
  }

  double quality(const std::array<Index, 3>& v, const Apex& apex) const
  {
    return measure_.quality(
        {point(v[0], apex), point(v[1], apex), point(v[2], apex)},
        {&metric(v[0], apex), &metric(v[1], apex), &metric(v[2], apex)});
  }
  double worst_old_quality() const
  {
    double worst = 1;
    for_each_old_face([&](Index f) { worst = std::max(worst, quality(f)); });
    return worst;
  }
  double worst_new_quality(const Apex& apex) const
  {
    double worst = 1;
    for_each_new_face(
        [&](const std::array<Index, 3>& v) { worst = std::max(worst, quality(v, apex)); });
    return worst;
  }

  /// What flips and relocations make less: sum (Q - 1)^2 over the faces and `weight` ln^2 l over
  /// the spokes.
  static double shape_energy(double quality)
  {
    const double excess = std::min(quality, 1e3) - 1;
    return excess * excess;
  }
  static double length_energy(double length)
  {
    const double logarithm = std::log(length);
    return logarithm * logarithm;
  }

  /// Whether the new faces look the way that the surface does, or are no worse than the old ones;
  /// and none is turned over.
  bool admits_normals(const Apex& apex);

  Verdict check(const Apex& apex)
  {
    disc_.apex_point = apex.point;
    if (!admits_normals(apex)) return Verdict::roughness;
    const Verdict verdict = bound_.check(disc_);
    if (verdict != Verdict::accept) return verdict;
    return guard_ && !guard_->admits(disc_) ? Verdict::self_intersection : Verdict::accept;
  }
  bool refuse(Verdict verdict)
  {
    operations_.refuse(verdict);
    return false;
  }

  void stand_at(Index v, const Apex& apex)
  {
    if (v >= stand_.size()) {
      stand_.resize(v + 1);
      metric_.resize(v + 1);
      normal_.resize(v + 1, Vector::Zero());
      offset_.resize(v + 1, 0);
      share_.resize(v + 1, 1);
    }
    stand_[v] = apex.stand;
    metric_[v] = apex.metric;
    normal_[v] = apex.normal;
    offset_[v] = apex.offset;
    share_[v] = apex.share;
  }

  /// Makes the relocation that check() has just accepted.
  void move_apex(const Apex& apex)
  {
    bound_.commit(disc_);
    mesh_.move(disc_.apex, apex.point, none);
    stand_at(disc_.apex, apex);
    if (guard_) guard_->commit(disc_);
    ++operations_.relocations;
  }

  Standpoint nearest_below(const Vector& p, Index e) const;
  Standpoint nearest_from_known_faces(const Vector& p, Index e) const;
  std::optional<Apex> middle_of(Index e) const;
  double mean_offset(Index h, const Apex& apex) const
  {
    if (apex.stand.edge != none) return 0;
    return (offset_[mesh_.source(h)] + offset_[mesh_.target(h)]) / 2;
  }
  bool begin_relocation(Index v);
  Vector middle_on_curve(const Apex& from) const;
  template <class Place>
  Vector mean_place(const Apex& from, Place place) const;
  double energy(const Apex& apex) const;
  double excess(const Apex& apex) const;
  template <class Steps, class Improve>
  Verdict move_towards(const Vector& aim, const Apex& from, const Steps& steps, Improve improves);
  bool is_remedy(const Apex& apex) const
  {
    constexpr double share = .95;
    return worst_new_quality(apex) < share * worst_old_quality();
  }
  bool mend_by_flip(Index e);
  bool mend_by_relocation(Index v, Index f);
  bool mend_by_collapse(Index h);
  void make_flip(Index e);
  void make_collapse(Index h);
  Verdict collapse_into(Index h, double longest);
  Verdict collapse_to_better_place(Index h, double longest);
  bool has_long_edge(const Apex& apex, double longest) const;
  bool refuses_shape(const Apex& apex) const
  {
    constexpr double good_enough = 3;
    const double worst = worst_new_quality(apex);
    return worst > good_enough && worst > worst_old_quality();
  }

  const Ground& ground_;
  Working_mesh& mesh_;
  Covering_bound& bound_;
  Measure measure_;
  bool places_freely_;
  std::optional<Intersection_guard> guard_;
  std::vector<Standpoint> stand_;
  std::vector<Local_metric> metric_;
  std::vector<Vector> normal_;
  std::vector<double> offset_;
  std::vector<double> share_;               ///< of the sizes that the ground asks for, at most 1
  std::set<std::pair<Index, Index>> whole_; ///< edges by their ends, the lower one first
  std::vector<Index> curve_; ///< of a feature edge of M: an edge of T of the same curve
  Operations operations_;
  Disc disc_;
  std::vector<Vector> old_normals_;
};

inline bool Editor::admits_normals(const Apex& apex)
{
  constexpr double least_cosine = .5, least_agreement = .3;
  double before = 1;
  old_normals_.clear();
  for_each_old_face([&](Index f) {
    const auto v = mesh_.vertices_of(f);
    const Vector n = unit(
        (mesh_.point(v[1]) - mesh_.point(v[0])).cross(mesh_.point(v[2]) - mesh_.point(v[0])));
    old_normals_.push_back(n);
    // What is only divided looks as it did.
    if (disc_.kind == Disc::Kind::split && !apex.normal.isZero(0))
      before = std::min(before, n.dot(apex.normal));
    for (const Index corner : v)
      if (!normal_[corner].isZero(0)) before = std::min(before, n.dot(normal_[corner]));
  });
  constexpr double rounding = 1e-9;
  const double least = std::min(least_cosine, before - rounding);
  bool admits = true;
  for_each_new_face([&](const std::array<Index, 3>& v) {
    if (!admits) return;
    const Vector p = point(v[0], apex);
    const Vector n = unit((point(v[1], apex) - p).cross(point(v[2], apex) - p));
    double agreement = -1;
    for (const Vector& old : old_normals_) agreement = std::max(agreement, old.dot(n));
    admits = agreement > least_agreement;
    for (const Index corner : v) {
      const Vector& wanted = normal(corner, apex);
      if (!wanted.isZero(0)) admits = admits && n.dot(wanted) >= least;
    }
  });
  return admits;
}

inline bool Editor::lower_sizes(
    const std::vector<Index>& vertices, double factor, double least, double growth)
{
  using Entry = std::pair<double, Index>; // share and vertex
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  std::vector<bool> is_marked(share_.size(), false);
  for (const Index v : vertices) {
    if (!mesh_.is_live_vertex(v) || is_marked[v]) continue;
    is_marked[v] = true;
    if (measure_.least_size(metric_[v]) * factor < least) continue;
    set_share(v, share_[v] * factor);
    queue.emplace(share_[v], v);
  }
  const bool is_any = !queue.empty();
  while (!queue.empty()) {
    const auto [share, v] = queue.top();
    queue.pop();
    if (share > share_[v]) continue;
    mesh_.for_each_outgoing(v, [&](Index h) {
      const Index w = mesh_.target(h);
      if (mesh_.is_ghost_vertex(w)) return;
      // The length before sizes were lowered.
      double most = share + growth * share_[v] * length(Working_mesh::edge(h));
      if (share_[w] <= most) return;
      // Where sizes are small already, shares need not be: the least holds for all.
      most = std::max(most, share_[w] * least / measure_.least_size(metric_[w]));
      if (share_[w] <= most) return;
      set_share(w, most);
      queue.emplace(most, w);
    });
  }
  return is_any;
}

} // namespace surety::internal::unit_mesh

#include <surety/internal/unit_mesh/collapse.h>
#include <surety/internal/unit_mesh/flip.h>
#include <surety/internal/unit_mesh/mend.h>
#include <surety/internal/unit_mesh/relocate.h>
#include <surety/internal/unit_mesh/split.h>

#endif // SURETY_INTERNAL_UNIT_MESH_EDITOR_H
