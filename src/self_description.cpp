// SPDX-License-Identifier: GPL-3.0-or-later
#include "self_description.h"

#include <surety/version.h>

#include <sstream>
#include <vector>

namespace surety::tool {
namespace {

using Words = std::vector<std::string>;

std::vector<const CLI::App*> commands_of(const CLI::App& program)
{
  return program.get_subcommands([](const CLI::App*) { return true; });
}

std::string joined(const Words& words, const char* separator)
{
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : separator) + word;
  return result;
}

/// The values of an option that knows a few only: ENUM:on-surface|free, or TEXT:{off,ply}.
Words choices(const CLI::Option& option)
{
  std::string text = option.get_type_name();
  const auto colon = text.find(':');
  if (colon == std::string::npos) return {};
  text.erase(0, colon + 1);
  for (char& c : text)
    if (c == '{' || c == '}' || c == '|' || c == ',') c = ' ';
  Words result;
  std::istringstream words(text);
  for (std::string word; words >> word;) result.push_back(word);
  return result;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// -o, --output
Words names(const CLI::Option& option)
{
  Words result;
  for (const std::string& name : option.get_snames()) result.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.push_back("--" + name);
  return result;
}

// The manual page.

/// Text as troff prints it: no character is a command, and a hyphen can be copied as one.
std::string escaped(const std::string& text)
{
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (begins_line && (text[i] == '.' || text[i] == '\'')) result += "\\&";
    if (text[i] == '\\') {
      result += "\\e";
    } else if (text[i] == '-') {
      result += "\\-";
    } else {
      result += text[i];
    }
  }
  return result;
}

/// What stands for the value of an option.
std::string placeholder(const CLI::Option& option)
{
  const Words values = choices(option);
  if (!values.empty()) return escaped(joined(values, "|"));
  const std::string type = option.get_type_name();
  return type == "UINT" ? "NUMBER" : type == "FLOAT" ? "REAL" : type;
}

void describe(std::ostream& page, const CLI::Option& option)
{
  page << ".TP\n";
  if (option.get_positional()) {
    page << "\\fI" << escaped(option.get_single_name()) << "\\fR\n";
  } else {
    page << "\\fB" << escaped(joined(names(option), ", ")) << "\\fR";
    if (takes_value(option)) page << " \\fI" << placeholder(option) << "\\fR";
    page << '\n';
  }
  page << escaped(option.get_description());
  if (!option.get_default_str().empty()) page << " [" << escaped(option.get_default_str()) << "]";
  page << '\n';
}

/// Each line of the text as a line of the page.
void write_lines(std::ostream& page, const std::string& text)
{
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) page << ".br\n" << escaped(line) << '\n';
}

void describe(std::ostream& page, const CLI::App& command)
{
  page << ".SS " << escaped(command.get_name()) << '\n'
       << escaped(command.get_description()) << ".\n.PP\n.B surety " << escaped(command.get_name());
  const auto options = command.get_options();
  for (const CLI::Option* option : options)
    if (option->get_positional()) page << " \\fI" << escaped(option->get_single_name()) << "\\fR";
  page << " \\fR[options]\n";
  for (const bool is_positional : {true, false})
    for (const CLI::Option* option : options)
      if (option->get_positional() == is_positional) describe(page, *option);
  page << ".PP\n";
  write_lines(page, command.get_footer());
}

// The completion.

std::string quoted(const Words& words) { return "'" + joined(words, " ") + "'"; }

/// What completes the word behind an option: one of its values, or a file where that is not known
/// to be a number.
std::string completed_value(const CLI::Option& option)
{
  const Words values = choices(option);
  if (!values.empty()) return "COMPREPLY=($(compgen -W " + quoted(values) + " -- \"$word\"))";
  if (option.get_type_name() == "TEXT") return "COMPREPLY=($(compgen -f -- \"$word\"))";
  return "COMPREPLY=()";
}

void complete(std::ostream& script, const CLI::App& app, const Words& first_words)
{
  Words all;
  script << "      case \"$previous\" in\n";
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) continue;
    const Words own = names(*option);
    all.insert(all.end(), own.begin(), own.end());
    if (!takes_value(*option)) continue;
    script << "        " << joined(own, "|") << ") " << completed_value(*option) << "; return ;;\n";
  }
  script << "      esac\n      options=" << quoted(all) << "\n      words=" << quoted(first_words)
         << '\n';
}

} // namespace

std::string manual_page(const CLI::App& program)
{
  std::ostringstream page;
  page << ".TH SURETY 1 \"\" \"surety " SURETY_VERSION_STRING "\" \"User Commands\"\n"
       << ".SH NAME\nsurety \\- certified surface remeshing\n"
       << ".SH SYNOPSIS\n.B surety \\fICOMMAND\\fR [options]\n"
       << ".SH DESCRIPTION\n"
       << escaped(program.get_description()) << "\n.PP\n";
  write_lines(page, program.get_footer());
  page << ".SH OPTIONS\n";
  for (const CLI::Option* option : program.get_options()) describe(page, *option);
  page << ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(program)) describe(page, *command);
  return page.str();
}

std::string bash_completion(const CLI::App& program)
{
  Words commands;
  for (const CLI::App* command : commands_of(program)) commands.push_back(command->get_name());
  std::ostringstream script;
  script << "# Completion of surety " SURETY_VERSION_STRING " for bash.\n"
            "_surety()\n"
            "{\n"
            "  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
            "  local command= options= words=\n"
            "  ((COMP_CWORD > 1)) && command=${COMP_WORDS[1]}\n"
            "  case \"$command\" in\n";
  for (const CLI::App* command : commands_of(program)) {
    script << "    " << command->get_name() << ")\n";
    complete(script, *command, {});
    script << "      ;;\n";
  }
  script << "    *)\n";
  complete(script, program, commands);
  script << "      ;;\n"
            "  esac\n"
            "  case \"$word\" in\n"
            "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
            "    *) if [[ -n $words ]]; then\n"
            "         COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
            "       else\n"
            "         COMPREPLY=($(compgen -f -- \"$word\"))\n"
            "       fi ;;\n"
            "  esac\n"
            "}\n"
            "complete -o filenames -F _surety surety";
  return script.str();
}

} // namespace surety::tool
