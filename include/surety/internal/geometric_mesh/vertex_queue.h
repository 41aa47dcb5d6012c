// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices by the cost of their cheapest collapse. Every vertex is in the queue at most once and
// can change its cost, where a queue of stale entries would grow to several times its size.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_VERTEX_QUEUE_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_VERTEX_QUEUE_H

#include <surety/internal/linear.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace surety::internal {

/// A heap with four children a node; ties go to the smaller index, so that the order is determined.
class Vertex_queue
{
public:
  explicit Vertex_queue(std::size_t vertices) : cost_(vertices), place_(vertices, none) {}

  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }
  bool contains(Index v) const { return place_[v] != none; }

  /// Puts v into the queue, or moves it.
  void set(Index v, float cost)
  {
    const float old = std::exchange(cost_[v], cost);
    if (place_[v] == none) {
      place_[v] = static_cast<Index>(heap_.size());
      heap_.push_back(v);
      rise(place_[v]);
    } else if (cost < old) {
      rise(place_[v]);
    } else if (cost > old) {
      sink(place_[v]);
    }
  }

  void remove(Index v)
  {
    const Index place = place_[v];
    if (place == none) return;
    place_[v] = none;
    const Index last = heap_.back();
    heap_.pop_back();
    if (last == v) return;
    put(place, last);
    rise(place);
    sink(place_[last]);
  }

  Index pop()
  {
    const Index v = heap_.front();
    remove(v);
    return v;
  }

private:
  static constexpr Index arity = 4;

  bool before(Index a, Index b) const { return cost_[a] != cost_[b] ? cost_[a] < cost_[b] : a < b; }
  void put(Index place, Index v)
  {
    heap_[place] = v;
    place_[v] = place;
  }
  void rise(Index place)
  {
    const Index v = heap_[place];
    while (place > 0 && before(v, heap_[(place - 1) / arity])) {
      put(place, heap_[(place - 1) / arity]);
      place = (place - 1) / arity;
    }
    put(place, v);
  }
  void sink(Index place)
  {
    const Index v = heap_[place];
    const auto size = static_cast<Index>(heap_.size());
    for (;;) {
      const Index first = arity * place + 1, last = std::min(first + arity, size);
      Index least = first;
      for (Index child = first + 1; child < last; ++child)
        if (before(heap_[child], heap_[least])) least = child;
      if (first >= size || !before(heap_[least], v)) break;
      put(place, heap_[least]);
      place = least;
    }
    put(place, v);
  }

  std::vector<float> cost_;
  std::vector<Index> place_, heap_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_VERTEX_QUEUE_H
