// SPDX-License-Identifier: GPL-3.0-or-later
//
// The samples round a side: rings of the mesh, or balls, that no feature edge cuts.
#ifndef SURETY_INTERNAL_CURVATURE_NEIGHBOURHOOD_H
#define SURETY_INTERNAL_CURVATURE_NEIGHBOURHOOD_H

#include <surety/internal/curvature/least_squares.h>
#include <surety/internal/curvature/side_graph.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace surety::internal::curvature {

/// A set of vertices that forgets all of them at once.
class Vertex_set
{
public:
  void clear()
  {
    ++generation_;
    size_ = 0;
  }
  bool is_full() const { return size_ == capacity; }
  /// False if the vertex is in the set already.
  bool insert(Index vertex)
  {
    std::size_t slot = vertex * 0x9e3779b1u >> 22;
    while (slots_[slot].first == generation_) {
      if (slots_[slot].second == vertex) return false;
      slot = (slot + 1) % slots_.size();
    }
    slots_[slot] = {generation_, vertex};
    ++size_;
    return true;
  }

private:
  static constexpr int capacity = 768;
  std::array<std::pair<Index, Index>, 1024> slots_{};
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
  explicit Neighbourhood(const Side_graph& graph) : graph_(graph) {}

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

  /// \brief Grows, nearest in space first, until there are `number` samples or no more.
  ///
  /// Begins anew the first time, and goes on from there.
  void grow_ball(int number)
  {
    if (rings_ > 0 || sides_.empty()) {
      start(centre_, normal_);
      queue_.clear();
      expand(centre_);
    }
    while (!queue_.empty() && size() < number) {
      std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
      const Index side = queue_.back().second;
      queue_.pop_back();
      sides_.push_back(side);
      expand(side);
    }
  }

private:
  /// Queues what is next to a side.
  void expand(Index side)
  {
    const Vector& p = graph_.point_of(centre_);
    const std::size_t end = sides_.size();
    visit(side);
    for (std::size_t i = end; i < sides_.size(); ++i) {
      queue_.push_back({(graph_.point_of(sides_[i]) - p).squaredNorm(), sides_[i]});
      std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
    }
    sides_.resize(end);
  }

  bool is_full() const { return seen_.is_full() || sides_.size() == maximum_samples; }

  /// Of a vertex with very many neighbours every so many-th is taken, so that no vertex costs more
  /// than a constant.
  void visit(Index side)
  {
    if (side != centre_ && graph_.is_ridge_end[side]) return;
    const Index step = 1 + graph_.degree(side) / largest_degree;
    for (Index i = graph_.first[side]; i < graph_.first[side + 1] && !is_full(); i += step) {
      const Index other = graph_.neighbour[i];
      if (other == Sides::no_side || !seen_.insert(graph_.vertex[other])) continue;
      if (graph_.normal[other].dot(normal_) < smallest_cosine) continue;
      sides_.push_back(other);
    }
  }

  static constexpr Index largest_degree = 64;
  static constexpr double smallest_cosine = 0.2;

  const Side_graph& graph_;
  Index centre_ = 0;
  Vector normal_ = Vector::Zero();
  Vertex_set seen_;
  std::vector<Index> sides_;
  std::vector<std::pair<double, Index>> queue_;
  std::size_t ring_begin_ = 0;
  int rings_ = 0;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_NEIGHBOURHOOD_H
