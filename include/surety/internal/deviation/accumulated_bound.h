// SPDX-License-Identifier: GPL-3.0-or-later
//
// The accumulated bound, the paper's (section 2.1, equations 4 and 5), made rigorous: every
// operation adds the distance between what it takes away and what it puts there.
//
// Invariant: there is a homeomorphism h : T -> M such that |x - h(x)| <= b(K) for all x with h(x)
// in the closed face K. It holds for M = T with b = 0. An operation composes h with the elementary
// map g from the old faces of its disc to the new ones (drawing.h). For y = h(x) in the cell of the
// old face i and the new face j, |x - g(y)| <= |x - y| + |y - g(y)| <= b(i) + d, with d the largest
// displacement on the cell, so that
//   b(j) = max over the cells ij in the new face j of b(i) + max over the corners of ij of |y -
//   g(y)|
// keeps the invariant. Since h is onto, every point of T has one of M within max b and the other
// way round: H(M, T) <= max b. Ridges and borders go to ridges and borders, so that these curves
// are within max b of their originals, too.
//
// Rounding: drawings are stored doubles and their signs exact; weights and lengths are intervals
// around the values of exact formulas of stored doubles, and b is the upper end.
#ifndef SURETY_INTERNAL_DEVIATION_ACCUMULATED_BOUND_H
#define SURETY_INTERNAL_DEVIATION_ACCUMULATED_BOUND_H

#include <surety/internal/deviation/drawing.h>
#include <surety/internal/deviation/policy.h>
#include <surety/internal/deviation/reference.h>

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <vector>

namespace surety::internal {

class Accumulated_bound final : public Deviation_policy
{
public:
  /// The reserve of 2^-20 keeps independent verifiers, which round too, away from ties.
  Accumulated_bound(const Reference& reference, const Working_mesh& mesh, double tolerance)
    : reference_(reference),
      mesh_(mesh),
      tolerance_(tolerance),
      limit_(tolerance * (1 - 0x1p-20)),
      bound_(mesh.number_of_real_faces(), 0.0)
  {}

  Verdict check(const Disc& disc) override
  {
    if (disc.is_closed()) return Verdict::correspondence; // the paper has no such operation
    disc_ = &disc;
    old_.clear();
    for (const Index f : disc.old_face) old_.push_back(mesh_.is_ghost_face(f) ? 0.0 : bound_[f]);
    new_.assign(disc.size(), 0.0);
    return disc_is_within_limit() ? Verdict::accept : Verdict::deviation;
  }

  void commit(const Disc& disc) override
  {
    for (const Index f : disc.old_face)
      if (!mesh_.is_ghost_face(f)) bound_[f] = 0;
    for (Index j = disc.first; j <= disc.last; ++j) bound_[disc.face[j]] = new_[j];
  }

  void set_stage(double share) override { limit_ = share * tolerance_ * (1 - 0x1p-20); }

  /// Zero for faces that are gone.
  std::vector<double> face_bounds() override { return bound_; }

private:
  using Interval = CGAL::Interval_nt<false>;

  /// A ridge parts the disc in two. A side of ghosts has nothing to move.
  bool disc_is_within_limit()
  {
    const Index k = disc_->size(), m = ridge_place();
    if (m == 0) return part_is_within_limit({0, k, k});
    return (disc_->first > 1 || part_is_within_limit({0, m, k}))
        && (disc_->last + 2 < k || part_is_within_limit({m, k, k}));
  }

  bool part_is_within_limit(const Part& part);
  Vector direction(const Part& part, Index candidate) const;
  bool draw(const Part& part, const Vector& normal);
  template <class Number>
  bool measure();
  template <class Number>
  bool measure_collapse();
  template <class Number>
  bool measure_flip();

  /// Where the ridge leaves the disc at its far end; 0 where there is none.
  Index ridge_place() const { return disc_->ridge[0] == none ? 0 : disc_->ridge[0]; }
  bool is_flip() const { return disc_->removed == none; }

  /// b(new face j) is at least `old`, a bound of an old face, plus the displacement.
  template <class Number>
  bool raise(Index j, double old, const Number& displacement)
  {
    const double bound = upper_end(Number(old) + displacement);
    new_[j] = std::max(new_[j], bound);
    return bound <= limit_; // false for a bound that is not a number
  }
  static double upper_end(double x) { return x; }
  static double upper_end(const Interval& x) { return x.sup(); }

  /// Relative to Q, which is ring vertex 0 and k.
  template <class Number>
  std::array<Number, 3> from_apex(Index vertex) const
  {
    const Vector &p = reference_.point(vertex), &q = reference_.point(disc_->apex);
    return {
        Number(p.x()) - Number(q.x()), Number(p.y()) - Number(q.y()),
        Number(p.z()) - Number(q.z())};
  }
  Vector ring_vector(Index i) const
  {
    if (i == disc_->size()) return Vector::Zero();
    return reference_.point(disc_->ring[i]) - reference_.point(disc_->apex);
  }
  Vector area_vector(Index j) const { return ring_vector(j).cross(ring_vector(j + 1)); }

