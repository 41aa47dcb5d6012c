// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables on standard output, as comma-separated values or as JSON, a row as soon as it is known.
#ifndef SURETY_BENCHMARK_TABLE_H
#define SURETY_BENCHMARK_TABLE_H

#include "child.h"

#include <nlohmann/json.hpp>

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
  enum class Format { csv, json };

  /// Of all tables that are made from now on: the choice of the command line.
  static Format& format()
  {
    static Format chosen = Format::csv;
    return chosen;
  }

  explicit Table(std::vector<std::string> columns)
    : columns_(std::move(columns)), is_json_(format() == Format::json)
  {
    if (is_json_) {
      std::cout << '[' << std::flush;
    } else {
      for (const auto& column : columns_) write(column, column);
    }
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;
  ~Table()
  {
    if (is_json_) std::cout << "\n]\n" << std::flush;
  }

  /// Columns that the record lacks stay empty, or are left out of the object.
  void add(const Record& record) const
  {
    if (is_json_) {
      add_object(record);
      return;
    }
    for (const auto& column : columns_) {
      const auto found = record.find(column);
      write(column, found == record.end() ? std::string() : found->second);
    }
  }

private:
  /// Numbers as numbers, the rest as text.
  void add_object(const Record& record) const
  {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    for (const auto& column : columns_) {
      const auto found = record.find(column);
      if (found == record.end()) continue;
      const auto number = nlohmann::ordered_json::parse(found->second, nullptr, false);
      if (number.is_number()) {
        object[column] = number;
      } else {
        object[column] = found->second;
      }
    }
    std::cout << (is_first_ ? "\n  " : ",\n  ") << object << std::flush;
    is_first_ = false;
  }

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
  bool is_json_;
  mutable bool is_first_ = true;
};

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_TABLE_H
