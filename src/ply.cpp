// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply.h"

#include <CGAL/Surface_mesh/IO.h>

#include <array>
#include <ostream>
#include <string>

namespace surety::tool {
namespace {

using Vertex = Mesh::Vertex_index;

void add_properties(Mesh& mesh, const Vtp_array& array)
{
  constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
  const auto number = static_cast<std::size_t>(array.components);
  for (std::size_t c = 0; c < number; ++c) {
    std::string name = "v:" + array.name;
    if (number == 3) name = name + "_" + axes[c];
    if (number == 9) name = name + "_" + axes[c / 3] + axes[c % 3];
    if (number == 9 && c % 3 < c / 3) continue; // symmetric
    if (array.is_integral) {
      const auto map = mesh.add_property_map<Vertex, int>(name, 0).first;
      for (const Vertex v : mesh.vertices()) put(map, v, int(array.values[v * number + c]));
    } else {
      const auto map = mesh.add_property_map<Vertex, double>(name, 0).first;
      for (const Vertex v : mesh.vertices()) put(map, v, array.values[v * number + c]);
    }
  }
}

} // namespace

void write_colored_ply(
    std::ostream& stream, const Mesh& mesh, const std::vector<CGAL::IO::Color>& colors,
    const std::vector<Vtp_array>& vertex_data)
{
  Mesh copy; // CGAL writes all properties of a mesh: this one has just those that it shall have
  for (const Vertex v : mesh.vertices()) copy.add_vertex(mesh.point(v));
  for (const auto face : mesh.faces()) {
    const auto h = mesh.halfedge(face);
    copy.add_face(mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)));
  }
  const auto color = copy.add_property_map<Vertex, CGAL::IO::Color>("v:color").first;
  for (const Vertex v : copy.vertices()) put(color, v, colors[v]);
  for (const Vtp_array& array : vertex_data) add_properties(copy, array);
  CGAL::IO::set_binary_mode(stream);
  CGAL::IO::write_PLY(stream, copy);
}

} // namespace surety::tool