  /// The length of the sum of weight[n] times the vector from Q to vertex[n]. Weights of the point
  /// before come as they are, those after with a minus sign, and Q takes the rest of either.
  template <class Number>
  Number displacement(const std::array<Number, 3>& weight, const std::array<Index, 3>& vertex) const
  {
    std::array<Number, 3> sum{Number(0), Number(0), Number(0)};
    for (int n = 0; n < 3; ++n) {
      const auto vector = from_apex<Number>(vertex[n]);
      for (int axis = 0; axis < 3; ++axis) sum[axis] += weight[n] * vector[axis];
    }
    return CGAL::sqrt(CGAL::square(sum[0]) + CGAL::square(sum[1]) + CGAL::square(sum[2]));
  }

  const Reference& reference_;
  const Working_mesh& mesh_;
  double tolerance_, limit_;
  std::vector<double> bound_;

  // What check() worked out, kept for commit().
  const Disc* disc_ = nullptr;
  std::vector<double> old_, new_; ///< bounds of the disc's faces, by their numbers in it
  Drawing drawing_;
};

/// Tries projections until one is injective, and takes that one. Most refusals end in the rehearsal
/// with plain doubles: to refuse needs no proof.
inline bool Accumulated_bound::part_is_within_limit(const Part& part)
{
  const Index candidates = 2 + part.last_new() + 1 - part.first_new();
  for (Index candidate = 0; candidate < candidates; ++candidate) {
    if (!draw(part, direction(part, candidate))) continue;
    if (!measure<double>()) return false;
    const Interval::Protector rounding_upwards;
    return measure<Interval>();
  }
  return false;
}

/// The normals to project along: the vector area of the ring, which is that of the old faces as
/// well as that of the new ones; the mean of the new faces' normals; each of these. Areas are
/// squares, which the stable norm does not square again: sizes from 1e-150 to 1e150 will do.
inline Vector Accumulated_bound::direction(const Part& part, Index candidate) const
{
  if (candidate >= 2) return area_vector(part.first_new() + candidate - 2).stableNormalized();
  Vector sum = Vector::Zero();
  for (Index j = part.first_new(); j <= part.last_new(); ++j)
    sum += candidate == 0 ? area_vector(j) : unit(area_vector(j));
  return sum.stableNormalized();
}

/// Projects a part along `normal`, or, beside a ridge, perpendicularly to QR and as much along
/// `normal` as this allows. QR is drawn on the first axis, and P on it.
inline bool Accumulated_bound::draw(const Part& part, const Vector& normal)
{
  const Index m = ridge_place();
  const Vector along = m == 0 ? Vector(normal.unitOrthogonal()) : unit(ring_vector(m));
  const Vector across = unit(normal.cross(along));
  drawing_.start(part);
  for (Index i = part.first_new(); i <= part.last_new() + 1; ++i) {
    const Vector r = ring_vector(i);
    drawing_.place_ring(i, along.dot(r), i == m ? 0.0 : across.dot(r));
  }
  if (is_flip()) return drawing_.is_valid_flip();
  const Vector p = reference_.point(disc_->removed) - reference_.point(disc_->apex);
  drawing_.place_removed(along.dot(p), m == 0 ? across.dot(p) : 0.0);
  return drawing_.is_valid();
}

template <class Number>
bool Accumulated_bound::measure()
{
  const Part& part = drawing_.part();
  for (Index j = part.first_new(); j <= part.last_new(); ++j) new_[j] = 0;
  return is_flip() ? measure_flip<Number>() : measure_collapse<Number>();
}

/// P, which is a corner of every old face, and the crossings, where two old and two new faces meet.
template <class Number>
bool Accumulated_bound::measure_collapse()
{
  const Part& part = drawing_.part();
  const auto& ring = disc_->ring;
  const Index p = disc_->removed;
  const auto first = old_.begin() + part.first_old(), last = old_.begin() + part.last_old();
  const double worst = *std::max_element(first, last + 1);
  for (Index j = part.first_new(); j <= part.last_new(); ++j) {
    if (!drawing_.contains_removed(j)) continue;
    const auto [v, w] = drawing_.weights_of_removed<Number>(j);
    const Number d = displacement<Number>({Number(1), -v, -w}, {p, ring[j], ring[j + 1]});
    if (!raise(j, worst, d)) return false;
  }
  return drawing_.all_of_crossings([&](Index i, Index j) {
    const auto [a, b] = drawing_.weights_of_crossing<Number>(i, j);
    const Number d = displacement<Number>({Number(1) - a, a, -b}, {p, ring[i], ring[j]});
    const double old = std::max(old_[i - 1], old_[i]);
    return raise(j - 1, old, d) && raise(j, old, d);
  });
}

template <class Number>
bool Accumulated_bound::measure_flip()
{
  const auto& ring = disc_->ring;
  const auto [a, b] = drawing_.weights_of_flip<Number>();
  const Number d = displacement<Number>({Number(1) - a, a, -b}, {ring[1], ring[3], ring[2]});
  const double old = std::max(old_[0], old_[1]);
  return raise(1, old, d) && raise(2, old, d);
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_ACCUMULATED_BOUND_H
