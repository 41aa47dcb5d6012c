// SPDX-License-Identifier: GPL-3.0-or-later
//
// Temporaries are made by mkstemp in the folder of their target, for only within one file system
// does a rename replace a file in one step.
#include "output_files.h"

#include "failure.h"

#include <algorithm>
#include <fstream>

#include <sys/stat.h>
#include <unistd.h>

namespace surety::tool {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& file, const std::string& problem)
{
  throw Failure(usage, file + ": " + problem);
}

/// The file behind a name, through all symbolic links, even one that leads to no file yet, so that
/// a link stays a link.
fs::path target_of(const std::string& file)
{
  constexpr int longest_chain = 40; // as in the kernel
  std::error_code error;
  fs::path path = fs::absolute(file);
  for (int i = 0; i < longest_chain && fs::is_symlink(path, error); ++i) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  const fs::path canonical = fs::weakly_canonical(path, error);
  return error ? path : canonical;
}

bool is_same_file(const std::string& a, const std::string& b)
{
  std::error_code error;
  return target_of(a) == target_of(b) || fs::equivalent(a, b, error);
}

fs::path make_temporary(const fs::path& target)
{
  std::string name
      = (target.parent_path() / ("." + target.filename().string() + ".XXXXXX")).string();
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0) refuse(target.string(), "its folder cannot be written to");
  // mkstemp makes private files; outputs get the usual permissions.
  const mode_t mask = umask(0);
  umask(mask);
  const bool is_open = fchmod(descriptor, 0666 & ~mask) == 0;
  close(descriptor);
  if (!is_open) refuse(target.string(), "its permissions cannot be set");
  return name;
}

} // namespace

Output_files::Output_files(std::vector<std::string> inputs) : inputs_(std::move(inputs)) {}

Output_files::~Output_files()
{
  std::error_code ignored;
  for (const auto& temporary : temporaries_) fs::remove(temporary.path, ignored);
}

void Output_files::announce(const std::string& file)
{
  const fs::path target = target_of(file), folder = target.parent_path();
  std::error_code error;
  const auto status = fs::status(target, error);
  if (target.filename().empty() || fs::is_directory(status)) {
    refuse(file, "this is a folder; give the name of a file");
  }
  if (fs::exists(status) && !fs::is_regular_file(status))
    refuse(file, "this is not a regular file");
  if (fs::exists(status) && (status.permissions() & fs::perms(0222)) == fs::perms::none) {
    refuse(file, "the file is write-protected");
  }
  if (!fs::is_directory(folder, error)) refuse(file, "there is no folder " + folder.string());
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse(file, "the folder " + folder.string() + " cannot be written to");
  }
  const auto is_same = [&](const std::string& other) { return is_same_file(file, other); };
  if (std::any_of(inputs_.begin(), inputs_.end(), is_same)) {
    refuse(file, "this would replace an input, without which a certificate says nothing");
  }
  if (std::any_of(announced_.begin(), announced_.end(), is_same)) {
    refuse(file, "two outputs have this name");
  }
  announced_.push_back(file);
}

void Output_files::write(const std::string& file, const std::function<void(std::ostream&)>& content)
{
  const fs::path target = target_of(file);
  temporaries_.push_back({make_temporary(target), target});
  std::ofstream stream(temporaries_.back().path, std::ios::binary);
  content(stream);
  stream.close();
  if (!stream) throw Failure(not_certified, file + ": writing failed; is the disk full?");
}

void Output_files::commit()
{
  for (const auto& temporary : temporaries_) {
    std::error_code error;
    fs::rename(temporary.path, temporary.target, error);
    if (error) {
      throw Failure(not_certified, temporary.target.string() + ": " + error.message());
    }
  }
  temporaries_.clear();
}

} // namespace surety::tool
