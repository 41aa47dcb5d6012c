// SPDX-License-Identifier: GPL-3.0-or-later
//
// Figures that tell a mesh's size, topology and quality: what a report shows before and after.
#ifndef SURETY_STATISTICS_H
#define SURETY_STATISTICS_H

#include <surety/errors.h>
#include <surety/internal/statistics/topology.h>
#include <surety/internal/statistics/triangle.h>
#include <surety/parameters.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace surety {

/// What `mesh_statistics()` finds. Lengths are in mesh units.
struct Mesh_statistics {
  std::size_t vertices = 0;     ///< of the mesh
  std::size_t edges = 0;        ///< of the mesh
  std::size_t faces = 0;        ///< of the mesh
  std::size_t components = 0;   ///< pieces that hang together by edges
  std::size_t border_edges = 0; ///< edges with one face
  std::size_t border_loops = 0; ///< closed curves that they form
  std::size_t self_intersections
      = 0;              ///< pairs of faces that meet elsewhere than in what they share
  long euler = 0;       ///< vertices - edges + faces
  long genus_sum = 0;   ///< number of handles, over all components
  double diagonal = 0;  ///< of the bounding box
  double area = 0;      ///< of all faces
  double Q_max = 0;     ///< largest `quality()` of a face
  double Q_avg = 0;     ///< mean `quality()` of the faces
  double Q_le_2 = 0;    ///< per cent of the faces with `quality()` at most 2
  double angle_min = 0; ///< smallest angle of a face, in degrees
  double angle_max = 0; ///< largest angle of a face, in degrees
};

/// \brief The shape of a triangle: Q = (sqrt(3)/6) longest side / inradius.
///
/// 1 for the equilateral triangle, larger for all others, infinite for a flat one. Does not depend
/// on scale, position or the order of the corners.
template <class Point>
double quality(const Point& p, const Point& q, const Point& r)
{
  return internal::quality(internal::triangle_sides(p, q, r));
}

namespace internal {

/// Fills in the figures that are sums and extremes over the faces.
template <class Mesh, class Points>
void measure_faces(const Mesh& mesh, const Points& points, Mesh_statistics& statistics)
{
  std::size_t good = 0;
  double sum = 0;
  statistics.angle_min = 180;
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    const Triangle_sides sides = triangle_sides(
        get(points, source(h, mesh)), get(points, target(h, mesh)),
        get(points, target(next(h, mesh), mesh)));
    const double q = quality(sides);
    const auto [smallest, largest] = [&] {
      const auto angle = angles(sides);
      return std::minmax({angle[0], angle[1], angle[2]});
    }();
    sum += q;
    if (q <= 2) ++good;
    statistics.Q_max = (std::max)(statistics.Q_max, q);
    statistics.angle_min = (std::min)(statistics.angle_min, smallest);
    statistics.angle_max = (std::max)(statistics.angle_max, largest);
    statistics.area += area(sides);
  }
  const auto number = static_cast<double>(statistics.faces);
  statistics.Q_avg = sum / number;
  statistics.Q_le_2 = 100 * static_cast<double>(good) / number;
}

template <class Mesh, class NamedParameters>
std::size_t count_self_intersections(const Mesh& mesh, const NamedParameters& np)
{
  using Face = typename boost::graph_traits<Mesh>::face_descriptor;
  std::vector<std::pair<Face, Face>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs), as_cgal(np));
  return pairs.size();
}

} // namespace internal

/// \brief Measures a mesh: counts, topology, shape of the faces, self-intersections.
///
/// The mesh may have any defect that leaves its connectivity sound. A degenerate face has an
/// infinite Q and counts as one self-intersection.
///
/// \pre The mesh has faces, and all are triangles.
/// \throws Invalid_input when a precondition fails.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{where the points of the vertices are}
///     \cgalParamDefault{`get(CGAL::vertex_point, mesh)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{geom_traits}
///     \cgalParamDescription{a kernel with exact predicates, used to find self-intersections}
///     \cgalParamDefault{the kernel of the points}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Mesh_statistics mesh_statistics(
    const Mesh& mesh, const NamedParameters& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;

  const char* const function = "mesh_statistics";
  if (faces(mesh).begin() == faces(mesh).end()) {
    throw Invalid_input(function, "mesh", "the mesh has no face");
  }
  if (!CGAL::is_triangle_mesh(mesh)) {
    throw Invalid_input(
        function, "mesh", "the mesh has a face that is not a triangle",
        "triangulate with CGAL::Polygon_mesh_processing::triangulate_faces");
  }

  const internal::Topology topology = internal::topology(mesh);
  Mesh_statistics result;
  result.vertices = topology.vertices;
  result.edges = topology.edges;
  result.faces = topology.faces;
  result.components = topology.components;
  result.border_edges = topology.border_edges;
  result.border_loops = topology.border_loops;
  result.euler = topology.euler();
  result.genus_sum = topology.genus_sum();

  const CGAL::Bbox_3 box = CGAL::Polygon_mesh_processing::bbox(mesh, internal::as_cgal(np));
  result.diagonal
      = std::hypot(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin());
  internal::measure_faces(
      mesh,
      choose_parameter(
          get_parameter(np, CGAL::internal_np::vertex_point), get(CGAL::vertex_point, mesh)),
      result);
  result.self_intersections = internal::count_self_intersections(mesh, np);
  return result;
}

} // namespace surety

#endif // SURETY_STATISTICS_H
