// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which creases make curves that are long enough. A crease of a part goes on until it closes or
// meets others; what noise makes is short, or ends in nothing. How long is enough grows with the
// tolerance and with the roughness beside the crease, so that one edge between two flat faces will
// do and a wrinkle of a scan will not.
#ifndef SURETY_INTERNAL_FEATURES_BY_NEED_CURVES_H
#define SURETY_INTERNAL_FEATURES_BY_NEED_CURVES_H

#include <surety/internal/features_by_need/crease.h>

#include <cstddef>
#include <vector>

namespace surety::internal {

class Curve_filter
{
public:
  /// `creases` by edge; `is_anchor` by vertex: where curves may end, as on borders.
  Curve_filter(
      const Flat_mesh& mesh, const std::vector<Crease>& creases, const std::vector<bool>& is_anchor)
    : mesh_(mesh),
      crease_(creases),
      is_anchor_(is_anchor),
      keep_(creases.size(), false),
      at_(mesh.point.size())
  {
    for (Index e = 0; e < creases.size(); ++e) {
      if (!creases[e].is_candidate) continue;
      keep_[e] = true;
      for (const Index v : mesh.ends[e]) at_[v].push_back(e);
    }
  }

  std::vector<bool> kept()
  {
    while (remove_short_curves()) {}
    remove_short_components();
    return keep_;
  }

private:
  static constexpr double free_curve = 2;    // times as long: one that ends in nothing
  static constexpr double bound_curve = 0.5; // one that ends on others
  static constexpr double reaches = 3;       // a curve is at least so many times the reach long
  static constexpr double rough_edges = 30;  // and this times the roughness, in edges

  struct Tally {
    double length = 0, wanted = 0;
    std::size_t edges = 0;

    void add(const Crease& c)
    {
      length += c.length;
      wanted += reaches * c.reach + rough_edges * c.roughness * c.length;
      ++edges;
    }
    bool is_long(double times) const { return length >= times * wanted / double(edges); }
  };

  std::size_t degree(Index v) const
  {
    std::size_t number = 0;
    for (const Index e : at_[v]) number += keep_[e];
    return number;
  }

  Index other_end(Index e, Index v) const
  {
    return mesh_.ends[e][0] == v ? mesh_.ends[e][1] : mesh_.ends[e][0];
  }

  bool is_end(Index v) const { return is_anchor_[v] || degree(v) != 2; }
  bool is_free_end(Index v) const { return !is_anchor_[v] && degree(v) == 1; }

  /// One pass over the curves between ends; whether one was removed.
  bool remove_short_curves()
  {
    bool is_changed = false;
    for (Index v = 0; v < at_.size(); ++v) {
      if (at_[v].empty() || !is_end(v)) continue;
      for (const Index first : at_[v]) {
        if (!keep_[first]) continue;
        const double times = trace(v, first);
        if (tally_.is_long(times)) continue;
        for (const Index e : curve_) keep_[e] = false;
        is_changed = true;
      }
    }
    return is_changed;
  }

  /// Follows a curve from an end; returns how many times the length it must have.
  double trace(Index from, Index first)
  {
    curve_.clear();
    tally_ = Tally();
    Index at = from, edge = first;
    while (true) {
      curve_.push_back(edge);
      tally_.add(crease_[edge]);
      at = other_end(edge, at);
      if (is_end(at) || at == from) break; // from may have lost its other curves
      const Index last = edge;
      for (const Index e : at_[at])
        if (keep_[e] && e != last) edge = e;
    }
    return is_free_end(from) || is_free_end(at) ? free_curve : bound_curve;
  }

  void remove_short_components()
  {
    std::vector<bool> is_seen(keep_.size(), false);
    std::vector<Index> component;
    for (Index first = 0; first < keep_.size(); ++first) {
      if (!keep_[first] || is_seen[first]) continue;
      component.assign(1, first);
      is_seen[first] = true;
      Tally tally;
      for (std::size_t k = 0; k < component.size(); ++k) {
        tally.add(crease_[component[k]]);
        for (const Index v : mesh_.ends[component[k]]) {
          for (const Index e : at_[v]) {
            if (!keep_[e] || is_seen[e]) continue;
            is_seen[e] = true;
            component.push_back(e);
          }
        }
      }
      if (tally.is_long(1)) continue;
      for (const Index e : component) keep_[e] = false;
    }
  }

  const Flat_mesh& mesh_;
  const std::vector<Crease>& crease_;
  const std::vector<bool>& is_anchor_;
  std::vector<Index> curve_;
  Tally tally_;                        // of that curve
  std::vector<bool> keep_;             // by edge
  std::vector<std::vector<Index>> at_; // by vertex: its candidates
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_FEATURES_BY_NEED_CURVES_H
