// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the command line fails: the exit statuses, and the exceptions that carry them to main.
#ifndef SURETY_TOOL_FAILURE_H
#define SURETY_TOOL_FAILURE_H

#include <stdexcept>
#include <string>

namespace surety::tool {

/// Exit statuses, part of the command line's promise.
enum Exit_status {
  done = 0,      ///< done, and certified where a certificate was asked for
  usage = 2,     ///< the command line does not make sense, or its output cannot be written there
  bad_input = 3, ///< a file that we cannot read, or a mesh that we cannot work with
  not_certified = 4, ///< the goal was not reached, or a certificate does not hold
  interrupted = 130  ///< by the user; as shells report SIGINT
};

/// Ends a command with a message and an exit status.
class Failure : public std::runtime_error
{
public:
  Failure(Exit_status status, const std::string& message)
    : std::runtime_error(message), status_(status)
  {}

  Exit_status status() const { return status_; }

private:
  Exit_status status_;
};

/// A file that we cannot work with: what is wrong, with the offending element, and the remedy.
class Bad_file : public Failure
{
public:
  Bad_file(const std::string& file, const std::string& problem, const std::string& remedy)
    : Failure(bad_input, file + ": " + problem + (remedy.empty() ? "" : "; " + remedy))
  {}
};

} // namespace surety::tool

#endif // SURETY_TOOL_FAILURE_H
