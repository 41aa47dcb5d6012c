// SPDX-License-Identifier: GPL-3.0-or-later
#include "medit.h"

#include "failure.h"

#include <surety/internal/metric/medit_words.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <sstream>

namespace surety::tool {
namespace {

using surety::internal::metric::Medit_words;
using surety::internal::metric::shortest_text;

class Text_reader
{
public:
  Text_reader(const std::string& file, std::istream& in) : file_(file), words_(in, "surety") {}

  Soup read()
  {
    while (has_keyword_ || words_.next(keyword_)) {
      has_keyword_ = false;
      if (keyword_ == "End") return medit::to_soup(file_, tables_);
      read_list();
    }
    words_.fail("the file ends without the word End", "it may be truncated: export it again");
  }

private:
  void read_list()
  {
    if (keyword_ == "MeshVersionFormatted") {
      words_.count();
    } else if (keyword_ == "Dimension") {
      const std::size_t dimension = words_.count();
      if (dimension != 3) words_.fail("the dimension is " + std::to_string(dimension) + ", not 3");
    } else if (keyword_ == "Vertices") {
      read_vertices();
    } else if (const auto kind = find(medit::kinds); kind != medit::kinds.end()) {
      read_table(*kind, tables_.lists[static_cast<std::size_t>(kind - medit::kinds.begin())]);
    } else if (const auto elements = find(medit::refused); elements != medit::refused.end()) {
      const std::size_t number = words_.count();
      if (number > 0) medit::refuse(file_, number, *elements);
    } else {
      skip();
    }
  }

  template <class List>
  typename List::const_iterator find(const List& list) const
  {
    return std::find_if(
        list.begin(), list.end(), [&](const auto& entry) { return keyword_ == entry.keyword; });
  }

  void read_vertices()
  {
    if (!tables_.points.empty()) words_.fail("there is more than one list of vertices");
    const std::size_t number = words_.count();
    for (std::size_t i = 0; i < number; ++i) {
      const double x = words_.real(), y = words_.real(), z = words_.real();
      tables_.points.emplace_back(x, y, z);
      tables_.references.push_back(reference());
    }
  }

  void read_table(const medit::Kind& kind, medit::Table& table)
  {
    if (!table.indices.empty())
      words_.fail(std::string("there is more than one list of ") + kind.keyword);
    const std::size_t number = words_.count();
    for (std::size_t i = 0; i < number; ++i) {
      for (std::size_t k = 0; k < kind.columns; ++k)
        table.indices.push_back(words_.number<long long>("a whole number"));
      if (kind.has_reference) table.references.push_back(reference());
      table.lines.push_back(words_.line());
    }
  }

  int reference() { return words_.number<int>("a reference"); }

  /// Lists that are of no use here have numbers only.
  void skip()
  {
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    if (!is_letter(keyword_.front()))
      words_.fail("\"" + Medit_words::shown(keyword_) + "\" is where a keyword should be");
    while (words_.next(keyword_)) {
      has_keyword_ = is_letter(keyword_.front());
      if (has_keyword_) return;
    }
  }

  const std::string& file_;
  Medit_words words_;
  std::string keyword_;
  bool has_keyword_ = false; ///< the next one is there already
  medit::Tables tables_;
};

void write_table(std::ostream& stream, const medit::Kind& kind, const medit::Table& table)
{
  if (table.indices.empty()) return;
  const std::size_t entries = table.indices.size() / kind.columns;
  stream << '\n' << kind.keyword << '\n' << entries << '\n';
  for (std::size_t i = 0; i < entries; ++i) {
    for (std::size_t k = 0; k < kind.columns; ++k)
      stream << (k == 0 ? "" : " ") << table.indices[i * kind.columns + k];
    if (kind.has_reference) stream << ' ' << table.references[i];
    stream << '\n';
  }
}

} // namespace

Soup read_medit_text(const std::string& file, const std::string& bytes)
{
  std::istringstream stream(bytes);
  try {
    return Text_reader(file, stream).read();
  } catch (const Invalid_input& error) {
    throw Bad_file(file, error.argument() + ": " + error.problem(), error.remedy());
  }
}

void write_medit_text(std::ostream& stream, const Soup& soup)
{
  const medit::Tables tables = medit::to_tables(soup);
  stream << "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n" << tables.points.size() << '\n';
  for (std::size_t v = 0; v < tables.points.size(); ++v) {
    const Point& p = tables.points[v];
    for (const double x : {p.x(), p.y(), p.z()}) stream << shortest_text(x) << ' ';
    stream << tables.references[v] << '\n';
  }
  for (std::size_t list = 0; list < medit::kinds.size(); ++list)
    write_table(stream, medit::kinds[list], tables.lists[list]);
  stream << "\nEnd\n";
}

} // namespace surety::tool
