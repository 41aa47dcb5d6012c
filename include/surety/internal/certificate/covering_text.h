// SPDX-License-Identifier: GPL-3.0-or-later
//
// The text format of coverings, version 1, with the conventions of text_format.h:
//
//   surety-covering 1
//   tolerance REAL      a length
//   bound REAL
//   input N             N lines, one a face of the input in the order of its file:
//   K W ... W           the K faces of the output that cover it, increasing; after 16 of them the
//   + W ... W           list goes on on a line of its own
//   output N            N lines, one a face of the output: faces of the input
//   ...
//   end
#ifndef SURETY_INTERNAL_CERTIFICATE_COVERING_TEXT_H
#define SURETY_INTERNAL_CERTIFICATE_COVERING_TEXT_H

#include <surety/covering.h>
#include <surety/internal/certificate/text_format.h>
#include <surety/internal/certificate/text_reader.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <string>
#include <string_view>

namespace surety::internal::checker {

constexpr unsigned covering_format_version = 1;

/// A list of more faces is continued on lines of its own: "+ W ... W".
constexpr Index most_on_a_line = 16;

inline bool are_lists(const Covering::Faces& faces)
{
  return !faces.first.empty() && faces.first.front() == 0
      && faces.first.back() == faces.witnesses.size()
      && std::is_sorted(faces.first.begin(), faces.first.end());
}

inline void write_lists(std::ostream& out, const char* name, const Covering::Faces& faces)
{
  out << name << ' ' << faces.first.size() - 1 << '\n';
  std::string line;
  for (std::size_t f = 0; f + 1 < faces.first.size(); ++f) {
    line = std::to_string(faces.first[f + 1] - faces.first[f]);
    for (Index i = faces.first[f]; i < faces.first[f + 1]; ++i) {
      const Index position = i - faces.first[f];
      if (position > 0 && position % most_on_a_line == 0) line += "\n+";
      line += ' ';
      line += std::to_string(faces.witnesses[i]);
    }
    line += '\n';
    out << line;
  }
}

inline void write_covering_text(std::ostream& out, const Covering& covering)
{
  const char* const function = "write_covering";
  for (const double length : {covering.tolerance, covering.bound})
    if (!std::isfinite(length) || std::signbit(length))
      throw Invalid_input(function, "covering", "a length is negative or not finite");
  if (!are_lists(covering.of_input) || !are_lists(covering.of_output))
    throw Invalid_input(function, "covering", "its lists do not fit together");
  {
    Text_writer writer(out);
    writer.line("surety-covering", covering_format_version);
    writer.line("tolerance", covering.tolerance);
    writer.line("bound", covering.bound);
  }
  write_lists(out, "input", covering.of_input);
  write_lists(out, "output", covering.of_output);
  out << "end\n";
}

class Covering_reader
{
public:
  explicit Covering_reader(std::istream& in) : lines_(in, "read_covering", "write_covering") {}

  Covering read()
  {
    if (lines_.count<unsigned>("surety-covering") != covering_format_version)
      lines_.fail("this version of the format is not known");
    Covering result;
    result.tolerance = lines_.length("tolerance");
    result.bound = lines_.length("bound");
    read_lists("input", result.of_input);
    read_lists("output", result.of_output);
    lines_.advance();
    lines_.keyword("end");
    lines_.expect_end();
    return result;
  }

private:
  void read_lists(std::string_view keyword, Covering::Faces& faces)
  {
    for (Index left = lines_.count<Index>(keyword); left > 0; --left) {
      lines_.advance();
      const Index number = lines_.integer();
      for (Index i = 0; i < number; ++i) {
        if (i > 0 && i % most_on_a_line == 0) {
          lines_.expect_end();
          lines_.advance();
          lines_.keyword("+");
        }
        if (faces.witnesses.size() == none - 1) lines_.fail("there are too many faces");
        faces.witnesses.push_back(lines_.integer());
      }
      lines_.expect_end();
      faces.first.push_back(static_cast<Index>(faces.witnesses.size()));
    }
  }

  Line_reader lines_;
};

inline Covering read_covering_text(std::istream& in) { return Covering_reader(in).read(); }

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_COVERING_TEXT_H
