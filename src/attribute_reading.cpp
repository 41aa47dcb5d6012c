// SPDX-License-Identifier: GPL-3.0-or-later
//
// PLY by CGAL's reader of points with properties; OBJ, whose normals and texture coordinates CGAL's
// reader drops, line by line.
#include "attribute_reading.h"

#include "failure.h"

#include <CGAL/IO/read_ply_points.h>
#include <CGAL/property_map.h>

#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/stream.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

namespace surety::tool {
namespace {

using Value = Attribute::Value;
using Memory_stream = boost::iostreams::stream<boost::iostreams::array_source>;

constexpr double full = 255; ///< of a colour's channel

[[noreturn]] void refuse(
    const std::string& file, const char* what, const char* element, std::size_t number,
    const char* problem)
{
  throw Bad_file(
      file, std::string("the ") + what + " of " + element + ' ' + std::to_string(number) + problem,
      std::string("correct it, or leave the ") + what + "s out of the file");
}

void require_finite(
    const Attribute& attribute, const std::string& file, const char* what, const char* element)
{
  for (std::size_t i = 0; i < attribute.values.size(); ++i)
    for (const double x : attribute.values[i])
      if (!std::isfinite(x)) refuse(file, what, element, i, " is not finite");
}

/// Colours as fractions become those from 0 to 255.
void scale_fractions(Attribute& color, const std::string& file)
{
  for (std::size_t i = 0; i < color.values.size(); ++i)
    for (double& channel : color.values[i]) {
      if (!(channel >= 0 && channel <= 1))
        refuse(file, "colour", "vertex", i, " is not between 0 and 1");
      channel *= full;
    }
}

/// For values of vertices: which vertex each corner is.
std::vector<std::uint32_t> vertices_of_corners(const Soup& soup)
{
  std::vector<std::uint32_t> result;
  for (const auto& polygon : soup.polygons)
    for (const std::size_t v : polygon) result.push_back(static_cast<std::uint32_t>(v));
  return result;
}

// PLY.

/// The types of the vertices' numbers, by their names, as a PLY header lists them.
std::map<std::string, std::string> vertex_properties(const std::string& text)
{
  std::map<std::string, std::string> types;
  std::istringstream header(text);
  bool is_of_vertices = false;
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string keyword, type, name;
    words >> keyword >> type >> name;
    if (keyword == "end_header") break;
    if (keyword == "element") is_of_vertices = type == "vertex" || type == "vertices";
    if (keyword == "property" && is_of_vertices && type != "list") types[name] = type;
  }
  return types;
}

template <class Number>
struct To_value {
  Value operator()(Number a, Number b, Number c, Number d) const
  {
    return {double(a), double(b), double(c), double(d)};
  }
};

/// \param names four; the empty one stands for 0.
template <class Number>
std::vector<Value> read_properties(const std::string& text, const std::vector<const char*>& names)
{
  using Property = CGAL::IO::PLY_property<Number>;
  std::vector<Value> values;
  Memory_stream stream(text.data(), text.size());
  CGAL::IO::read_PLY_with_properties<Value>(
      stream, std::back_inserter(values),
      std::make_tuple(
          CGAL::Identity_property_map<Value>(), To_value<Number>(), Property(names[0]),
          Property(names[1]), Property(names[2]), Property(names[3])));
  return values;
}

std::vector<Value> read_properties(
    const std::string& file, const std::string& text, const std::vector<const char*>& names,
    const std::string& type)
{
  if (type == "uchar" || type == "uint8") return read_properties<std::uint8_t>(text, names);
  if (type == "ushort" || type == "uint16") return read_properties<std::uint16_t>(text, names);
  if (type == "float" || type == "float32" || type == "double" || type == "float64")
    return read_properties<double>(text, names);
  throw Bad_file(
      file, std::string("the vertices' '") + names[0] + "' is of type " + type,
      "store colours as uchar, normals and texture coordinates as float or double");
}

/// Properties that belong together, if the first is there.
std::optional<Attribute> read_group(
    const std::string& file, const std::string& text, const Soup& soup,
    const std::map<std::string, std::string>& types, std::vector<const char*> names)
{
  const auto has = [&](const char* name) { return types.count(name) != 0; };
  const auto there = std::find_if(names.begin(), names.end(), has);
  if (there == names.end()) return std::nullopt;
  for (const char* name : names) {
    if (has(name) && types.at(name) == types.at(*there)) continue;
    throw Bad_file(
        file,
        std::string("vertices have the property '") + *there + "', but not '" + name
            + "' of the same type",
        "write them all, or none");
  }
  Attribute result;
  result.components = names.size();
  const std::string type = types.at(*there);
  names.resize(4, "");
  result.values = read_properties(file, text, names, type);
  if (result.values.size() != soup.points.size())
    throw Bad_file(
        file,
        "there are " + std::to_string(soup.points.size()) + " vertices, but "
            + std::to_string(result.values.size()) + " have '" + names[0] + "'",
        "export the file again");
  result.of_corner = vertices_of_corners(soup);
  return result;
}

std::optional<Attribute> read_ply_color(
    const std::string& file, const std::string& text, const Soup& soup,
    const std::map<std::string, std::string>& types)
{
  std::vector<const char*> names = {"red", "green", "blue"};
  if (types.count("alpha") != 0) names.push_back("alpha");
  auto color = read_group(file, text, soup, types, names);
  if (!color) return std::nullopt;
  const std::string type = types.at("red");
  if (type == "ushort" || type == "uint16") {
    for (Value& value : color->values)
      for (double& channel : value) channel *= full / 65535;
  } else if (type != "uchar" && type != "uint8") {
    scale_fractions(*color, file);
  }
  return color;
}

// OBJ.

class Obj_attributes
{
public:
  Obj_attributes(const std::string& file, const Soup& soup) : file_(file), soup_(soup) {}

