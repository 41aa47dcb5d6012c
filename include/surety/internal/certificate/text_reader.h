// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads certificate files (text_format.h) from anywhere: every line is checked, a count in the file
// reserves only a little memory, and a line that is not as it must be is reported by its number.
#ifndef SURETY_INTERNAL_CERTIFICATE_TEXT_READER_H
#define SURETY_INTERNAL_CERTIFICATE_TEXT_READER_H

#include <surety/internal/certificate/text_format.h>

#include <algorithm>

namespace surety::internal::checker {

/// The words of one line after another.
class Line_reader
{
public:
  /// The names of the function that reads, and of the one that wrote, are for the messages.
  explicit Line_reader(
      std::istream& in, const char* reader = "read_certificate",
      const char* writer = "write_certificate")
    : in_(in), reader_(reader), writer_(writer)
  {}

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw Invalid_input(
        reader_, "line " + std::to_string(number_), problem,
        std::string("write the file again with ") + writer_);
  }

  /// Goes to the next line; the current one must have been used up.
  void advance()
  {
    ++number_;
    in_.getline(buffer_, sizeof buffer_);
    if (in_.fail()) {
      const bool too_long = in_.gcount() + 1 == sizeof buffer_;
      fail(too_long ? "the line is too long" : "the file ends too early or cannot be read");
    }
    const auto length = static_cast<std::size_t>(in_.gcount()) - (in_.eof() ? 0 : 1);
    rest_ = std::string_view(buffer_, length);
    if (!rest_.empty() && rest_.back() == '\r') rest_.remove_suffix(1);
  }

  void expect_end() const
  {
    if (!rest_.empty()) fail("there is more on the line than expected: \"" + shown(rest_) + "\"");
  }

  std::string_view word()
  {
    const std::size_t length = (std::min)(rest_.find(' '), rest_.size());
    const std::string_view result = rest_.substr(0, length);
    if (result.empty()) fail("a word is missing");
    const bool more
        = length + 1 < rest_.size(); // a space at the end of the line stays, as an error
    rest_.remove_prefix(more ? length + 1 : length);
    return result;
  }

  void keyword(std::string_view expected)
  {
    const std::string_view found = word();
    if (found != expected) {
      fail("expected \"" + std::string(expected) + "\" instead of \"" + shown(found) + "\"");
    }
  }

  template <class Integer = Index>
  Integer integer()
  {
    const std::string_view text = word();
    Integer value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      fail("\"" + shown(text) + "\" is not a number of an element or a count");
    }
    return value;
  }

  double real()
  {
    const std::string_view text = word();
    const bool negative = text.front() == '-';
    std::string_view digits = text.substr(negative ? 1 : 0);
    double value = 0;
    const bool prefix = digits.substr(0, 2) == "0x" && digits.size() > 2 && digits[2] != '-';
    if (prefix) digits.remove_prefix(2);
    const char* last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, value, std::chars_format::hex);
    if (!prefix || error != std::errc() || end != last || !std::isfinite(value)) {
      fail("\"" + shown(text) + "\" is not a finite hexadecimal floating-point number");
    }
    return negative ? -value : value;
  }

  /// A line of a keyword and an integer.
  template <class Integer>
  Integer count(std::string_view keyword)
  {
    advance();
    this->keyword(keyword);
    const Integer value = integer<Integer>();
    expect_end();
    return value;
  }

  /// A line of a keyword and a length.
  double length(std::string_view keyword)
  {
    advance();
    this->keyword(keyword);
    const double value = real();
    expect_end();
    if (std::signbit(value)) fail("the " + std::string(keyword) + " is negative");
    return value;
  }

private:
  /// Printable, and short enough for a message.
  static std::string shown(std::string_view text)
  {
    std::string result(text.substr(0, 40));
    for (char& c : result) {
      if (c < ' ' || c > '~') c = '?';
    }
    return result;
  }

  std::istream& in_;
  const char *reader_, *writer_;
  char buffer_[256];
  std::string_view rest_;
  std::size_t number_ = 0;
};

class Text_reader
{
public:
  explicit Text_reader(std::istream& in) : lines_(in) {}

  void read(Header& header, Correspondence& record)
  {
    read_header(header);
    read_images(record);
    read_crossings(record);
    read_inner(record);
    read_ridges(record);
    lines_.advance();
    lines_.keyword("end");
    lines_.expect_end();
  }

private:
  void require(const std::string& defect) const
  {
    if (!defect.empty()) lines_.fail(defect);
  }

  template <class Container>
  static void reserve(Container& container, Index number)
  {
    container.reserve((std::min)(number, Index(1) << 16));
  }

