// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many threads the library may use.
#ifndef SURETY_TOOL_THREADS_H
#define SURETY_TOOL_THREADS_H

#include <memory>

namespace surety::tool {

/// Limits the threads while it lives; 0: as many as there are. No result depends on it.
class Thread_limit
{
public:
  /// \throws Failure (usage) for more than one thread in a program that was built without TBB.
  explicit Thread_limit(unsigned threads);
  ~Thread_limit();

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace surety::tool

#endif // SURETY_TOOL_THREADS_H
