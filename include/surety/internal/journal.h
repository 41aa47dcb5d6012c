// SPDX-License-Identifier: GPL-3.0-or-later
//
// The undo log of a transaction: what memory held before it was written.
#ifndef SURETY_INTERNAL_JOURNAL_H
#define SURETY_INTERNAL_JOURNAL_H

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace surety::internal {

/// Everything that a transaction may have to undo is written by set(). The places must keep their
/// addresses from begin() to keep() or undo(), which holds for arrays that do not grow and for the
/// elements of a deque.
class Journal
{
public:
  void begin() { is_recording_ = true; }
  bool is_recording() const { return is_recording_; }

  template <class T>
  void set(T& place, const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= largest_value);
    if (is_recording_) {
      entries_.emplace_back();
      entries_.back().place = &place;
      entries_.back().size = sizeof(T);
      std::memcpy(entries_.back().before, &place, sizeof(T));
    }
    place = value;
  }

  /// Ends the transaction and forgets what was before.
  void keep()
  {
    entries_.clear();
    is_recording_ = false;
  }

  /// Ends the transaction and puts back what was before, the latest writes first.
  void undo()
  {
    for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry)
      std::memcpy(entry->place, entry->before, entry->size);
    keep();
  }

private:
  static constexpr std::size_t largest_value = 24;
  struct Entry {
    void* place;
    std::size_t size;
    unsigned char before[largest_value];
  };

  std::vector<Entry> entries_;
  bool is_recording_ = false;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_JOURNAL_H
