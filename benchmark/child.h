// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs one case of a benchmark in a process of its own, so that a crash or an endless loop is a row
// of the table and not the end of it.
#ifndef SURETY_BENCHMARK_CHILD_H
#define SURETY_BENCHMARK_CHILD_H

#include <functional>
#include <map>
#include <sstream>
#include <string>

namespace surety::benchmark {

/// What a case found, by column.
using Record = std::map<std::string, std::string>;

/// How a case writes down what it finds. Each value is sent at once, so that what was found before
/// a crash is kept.
class Report
{
public:
  explicit Report(int descriptor) : descriptor_(descriptor) {}

  template <class Value>
  void set(const std::string& column, const Value& value) const
  {
    std::ostringstream text;
    text.precision(9);
    text << value;
    send(column, text.str());
  }

private:
  void send(const std::string& column, std::string value) const;

  int descriptor_;
};

/// How a case ended.
enum class Ending { finished, threw, crashed, out_of_time };

struct Outcome {
  Ending ending;
  Record record;       ///< whatever the ending
  std::string message; ///< of the exception, or the name of the signal
};

/// \brief Runs a case in a forked process.
///
/// \param cpu_limit in seconds of the case's own CPU time, so that the load of the machine does not
///   decide what is out of time.
Outcome run_in_child(const std::function<void(const Report&)>& run, unsigned cpu_limit);

/// The outcome in one or two words, for tables.
std::string to_string(Ending ending);

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_CHILD_H
