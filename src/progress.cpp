// SPDX-License-Identifier: GPL-3.0-or-later
//
// A stage has its own bar, since no stage knows how long the next one takes.
#include "progress.h"

#include "interruption.h"

#include <algorithm>
#include <iostream>

#include <unistd.h>

namespace surety::tool {
namespace {

constexpr unsigned long steps = 1000;

} // namespace

Progress_bar::Progress_bar(bool is_quiet) : is_visible_(!is_quiet && isatty(STDERR_FILENO) != 0) {}

Progress_bar::~Progress_bar() { finish(); }

bool Progress_bar::on_progress(const Progress& progress)
{
  if (is_interrupted()) return false;
  if (!is_visible_) return true;
  if (!bar_ || stage_ != progress.stage) {
    finish();
    stage_ = progress.stage;
    bar_.emplace(steps, std::cerr, stage_ + '\n');
  }
  const double fraction = std::clamp(progress.fraction, 0., 1.);
  const auto position = static_cast<unsigned long>(fraction * double(steps));
  if (position > bar_->count()) *bar_ += position - bar_->count();
  return true;
}

void Progress_bar::finish()
{
  if (bar_ && bar_->count() < steps) *bar_ += steps - bar_->count();
  bar_.reset();
}

} // namespace surety::tool
