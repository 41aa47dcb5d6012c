// SPDX-License-Identifier: GPL-3.0-or-later
#include "shown_mesh.h"

#include "controls.h"
#include "length.h"
#include "library_simplification.h"
#include "marks.h"
#include "progress.h"
#include "tolerance_field.h"

#include <surety/statistics.h>

#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace surety::tool {
namespace {

using Face = Mesh::Face_index;

std::array<Mesh::Vertex_index, 3> corners(const Mesh& mesh, Face face)
{
  const auto h = mesh.halfedge(face);
  return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
}

/// Bytes as text, as RFC 4648 has it.
std::string base64(const std::string& bytes)
{
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? std::uint32_t(static_cast<unsigned char>(bytes[k])) : 0u;
    };
    const std::uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[three >> shift & 63];
  }
  // What stands for no byte at all is told by '='.
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

void append(std::string& bytes, std::uint32_t value, int number_of_bytes)
{
  for (int i = 0; i < number_of_bytes; ++i) bytes += static_cast<char>(value >> 8 * i & 255);
}

/// The integer from 0 to `largest` for a share of the way.
std::uint32_t quantise(double share, double largest)
{
  // A value that is no number is shown as the least one.
  if (!(share > 0)) return 0;
  return static_cast<std::uint32_t>(std::lround(std::min(share, 1.) * largest));
}

Json describe_field(const Shown_field& field)
{
  std::string bytes;
  for (const double value : field.values)
    append(bytes, quantise((value - field.low) / (field.high - field.low), 255), 1);
  const auto largest = std::max_element(field.values.begin(), field.values.end());
  return {
      {"name", field.name},
      {"label", field.label},
      {"low", field.low},
      {"high", field.high},
      {"is_clamped", largest != field.values.end() && *largest > field.high},
      {"values", base64(bytes)}};
}

} // namespace

Display_mesh simplified_for_display(const Mesh& mesh, std::size_t faces)
{
  Display_mesh result{mesh, 0};
  Controls controls;
  controls.target_faces = faces;
  controls.effort = Effort::fast;
  // For the eye only: what it costs to look for them is not worth it.
  controls.allow_self_intersections = true;
  const double tolerance = diagonal(mesh);
  set_ridge_length(controls, tolerance, tolerance);
  Progress_bar bar(true);
  const Tolerances tolerances = add_tolerances(result.mesh, tolerance, "");
  result.bound = make_geometric_mesh<Concurrency>(
                     result.mesh, tolerance,
                     simplify_parameters(controls, tolerances, constraints_of(mesh), Visitor(bar)))
                     .bound();
  return result;
}

std::vector<double> face_qualities(const Mesh& mesh)
{
  std::vector<double> values;
  for (const Face face : mesh.faces()) {
    const auto [a, b, c] = corners(mesh, face);
    values.push_back(quality(mesh.point(a), mesh.point(b), mesh.point(c)));
  }
  return values;
}

std::vector<double> face_sizes(const Mesh& mesh)
{
  const auto length = [&](Mesh::Vertex_index a, Mesh::Vertex_index b) {
    return std::sqrt(CGAL::squared_distance(mesh.point(a), mesh.point(b)));
  };
  std::vector<double> values;
  for (const Face face : mesh.faces()) {
    const auto [a, b, c] = corners(mesh, face);
    values.push_back((length(a, b) + length(b, c) + length(c, a)) / 3);
  }
  return values;
}

Json describe_shape(const Mesh& mesh, const std::vector<Shown_field>& fields)
{
  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh);
  const std::array<double, 3> extent
      = {box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()};
  const double largest = *std::max_element(extent.begin(), extent.end());
  std::string positions, indices;
  std::vector<std::uint32_t> number(mesh.num_vertices());
  std::uint32_t vertices = 0;
  for (const auto v : mesh.vertices()) {
    number[v] = vertices++;
    for (int k = 0; k < 3; ++k)
      append(positions, quantise((mesh.point(v)[k] - box.min(k)) / largest, 65535), 2);
  }
  const int index_bytes = vertices <= 65536 ? 2 : 4;
  for (const Face face : mesh.faces())
    for (const auto v : corners(mesh, face)) append(indices, number[v], index_bytes);

  Json json
      = {{"origin", {box.xmin(), box.ymin(), box.zmin()}},
         {"size", extent},
         {"step", largest / 65535},
         {"positions", base64(positions)},
         {"index_bytes", index_bytes},
         {"faces", base64(indices)}};
  json["fields"] = Json::array();
  for (const Shown_field& field : fields) json["fields"].push_back(describe_field(field));
  return json;
}

} // namespace surety::tool
