// SPDX-License-Identifier: GPL-3.0-or-later
#include "attribute_writing.h"

#include <CGAL/IO/Color.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <ostream>
#include <string>

namespace surety::tool {
namespace {

using Vertex = Mesh::Vertex_index;
using Value = Attribute::Value;

/// A channel as files have it.
unsigned char to_byte(double channel)
{
  return static_cast<unsigned char>(std::lround(std::clamp(channel, 0., 255.)));
}

void write_numbers(std::ostream& stream, const Value& value, std::size_t components)
{
  for (std::size_t i = 0; i < components; ++i) stream << ' ' << value[i];
}

/// Writes each value once. \returns its number, from 1, by corner.
std::vector<std::size_t> write_values(
    std::ostream& stream, const char* keyword, const Attribute& attribute)
{
  std::map<Value, std::size_t> numbers;
  std::vector<std::size_t> result;
  for (const std::uint32_t index : attribute.of_corner) {
    const Value& value = attribute.values[index];
    const auto [at, is_new] = numbers.emplace(value, numbers.size() + 1);
    result.push_back(at->second);
    if (!is_new) continue;
    stream << keyword;
    write_numbers(stream, value, attribute.components);
    stream << '\n';
  }
  return result;
}

void write_vertices(std::ostream& stream, const Mesh& mesh, const Attributes& attributes)
{
  std::vector<Value> colors;
  if (attributes.color) colors = vertex_values(*attributes.color, mesh, false);
  for (const Vertex v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    stream << "v " << p.x() << ' ' << p.y() << ' ' << p.z();
    if (attributes.color)
      for (std::size_t c = 0; c < attributes.color->components; ++c)
        stream << ' ' << to_byte(colors[v][c]) / 255.;
    stream << '\n';
  }
}

void add_array(
    std::vector<Vtp_array>& arrays, const char* name, const Attribute& attribute, const Mesh& mesh)
{
  Vtp_array array{name, int(attribute.components), {}};
  array.is_color = std::string(name) == "color";
  for (const Value& value : vertex_values(attribute, mesh, std::string(name) == "normal"))
    for (std::size_t c = 0; c < attribute.components; ++c)
      array.values.push_back(array.is_color ? to_byte(value[c]) : value[c]);
  arrays.push_back(std::move(array));
}

} // namespace

void write_obj(std::ostream& stream, const Mesh& mesh, const Attributes& attributes)
{
  write_vertices(stream, mesh, attributes);
  std::vector<std::size_t> texture, normal;
  if (attributes.texture) texture = write_values(stream, "vt", *attributes.texture);
  if (attributes.normal) normal = write_values(stream, "vn", *attributes.normal);
  std::size_t corner = 0;
  for (const auto f : mesh.faces()) {
    stream << 'f';
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
      stream << ' ' << mesh.target(h) + 1;
      if (!texture.empty() || !normal.empty()) stream << '/';
      if (!texture.empty()) stream << texture[corner];
      if (!normal.empty()) stream << '/' << normal[corner];
      ++corner;
    }
    stream << '\n';
  }
}

void add_ply_properties(Mesh& copy, const Attributes& attributes, const Mesh& mesh)
{
  if (attributes.normal) {
    const auto map = copy.add_property_map<Vertex, Kernel::Vector_3>("v:normal").first;
    const auto values = vertex_values(*attributes.normal, mesh, true);
    for (const Vertex v : copy.vertices())
      put(map, v, Kernel::Vector_3(values[v][0], values[v][1], values[v][2]));
  }
  if (attributes.color) {
    const auto map = copy.add_property_map<Vertex, CGAL::IO::Color>("v:color").first;
    const auto values = vertex_values(*attributes.color, mesh, false);
    const bool has_alpha = attributes.color->components == 4;
    for (const Vertex v : copy.vertices()) {
      const auto& [red, green, blue, alpha] = values[v];
      put(map, v,
          CGAL::IO::Color(
              to_byte(red), to_byte(green), to_byte(blue), to_byte(has_alpha ? alpha : 255)));
    }
  }
  if (!attributes.texture) return;
  const auto values = vertex_values(*attributes.texture, mesh, false);
  const auto s = copy.add_property_map<Vertex, double>("v:s").first,
             t = copy.add_property_map<Vertex, double>("v:t").first;
  for (const Vertex v : copy.vertices()) s[v] = values[v][0], t[v] = values[v][1];
}

std::vector<Vtp_array> vtp_arrays(const Attributes& attributes, const Mesh& mesh)
{
  std::vector<Vtp_array> arrays;
  if (attributes.color) add_array(arrays, "color", *attributes.color, mesh);
  if (attributes.normal) add_array(arrays, "normal", *attributes.normal, mesh);
  if (attributes.texture) add_array(arrays, "texture", *attributes.texture, mesh);
  return arrays;
}

} // namespace surety::tool
