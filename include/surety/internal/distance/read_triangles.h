// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a mesh to the arrays that the verifier of distances works on, with the checks of what it
// asks for: triangles and finite coordinates. Degenerate and duplicate faces are welcome.
#ifndef SURETY_INTERNAL_DISTANCE_READ_TRIANGLES_H
#define SURETY_INTERNAL_DISTANCE_READ_TRIANGLES_H

#include <surety/errors.h>
#include <surety/internal/distance/triangle_set.h>

#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace surety {
namespace internal {
namespace hausdorff {

template <class Mesh, class Point_map>
class Triangle_reader
{
  using Graph = boost::graph_traits<Mesh>;
  using Vertex = typename Graph::vertex_descriptor;
  using Mesh_point = typename boost::property_traits<Point_map>::value_type;
  static_assert(
      std::is_convertible_v<decltype(std::declval<Mesh_point>().x()), double>,
      "distances are certified for meshes whose coordinates are doubles");

public:
  Triangle_reader(
      const Mesh& mesh, const Point_map& points, const char* function, const char* argument)
    : mesh_(mesh), points_(points), function_(function), argument_(argument)
  {}

  Soup read()
  {
    Soup soup;
    const auto index = CGAL::get_initialized_vertex_index_map(mesh_);
    std::vector<std::uint32_t> number;
    for (const auto f : faces(mesh_)) {
      soup.faces.emplace_back();
      int i = 0;
      for (const Vertex v : corners(f, soup.faces.size() - 1)) {
        const auto id = static_cast<std::size_t>(get(index, v));
        if (id >= number.size()) number.resize(2 * id + 1, unseen);
        if (number[id] == unseen) {
          number[id] = static_cast<std::uint32_t>(soup.points.size());
          soup.points.push_back(coordinates(v, soup.faces.size() - 1));
        }
        soup.faces.back()[i++] = number[id];
      }
    }
    if (soup.faces.empty()) fail("the mesh has no face", "");
    if (soup.faces.size() >= unseen) fail("the mesh has more than 2^32 - 2 faces", "");
    return soup;
  }

private:
  static constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();

  std::array<Vertex, 3> corners(typename Graph::face_descriptor f, std::size_t number) const
  {
    const auto h = halfedge(f, mesh_);
    const auto second = next(h, mesh_), third = next(second, mesh_);
    if (third == h || next(third, mesh_) != h) {
      fail(
          "face " + std::to_string(number) + " is not a triangle",
          "triangulate with CGAL::Polygon_mesh_processing::triangulate_faces");
    }
    return {target(h, mesh_), target(second, mesh_), target(third, mesh_)};
  }

  Coordinates coordinates(Vertex v, std::size_t face) const
  {
    const Mesh_point& p = get(points_, v);
    const Coordinates result = {double(p.x()), double(p.y()), double(p.z())};
    for (const double x : result) {
      if (std::isfinite(x)) continue;
      fail(
          "a vertex of face " + std::to_string(face) + " has a coordinate that is not finite",
          "remove the vertex, or repair the program that wrote the file");
    }
    return result;
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const
  {
    throw Invalid_input(function_, argument_, problem, remedy);
  }

  const Mesh& mesh_;
  Point_map points_;
  const char* function_;
  const char* argument_;
};

/// Reads a mesh; throws `Invalid_input` if it is empty, not triangulated or not finite.
template <class Mesh, class NamedParameters>
Soup read_triangles(
    const Mesh& mesh, const NamedParameters& np, const char* function, const char* argument)
{
  const auto points = CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_point),
      CGAL::get_const_property_map(CGAL::vertex_point, mesh));
  return Triangle_reader<Mesh, std::decay_t<decltype(points)>>(mesh, points, function, argument)
      .read();
}

} // namespace hausdorff
} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_DISTANCE_READ_TRIANGLES_H
