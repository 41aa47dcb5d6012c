// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a command has to say, as JSON for programs and as lines for people.
#ifndef SURETY_TOOL_REPORT_H
#define SURETY_TOOL_REPORT_H

#include <surety/metric_fit.h>
#include <surety/operations.h>
#include <surety/statistics.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstddef>
#include <string>

namespace surety::tool {

/// Keeps the order in which members are added.
using Json = nlohmann::ordered_json;

/// The beginning of every report: the program, its version and the command.
Json new_report(const std::string& command);

/// Everything that `mesh_statistics()` found, with the file's name.
Json to_json(const std::string& file, const Mesh_statistics& statistics);

/// Operations performed, and refused by reason.
Json to_json(const Operations& operations);

/// How many values lie in each bin: `number` upper limits, and one bin more for what is above.
Json histogram(const double* limits, std::size_t number, const std::size_t* counts);

/// How well a mesh fits a metric.
Json to_json(const Metric_fit& fit);

/// The report as it is written to a file.
std::string to_text(const Json& report);

/// Six digits, enough to read.
std::string to_text(double value);

/// With the digits of large numbers in groups of three.
std::string to_text(std::size_t count);

/// Two or three lines about a mesh: size, topology, quality.
std::string to_text(const Mesh_statistics& statistics, const std::string& indentation);

/// Seconds, by name of the step.
class Stopwatch
{
public:
  /// Ends a step, which began when the last one ended; returns its seconds.
  double lap(const char* step);
  const Json& seconds() const { return seconds_; }

private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_ = Clock::now();
  Json seconds_ = Json::object();
};

} // namespace surety::tool

#endif // SURETY_TOOL_REPORT_H
