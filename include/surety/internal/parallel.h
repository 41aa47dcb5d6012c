// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loops over independent pieces of work, on one thread or on many.
#ifndef SURETY_INTERNAL_PARALLEL_H
#define SURETY_INTERNAL_PARALLEL_H

#include <surety/internal/linear.h>

#include <CGAL/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/parallel_for.h>
#endif

#include <type_traits>

namespace surety::internal {

/// Calls work(i) for each i below `number`.
template <class ConcurrencyTag, class Work>
void for_each_index(Index number, const Work& work)
{
#ifdef CGAL_LINKED_WITH_TBB
  if constexpr (std::is_convertible_v<ConcurrencyTag, CGAL::Parallel_tag>) {
    tbb::parallel_for(Index(0), number, work);
    return;
  }
#else
  static_assert(
      !std::is_convertible_v<ConcurrencyTag, CGAL::Parallel_tag>,
      "CGAL::Parallel_tag needs TBB: link CGAL::TBB_support");
#endif
  for (Index i = 0; i < number; ++i) work(i);
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_PARALLEL_H
