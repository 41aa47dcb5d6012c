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
  /// Moves a vertex to where its faces are better and its edges nearer to one; with free placement
  /// also along the normal, towards where its faces are as far on one side of T as on the other.
  bool relocate(Index v);
  /// Makes the worst face around a bad one better, by the first operation that does: a flip, a
  /// relocation of a corner, a collapse.
  bool mend(Index f);

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

/// The point of T nearest to one of an edge of M that is on no curve. The walk starts where a
/// vertex of its faces stands that is on none; where that ends too far away, curves bar the way,
/// and other starts may do better.
inline Standpoint Editor::nearest_below(const Vector& p, Index e) const
{
  for (const Index h : {2 * e, 2 * e + 1}) {
    if (mesh_.is_ghost_face(mesh_.face(h))) continue;
    for (const Index v : {mesh_.source(h), mesh_.target(mesh_.next(h))}) {
      if (stand_[v].edge != none || normal_[v].isZero(0)) continue;
      const Standpoint foot = ground_.nearest(p, stand_[v].face);
      if ((ground_.point(foot) - p).norm() <= bound_.tolerance()) return foot;
    }
  }
  return nearest_from_known_faces(p, e);
}

/// Of the faces of T that are known around an edge, from those that look the way that its faces do.
inline Standpoint Editor::nearest_from_known_faces(const Vector& p, Index e) const
{
  Vector looks = Vector::Zero();
  std::vector<Index> known;
  for (const Index h : {2 * e, 2 * e + 1}) {
    if (mesh_.is_ghost_face(mesh_.face(h))) continue;
    const auto corner = mesh_.vertices_of(mesh_.face(h));
    looks += (mesh_.point(corner[1]) - mesh_.point(corner[0]))
                 .cross(mesh_.point(corner[2]) - mesh_.point(corner[0]));
    known.push_back(bound_.seed_of(mesh_.face(h)));
    for (const Index v : corner) {
      if (stand_[v].edge == none && !normal_[v].isZero(0)) known.push_back(stand_[v].face);
      if (stand_[v].edge == none) continue;
      for (const Index f : ground_.faces_beside(stand_[v].edge))
        if (f != none) known.push_back(f);
    }
  }
  constexpr double agrees = .7; // what a face beside a ridge does not
  looks = unit(looks);
  double most = -1, least = std::numeric_limits<double>::infinity();
  for (const Index f : known) most = std::max(most, looks.dot(ground_.normal_of_face(f)));
  Standpoint best;
  for (const Index f : known) {
    if (looks.dot(ground_.normal_of_face(f)) < std::min(most, agrees)) continue;
    const Standpoint foot = ground_.nearest(p, f);
    const double distance = (ground_.point(foot) - p).squaredNorm();
    if (distance < least) least = distance, best = foot;
  }
  return best;
}

/// The point of the ground below the metric middle of an edge: where both halves are as long.
inline std::optional<Editor::Apex> Editor::middle_of(Index e) const
{
  const Index a = mesh_.source(2 * e), b = mesh_.target(2 * e);
  const Vector along = mesh_.point(b) - mesh_.point(a);
  double t = .5;
  if (metric_[a].kind == metric_[b].kind) {
    // Sizes are linear between a and b; r is their ratio.
    const double r = measure_.length_at(along, metric_[a]) / measure_.length_at(along, metric_[b]);
    if (std::abs(r - 1) > 1e-6) t = (std::sqrt(r) - 1) / (r - 1);
  }
  const Vector middle = mesh_.point(a) + std::clamp(t, .2, .8) * along;
  const double share = (share_[a] + share_[b]) / 2;
  if (mesh_.is_feature(e)) {
    if (curve_[e] == none) return std::nullopt;
    return apex_at(ground_.nearest_on_curve(middle, curve_[e]), middle, share);
  }
  return apex_at(nearest_below(middle, e), middle, share);
}

