// SPDX-License-Identifier: GPL-3.0-or-later
#include "tolerance_field.h"

#include "failure.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

namespace surety::tool {
namespace {

std::vector<double> read_numbers(const std::string& file)
{
  std::ifstream stream(file);
  if (!stream) throw Bad_file(file, "the file cannot be opened", "");
  std::vector<double> numbers;
  for (double number; stream >> number;) {
    if (!(number > 0) || !std::isfinite(number))
      throw Bad_file(
          file, "number " + std::to_string(numbers.size()) + " is not a positive length",
          "give lengths in the units of the mesh");
    numbers.push_back(number);
  }
  if (!stream.eof())
    throw Bad_file(
        file, "what follows number " + std::to_string(numbers.size()) + " is not a number", "");
  return numbers;
}

} // namespace

Tolerances add_tolerances(Mesh& mesh, double tolerance, const std::string& file)
{
  const Tolerances result
      = mesh.add_property_map<Mesh::Vertex_index, double>("v:tolerance", tolerance).first;
  if (file.empty()) return result;
  const std::vector<double> numbers = read_numbers(file);
  std::size_t next = 0;
  if (numbers.size() == mesh.number_of_vertices()) {
    for (const auto v : mesh.vertices()) result[v] = std::min(tolerance, numbers[next++]);
    return result;
  }
  if (numbers.size() != mesh.number_of_faces())
    throw Bad_file(
        file,
        "it holds " + std::to_string(numbers.size()) + " numbers, but the mesh has "
            + std::to_string(mesh.number_of_vertices()) + " vertices and "
            + std::to_string(mesh.number_of_faces()) + " faces",
        "give one tolerance for each vertex, or one for each face");
  for (const auto f : mesh.faces()) {
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      result[v] = std::min(result[v], numbers[next]);
    ++next;
  }
  return result;
}

} // namespace surety::tool
