// SPDX-License-Identifier: GPL-3.0-or-later
//
// The samples round a side: rings of the mesh, or balls, that no feature edge cuts.
#ifndef SURETY_INTERNAL_CURVATURE_NEIGHBOURHOOD_H
#define SURETY_INTERNAL_CURVATURE_NEIGHBOURHOOD_H

#include <surety/internal/curvature/least_squares.h>
#include <surety/internal/curvature/side_graph.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace surety::internal::curvature {

/// \brief A set of vertices that forgets all of them at once.
///
/// A mark a vertex: a neighbourhood asks some six times as often as it has vertices.
class Vertex_set
{
public:
  explicit Vertex_set(std::size_t vertices) : mark_(vertices, 0) {}

  void clear()
  {
    size_ = 0;
    if (++generation_ != 0) return;
    std::fill(mark_.begin(), mark_.end(), 0);
    generation_ = 1;
  }
  bool is_full() const { return size_ >= capacity; }
  /// False if the vertex is in the set already.
  bool insert(Index vertex)
  {
    const bool is_new = mark_[vertex] != generation_;
    mark_[vertex] = generation_;
    size_ += is_new;
    return is_new;
  }

private:
  static constexpr int capacity = 768;
  std::vector<Index> mark_;
  Index generation_ = 0;
  int size_ = 0;
};

/// \brief Gathers sides round a side, nearest first.
///
/// A step goes from a side to those that share a face with it, so that nothing is reached across a
/// feature edge; nor does a step pass the end of a ridge. A vertex counts once. Sides whose normal
/// is far from that of the first are left out: there the surface is no height field.
class Neighbourhood
{
public:
  explicit Neighbourhood(const Side_graph& graph) : graph_(graph), seen_(graph.point.size()) {}

  /// Forgets what was gathered and starts at a side, whose normal must not be zero.
  void start(Index centre, const Vector& normal)
  {
    centre_ = centre;
    normal_ = normal;
    seen_.clear();
    seen_.insert(graph_.vertex[centre]);
    sides_.clear();
    ring_begin_ = 0;
    rings_ = 0;
    next_ = 0;
    has_no_room_ = false;
  }

  /// The sides that were gathered, without the first.
  const std::vector<Index>& sides() const { return sides_; }
  int size() const { return static_cast<int>(sides_.size()); }
  int rings() const { return rings_; }

  /// Adds the next ring; false if there is none, or no room for it.
  bool add_ring()
  {
    const std::size_t end = sides_.size();
    if (rings_ == 0) {
      visit(centre_);
    } else {
      for (std::size_t i = ring_begin_; i < end && !is_full(); ++i) visit(sides_[i]);
    }
    ring_begin_ = end;
    ++rings_;
    return sides_.size() > end;
  }

  /// \brief Grows to what lies within a ball and can be reached in it.
  ///
  /// Begins anew the first time, and goes on from there. False if there is no room for all.
  bool grow_ball(double square_radius)
  {
    if (rings_ > 0 || sides_.empty()) {
      start(centre_, normal_);
      beyond_.clear();
      visit(centre_);
      defer(0, square_radius);
    } else {
      retry(square_radius);
    }
    for (; next_ < sides_.size() && !is_full(); ++next_) {
      const std::size_t end = sides_.size();
      visit(sides_[next_]);
      defer(end, square_radius);
    }
    return !has_no_room_ && !is_full();
  }

private:
  /// Takes in what lay outside a smaller ball.
  void retry(double square_radius)
  {
    const Vector& p = graph_.point_of(centre_);
    std::size_t end = 0;
    for (const Index side : beyond_) {
      if ((graph_.point_of(side) - p).squaredNorm() <= square_radius)
        push(side);
      else
        beyond_[end++] = side;
    }
    beyond_.resize(end);
  }

  /// Keeps what was added from `begin` on and lies outside a ball for a larger one.
  void defer(std::size_t begin, double square_radius)
  {
    const Vector& p = graph_.point_of(centre_);
    std::size_t end = begin;
    for (std::size_t i = begin; i < sides_.size(); ++i) {
      const Index side = sides_[i];
      if ((graph_.point_of(side) - p).squaredNorm() <= square_radius)
        sides_[end++] = side;
      else
        beyond_.push_back(side);
    }
    sides_.resize(end);
  }

  bool is_full() const { return seen_.is_full() || sides_.size() == std::size_t(maximum_samples); }

  /// Of a vertex with very many neighbours every so many-th is taken, so that no vertex costs more
  /// than a constant.
  void visit(Index side)
  {
    if (is_full() || (side != centre_ && graph_.is_ridge_end[side])) return;
    const Index step = 1 + graph_.degree(side) / largest_degree;
    // Whether a vertex is new cannot be foretold: no branch depends on it.
    std::array<Index, largest_degree + 1> fresh;
    std::size_t number = 0;
    for (Index i = graph_.first[side]; i < graph_.first[side + 1]; i += step) {
      const Index other = graph_.neighbour[i];
      if (other == Sides::no_side) continue;
      fresh[number] = other;
      number += seen_.insert(graph_.vertex[other]);
    }
    for (std::size_t i = 0; i < number; ++i) {
      if (graph_.normal[fresh[i]].dot(normal_) >= smallest_cosine) push(fresh[i]);
    }
  }

  void push(Index side)
  {
    if (sides_.size() < std::size_t(maximum_samples))
      sides_.push_back(side);
    else
      has_no_room_ = true;
  }

  static constexpr Index largest_degree = 64;
  static constexpr double smallest_cosine = 0.2;

  const Side_graph& graph_;
  Index centre_ = 0;
  Vector normal_ = Vector::Zero();
  Vertex_set seen_;
  std::vector<Index> sides_;
  std::vector<Index> beyond_; ///< reached, but outside the ball
  std::size_t next_ = 0;      ///< of the ball: the first whose neighbours are due
  std::size_t ring_begin_ = 0;
  int rings_ = 0;
  bool has_no_room_ = false; ///< for all that was reached
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_NEIGHBOURHOOD_H