inline bool Editor::split(Index e)
{
  constexpr double longest_half = .85, cap = 8;
  if (is_whole(e)) return false;
  // A flat face with a longer edge is mended there first: else caps are split for ever.
  for (const Index h : {2 * e, 2 * e + 1}) {
    const Index f = mesh_.face(h);
    if (mesh_.is_ghost_face(f) || quality(f) < cap) continue;
    const double here = length(e);
    for (const Index k : {mesh_.next(h), mesh_.prev(h)})
      if (length(Working_mesh::edge(k)) > here) return refuse(Verdict::shape);
  }
  const auto with = mesh_.elements_for_split(2 * e);
  make_split_disc(mesh_, 2 * e, with, disc_);
  auto apex = middle_of(e);
  if (!apex) return refuse(Verdict::feature);

  const Vector middle = apex->point;
  const Vector above = apex_above(apex->stand, apex->share, mean_offset(2 * e, *apex)).point;
  const Index a = mesh_.source(2 * e), b = mesh_.target(2 * e);
  const double whole = (mesh_.point(b) - mesh_.point(a)).norm();
  Verdict verdict = Verdict::shape;
  for (const double share : {0., .5, .75, 1.}) {
    apex->point = above + share * (middle - above);
    // Metric lengths may add up to more than the whole, where sizes are small in the middle.
    if (std::max((apex->point - mesh_.point(a)).norm(), (apex->point - mesh_.point(b)).norm())
        > longest_half * whole) {
      verdict = Verdict::shape;
      continue;
    }
    verdict = check(*apex);
    if (verdict != Verdict::accept) continue;
    apex->offset = (apex->point - ground_.support_point(apex->stand)).dot(apex->normal);
    bound_.commit(disc_);
    mesh_.split(2 * e, with, apex->point, none);
    stand_at(with.vertex, *apex);
    for (const Index i : with.edge)
      if (i >= curve_.size()) curve_.resize(i + 1, none);
    curve_[with.edge[0]] = curve_[e] = apex->stand.edge;
    curve_[with.edge[1]] = curve_[with.edge[2]] = none;
    if (guard_) guard_->commit(disc_);
    ++operations_.splits;
    return true;
  }
  return refuse(verdict);
}

inline bool Editor::has_long_edge(const Apex& apex, double longest) const
{
  bool found = false;
  disc_.for_each_new_spoke([&](Index i) {
    const Index r = disc_.ring[i];
    if (!mesh_.is_ghost_vertex(r)) found = found || length(r, apex) > longest;
  });
  return found;
}

