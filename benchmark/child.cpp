// SPDX-License-Identifier: GPL-3.0-or-later
//
// A forked process that sends lines "column=value" through a pipe.
#include "child.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <system_error>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace surety::benchmark {
namespace {

constexpr int exit_after_exception = 3;
const char* const message_column = "exception";

[[noreturn]] void run_and_exit(
    const std::function<void(const Report&)>& run, unsigned cpu_limit, int descriptor)
{
  const rlimit limit{cpu_limit, cpu_limit + 1};
  setrlimit(RLIMIT_CPU, &limit);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);

  const Report report(descriptor);
  int status = EXIT_SUCCESS;
  try {
    run(report);
  } catch (const std::exception& error) {
    report.set(message_column, error.what());
    status = exit_after_exception;
  }
  // Neither the buffers nor the destructors of the parent are ours.
  _exit(status);
}

std::string read_all(int descriptor)
{
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) return text;
  }
}

Record parse(const std::string& text)
{
  Record record;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto equals = line.find('=');
    if (equals != std::string::npos) record[line.substr(0, equals)] = line.substr(equals + 1);
  }
  return record;
}

Outcome outcome_of(int status, Record record)
{
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    // After the soft limit the system sends SIGXCPU, and at the hard one SIGKILL.
    const bool out_of_time = signal == SIGXCPU || signal == SIGKILL;
    return {
        out_of_time ? Ending::out_of_time : Ending::crashed, std::move(record), strsignal(signal)};
  }
  if (WEXITSTATUS(status) == EXIT_SUCCESS) return {Ending::finished, std::move(record), ""};
  std::string message = record[message_column];
  return {Ending::threw, std::move(record), std::move(message)};
}

} // namespace

void Report::send(const std::string& column, std::string value) const
{
  std::replace(value.begin(), value.end(), '\n', ' ');
  const std::string line = column + '=' + value + '\n';
  for (std::size_t sent = 0; sent < line.size();) {
    const ssize_t count = write(descriptor_, line.data() + sent, line.size() - sent);
    if (count < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category());
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
}

Outcome run_in_child(const std::function<void(const Report&)>& run, unsigned cpu_limit)
{
  std::array<int, 2> ends;
  if (pipe(ends.data()) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    close(ends[0]);
    run_and_exit(run, cpu_limit, ends[1]);
  }
  close(ends[1]);
  Record record = parse(read_all(ends[0]));
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
  }
  return outcome_of(status, std::move(record));
}

std::string to_string(Ending ending)
{
  constexpr std::array<const char*, 4> names = {"finished", "exception", "crash", "out of time"};
  return names[static_cast<std::size_t>(ending)];
}

} // namespace surety::benchmark
