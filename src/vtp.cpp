// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtp.h"

#include <algorithm>
#include <ostream>

namespace surety::tool {
namespace {

template <class Value, class Values>
void write_array(
    std::ostream& stream, const char* type, const std::string& name, int components,
    const Values& values)
{
  stream << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
         << components << "\" format=\"ascii\">\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool ends_line = (i + 1) % std::size_t(components) == 0;
    stream << Value(values[i]) << (ends_line ? '\n' : ' ');
  }
  stream << "</DataArray>\n";
}

void write_data(
    std::ostream& stream, const char* element, const std::vector<Vtp_array>& data,
    const std::string& shown_first)
{
  if (data.empty()) return;
  const bool has_first = std::any_of(
      data.begin(), data.end(), [&](const Vtp_array& array) { return array.name == shown_first; });
  stream << '<' << element;
  if (has_first) stream << " Scalars=\"" << shown_first << '"';
  stream << ">\n";
  for (const Vtp_array& array : data) {
    if (array.is_color) {
      write_array<int>(stream, "UInt8", array.name, array.components, array.values);
    } else if (array.is_integral) {
      write_array<long long>(stream, "Int64", array.name, array.components, array.values);
    } else {
      write_array<double>(stream, "Float64", array.name, array.components, array.values);
    }
  }
  stream << "</" << element << ">\n";
}

} // namespace

void write_vtp(
    std::ostream& stream, const Mesh& mesh, const std::vector<Vtp_array>& vertex_data,
    const std::vector<Vtp_array>& face_data, const std::string& shown_first)
{
  std::vector<double> coordinates;
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  }
  std::vector<std::size_t> connectivity, offsets;
  for (const auto face : mesh.faces()) {
    const auto h = mesh.halfedge(face);
    for (const auto v : {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))}) {
      connectivity.push_back(v);
    }
    offsets.push_back(connectivity.size());
  }
  stream << "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
            "<PolyData>\n<Piece NumberOfPoints=\""
         << mesh.number_of_vertices() << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
         << "NumberOfStrips=\"0\" NumberOfPolys=\"" << mesh.number_of_faces() << "\">\n<Points>\n";
  write_array<double>(stream, "Float64", "Points", 3, coordinates);
  stream << "</Points>\n<Polys>\n";
  write_array<std::size_t>(stream, "Int64", "connectivity", 1, connectivity);
  write_array<std::size_t>(stream, "Int64", "offsets", 1, offsets);
  stream << "</Polys>\n";
  write_data(stream, "PointData", vertex_data, shown_first);
  write_data(stream, "CellData", face_data, shown_first);
  stream << "</Piece>\n</PolyData>\n</VTKFile>\n";
}

} // namespace surety::tool
