// SPDX-License-Identifier: GPL-3.0-or-later
//
// What independent pieces of work, on one thread or on many, tell a visitor.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_CONCURRENCY_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_CONCURRENCY_H

#include <surety/internal/linear.h>
#include <surety/internal/parallel.h>
#include <surety/parameters.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

namespace surety::internal {

/// Puts together what many patches tell one visitor, one call at a time.
class Shared_progress
{
public:
  Shared_progress(
      const std::function<bool(const Progress&)>& visitor, Index patches, std::size_t faces)
    : visitor_(visitor), patches_(patches), faces_(faces)
  {}

  bool is_cancelled() const { return cancelled_; }

  /// The visitor of one patch: it looks at the faces of the patch only, and so tells the share of
  /// the patches that are done.
  std::function<bool(const Progress&)> of_patch()
  {
    return [this](const Progress&) { return !cancelled_ && tell(); };
  }
  void finish(bool is_complete)
  {
    ++finished_;
    if (!is_complete) cancelled_ = true;
  }

private:
  bool tell()
  {
    if (!visitor_) return true;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!visitor_({"patches", double(finished_) / patches_, faces_})) cancelled_ = true;
    return !cancelled_;
  }

  const std::function<bool(const Progress&)>& visitor_;
  Index patches_;
  std::size_t faces_;
  std::mutex mutex_;
  std::atomic<Index> finished_{0};
  std::atomic<bool> cancelled_{false};
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_CONCURRENCY_H
