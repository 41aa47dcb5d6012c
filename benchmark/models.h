// SPDX-License-Identifier: GPL-3.0-or-later
//
// The meshes that benchmarks run on: names of models in the data folder, or files of the user's.
#ifndef SURETY_BENCHMARK_MODELS_H
#define SURETY_BENCHMARK_MODELS_H

#include "mesh_reading.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace surety::benchmark {

using tool::Kernel;
using tool::Mesh;
using tool::Point;

/// The folder of models and the option --data that names it.
class Models
{
public:
  explicit Models(CLI::App& program);

  /// The path of a model, "bunny00" or "bunny00.off", or of a file that is given by its path.
  /// \throws std::runtime_error when there is no such model.
  std::string path(const std::string& name) const;

  /// All meshes of the folder, in alphabetical order.
  std::vector<std::string> all() const;

private:
  std::string folder_;
};

/// A path without folder and extension, for tables.
std::string model_name(const std::string& path);

inline double diagonal(const Mesh& mesh)
{
  const auto box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
}

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_MODELS_H
