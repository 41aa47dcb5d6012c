// SPDX-License-Identifier: GPL-3.0-or-later
//
// What files say of vertices beside their place, colours, normals and texture coordinates, and how
// a new mesh of the same surface gets it.
#ifndef SURETY_TOOL_ATTRIBUTES_H
#define SURETY_TOOL_ATTRIBUTES_H

#include "mesh.h"

#include <surety/correspondence.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace surety::tool {

/// One value a corner of each face, so that the sides of a ridge may have normals of their own.
struct Attribute {
  using Value = std::array<double, 4>;

  std::size_t components = 0; ///< how many numbers of a value count; the others are 0
  std::vector<Value> values;
  /// Which value each corner has: those of the first face in order, of the second, ... In a mesh
  /// the corners of a face are the targets of its halfedge and of the two that follow.
  std::vector<std::uint32_t> of_corner;
};

struct Attributes {
  std::optional<Attribute> color; ///< red, green, blue and perhaps alpha, from 0 to 255
  std::optional<Attribute> normal, texture;

  bool is_empty() const { return !color && !normal && !texture; }
};

/// Values for the corners of a mesh that was made of another one.
///
/// Each corner takes what is linearly interpolated in a face of the old mesh: with a map between
/// the two, the nearest of the faces around what it takes to the vertex, otherwise the nearest of
/// all that look the same way. Where values part at an edge of the old mesh, as normals do at a
/// ridge, the corner keeps to the side on which the middle of its face lies. Corners at a vertex
/// share a mean on each side. Normals get unit length. Texture coordinates with seams are left out:
/// what lies across a seam has nothing in between.
Attributes carry_attributes(
    const Attributes& given, const Mesh& from, const Mesh& to,
    const std::optional<Correspondence>& map = std::nullopt);

/// One value a vertex: the mean of those at its corners; normals get unit length.
std::vector<Attribute::Value> vertex_values(
    const Attribute& attribute, const Mesh& mesh, bool is_normal);

/// Whether files with this extension have room for them.
bool holds_attributes(const std::string& extension);

/// A line that tells what was carried and what was not, or nothing.
std::string to_text(
    const Attributes& given, const Attributes& carried, const std::string& indentation);

/// What there is, as reports call it.
std::vector<std::string> names_of(const Attributes& attributes);

} // namespace surety::tool

#endif // SURETY_TOOL_ATTRIBUTES_H