inline bool Editor::lower_sizes(
    const std::vector<Index>& vertices, double factor, double least, double growth)
{
  using Entry = std::pair<double, Index>; // share and vertex
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  std::vector<bool> is_marked(share_.size(), false);
  for (const Index v : vertices) {
    if (!mesh_.is_live_vertex(v) || mesh_.is_fixed(v) || is_marked[v]) continue;
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

inline Verdict Editor::collapse_into(Index h, double longest)
{
  make_collapse_disc(mesh_, h, disc_);
  Verdict verdict = check_collapse_topology(mesh_, disc_);
  const Apex apex = apex_of(disc_.apex);
  if (verdict == Verdict::accept && (has_long_edge(apex, longest) || refuses_shape(apex)))
    verdict = Verdict::shape;
  if (verdict == Verdict::accept) verdict = check(apex);
  if (verdict == Verdict::accept) make_collapse(h);
  return verdict;
}

inline void Editor::make_collapse(Index h)
{
  bound_.commit(disc_);
  mesh_.collapse(h);
  if (guard_) guard_->commit(disc_);
  ++operations_.collapses;
}

/// Both ends go, to a point of the support: the middle between the two, or nearer to Q.
inline Verdict Editor::collapse_to_better_place(Index h, double longest)
{
  make_placement_disc(mesh_, h, disc_);
  Verdict verdict = check_placement_topology(mesh_, disc_);
  if (verdict != Verdict::accept) return verdict;
  const Index p = disc_.removed, q = disc_.apex;
  const bool is_on_curve = mesh_.is_on_feature(q);
  if (is_on_curve && (curve_[Working_mesh::edge(h)] == none)) return Verdict::feature;
  for (const double share : {.5, .75, .25}) {
    const Vector aim = mesh_.point(p) + share * (mesh_.point(q) - mesh_.point(p));
    const Standpoint stand = is_on_curve
        ? ground_.nearest_on_curve(aim, curve_[Working_mesh::edge(h)])
        : ground_.nearest(aim, stand_[q].face);
    Apex apex = apex_above(
        stand, (share_[p] + share_[q]) / 2, is_on_curve ? 0 : (offset_[p] + offset_[q]) / 2);
    if (places_freely_ && !is_on_curve)
      for (int round = 0; round < 2; ++round) shift(apex, .5);
    if (has_long_edge(apex, longest) || refuses_shape(apex)) {
      verdict = Verdict::shape;
      continue;
    }
    verdict = check(apex);
    if (verdict != Verdict::accept) continue;
    bound_.commit(disc_);
    mesh_.collapse(h);
    mesh_.move(q, apex.point, none);
    stand_at(q, apex);
    if (guard_) guard_->commit(disc_);
    ++operations_.collapses;
    return verdict;
  }
  return verdict;
}

inline Verdict Editor::collapse(Index e, double longest)
{
  // The end with the larger size goes first: it is where the mesh is to be coarser.
  const Index a = mesh_.source(2 * e), b = mesh_.target(2 * e);
  const Vector along = mesh_.point(b) - mesh_.point(a);
  const bool b_goes = measure_.length_at(along, metric_[b]) < measure_.length_at(along, metric_[a]);
  const Index first = 2 * e + (b_goes ? 1 : 0);
  Verdict verdict = Verdict::accept;
  for (const Index h : {first, first ^ 1}) {
    const Verdict answer = collapse_into(h, longest);
    if (answer == Verdict::accept) return answer;
    if (verdict != Verdict::deviation) verdict = answer;
  }
  if (verdict == Verdict::feature || verdict == Verdict::topology) {
    operations_.refuse(verdict);
    return verdict;
  }
  const Verdict answer = collapse_to_better_place(first, longest);
  if (answer == Verdict::accept) return answer;
  if (verdict != Verdict::deviation) verdict = answer;
  operations_.refuse(verdict);
  return verdict;
}

inline bool Editor::flip(Index e)
{
  constexpr double good_enough = 3, gain = .02, weight = .5;
  make_flip_disc(mesh_, 2 * e, disc_);
  const Verdict topology = check_flip_topology(mesh_, disc_);
  if (topology != Verdict::accept || mesh_.is_border(e)) return false;
  const Apex apex = apex_of(disc_.apex);
  double before = weight * length_energy(length(e)), worst_before = 1;
  for_each_old_face([&](Index f) {
    const double q = quality(f);
    before += shape_energy(q);
    worst_before = std::max(worst_before, q);
  });
  double after = weight * length_energy(length(disc_.ring[2], apex)), worst_after = 1;
  for_each_new_face([&](const std::array<Index, 3>& v) {
    const double q = quality(v, apex);
    after += shape_energy(q);
    worst_after = std::max(worst_after, q);
  });
  if (!(after < (1 - gain) * before)) return false;
  if (worst_after > good_enough && worst_after > worst_before) return false;
  const Verdict verdict = check(apex);
  if (verdict != Verdict::accept) return refuse(verdict);
  make_flip(e);
  return true;
}

inline void Editor::make_flip(Index e)
{
  bound_.commit(disc_);
  mesh_.flip(2 * e);
  if (guard_) guard_->commit(disc_);
  ++operations_.flips;
}

inline bool Editor::relocate(Index v)
{
  if (mesh_.is_fixed(v)) return false;
  make_relocation_disc(mesh_, v, disc_);
  const Apex from = apex_of(v);
  const auto energy = [&](const Apex& apex) {
    double sum = 0;
    for_each_new_face(
        [&](const std::array<Index, 3>& corners) { sum += shape_energy(quality(corners, apex)); });
    for (const Index r : disc_.ring)
      if (!mesh_.is_ghost_vertex(r)) sum += length_energy(length(r, apex));
    return sum;
  };
  Vector aim = Vector::Zero();
  const bool is_on_curve = mesh_.is_on_feature(v);
  if (is_on_curve) {
    if (disc_.ridge[1] == none || stand_[v].edge == none) return false;
    const Index p = disc_.ring[disc_.ridge[0]], q = disc_.ring[disc_.ridge[1]];
    const double to_p = length(p, from), to_q = length(q, from);
    const Vector& end = mesh_.point(to_p > to_q ? p : q);
    aim = from.point + std::abs(to_p - to_q) / (2 * std::max(to_p, to_q)) * (end - from.point);
  } else {
    int number = 0;
    for_each_new_face([&](const std::array<Index, 3>& corners) {
      aim += measure_.ideal_apex(
          mesh_.point(corners[1]), mesh_.point(corners[2]), from.point,
          {&metric_[v], &metric_[corners[1]], &metric_[corners[2]]});
      ++number;
    });
    aim /= number;
  }

  // Not all of what evens the gaps on both sides of T, for each face has other vertices, too.
  constexpr double gain = 3e-3, evened = .4;
  const double before = energy(from);
  Verdict verdict = Verdict::accept;
  for (const double step : {1., .4, .16}) {
    const Vector target = from.point + step * (aim - from.point);
    const Standpoint stand = is_on_curve ? ground_.nearest_on_curve(target, stand_[v].edge)
                                         : ground_.nearest(target, stand_[v].face);
    Apex apex = apex_above(stand, share_[v], offset_[v]);
    if (!(energy(apex) < (1 - gain) * before)) continue;
    if (places_freely_ && !is_on_curve) shift(apex, evened);
    verdict = check(apex);
    if (verdict != Verdict::accept) continue;
    move_apex(apex);
    return true;
  }
  if (verdict != Verdict::accept) operations_.refuse(verdict);
  return false;
}

} // namespace surety::internal::unit_mesh

#include <surety/internal/unit_mesh/mend.h>

#endif // SURETY_INTERNAL_UNIT_MESH_EDITOR_H
