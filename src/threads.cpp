// SPDX-License-Identifier: GPL-3.0-or-later
#include "threads.h"

#include "failure.h"

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#endif

namespace surety::tool {

#ifdef CGAL_LINKED_WITH_TBB

class Thread_limit::Implementation
{
public:
  explicit Implementation(unsigned threads)
    : control_(tbb::global_control::max_allowed_parallelism, threads)
  {}

private:
  tbb::global_control control_;
};

Thread_limit::Thread_limit(unsigned threads)
{
  if (threads > 0) implementation_ = std::make_unique<Implementation>(threads);
}

#else

class Thread_limit::Implementation
{};

Thread_limit::Thread_limit(unsigned threads)
{
  if (threads > 1)
    throw Failure(usage, "--threads: this program was built without TBB and has one thread");
}

#endif

Thread_limit::~Thread_limit() = default;

} // namespace surety::tool
