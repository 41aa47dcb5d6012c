// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices by the cost of their cheapest collapse. Every vertex is in the queue at most once and
// can change its cost, where a queue of stale entries would grow to several times its size.
//
// Costs count by their order of magnitude only. Among vertices of one level the order is that of
// their indices, which follow a space-filling curve: successive collapses are neighbours and find
// their data in the cache, and they leave fewer faces than those in the exact order of their cost.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_VERTEX_QUEUE_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_VERTEX_QUEUE_H

#include <surety/internal/linear.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace surety::internal {

/// A heap with four children a node; ties go to the smaller index, so that the order is determined.
class Vertex_queue
{
public:
  explicit Vertex_queue(std::size_t vertices) : level_(vertices), place_(vertices, none) {}

  bool empty() const { return heap_.empty(); }
  std::size_t size() const { return heap_.size(); }
  bool contains(Index v) const { return place_[v] != none; }

  /// Puts v into the queue, or moves it.
  void set(Index v, double cost)
  {
    const std::int16_t level = level_of(cost), old = level_[v];
    level_[v] = level;
    if (place_[v] == none) {
      place_[v] = static_cast<Index>(heap_.size());
      heap_.push_back(v);
      rise(place_[v]);
    } else if (level < old) {
      rise(place_[v]);
    } else if (level > old) {
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

  /// A level for every factor of 16.
  static std::int16_t level_of(double cost)
  {
    constexpr int lowest = -1200; // below the exponent of every double
    if (!(cost > 0)) return lowest / 4;
    int exponent = 0;
    std::frexp(cost, &exponent);
    return static_cast<std::int16_t>((exponent - lowest) / 4 + lowest / 4);
  }

  bool before(Index a, Index b) const
  {
    return level_[a] != level_[b] ? level_[a] < level_[b] : a < b;
  }
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

  std::vector<std::int16_t> level_;
  std::vector<Index> place_, heap_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_VERTEX_QUEUE_H
