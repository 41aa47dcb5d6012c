// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a soup to a mesh. Vertices and faces keep the order of the file, because a certificate
// refers to them by number.
#include "mesh_reading.h"

#include "failure.h"
#include "soup_reading.h"

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/helpers.h>

namespace surety::tool {

namespace PMP = CGAL::Polygon_mesh_processing;

Mesh read_mesh(const std::string& file, const Reading& options)
{
  Soup soup = read_soup(file);
  if (options.stitch) stitch_if_unconnected(soup);
  require_manifold(soup, file, options.triangulate);
  orient(soup, file);

  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  if (!CGAL::is_triangle_mesh(mesh) && !PMP::triangulate_faces(mesh)) {
    throw Bad_file(file, "some faces cannot be split into triangles", "triangulate them yourself");
  }
  return mesh;
}

} // namespace surety::tool