  void read_line(const char* line)
  {
    while (*line == ' ') ++line;
    if (line[0] == 'f' && line[1] == ' ') read_face(line + 2);
    if (line[0] != 'v') return;
    if (line[1] == ' ') read_vertex(line + 2);
    if (line[1] == 'n' && line[2] == ' ') normal_.values.push_back(numbers(line + 3).first);
    if (line[1] == 't' && line[2] == ' ') {
      texture_.values.push_back(numbers(line + 3).first);
      texture_.values.back()[2] = 0;
    }
  }

  Attributes result()
  {
    Attributes all;
    if (color_.components > 0) {
      scale_fractions(color_, file_);
      color_.of_corner = vertices_of_corners(soup_);
      all.color = std::move(color_);
    }
    normal_.components = 3;
    texture_.components = 2;
    all.normal = finished(normal_, "normal");
    all.texture = finished(texture_, "texture coordinate");
    return all;
  }

private:
  /// Up to four numbers, and how many there are.
  static std::pair<Value, std::size_t> numbers(const char* text)
  {
    Value value{};
    std::size_t count = 0;
    for (char* end = nullptr;; text = end, ++count) {
      const double x = std::strtod(text, &end);
      if (end == text) return {value, count};
      if (count < value.size()) value[count] = x;
    }
  }

  void read_vertex(const char* text)
  {
    for (int i = 0; i < 3; ++i) {
      char* end = nullptr;
      std::strtod(text, &end);
      text = end;
    }
    // A single number is a weight.
    const auto [value, count] = numbers(text);
    const std::size_t components = count == 3 || count == 4 ? count : 0;
    if (vertices_ > 0 && components != color_.components) {
      const bool lacks = components < color_.components;
      throw Bad_file(
          file_,
          "vertex " + std::to_string(vertices_) + (lacks ? " has no such colour" : " has a colour")
              + (lacks ? " as those before it" : ", unlike those before it"),
          "give all vertices one, or none");
    }
    color_.components = components;
    if (components > 0) color_.values.push_back(value);
    ++vertices_;
  }

  /// Corners as `1`, `1/2`, `1//3` or `1/2/3`: a vertex, a texture coordinate and a normal, counted
  /// from 1, or backwards from -1.
  void read_face(const char* text)
  {
    for (char* end = nullptr;; text = end) {
      const long vertex = std::strtol(text, &end, 10);
      if (end == text) break;
      (void)vertex;
      long texture = 0, normal = 0;
      if (*end == '/') {
        const char* at = end + 1;
        texture = std::strtol(at, &end, 10);
        if (*end == '/') normal = std::strtol(end + 1, &end, 10);
      }
      refer(texture_, texture, textured_, "texture coordinate");
      refer(normal_, normal, with_normal_, "normal");
      ++corners_;
      while (*end != '\0' && *end != ' ') ++end;
    }
    ++faces_;
  }

  /// \param number of corners that have one, so far
  void refer(Attribute& attribute, long index, std::size_t& number, const char* what) const
  {
    const auto size = static_cast<long>(attribute.values.size());
    attribute.of_corner.push_back(static_cast<std::uint32_t>(index < 0 ? size + index : index - 1));
    if (index == 0 && number == 0) return;
    if (index == 0 || number < corners_)
      throw Bad_file(
          file_,
          "face " + std::to_string(faces_) + " has a corner "
              + (index == 0 ? "without a " : "with a ") + what + ", unlike those before it",
          "give all corners one, or none");
    if (index < -size)
      throw Bad_file(
          file_,
          "face " + std::to_string(faces_) + " refers to the " + what + ' ' + std::to_string(index)
              + ", where there are " + std::to_string(size),
          "export the file again");
    ++number;
  }

