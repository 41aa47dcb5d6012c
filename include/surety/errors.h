// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one exception that the library throws on purpose: an argument or an input mesh that a
// function cannot work with. It keeps its parts apart, so that a program can present them in its
// own way.
#ifndef SURETY_ERRORS_H
#define SURETY_ERRORS_H

#include <stdexcept>
#include <string>
#include <utility>

namespace surety {

/// \brief A precondition that does not hold: which function, which argument, what is wrong with it,
/// and what the caller can do about it.
///
/// `what()` reads `<function>: <argument>: <problem>; <remedy>`, without the last part when no
/// remedy is known.
class Invalid_input : public std::invalid_argument
{
public:
  /// The parts of the sentence; see the functions of the same names.
  Invalid_input(
      std::string function, std::string argument, std::string problem, std::string remedy = "")
    : std::invalid_argument(sentence(function, argument, problem, remedy)),
      function_(std::move(function)),
      argument_(std::move(argument)),
      problem_(std::move(problem)),
      remedy_(std::move(remedy))
  {}

  /// The public function that refused.
  const std::string& function() const { return function_; }
  /// The name of its argument, or of the named parameter.
  const std::string& argument() const { return argument_; }
  /// What is wrong, with the offending element and value.
  const std::string& problem() const { return problem_; }
  /// What repairs it; may be empty.
  const std::string& remedy() const { return remedy_; }

private:
  static std::string sentence(
      const std::string& function, const std::string& argument, const std::string& problem,
      const std::string& remedy)
  {
    const std::string text = function + ": " + argument + ": " + problem;
    return remedy.empty() ? text : text + "; " + remedy;
  }

  std::string function_;
  std::string argument_;
  std::string problem_;
  std::string remedy_;
};

} // namespace surety

#endif // SURETY_ERRORS_H
