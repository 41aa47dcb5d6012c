// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a soup to a mesh. Vertices and faces keep the order of the file, because a certificate
// refers to them by number.
#include "mesh_reading.h"

#include "failure.h"
#include "marks.h"
#include "soup_reading.h"

#include <surety/internal/validation.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/helpers.h>

namespace surety::tool {

namespace PMP = CGAL::Polygon_mesh_processing;

namespace {

void triangulate(Mesh& mesh, const std::string& file)
{
  if (CGAL::is_triangle_mesh(mesh) || PMP::triangulate_faces(mesh)) return;
  throw Bad_file(file, "some faces cannot be split into triangles", "triangulate them yourself");
}

void repair_soup(Soup& soup, const std::string& file, const Reading& options, Repairs& repairs)
{
  if (soup.annotations)
    throw Bad_file(
        file, "its references and required elements name vertices, which repairing numbers anew",
        "leave --repair out, or write it as off, obj or ply first");
  require_polygons(soup, file, options.triangulate);
  repair(soup, repairs);
}

/// Each polygon with vertices of its own.
Mesh unconnected(const Soup& soup)
{
  Mesh mesh;
  for (const auto& polygon : soup.polygons) {
    std::vector<Mesh::Vertex_index> corners;
    for (const std::size_t v : polygon) corners.push_back(mesh.add_vertex(soup.points[v]));
    mesh.add_face(corners);
  }
  return mesh;
}

} // namespace

Mesh read_mesh(const std::string& file, const Reading& options)
{
  Repairs repairs;
  return read_mesh(file, options, repairs);
}

Mesh read_mesh(const std::string& file, const Reading& options, Repairs& repairs)
{
  Soup soup = read_soup(file);
  if (options.repair) repair_soup(soup, file, options, repairs);
  // What annotations refer to keeps its number.
  if (options.stitch && !soup.annotations) stitch_if_unconnected(soup);
  require_polygons(soup, file, options.triangulate);
  require_manifold(soup, file);
  orient(soup, file);

  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  triangulate(mesh, file);
  if (options.repair) {
    if (soup.annotations) mark(mesh, *soup.annotations, file);
    repair(mesh, repairs);
  }
  if (const auto defect = surety::internal::find_defect(mesh)) {
    throw Bad_file(file, defect->problem, defect->remedy);
  }
  if (soup.annotations && !options.repair) mark(mesh, *soup.annotations, file);
  return mesh;
}

Mesh read_triangles(const std::string& file, const Reading& options)
{
  Soup soup = read_soup(file);
  if (options.stitch) stitch_if_unconnected(soup);
  require_polygons(soup, file, options.triangulate);

  Mesh mesh;
  if (PMP::is_polygon_soup_a_polygon_mesh(soup.polygons)) {
    PMP::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  } else {
    mesh = unconnected(soup);
  }
  triangulate(mesh, file);
  return mesh;
}

} // namespace surety::tool
