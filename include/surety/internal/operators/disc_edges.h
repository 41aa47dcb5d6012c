// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an edge of M is to a disc, asked once a crossing and so answered without a search.
#ifndef SURETY_INTERNAL_OPERATORS_DISC_EDGES_H
#define SURETY_INTERNAL_OPERATORS_DISC_EDGES_H

#include <surety/internal/operators/disc.h>
#include <surety/internal/slot_table.h>

#include <vector>

namespace surety::internal {

class Disc_edges
{
public:
  struct Role {
    Index link = none;      ///< place in the link
    Index new_spoke = none; ///< place among the new spokes
    bool is_old_spoke = false;
  };

  void clear()
  {
    slots_.clear();
    roles_.clear();
  }
  void assign(const Disc& disc)
  {
    clear();
    for (Index i = 0; i < disc.size(); ++i) role_of(disc.link[i]).link = i;
    disc.for_each_new_spoke([&](Index i) { role_of(disc.spoke[i]).new_spoke = i; });
    for (const Index e : disc.old_spoke) role_of(e).is_old_spoke = true;
  }

  const Role& operator[](Index edge) const
  {
    const Index slot = slots_.find(edge);
    return slot != none ? roles_[slot] : outside_;
  }

private:
  Role& role_of(Index edge)
  {
    const Index slot = slots_.find(edge);
    if (slot != none) return roles_[slot];
    slots_.insert(edge, static_cast<Index>(roles_.size()));
    roles_.emplace_back();
    return roles_.back();
  }

  Slot_table slots_;
  std::vector<Role> roles_;
  Role outside_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_OPERATORS_DISC_EDGES_H
