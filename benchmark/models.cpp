// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds models.
#include "models.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

namespace surety::benchmark {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 4> extensions = {".off", ".ply", ".stl", ".obj"};

bool is_mesh_file(const fs::path& path)
{
  return std::find(extensions.begin(), extensions.end(), path.extension()) != extensions.end();
}

} // namespace

Models::Models(CLI::App& program) : folder_(SURETY_BENCHMARK_DATA_DIR)
{
  program.add_option("--data", folder_, "Folder of the models")
      ->envname("SURETY_DATA_DIR")
      ->capture_default_str();
}

std::string Models::path(const std::string& name) const
{
  if (fs::is_regular_file(name)) return name;
  const fs::path model = fs::path(folder_) / name;
  if (fs::is_regular_file(model)) return model.string();
  for (const char* extension : extensions) {
    const std::string path = model.string() + extension;
    if (fs::is_regular_file(path)) return path;
  }
  throw std::runtime_error(
      "there is no model or file '" + name + "'; name the folder of models with --data");
}

std::vector<std::string> Models::all() const
{
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (is_mesh_file(entry.path())) paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string model_name(const std::string& path) { return fs::path(path).stem().string(); }

} // namespace surety::benchmark