  void read_header(Header& header)
  {
    if (lines_.count<unsigned>("surety-certificate") != text_format_version) {
      lines_.fail("this version of the format is not known");
    }
    header.tolerance = lines_.length("tolerance");
    header.bound = lines_.length("bound");
    const unsigned cancelled = lines_.count<unsigned>("cancelled");
    if (cancelled > 1) lines_.fail("expected 0 or 1");
    header.cancelled = cancelled == 1;
    header.operations.collapses = lines_.count<std::size_t>("collapses");
    header.operations.flips = lines_.count<std::size_t>("flips");
    header.operations.relocations = lines_.count<std::size_t>("relocations");
    for (unsigned left = lines_.count<unsigned>("refused"); left > 0; --left) read_refusal(header);
  }

  void read_refusal(Header& header)
  {
    lines_.advance();
    const std::string_view reason = lines_.word();
    std::size_t verdict = 1;
    while (verdict < number_of_verdicts
           && reason != surety::to_string(static_cast<Verdict>(verdict))) {
      ++verdict;
    }
    if (verdict == number_of_verdicts) lines_.fail("this reason of a refusal is not known");
    header.operations.refused[verdict] = lines_.integer<std::size_t>();
    lines_.expect_end();
  }

  void read_images(Correspondence& record)
  {
    const Index number = lines_.count<Index>("images");
    reserve(record.images, number);
    for (Index i = 0; i < number; ++i) {
      lines_.advance();
      const std::string_view kind = lines_.word();
      Correspondence::Image image;
      if (kind == "v")
        image.kind = Correspondence::Kind::vertex;
      else if (kind == "e")
        image.kind = Correspondence::Kind::edge;
      else if (kind == "f")
        image.kind = Correspondence::Kind::face;
      else
        lines_.fail("expected an image that starts with v, e or f");
      image.a = lines_.integer();
      if (image.kind == Correspondence::Kind::edge) image.b = lines_.integer();
      lines_.expect_end();
      require(image_defect(image));
      record.images.push_back(image);
    }
  }

  Vertex_pair edge_name(const Correspondence& record)
  {
    const Index first = lines_.integer(), second = lines_.integer();
    require(edge_name_defect({first, second}, record.images.size()));
    return {first, second};
  }

  void read_crossings(Correspondence& record)
  {
    const Index number = lines_.count<Index>("edges");
    reserve(record.edges, number);
    record.offsets.assign(1, 0);
    for (Index i = 0; i < number; ++i) {
      lines_.advance();
      lines_.keyword("x");
      record.edges.push_back(edge_name(record));
      if (i > 0 && !(record.edges[i - 1] < record.edges[i])) lines_.fail("edges are not sorted");
      const Index crossings = lines_.integer();
      lines_.expect_end();
      if (crossings >= none - record.offsets.back()) lines_.fail("there are too many crossings");
      read_crossings_of_edge(record, crossings);
      record.offsets.push_back(static_cast<Index>(record.crossings.size()));
    }
  }

  void read_crossings_of_edge(Correspondence& record, Index number)
  {
    double previous = 0;
    for (Index k = 0; k < number; ++k) {
      lines_.advance();
      Correspondence::Crossing crossing;
      crossing.a = lines_.integer();
      crossing.b = lines_.integer();
      crossing.lambda = lines_.real();
      lines_.expect_end();
      require(crossing_defect(crossing, previous));
      previous = crossing.lambda;
      record.crossings.push_back(crossing);
    }
  }

  void read_inner(Correspondence& record)
  {
    const Index number = lines_.count<Index>("inner");
    reserve(record.inner, number);
    for (Index i = 0; i < number; ++i) {
      lines_.advance();
      Correspondence::Inner inner;
      inner.face = lines_.integer();
      inner.vertex = lines_.integer();
      inner.lambda = lines_.real();
      inner.mu = lines_.real();
      lines_.expect_end();
      require(inner_defect(inner));
      if (i > 0 && record.inner.back().face >= inner.face) lines_.fail(inner_order_defect);
      record.inner.push_back(inner);
    }
    require(has_too_many_items(record) ? "there are too many items" : "");
  }

  void read_ridges(Correspondence& record)
  {
    const Index number = lines_.count<Index>("ridges");
    reserve(record.ridges, number);
    for (Index i = 0; i < number; ++i) {
      lines_.advance();
      record.ridges.push_back(edge_name(record));
      lines_.expect_end();
    }
  }

  Line_reader lines_;
};

} // namespace surety::internal::checker

#endif // SURETY_INTERNAL_CERTIFICATE_TEXT_READER_H
