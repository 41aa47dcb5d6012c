// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables of comma-separated values on standard output, a row as soon as it is known.
#ifndef SURETY_BENCHMARK_TABLE_H
#define SURETY_BENCHMARK_TABLE_H

#include "child.h"

#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace surety::benchmark {

/// A figure in as many digits as it takes.
inline std::string to_text(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

class Table
{
public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns))
  {
    for (const auto& column : columns_) write(column, column);
  }

  /// Columns that the record lacks stay empty.
  void add(const Record& record) const
  {
    for (const auto& column : columns_) {
      const auto found = record.find(column);
      write(column, found == record.end() ? std::string() : found->second);
    }
  }

private:
  void write(const std::string& column, const std::string& value) const
  {
    const bool is_last = &column == &columns_.back();
    std::cout << quoted(value) << (is_last ? '\n' : ',');
    if (is_last) std::cout.flush();
  }

  static std::string quoted(const std::string& value)
  {
    if (value.find_first_of(",\"") == std::string::npos) return value;
    std::string text = "\"";
    for (const char c : value) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + '"';
  }

  std::vector<std::string> columns_;
};

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_TABLE_H
