// SPDX-License-Identifier: GPL-3.0-or-later
//
// The text format of certificate files, version 2. One record a line, words separated by one space,
// numbers exact: integers in decimal, reals as C's hexadecimal floating-point ("%a").
//
//   surety-certificate 2
//   tolerance REAL               a length
//   bound REAL
//   cancelled 0|1
//   collapses N                  operations performed
//   flips N
//   relocations N
//   refused N                    operations refused: N lines "REASON COUNT"
//   ...
//   images N                     N lines, one a vertex of the input in the order of its file:
//   v W                          vertex W of the output
//   e A B                        the closest point of its edge (A, B), A < B
//   f F                          the closest point of its face F
//   edges N                      N edges (S, T) of the input with crossings, S < T, sorted:
//   x S T K                      followed by K lines, the crossings from S to T:
//   A B LAMBDA                   the edge (A, B) of the output, A < B, at (1 - LAMBDA) S + LAMBDA T
//   ...
//   inner N                      N lines, points in faces of the input that go to vertices of the
//   F V LAMBDA MU                output, V: (1 - LAMBDA - MU) A + LAMBDA B + MU C, where A < B < C
//                                are the vertices of face F; F increases from line to line
//   ridges N                     N lines, edges (S, T) of the input, S < T
//   S T
//   end
//
// Elements are numbered from 0, in the order of the files of the two meshes.
#ifndef SURETY_INTERNAL_CERTIFICATE_TEXT_FORMAT_H
#define SURETY_INTERNAL_CERTIFICATE_TEXT_FORMAT_H

#include <surety/errors.h>
#include <surety/internal/certificate/record.h>
#include <surety/operations.h>

#include <charconv>
#include <cmath>
#include <initializer_list>
#include <istream>
#include <limits>
#include <ostream>
#include <string_view>
#include <system_error>

namespace surety::internal::checker {

constexpr unsigned text_format_version = 2;

/// Collects text and hands it to a stream in large pieces.
class Text_writer
{
public:
  explicit Text_writer(std::ostream& out) : out_(out) {}
  ~Text_writer() { flush(); }
  Text_writer(const Text_writer&) = delete;
  Text_writer& operator=(const Text_writer&) = delete;

  template <class... Fields>
  void line(const Fields&... fields)
  {
    bool first = true;
    ((first ? void(first = false) : text_.push_back(' '), add(fields)), ...);
    text_.push_back('\n');
    if (text_.size() > 1 << 16) flush();
  }

private:
  void add(std::string_view word) { text_ += word; }
  void add(std::uint64_t number)
  {
    char digits[24];
    text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  }
  void add(double value)
  {
    if (!std::isfinite(value)) return add(std::string_view(std::isnan(value) ? "nan" : "inf"));
    text_ += std::signbit(value) ? "-0x" : "0x";
    char digits[32];
    text_.append(
        digits,
        std::to_chars(digits, digits + sizeof digits, std::abs(value), std::chars_format::hex).ptr);
  }
  template <class Integer, class = std::enable_if_t<std::is_integral_v<Integer>>>
  void add(Integer number)
  {
    add(static_cast<std::uint64_t>(number));
  }

  void flush()
  {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  std::ostream& out_;
  std::string text_;
};

/// The numbers of a certificate that are not part of its correspondence.
struct Header {
  double tolerance = 0, bound = 0;
  bool cancelled = false;
  Operations operations;
};

inline void write_text(std::ostream& out, const Header& header, const Correspondence& record)
{
  Text_writer writer(out);
  writer.line("surety-certificate", text_format_version);
  writer.line("tolerance", header.tolerance);
  writer.line("bound", header.bound);
  writer.line("cancelled", header.cancelled);
  writer.line("collapses", header.operations.collapses);
  writer.line("flips", header.operations.flips);
  writer.line("relocations", header.operations.relocations);
  writer.line("refused", number_of_verdicts - 1);
  for (std::size_t i = 1; i < number_of_verdicts; ++i) {
    writer.line(surety::to_string(static_cast<Verdict>(i)), header.operations.refused[i]);
  }
  writer.line("images", record.images.size());
  for (const auto& image : record.images) {
    switch (image.kind) {
    case Correspondence::Kind::vertex:
      writer.line("v", image.a);
      break;
    case Correspondence::Kind::edge:
      writer.line("e", image.a, image.b);
      break;
    case Correspondence::Kind::face:
      writer.line("f", image.a);
      break;
    }
  }
  writer.line("edges", record.edges.size());
  for (std::size_t i = 0; i < record.edges.size(); ++i) {
    const Index first = record.offsets[i], last = record.offsets[i + 1];
    writer.line("x", record.edges[i][0], record.edges[i][1], last - first);
    for (Index k = first; k < last; ++k) {
      writer.line(record.crossings[k].a, record.crossings[k].b, record.crossings[k].lambda);
    }
  }
  writer.line("inner", record.inner.size());
  for (const auto& inner : record.inner) {
    writer.line(inner.face, inner.vertex, inner.lambda, inner.mu);
  }
  writer.line("ridges", record.ridges.size());
  for (const Vertex_pair& ridge : record.ridges) writer.line(ridge[0], ridge[1]);
  writer.line("end");
}

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_TEXT_FORMAT_H
