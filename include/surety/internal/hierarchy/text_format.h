// SPDX-License-Identifier: GPL-3.0-or-later
//
// The text format of hierarchy records, version 1; lines, words and numbers as in certificate files
// (certificate/text_format.h).
//
//   surety-hierarchy 1
//   input HASH V                 of an input with V vertices
//   levels N                     N lines, from fine to coarse:
//   TOLERANCE BOUND OPERATIONS   lengths, and the number of operations from the input
//   operations N                 N lines, one of
//   c S T                        vertex S goes to T along their edge and is gone
//   f S T                        the edge (S, T) becomes the other diagonal
//   p S T X Y Z                  S goes to T, and T moves
//   m V X Y Z                    V moves
//   end
//
// An upper-case letter says that the mesh need not be within the tolerance after this operation,
// only after the next one that has a lower-case letter.
#ifndef SURETY_INTERNAL_HIERARCHY_TEXT_FORMAT_H
#define SURETY_INTERNAL_HIERARCHY_TEXT_FORMAT_H

#include <surety/hierarchy_record.h>
#include <surety/internal/certificate/text_reader.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace surety::internal {

constexpr unsigned hierarchy_format_version = 1;

inline bool moves_a_vertex(Hierarchy_record::Kind kind)
{
  return kind == Hierarchy_record::Kind::placement || kind == Hierarchy_record::Kind::relocation;
}

/// What is wrong with an operation, as far as this can be told without the mesh; empty if nothing.
inline std::string operation_defect(
    const Hierarchy_record::Operation& operation, std::uint32_t vertices)
{
  if (operation.kind > Hierarchy_record::Kind::relocation) return "an operation of an unknown kind";
  if (operation.source >= vertices || operation.target >= vertices)
    return "an operation names a vertex that the input does not have";
  const bool is_relocation = operation.kind == Hierarchy_record::Kind::relocation;
  if ((operation.source == operation.target) != is_relocation)
    return "an operation has the wrong vertices";
  return "";
}

inline std::string level_defect(
    const Hierarchy_record::Level& level, const Hierarchy_record::Level& previous)
{
  if (!(level.tolerance > previous.tolerance && std::isfinite(level.tolerance)))
    return "the tolerances do not increase";
  if (!(level.bound >= previous.bound && std::isfinite(level.bound))) return "the bounds decrease";
  if (level.operations < previous.operations) return "the levels are not in order";
  return "";
}

/// Levels end where the mesh is within the tolerance, the last one with the last operation.
inline std::string boundary_defect(const Hierarchy_record& record)
{
  for (const auto& level : record.levels) {
    if (level.operations > record.operations.size()) return "operations are missing";
    if (level.operations > 0 && !record.operations[level.operations - 1].is_boundary)
      return "a level ends inside a transaction";
  }
  if (record.levels.empty() || record.levels.back().operations != record.operations.size())
    return "the last level does not end with the last operation";
  return "";
}

inline std::string record_defect(const Hierarchy_record& record)
{
  std::string defect = boundary_defect(record);
  Hierarchy_record::Level previous;
  for (const auto& level : record.levels) {
    if (defect.empty()) defect = level_defect(level, previous);
    previous = level;
  }
  std::size_t moves = 0;
  for (const auto& operation : record.operations) {
    if (defect.empty()) defect = operation_defect(operation, record.vertices);
    moves += moves_a_vertex(operation.kind);
  }
  if (defect.empty() && moves != record.points.size()) defect = "there is not one point a move";
  for (const auto& point : record.points)
    for (const double x : point)
      if (!std::isfinite(x)) defect = "a point is not finite";
  return defect;
}

inline void write_text(std::ostream& out, const Hierarchy_record& record)
{
  constexpr std::string_view letters[2][4] = {{"C", "F", "P", "M"}, {"c", "f", "p", "m"}};
  checker::Text_writer writer(out);
  writer.line("surety-hierarchy", hierarchy_format_version);
  writer.line("input", record.fingerprint, record.vertices);
  writer.line("levels", record.levels.size());
  for (const auto& level : record.levels)
    writer.line(level.tolerance, level.bound, level.operations);
  writer.line("operations", record.operations.size());
  auto point = record.points.begin();
  for (const auto& operation : record.operations) {
    const std::string_view letter
        = letters[operation.is_boundary][static_cast<std::size_t>(operation.kind)];
    if (!moves_a_vertex(operation.kind)) {
      writer.line(letter, operation.source, operation.target);
      continue;
    }
    const auto [x, y, z] = *point++;
    if (operation.kind == Hierarchy_record::Kind::placement)
      writer.line(letter, operation.source, operation.target, x, y, z);
    else
      writer.line(letter, operation.source, x, y, z);
  }
  writer.line("end");
}

class Hierarchy_text_reader
{
public:
  explicit Hierarchy_text_reader(std::istream& in)
    : lines_(in, "read_hierarchy_record", "write_hierarchy_record")
  {}

  Hierarchy_record read()
  {
    if (count("surety-hierarchy") != hierarchy_format_version)
      lines_.fail("this version of the format is not known");
    lines_.advance();
    lines_.keyword("input");
    record_.fingerprint = lines_.integer<std::uint64_t>();
    record_.vertices = lines_.integer();
    lines_.expect_end();
    for (Index left = count("levels"); left > 0; --left) read_level();
    const Index number = count("operations");
    // A count in a file that nobody vouches for reserves only a little memory.
    record_.operations.reserve(std::min(number, Index(1) << 16));
    for (Index left = number; left > 0; --left) read_operation();
    lines_.advance();
    lines_.keyword("end");
    lines_.expect_end();
    require(boundary_defect(record_));
    return std::move(record_);
  }

private:
  Index count(std::string_view keyword)
  {
    lines_.advance();
    lines_.keyword(keyword);
    const Index value = lines_.integer();
    lines_.expect_end();
    return value;
  }

  void read_level()
  {
    lines_.advance();
    Hierarchy_record::Level level;
    level.tolerance = lines_.real();
    level.bound = lines_.real();
    level.operations = lines_.integer();
    lines_.expect_end();
    require(level_defect(
        level, record_.levels.empty() ? Hierarchy_record::Level() : record_.levels.back()));
    record_.levels.push_back(level);
  }

  void read_operation()
  {
    constexpr std::string_view letters = "cfpmCFPM";
    lines_.advance();
    const std::string_view word = lines_.word();
    const std::size_t letter = word.size() == 1 ? letters.find(word) : std::string_view::npos;
    if (letter == std::string_view::npos) lines_.fail("this operation is not known");
    Hierarchy_record::Operation operation;
    operation.kind = static_cast<Hierarchy_record::Kind>(letter % 4);
    operation.is_boundary = letter < 4;
    operation.source = operation.target = lines_.integer();
    if (operation.kind != Hierarchy_record::Kind::relocation) operation.target = lines_.integer();
    require(operation_defect(operation, record_.vertices));
    record_.operations.push_back(operation);
    if (moves_a_vertex(operation.kind)) {
      const double x = lines_.real(), y = lines_.real(), z = lines_.real();
      record_.points.push_back({x, y, z});
    }
    lines_.expect_end();
  }

  void require(const std::string& defect) const
  {
    if (!defect.empty()) lines_.fail(defect);
  }

  checker::Line_reader lines_;
  Hierarchy_record record_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_HIERARCHY_TEXT_FORMAT_H
