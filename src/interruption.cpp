// SPDX-License-Identifier: GPL-3.0-or-later
//
// The signal handler sets a flag, which is all that a handler may safely do.
#include "interruption.h"

#include "failure.h"

#include <csignal>

namespace surety::tool {
namespace {

volatile std::sig_atomic_t requested = 0;

extern "C" void request_interruption(int) { requested = 1; }

} // namespace

void watch_for_interruption()
{
  struct sigaction action = {};
  action.sa_handler = request_interruption;
  action.sa_flags = static_cast<int>(SA_RESETHAND); // a second Ctrl-C does what it always does
  sigaction(SIGINT, &action, nullptr);
}

bool is_interrupted() { return requested != 0; }

void stop_if_interrupted()
{
  if (is_interrupted()) throw Failure(interrupted, "interrupted; nothing was written");
}

} // namespace surety::tool
