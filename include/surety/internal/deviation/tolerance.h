// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tolerance as the bound compares with it: the same everywhere, or linear over each triangle of
// T between values at its vertices. A linear tolerance needs no more proof than a constant one: on
// a cell the displacement is convex and the tolerance linear, so that what holds at the corners
// holds inside.
#ifndef SURETY_INTERNAL_DEVIATION_TOLERANCE_H
#define SURETY_INTERNAL_DEVIATION_TOLERANCE_H

#include <surety/internal/deviation/rounding.h>
#include <surety/internal/linear.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace surety::internal {

class Tolerance
{
public:
  Tolerance(const Rounding& rounding, double everywhere) : rounding_(rounding), largest_(everywhere)
  {
    update();
  }
  /// One value a vertex of T.
  Tolerance(const Rounding& rounding, std::vector<double> at_vertices)
    : rounding_(rounding),
      largest_(*std::max_element(at_vertices.begin(), at_vertices.end())),
      at_vertices_(std::move(at_vertices))
  {
    update();
  }

  /// Bounds curves, ridges and borders, by less than the surface.
  void limit_curves(double largest)
  {
    largest_on_curves_ = largest;
    update();
  }

  /// The same for some of the vertices.
  Tolerance restricted_to(const std::vector<Index>& vertices) const
  {
    Tolerance result = *this;
    result.at_vertices_.clear();
    if (is_uniform()) return result;
    for (const Index v : vertices) result.at_vertices_.push_back(at_vertices_[v]);
    return result;
  }

  /// The share of the tolerance that counts in this stage.
  void set_stage(double share)
  {
    stage_ = share;
    update();
  }
  /// A factor by which that may be exceeded for a while.
  void overshoot(double factor)
  {
    overshoot_ = factor;
    update();
  }

  /// The square that a computed squared distance must not exceed: at a vertex of T, between two,
  /// between three.
  double squared_limit(Index v) const
  {
    return is_uniform() ? squared_ : rounding_.squared_limit(factor_ * at_vertices_[v]);
  }
  double squared_limit(Index s, Index t, double lambda) const
  {
    if (is_uniform()) return squared_;
    return rounding_.squared_limit(
        factor_ * (at_vertices_[s] + lambda * (at_vertices_[t] - at_vertices_[s])));
  }
  double squared_limit(Index a, Index b, Index c, double v, double w) const
  {
    if (is_uniform()) return squared_;
    const double at_a = at_vertices_[a];
    return rounding_.squared_limit(
        factor_ * (at_a + v * (at_vertices_[b] - at_a) + w * (at_vertices_[c] - at_a)));
  }

  /// At a vertex of a curve of T, which goes to one of M.
  double squared_limit_on_curve(Index v) const
  {
    return std::min(squared_limit(v), squared_on_curves_);
  }

  double squared_limit_of_largest() const { return squared_; }

  bool is_uniform() const { return at_vertices_.empty(); }
  double largest() const { return largest_; }
  double at_vertex(Index v) const { return is_uniform() ? largest_ : at_vertices_[v]; }

private:
  void update()
  {
    factor_ = stage_ * overshoot_;
    squared_ = rounding_.squared_limit(factor_ * largest_);
    squared_on_curves_ = rounding_.squared_limit(factor_ * std::min(largest_, largest_on_curves_));
  }

  Rounding rounding_;
  double largest_;
  double largest_on_curves_ = std::numeric_limits<double>::infinity();
  double squared_on_curves_ = 0;
  double stage_ = 1, overshoot_ = 1, factor_ = 1, squared_ = 0;
  std::vector<double> at_vertices_; ///< empty: the same everywhere
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_TOLERANCE_H
