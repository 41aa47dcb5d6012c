// SPDX-License-Identifier: GPL-3.0-or-later
#include "shown_mesh.h"

#include "controls.h"
#include "faces.h"
#include "length.h"
#include "library_simplification.h"
#include "marks.h"
#include "progress.h"
#include "tolerance_field.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace surety::tool {
namespace {

using Face = Mesh::Face_index;

/// Bytes as text, as RFC 4648 has it.
std::string base64(std::string bytes)
{
  namespace iterators = boost::archive::iterators;
  using Digits = iterators::base64_from_binary<
      iterators::transform_width<std::string::const_iterator, 6, 8>>;
  // Three bytes make four digits; what stands for no byte at all is told by '='.
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  bytes.append(missing, '\0');
  std::string text(Digits(bytes.cbegin()), Digits(bytes.cend()));
  return text.replace(text.size() - missing, missing, missing, '=');
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
  result.mesh.remove_all_property_maps(); // a result has the tolerances that it was made with
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
