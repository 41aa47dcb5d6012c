// SPDX-License-Identifier: GPL-3.0-or-later
//
// Medit's meshes, as mesh generators exchange them: text (.mesh) and binary (.meshb), with
// vertices, triangles, edges, ridges, corners, required elements and references.
#ifndef SURETY_TOOL_MEDIT_H
#define SURETY_TOOL_MEDIT_H

#include "soup.h"

#include <array>
#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace surety::tool {

/// The soup of a file's bytes, with annotations. What is of no use for a surface (normals,
/// tangents) is skipped. \throws Bad_file if the bytes are no such file, or hold elements that are
/// no triangles; names the line of a text, the element of a binary file.
Soup read_medit_text(const std::string& file, const std::string& bytes);
Soup read_medit_binary(const std::string& file, const std::string& bytes);

/// Both read the same back, to the last bit. The polygons are triangles.
void write_medit_text(std::ostream& stream, const Soup& soup);
void write_medit_binary(std::ostream& stream, const Soup& soup);

namespace medit {

/// One of the lists that a file may have beside its vertices.
struct Kind {
  const char* keyword;
  int code;             ///< in binary files
  std::size_t columns;  ///< indices of an entry
  bool has_reference;   ///< which follows them
  const char* referred; ///< what the indices count
};

enum Kind_index {
  edges,
  triangles,
  corners,
  ridges,
  required_vertices,
  required_edges,
  required_triangles,
  number_of_kinds
};
extern const std::array<Kind, number_of_kinds> kinds;

/// Of binary files.
enum Code { dimension_code = 3, vertices_code = 4, end_code = 54 };

/// Elements that make the file something else than a triangulated surface.
struct Refused {
  const char* keyword;
  int code;
};
extern const std::array<Refused, 5> refused;
/// Throws, and says what to do about them.
[[noreturn]] void refuse(const std::string& file, std::size_t number, const Refused& elements);

/// The entries of one list, as they stand in the file.
struct Table {
  std::vector<long long> indices; ///< from 1; as many an entry as the kind has columns
  std::vector<int> references;
  std::vector<std::size_t> lines; ///< of text files
};

struct Tables {
  std::vector<Point> points;
  std::vector<int> references;
  std::array<Table, number_of_kinds> lists;
};

/// \throws Bad_file if an index leads nowhere.
Soup to_soup(const std::string& file, const Tables& tables);
Tables to_tables(const Soup& soup);

} // namespace medit
} // namespace surety::tool

#endif // SURETY_TOOL_MEDIT_H
