// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that appear complete or not at all: each is written to a temporary beside its target, and
// all are renamed together when everything has succeeded.
#ifndef SURETY_TOOL_OUTPUT_FILES_H
#define SURETY_TOOL_OUTPUT_FILES_H

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace surety::tool {

class Output_files
{
public:
  /// \param inputs files that no output may replace.
  explicit Output_files(std::vector<std::string> inputs);
  Output_files(const Output_files&) = delete;
  Output_files& operator=(const Output_files&) = delete;
  /// Removes what was not committed.
  ~Output_files();

  /// Announces an output, before the work that it takes to make it.
  /// \throws Failure (usage) if it could not be written, or would replace another file of ours.
  void announce(const std::string& file);

  /// Writes an announced output to its temporary.
  /// \throws Failure if writing fails, as on a full disk.
  void write(const std::string& file, const std::function<void(std::ostream&)>& content);

  /// Renames all temporaries to their targets.
  void commit();

private:
  struct Temporary {
    std::filesystem::path path, target;
  };

  std::vector<std::string> inputs_;
  std::vector<std::string> announced_;
  std::vector<Temporary> temporaries_;
};

} // namespace surety::tool

#endif // SURETY_TOOL_OUTPUT_FILES_H
