// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a soup to a mesh. Vertices and faces keep the order of the file, because a certificate
// refers to them by number.
#include "mesh_reading.h"

#include "attribute_reading.h"
#include "failure.h"
#include "marks.h"
#include "soup_reading.h"

#include <surety/internal/validation.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/helpers.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace surety::tool {

namespace PMP = CGAL::Polygon_mesh_processing;

namespace {

/// Notes which polygon each triangle is a part of.
class Origins : public PMP::Triangulate_faces::Default_visitor<Mesh>
{
public:
  explicit Origins(std::vector<std::uint32_t>& polygon) : polygon_(&polygon) {}

  void before_subface_creations(Mesh::Face_index face) { current_ = (*polygon_)[face]; }
  void after_subface_created(Mesh::Face_index face)
  {
    if (face >= polygon_->size()) polygon_->resize(face + 1);
    (*polygon_)[face] = current_;
  }

private:
  std::vector<std::uint32_t>* polygon_;
  std::uint32_t current_ = 0;
};

/// \returns the polygon of each triangle
std::vector<std::uint32_t> triangulate(Mesh& mesh, const std::string& file)
{
  std::vector<std::uint32_t> polygon(mesh.number_of_faces());
  std::iota(polygon.begin(), polygon.end(), std::uint32_t{0});
  if (CGAL::is_triangle_mesh(mesh)
      || PMP::triangulate_faces(mesh, CGAL::parameters::visitor(Origins(polygon))))
    return polygon;
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

/// \param attributes where to put them, if they are wanted
Mesh to_mesh(
    Soup soup, const std::string& file, const Reading& options, Repairs& repairs,
    Attributes* attributes)
{
  require_polygons(soup, file, options.triangulate);
  const Attribute_source source(soup);
  if (options.repair) repair_soup(soup, file, options, repairs);
  // What annotations refer to keeps its number.
  if (options.stitch && !soup.annotations) stitch_if_unconnected(soup);
  require_polygons(soup, file, options.triangulate);
  require_manifold(soup, file);
  orient(soup, file);

  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  const std::vector<std::uint32_t> polygons = triangulate(mesh, file);
  if (options.repair) {
    if (soup.annotations) mark(mesh, *soup.annotations, file);
    repair(mesh, repairs);
  }
  if (const auto defect = surety::internal::find_defect(mesh)) {
    throw Bad_file(file, defect->problem, defect->remedy);
  }
  if (soup.annotations && !options.repair) mark(mesh, *soup.annotations, file);
  if (attributes != nullptr)
    *attributes = options.repair ? source.by_place(mesh) : source.of_parts(mesh, polygons);
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
  return to_mesh(read_soup(file), file, options, repairs, nullptr);
}

Mesh read_mesh(
    const std::string& file, const Reading& options, Repairs& repairs, Attributes& attributes)
{
  return to_mesh(read_soup(file, true), file, options, repairs, &attributes);
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
