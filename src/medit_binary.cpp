// SPDX-License-Identifier: GPL-3.0-or-later
//
// The binary form: a 1 in the byte order of the machine that wrote it, the version, and lists, each
// with its code, the position of the next one, the number of entries, and the entries. Version 1
// has single-precision coordinates, version 3 positions of 64 bits, version 4 all integers of 64
// bits.
#include "medit.h"

#include "failure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <ostream>

namespace surety::tool {
namespace {

class Binary_reader
{
public:
  Binary_reader(const std::string& file, const std::string& bytes) : file_(file), bytes_(bytes) {}

  Soup read()
  {
    read_header();
    while (true) {
      const auto code = static_cast<int>(number<std::int32_t>());
      if (code == medit::end_code) return medit::to_soup(file_, tables_);
      const std::uint64_t next = position();
      if (next != 0 && (next <= at_ || next > bytes_.size()))
        fail("the list of code " + std::to_string(code) + " ends outside of the file");
      read_list(code);
      if (next == 0) return medit::to_soup(file_, tables_);
      at_ = next;
    }
  }

private:
  [[noreturn]] void fail(const std::string& problem) const
  {
    throw Bad_file(
        file_, "this is not a complete Medit file: " + problem,
        "it may be truncated or of another format: export it again");
  }

  template <class Number>
  Number number()
  {
    if (bytes_.size() - at_ < sizeof(Number))
      fail("it ends at byte " + std::to_string(bytes_.size()) + ", where more is promised");
    std::array<char, sizeof(Number)> raw;
    std::copy_n(bytes_.data() + at_, raw.size(), raw.begin());
    if (is_swapped_) std::reverse(raw.begin(), raw.end());
    at_ += raw.size();
    Number result;
    std::memcpy(&result, raw.data(), raw.size());
    return result;
  }

  void read_header()
  {
    const auto mark = number<std::int32_t>();
    is_swapped_ = mark == 1 << 24;
    if (mark != 1 && !is_swapped_) fail("it does not begin with the number 1");
    version_ = number<std::int32_t>();
    if (version_ < 1 || version_ > 4)
      fail("its version is " + std::to_string(version_) + ", not 1 to 4");
  }

  std::int64_t integer() { return version_ == 4 ? number<std::int64_t>() : number<std::int32_t>(); }
  std::uint64_t position()
  {
    return version_ >= 3 ? number<std::uint64_t>() : number<std::uint32_t>();
  }
  double real() { return version_ == 1 ? double(number<float>()) : number<double>(); }
  int reference() { return static_cast<int>(integer()); }

  /// \param bytes that each entry takes at least
  std::size_t count(const char* keyword, std::size_t bytes)
  {
    const std::int64_t number = integer();
    if (number < 0 || std::uint64_t(number) > (bytes_.size() - at_) / bytes)
      fail(
          "it promises " + std::to_string(number) + " " + keyword
          + ", more than the file can hold");
    return static_cast<std::size_t>(number);
  }

  void read_list(int code)
  {
    const auto has_code = [code](const auto& entry) { return entry.code == code; };
    const auto kind = std::find_if(medit::kinds.begin(), medit::kinds.end(), has_code);
    const auto elements = std::find_if(medit::refused.begin(), medit::refused.end(), has_code);
    if (code == medit::dimension_code) {
      const auto dimension = number<std::int32_t>();
      if (dimension != 3)
        throw Bad_file(
            file_, "the dimension is " + std::to_string(dimension) + ", not 3",
            "give a surface in space");
    } else if (code == medit::vertices_code) {
      read_vertices();
    } else if (kind != medit::kinds.end()) {
      read_table(*kind, tables_.lists[static_cast<std::size_t>(kind - medit::kinds.begin())]);
    } else if (elements != medit::refused.end()) {
      const std::size_t number = count(elements->keyword, 4);
      if (number > 0) medit::refuse(file_, number, *elements);
    }
  }

