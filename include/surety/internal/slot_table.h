// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which place the elements of a short list have in it. A table of the size of the list stays in the
// cache, where one entry an element of the mesh would not, and takes no memory a face.
#ifndef SURETY_INTERNAL_SLOT_TABLE_H
#define SURETY_INTERNAL_SLOT_TABLE_H

#include <surety/internal/linear.h>

#include <vector>

namespace surety::internal {

/// A hash table with linear probing, at most half full.
class Slot_table
{
public:
  /// The slot of an element, or `none`.
  Index find(Index element) const
  {
    const Entry& entry = entries_[place_of(element)];
    return entry.element == element ? entry.slot : none;
  }
  /// Gives an element a slot; false where it has one already.
  bool insert_if_new(Index element, Index slot)
  {
    Index i = place_of(element);
    if (entries_[i].element == element) return false;
    if (2 * (used_.size() + 1) > entries_.size()) {
      grow();
      i = place_of(element);
    }
    put(i, {element, slot});
    return true;
  }
  /// For an element that has no slot yet.
  void insert(Index element, Index slot)
  {
    if (2 * (used_.size() + 1) > entries_.size()) grow();
    put(place_of(element), {element, slot});
  }
  void clear()
  {
    for (const Index i : used_) entries_[i].element = none;
    used_.clear();
  }

private:
  struct Entry {
    Index element = none, slot = none;
  };

  /// Where the element is, or is to be. Fibonacci hashing: the upper bits of a product with 2^32 /
  /// golden ratio.
  Index place_of(Index element) const
  {
    const auto mask = static_cast<Index>(entries_.size() - 1);
    Index i = (element * 0x9e3779b1u) >> shift_;
    while (entries_[i].element != element && entries_[i].element != none) i = (i + 1) & mask;
    return i;
  }
  void put(Index place, const Entry& entry)
  {
    entries_[place] = entry;
    used_.push_back(place);
  }
  void grow()
  {
    std::vector<Entry> old;
    for (const Index i : used_) old.push_back(entries_[i]);
    used_.clear();
    entries_.assign(2 * entries_.size(), {});
    --shift_;
    for (const Entry& entry : old) put(place_of(entry.element), entry);
  }

  unsigned shift_ = 32 - 8;
  std::vector<Entry> entries_ = std::vector<Entry>(1 << 8);
  std::vector<Index> used_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SLOT_TABLE_H
