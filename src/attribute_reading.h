// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colours, normals and texture coordinates of PLY and OBJ files, and their way to the mesh that is
// made of the soup.
#ifndef SURETY_TOOL_ATTRIBUTE_READING_H
#define SURETY_TOOL_ATTRIBUTE_READING_H

#include "attributes.h"
#include "mesh.h"
#include "soup.h"

#include <cstdint>
#include <string>
#include <vector>

namespace surety::tool {

/// Those of the vertices of a PLY file: `red`, `green`, `blue` and perhaps `alpha`; `nx`, `ny`,
/// `nz`; `s`, `t`, or `u`, `v`, or `texture_u`, `texture_v`.
/// \param soup of the same file. \throws Bad_file if they are incomplete, or no numbers to work
/// with.
Attributes read_ply_attributes(const std::string& file, const std::string& text, const Soup& soup);

/// Those of an OBJ file: numbers behind the coordinates of `v`, `vn` and `vt`.
/// \param text with continued lines joined. \throws Bad_file as above.
Attributes read_obj_attributes(const std::string& file, const std::string& text, const Soup& soup);

/// A soup's attributes and the places of its corners, taken before the soup is changed.
class Attribute_source
{
public:
  explicit Attribute_source(const Soup& soup);

  /// Those of a mesh, by what polygon each face is a part of: its corners are recognised by their
  /// coordinates, whatever numbers they have by now.
  Attributes of_parts(const Mesh& mesh, const std::vector<std::uint32_t>& polygon_of_face) const;

  /// Those of a mesh whose faces may be others: where corners in one place have several values, it
  /// is the first one.
  Attributes by_place(const Mesh& mesh) const;

private:
  Attributes attributes_;
  std::vector<Point> corners_;
  std::vector<std::size_t> first_; ///< corner of each polygon
};

} // namespace surety::tool

#endif // SURETY_TOOL_ATTRIBUTE_READING_H