  void read_vertices()
  {
    const std::size_t number = count("Vertices", 16);
    tables_.points.clear();
    tables_.references.clear();
    for (std::size_t i = 0; i < number; ++i) {
      const double x = real(), y = real(), z = real();
      if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
        throw Bad_file(
            file_, "Vertices, entry " + std::to_string(i + 1) + ": the coordinates are not finite",
            "correct or remove the vertex");
      tables_.points.emplace_back(x, y, z);
      tables_.references.push_back(reference());
    }
  }

  void read_table(const medit::Kind& kind, medit::Table& table)
  {
    const std::size_t number = count(kind.keyword, 4 * kind.columns);
    table = {};
    for (std::size_t i = 0; i < number; ++i) {
      for (std::size_t k = 0; k < kind.columns; ++k) table.indices.push_back(integer());
      if (kind.has_reference) table.references.push_back(reference());
    }
  }

  const std::string &file_, &bytes_;
  std::size_t at_ = 0;
  bool is_swapped_ = false;
  int version_ = 2;
  medit::Tables tables_;
};

/// Writes version 2, or 3 where a position needs more than 32 bits.
class Binary_writer
{
public:
  Binary_writer(std::ostream& stream, const medit::Tables& tables)
    : stream_(stream), tables_(tables)
  {}

  void write()
  {
    constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
    is_long_ = size() > most;
    put(std::int32_t{1});
    put(std::int32_t{is_long_ ? 3 : 2});
    begin(medit::dimension_code, sizeof(std::int32_t));
    put(std::int32_t{3});
    begin(medit::vertices_code, 4 + tables_.points.size() * bytes_a_vertex);
    put(static_cast<std::int32_t>(tables_.points.size()));
    for (std::size_t v = 0; v < tables_.points.size(); ++v) {
      const Point& p = tables_.points[v];
      for (const double x : {p.x(), p.y(), p.z()}) put(x);
      put(std::int32_t{tables_.references[v]});
    }
    for (std::size_t list = 0; list < medit::kinds.size(); ++list)
      write_table(medit::kinds[list], tables_.lists[list]);
    put(std::int32_t{medit::end_code});
    put_position(0);
  }

private:
  static constexpr std::uint64_t bytes_a_vertex = 28;

  static std::uint64_t bytes(const medit::Table& table)
  {
    return 4 * (1 + std::uint64_t(table.indices.size() + table.references.size()));
  }
  /// With room for all heads.
  std::uint64_t size() const
  {
    std::uint64_t result = 256 + tables_.points.size() * bytes_a_vertex;
    for (const medit::Table& table : tables_.lists) result += bytes(table);
    return result;
  }

  template <class Number>
  void put(Number value)
  {
    std::array<char, sizeof value> raw;
    std::memcpy(raw.data(), &value, raw.size());
    stream_.write(raw.data(), raw.size());
    at_ += raw.size();
  }
  void put_position(std::uint64_t position)
  {
    if (is_long_)
      put(position);
    else
      put(static_cast<std::uint32_t>(position));
  }
  void begin(int code, std::uint64_t bytes)
  {
    put(std::int32_t{code});
    put_position(at_ + (is_long_ ? 8 : 4) + bytes);
  }

  void write_table(const medit::Kind& kind, const medit::Table& table)
  {
    if (table.indices.empty()) return;
    begin(kind.code, bytes(table));
    const std::size_t entries = table.indices.size() / kind.columns;
    put(static_cast<std::int32_t>(entries));
    for (std::size_t i = 0; i < entries; ++i) {
      for (std::size_t k = 0; k < kind.columns; ++k)
        put(static_cast<std::int32_t>(table.indices[i * kind.columns + k]));
      if (kind.has_reference) put(std::int32_t{table.references[i]});
    }
  }

  std::ostream& stream_;
  const medit::Tables& tables_;
  std::uint64_t at_ = 0;
  bool is_long_ = false;
};

} // namespace

Soup read_medit_binary(const std::string& file, const std::string& bytes)
{
  return Binary_reader(file, bytes).read();
}

void write_medit_binary(std::ostream& stream, const Soup& soup)
{
  const medit::Tables tables = medit::to_tables(soup);
  Binary_writer(stream, tables).write();
}

} // namespace surety::tool
