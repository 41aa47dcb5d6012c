// SPDX-License-Identifier: GPL-3.0-or-later
//
// One mesh with positions and indices, in one buffer: glTF 2.0, sections 3.6 and 4.4. All numbers
// are little-endian.
#include "glb.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <ostream>
#include <string>

namespace surety::tool {
namespace {

constexpr std::uint32_t type_float = 5126, type_unsigned_int = 5125;
constexpr std::uint32_t target_vertices = 34962, target_indices = 34963;

void append(std::string& bytes, std::uint32_t word)
{
  for (int i = 0; i < 4; ++i, word >>= 8) bytes.push_back(static_cast<char>(word & 0xff));
}

void append(std::string& bytes, float value)
{
  std::uint32_t word;
  static_assert(sizeof word == sizeof value);
  std::memcpy(&word, &value, sizeof word);
  append(bytes, word);
}

void append_chunk(std::string& bytes, const char* type, std::string content, char padding)
{
  while (content.size() % 4 != 0) content.push_back(padding);
  append(bytes, static_cast<std::uint32_t>(content.size()));
  bytes.append(type, 4);
  bytes += content;
}

} // namespace

void write_glb(std::ostream& stream, const Mesh& mesh)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low = {infinity, infinity, infinity},
                       high = {-infinity, -infinity, -infinity};
  std::string buffer;
  for (const auto v : mesh.vertices())
    for (int i = 0; i < 3; ++i) {
      const auto x = static_cast<float>(mesh.point(v)[i]);
      low[i] = std::min(low[i], x);
      high[i] = std::max(high[i], x);
      append(buffer, x);
    }
  const std::size_t positions = buffer.size();
  for (const auto face : mesh.faces())
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(face)))
      append(buffer, static_cast<std::uint32_t>(v));

  using Json = nlohmann::ordered_json;
  const Json primitive
      = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"mode", 4}, {"material", 0}};
  const Json json
      = {{"asset", {{"version", "2.0"}, {"generator", "surety"}}},
         {"scene", 0},
         {"scenes", Json::array({{{"nodes", {0}}}})},
         {"nodes", Json::array({{{"mesh", 0}}})},
         {"meshes", Json::array({{{"primitives", Json::array({primitive})}}})},
         {"materials", Json::array({{{"doubleSided", true}}})},
         {"accessors",
          Json::array(
              {{{"bufferView", 0},
                {"componentType", type_float},
                {"count", mesh.number_of_vertices()},
                {"type", "VEC3"},
                {"min", low},
                {"max", high}},
               {{"bufferView", 1},
                {"componentType", type_unsigned_int},
                {"count", 3 * mesh.number_of_faces()},
                {"type", "SCALAR"}}})},
         {"bufferViews",
          Json::array(
              {{{"buffer", 0},
                {"byteOffset", 0},
                {"byteLength", positions},
                {"target", target_vertices}},
               {{"buffer", 0},
                {"byteOffset", positions},
                {"byteLength", buffer.size() - positions},
                {"target", target_indices}}})},
         {"buffers", Json::array({{{"byteLength", buffer.size()}}})}};

  std::string chunks, header = "glTF";
  append_chunk(chunks, "JSON", json.dump(), ' ');
  append_chunk(chunks, std::string("BIN\0", 4).data(), std::move(buffer), '\0');
  append(header, std::uint32_t(2));
  append(header, static_cast<std::uint32_t>(12 + chunks.size()));
  stream << header << chunks;
}

double single_precision_error(const Mesh& mesh)
{
  double largest = 0;
  for (const auto v : mesh.vertices())
    for (int i = 0; i < 3; ++i) {
      const double x = mesh.point(v)[i];
      largest = std::max(largest, std::abs(x - double(static_cast<float>(x))));
    }
  // Each difference is exact, and three of them make at most sqrt(3) times the largest.
  return largest * 1.7320508075689;
}

} // namespace surety::tool
