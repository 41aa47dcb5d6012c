// SPDX-License-Identifier: GPL-3.0-or-later
//
// The members of the JSON report are part of the command line's promise: add, never rename.
#include "report.h"

#include <surety/version.h>

#include <sstream>

namespace surety::tool {

Json new_report(const std::string& command)
{
  return {{"program", "surety"}, {"version", SURETY_VERSION_STRING}, {"command", command}};
}

Json to_json(const std::string& file, const Mesh_statistics& s)
{
  return {
      {"file", file},
      {"vertices", s.vertices},
      {"edges", s.edges},
      {"faces", s.faces},
      {"components", s.components},
      {"border_edges", s.border_edges},
      {"border_loops", s.border_loops},
      {"euler", s.euler},
      {"genus", s.genus_sum},
      {"diagonal", s.diagonal},
      {"area", s.area},
      {"Q_max", s.Q_max},
      {"Q_avg", s.Q_avg},
      {"Q_le_2", s.Q_le_2},
      {"angle_min", s.angle_min},
      {"angle_max", s.angle_max},
      {"self_intersections", s.self_intersections}};
}

Json to_json(const Operations& operations)
{
  Json refused = Json::object();
  for (std::size_t i = 0; i < number_of_verdicts; ++i) {
    const auto verdict = static_cast<Verdict>(i);
    if (verdict != Verdict::accept) refused[to_string(verdict)] = operations.refused[i];
  }
  return {
      {"performed",
       {{"collapse", operations.collapses},
        {"flip", operations.flips},
        {"relocation", operations.relocations},
        {"split", operations.splits}}},
      {"refused", refused}};
}

Json histogram(const double* limits, std::size_t number, const std::size_t* counts)
{
  Json result = Json::array();
  for (std::size_t i = 0; i <= number; ++i) {
    Json bin;
    if (i < number) bin["up_to"] = limits[i];
    bin["number"] = counts[i];
    result.push_back(bin);
  }
  return result;
}

Json to_json(const Metric_fit& fit)
{
  return {
      {"unit_edges", fit.unit_edges},
      {"efficiency_index", fit.efficiency_index},
      {"Q_avg", fit.Q_avg},
      {"Q_max", fit.Q_max},
      {"lengths",
       histogram(
           Metric_fit::length_limits.data(), Metric_fit::length_limits.size(),
           fit.length_histogram.data())},
      {"qualities",
       histogram(
           Metric_fit::quality_limits.data(), Metric_fit::quality_limits.size(),
           fit.quality_histogram.data())}};
}

std::string to_text(const Json& report)
{
  // A file name need not be UTF-8; JSON must be.
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string to_text(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string to_text(std::size_t count)
{
  std::string text = std::to_string(count);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
  return text;
}

std::string to_text(const Mesh_statistics& s, const std::string& indentation)
{
  std::ostringstream text;
  text << indentation << to_text(s.vertices) << " vertices, " << to_text(s.faces) << " faces, "
       << s.components << (s.components == 1 ? " component" : " components") << ", genus "
       << s.genus_sum << ", " << s.border_loops
       << (s.border_loops == 1 ? " border loop" : " border loops") << '\n'
       << indentation << "quality Q: mean " << s.Q_avg << ", worst " << s.Q_max
       << ", at most 2 for " << s.Q_le_2 << " % of the faces\n"
       << indentation << "angles: from " << s.angle_min << " to " << s.angle_max << " degrees\n"
       << indentation << "self-intersections: " << to_text(s.self_intersections) << '\n';
  return text.str();
}

double Stopwatch::lap(const char* step)
{
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - start_).count();
  seconds_[step] = seconds;
  start_ = now;
  return seconds;
}

} // namespace surety::tool
