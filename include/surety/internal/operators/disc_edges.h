// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an edge of M is to a disc, asked once a crossing and so answered without a search.
#ifndef SURETY_INTERNAL_OPERATORS_DISC_EDGES_H
#define SURETY_INTERNAL_OPERATORS_DISC_EDGES_H

#include <surety/internal/operators/disc.h>

#include <vector>

namespace surety::internal {

/// A sparse set: an edge leads to a slot, which is valid if it names the edge.
class Disc_edges
{
public:
  struct Role {
    Index edge = none;
    Index link = none;      ///< place in the link
    Index new_spoke = none; ///< place among the new spokes
    bool is_old_spoke = false;
  };

  explicit Disc_edges(Index edges) : slot_(edges, 0) {}

  void clear() { roles_.clear(); }
  void assign(const Disc& disc)
  {
    clear();
    for (Index i = 0; i < disc.size(); ++i) role_of(disc.link[i]).link = i;
    disc.for_each_new_spoke([&](Index i) { role_of(disc.spoke[i]).new_spoke = i; });
    for (const Index e : disc.old_spoke) role_of(e).is_old_spoke = true;
  }

  const Role& operator[](Index edge) const
  {
    const Index slot = slot_[edge];
    return slot < roles_.size() && roles_[slot].edge == edge ? roles_[slot] : outside_;
  }

private:
  Role& role_of(Index edge)
  {
    const Index slot = slot_[edge];
    if (slot < roles_.size() && roles_[slot].edge == edge) return roles_[slot];
    slot_[edge] = static_cast<Index>(roles_.size());
    roles_.push_back({edge, none, none, false});
    return roles_.back();
  }

  std::vector<Index> slot_;
  std::vector<Role> roles_;
  Role outside_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_OPERATORS_DISC_EDGES_H
