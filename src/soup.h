// SPDX-License-Identifier: GPL-3.0-or-later
//
// A soup of polygons, as files hold it, and what can be wrong with one. A half-edge mesh cannot
// even represent most of these defects, so they must be found, and named, before there is a mesh.
#ifndef SURETY_TOOL_SOUP_H
#define SURETY_TOOL_SOUP_H

#include "annotations.h"
#include "attributes.h"
#include "mesh.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace surety::tool {

struct Soup {
  using Polygon = std::vector<std::size_t>;

  std::vector<Point> points;
  std::vector<Polygon> polygons;
  std::optional<Annotations> annotations; ///< of formats that know any
  Attributes attributes;                  ///< likewise, corner by corner of the polygons
};

/// Merges points that are equal, if no two polygons share one: then the file knows no
/// connectivity, as an STL file. A soup that has some connectivity is left as it is, for what
/// touches in it without being connected may well be meant so.
void stitch_if_unconnected(Soup& soup);

/// Turns polygons round where neighbours disagree, and only there.
/// \throws Bad_file if the surface has one side only.
void orient(Soup& soup, const std::string& file);

/// \throws Bad_file unless all polygons are triangles, or polygons are admitted, with vertices that
/// exist and have finite coordinates.
void require_polygons(const Soup& soup, const std::string& file, bool admit_polygons);

/// \throws Bad_file unless the soup, of sound polygons, is a manifold surface: no isolated vertex,
/// no polygon twice, at most two polygons an edge, one fan a vertex.
void require_manifold(const Soup& soup, const std::string& file);

} // namespace surety::tool

#endif // SURETY_TOOL_SOUP_H
