// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's writers for OFF, OBJ, PLY and STL, and ours for the others.
#include "mesh_writing.h"

#include "attribute_writing.h"
#include "colors.h"
#include "faces.h"
#include "marks.h"
#include "medit.h"
#include "vtp.h"

#include <CGAL/IO/Color.h>
#include <CGAL/Surface_mesh/IO.h>
#include <CGAL/boost/graph/IO/OBJ.h>
#include <CGAL/boost/graph/IO/STL.h>

#include <algorithm>
#include <array>
#include <ostream>
#include <vector>

namespace surety::tool {
namespace {

using Face = Mesh::Face_index;

std::vector<double> bounds(const Mesh& mesh, const Deviation& deviation)
{
  std::vector<double> values;
  for (const Face face : mesh.faces()) values.push_back(get(deviation.bound, face));
  return values;
}

/// PLY writes all properties of a mesh: this copy has just those that the file shall have.
Mesh heat_map(const Mesh& mesh, const Deviation& deviation, const Attributes& attributes)
{
  Mesh result;
  for (const auto v : mesh.vertices()) result.add_vertex(mesh.point(v));
  for (const Face face : mesh.faces()) {
    const auto [a, b, c] = corners(mesh, face);
    result.add_face(a, b, c);
  }
  const auto bound = result.add_property_map<Face, double>("f:deviation", 0).first;
  const auto shape = result.add_property_map<Face, double>("f:quality", 0).first;
  const auto all_bounds = bounds(mesh, deviation), all_shapes = face_qualities(mesh);
  for (const Face face : result.faces()) {
    put(bound, face, all_bounds[face]);
    put(shape, face, all_shapes[face]);
  }
  add_ply_properties(result, attributes, mesh);
  if (attributes.color) return result;
  const auto color = result.add_property_map<Face, CGAL::IO::Color>("f:color").first;
  for (const Face face : result.faces())
    put(color, face, heat(all_bounds[face] / deviation.tolerance));
  return result;
}

void write_stl(std::ostream& stream, const Mesh& mesh)
{
  // Binary STL knows single precision only.
  if (has_float_coordinates(mesh)) CGAL::IO::set_binary_mode(stream);
  CGAL::IO::write_STL(stream, mesh);
}

} // namespace

bool is_writable(const std::string& extension)
{
  constexpr std::array<const char*, 7> known = {"off", "obj", "ply", "stl", "vtp", "mesh", "meshb"};
  return std::find(known.begin(), known.end(), extension) != known.end();
}

bool is_medit(const std::string& extension) { return extension == "mesh" || extension == "meshb"; }

bool has_float_coordinates(const Mesh& mesh)
{
  // Through memory: g++ 12 takes the way to float and back for the identity where it vectorises.
  const auto is_float = [](double x) {
    const volatile float single = static_cast<float>(x);
    return double(single) == x;
  };
  const auto vertices = mesh.vertices();
  return std::all_of(vertices.begin(), vertices.end(), [&](Mesh::Vertex_index v) {
    const Point& p = mesh.point(v);
    return is_float(p.x()) && is_float(p.y()) && is_float(p.z());
  });
}

void write_mesh(
    std::ostream& stream, const std::string& extension, const Mesh& mesh,
    const Deviation& deviation, const Attributes& attributes)
{
  stream.precision(17);
  if (extension == "off") CGAL::IO::write_OFF(stream, mesh);
  if (extension == "obj" && attributes.is_empty()) CGAL::IO::write_OBJ(stream, mesh);
  if (extension == "obj" && !attributes.is_empty()) write_obj(stream, mesh, attributes);
  if (extension == "stl") write_stl(stream, mesh);
  if (extension == "mesh") write_medit_text(stream, to_soup(mesh));
  if (extension == "meshb") write_medit_binary(stream, to_soup(mesh));
  if (extension == "vtp") {
    write_vtp(
        stream, mesh, vtp_arrays(attributes, mesh),
        {{"deviation", 1, bounds(mesh, deviation)}, {"quality", 1, face_qualities(mesh)}},
        "deviation");
  }
  if (extension == "ply") {
    CGAL::IO::set_binary_mode(stream);
    CGAL::IO::write_PLY(stream, heat_map(mesh, deviation, attributes));
  }
}

} // namespace surety::tool
