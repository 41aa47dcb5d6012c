// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words of Medit's text formats: between white space, with comments from # to the end of a
// line. Every word is checked, and what is not as it must be is reported by its line.
#ifndef SURETY_INTERNAL_METRIC_MEDIT_WORDS_H
#define SURETY_INTERNAL_METRIC_MEDIT_WORDS_H

#include <surety/errors.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <istream>
#include <string>
#include <system_error>

namespace surety::internal::metric {

class Medit_words
{
public:
  /// \param function that errors name
  Medit_words(std::istream& in, const char* function) : in_(in), function_(function) {}

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = "") const
  {
    throw Invalid_input(function_, "line " + std::to_string(line_), problem, remedy);
  }

  /// That of the last word.
  std::size_t line() const { return line_; }

  /// The next word; false at the end of the file.
  bool next(std::string& word)
  {
    word.clear();
    // The line ends after its last word: a message about that word must not name the next line.
    for (int c = in_.get(); c != std::char_traits<char>::eof(); c = in_.get()) {
      if (c == '#') {
        while (in_.peek() != '\n' && in_.peek() != std::char_traits<char>::eof()) in_.get();
      } else if (c > ' ') {
        word.push_back(static_cast<char>(c));
        if (is_end_of_word(in_.peek())) return true;
      } else if (c == '\n') {
        ++line_;
      }
    }
    return false;
  }

  template <class Number>
  Number number(const char* what)
  {
    if (!next(word_)) fail(std::string("the file ends where ") + what + " should be");
    Number value{};
    const char *begin = word_.data(), *end = begin + word_.size();
    const auto [stop, error] = std::from_chars(begin + (*begin == '+' ? 1 : 0), end, value);
    if (error != std::errc() || stop != end) fail("\"" + shown(word_) + "\" is not " + what);
    return value;
  }

  std::size_t count() { return number<std::size_t>("a whole number"); }

  double real()
  {
    const auto value = number<double>("a number");
    if (!std::isfinite(value)) fail("\"" + shown(word_) + "\" is not finite");
    return value;
  }

  /// The text of the last number.
  std::string shown() const { return shown(word_); }

  /// Printable, and short enough for a message.
  static std::string shown(const std::string& text)
  {
    std::string result = text.substr(0, 40);
    for (char& c : result) {
      if (c < ' ' || c > '~') c = '?';
    }
    return result;
  }

private:
  static bool is_end_of_word(int c)
  {
    return c == std::char_traits<char>::eof() || c <= ' ' || c == '#';
  }

  std::istream& in_;
  const char* function_;
  std::string word_;
  std::size_t line_ = 1;
};

/// The shortest decimal number that is read back to the last bit, whatever the locale.
inline std::string shortest_text(double value)
{
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_MEDIT_WORDS_H