  std::optional<Attribute> finished(Attribute& attribute, const char* what) const
  {
    const std::size_t number = attribute.components == 3 ? with_normal_ : textured_;
    if (number == 0) return std::nullopt;
    require_finite(attribute, file_, what, what);
    std::size_t corner = 0;
    for (std::size_t face = 0; face < soup_.polygons.size(); ++face)
      for (std::size_t i = 0; i < soup_.polygons[face].size(); ++i, ++corner) {
        if (corner < number && attribute.of_corner[corner] < attribute.values.size()) continue;
        throw Bad_file(
            file_,
            "face " + std::to_string(face) + " refers to a " + what + " that does not exist: there "
                + "are " + std::to_string(attribute.values.size()),
            "export the file again");
      }
    return std::move(attribute);
  }

  const std::string& file_;
  const Soup& soup_;
  Attribute color_, normal_, texture_;
  std::size_t vertices_ = 0, faces_ = 0, corners_ = 0, textured_ = 0, with_normal_ = 0;
};

} // namespace

Attributes read_ply_attributes(const std::string& file, const std::string& text, const Soup& soup)
{
  const auto types = vertex_properties(text);
  Attributes result;
  result.color = read_ply_color(file, text, soup, types);
  result.normal = read_group(file, text, soup, types, {"nx", "ny", "nz"});
  if (result.normal) require_finite(*result.normal, file, "normal", "vertex");
  constexpr std::array<std::array<const char*, 2>, 3> pairs
      = {{{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}};
  for (const auto& [first, second] : pairs) {
    // One of these letters alone may mean anything.
    if (result.texture || types.count(first) == 0 || types.count(second) == 0) continue;
    result.texture = read_group(file, text, soup, types, {first, second});
    require_finite(*result.texture, file, "texture coordinate", "vertex");
  }
  return result;
}

Attributes read_obj_attributes(const std::string& file, const std::string& text, const Soup& soup)
{
  Obj_attributes attributes(file, soup);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) attributes.read_line(line.c_str());
  return attributes.result();
}

namespace {

/// Applies a function to each attribute that there is.
template <class Function>
Attributes mapped(const Attributes& attributes, const Function& function)
{
  Attributes result;
  if (attributes.color) result.color = function(*attributes.color);
  if (attributes.normal) result.normal = function(*attributes.normal);
  if (attributes.texture) result.texture = function(*attributes.texture);
  return result;
}

/// Takes from each corner of a mesh to one of the soup.
Attributes renumbered(const Attributes& attributes, const std::vector<std::size_t>& corner)
{
  return mapped(attributes, [&](const Attribute& given) {
    Attribute result{given.components, given.values, {}};
    for (const std::size_t c : corner) result.of_corner.push_back(given.of_corner[c]);
    return result;
  });
}

template <class Find>
std::vector<std::size_t> corners_of(const Mesh& mesh, const Find& find)
{
  std::vector<std::size_t> result;
  for (const auto f : mesh.faces())
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f)))
      result.push_back(find(f, mesh.point(mesh.target(h))));
  return result;
}

} // namespace

Attribute_source::Attribute_source(const Soup& soup) : attributes_(soup.attributes)
{
  if (attributes_.is_empty()) return;
  for (const auto& polygon : soup.polygons) {
    first_.push_back(corners_.size());
    for (const std::size_t v : polygon) corners_.push_back(soup.points[v]);
  }
}

Attributes Attribute_source::of_parts(
    const Mesh& mesh, const std::vector<std::uint32_t>& polygon_of_face) const
{
  if (attributes_.is_empty()) return {};
  return renumbered(attributes_, corners_of(mesh, [&](Mesh::Face_index f, const Point& p) {
                      std::size_t corner = first_[polygon_of_face[f]];
                      while (corners_[corner] != p) ++corner;
                      return corner;
                    }));
}

Attributes Attribute_source::by_place(const Mesh& mesh) const
{
  if (attributes_.is_empty()) return {};
  std::map<Point, std::size_t> at;
  for (std::size_t c = 0; c < corners_.size(); ++c) at.emplace(corners_[c], c);
  return renumbered(
      attributes_, corners_of(mesh, [&](Mesh::Face_index, const Point& p) { return at.at(p); }));
}

} // namespace surety::tool
