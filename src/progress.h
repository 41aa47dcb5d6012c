// SPDX-License-Identifier: GPL-3.0-or-later
//
// The visitor of all commands: a progress bar where somebody can see it, and Ctrl-C.
#ifndef SURETY_TOOL_PROGRESS_H
#define SURETY_TOOL_PROGRESS_H

#include <surety/parameters.h>

#include <boost/timer/progress_display.hpp>

#include <optional>
#include <string>

namespace surety::tool {

class Progress_bar
{
public:
  /// Draws on standard error, and only if that is a terminal and the user wants to hear from us.
  explicit Progress_bar(bool is_quiet);
  ~Progress_bar();

  /// \returns false, to cancel, when the user has pressed Ctrl-C.
  bool on_progress(const Progress& progress);

private:
  void finish();

  bool is_visible_;
  std::string stage_;
  std::optional<boost::timer::progress_display> bar_;
};

/// What the library gets: named parameters are copied, the bar cannot be.
class Visitor
{
public:
  explicit Visitor(Progress_bar& bar) : bar_(&bar) {}
  bool on_progress(const Progress& progress) const { return bar_->on_progress(progress); }

private:
  Progress_bar* bar_;
};

} // namespace surety::tool

#endif // SURETY_TOOL_PROGRESS_H
