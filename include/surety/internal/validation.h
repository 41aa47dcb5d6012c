// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every public function asks of its input: a finite, triangulated, simplicial, manifold mesh
// without degenerate faces, and numbers in their range. A mesh that fails is refused with the first
// offending element, how many there are, and the CGAL function that repairs them.
#ifndef SURETY_INTERNAL_VALIDATION_H
#define SURETY_INTERNAL_VALIDATION_H

#include <surety/errors.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace surety {
namespace internal {

/// What is wrong with a mesh, and what repairs it.
struct Defect {
  std::string problem;
  std::string remedy;
};

/// Beyond these, products of three lengths (volumes, orientations) leave the range of a double.
constexpr double largest_length = 1e100;
constexpr double smallest_length = 1e-100;

/// \brief Looks for the defects of a mesh, one kind after the other, in linear time.
///
/// Works on indices and never follows `next` further than the mesh can be long, so that a mesh with
/// inconsistent connectivity is reported instead of running for ever.
template <class Mesh, class NamedParameters>
class Mesh_inspector
{
  using Graph = boost::graph_traits<Mesh>;
  using Vertex = typename Graph::vertex_descriptor;
  using Halfedge = typename Graph::halfedge_descriptor;
  using Face = typename Graph::face_descriptor;
  using Predicates = CGAL::Exact_predicates_inexact_constructions_kernel;

public:
  Mesh_inspector(const Mesh& mesh, const NamedParameters& np)
    : mesh_(mesh),
      points_(CGAL::parameters::choose_parameter(
          CGAL::parameters::get_parameter(np, CGAL::internal_np::vertex_point),
          get(CGAL::vertex_point, mesh)))
  {}

  std::optional<Defect> first_defect() const
  {
    using Check = std::optional<Defect> (Mesh_inspector::*)() const;
    constexpr std::array<Check, 10> checks
        = {&Mesh_inspector::no_face,        &Mesh_inspector::isolated_vertex,
           &Mesh_inspector::larger_face,    &Mesh_inspector::infinite_coordinate,
           &Mesh_inspector::extreme_size,   &Mesh_inspector::degenerate_face,
           &Mesh_inspector::duplicate_face, &Mesh_inspector::double_edge,
           &Mesh_inspector::pinched_vertex, &Mesh_inspector::inconsistent_connectivity};
    for (const Check check : checks) {
      if (auto defect = (this->*check)()) return defect;
    }
    return std::nullopt;
  }

private:
  std::optional<Defect> no_face() const
  {
    if (faces(mesh_).begin() != faces(mesh_).end()) return std::nullopt;
    return Defect{"the mesh has no face", "check that the file holds a surface, not only points"};
  }

  std::optional<Defect> isolated_vertex() const
  {
    return first_of(
        vertices(mesh_), [this](Vertex v) { return halfedge(v, mesh_) == Graph::null_halfedge(); },
        [this](Vertex v) { return name(v) + " belongs to no face"; },
        "remove such vertices with CGAL::Polygon_mesh_processing::remove_isolated_vertices");
  }

  std::optional<Defect> larger_face() const
  {
    return first_of(
        faces(mesh_),
        [this](Face f) {
          const Halfedge h = halfedge(f, mesh_);
          return next(h, mesh_) == h || next(next(next(h, mesh_), mesh_), mesh_) != h;
        },
        [this](Face f) { return name(f) + " is not a triangle"; },
        "triangulate with CGAL::Polygon_mesh_processing::triangulate_faces, or --triangulate on "
        "the command line");
  }

  std::optional<Defect> infinite_coordinate() const
  {
    return first_of(
        vertices(mesh_),
        [this](Vertex v) {
          const auto p = coordinates(v);
          return !(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
        },
        [this](Vertex v) { return name(v) + " has a coordinate that is not finite: " + place(v); },
        "remove the vertex, or repair the program that wrote the file");
  }

  std::optional<Defect> extreme_size() const
  {
    double magnitude = 0;
    std::array<double, 3> low, high;
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (const Vertex v : vertices(mesh_)) {
      const auto p = coordinates(v);
      for (int i = 0; i < 3; ++i) {
        low[i] = (std::min)(low[i], p[i]);
        high[i] = (std::max)(high[i], p[i]);
        magnitude = (std::max)(magnitude, std::abs(p[i]));
      }
    }
    std::ostringstream text;
    if (magnitude > largest_length) {
      text << "coordinates reach " << magnitude << ", more than " << largest_length;
      return Defect{text.str(), "rescale the mesh"};
    }
    const double extent = (std::max)({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    if (extent >= smallest_length) return std::nullopt;
    if (extent == 0) {
      text << "all vertices lie at the point " << place(*vertices(mesh_).begin());
      return Defect{text.str(), "check the coordinates"};
    }
    text << "the bounding box measures " << extent << ", less than " << smallest_length;
    return Defect{text.str(), "rescale the mesh"};
  }

  std::optional<Defect> degenerate_face() const
  {
    const Predicates::Collinear_3 collinear = Predicates().collinear_3_object();
    return first_of(
        faces(mesh_),
        [&](Face f) {
          const auto v = corners(f);
          return collinear(exact_point(v[0]), exact_point(v[1]), exact_point(v[2]));
        },
        [this](Face f) { return name(f) + " is degenerate: its corners lie on one line"; },
        "remove such faces with CGAL::Polygon_mesh_processing::remove_degenerate_faces");
  }

  /// Where no edge is double, two faces on the same vertices share all their edges: looking across
  /// one edge of each face finds them.
  std::optional<Defect> duplicate_face() const
  {
    return first_of(
        faces(mesh_),
        [this](Face f) {
          const Halfedge h = halfedge(f, mesh_);
          const Halfedge o = opposite(h, mesh_);
          return face(o, mesh_) != Graph::null_face()
              && target(next(o, mesh_), mesh_) == target(next(h, mesh_), mesh_);
        },
        [this](Face f) {
          const Face other = face(opposite(halfedge(f, mesh_), mesh_), mesh_);
          return name(f) + " and " + name(other) + " have the same three vertices";
        },
        "remove one of the two with CGAL::Euler::remove_face");
  }

  std::optional<Defect> double_edge() const
  {
    // Edges by their smaller end vertex, then one stamp a larger one: a sort in linear time.
    const std::size_t size = index_bound();
    std::vector<std::uint32_t> offset(size + 1, 0);
    for (const auto e : edges(mesh_)) ++offset[ends(e).first + 1];
    for (std::size_t i = 0; i < size; ++i) offset[i + 1] += offset[i];
    std::vector<std::uint32_t> larger(offset[size]), filled(offset.begin(), offset.end() - 1);
    for (const auto e : edges(mesh_)) larger[filled[ends(e).first]++] = ends(e).second;

    std::vector<std::uint32_t> stamp(size, std::uint32_t(-1));
    for (const Vertex v : vertices(mesh_)) {
      const auto i = static_cast<std::uint32_t>(v);
      for (std::uint32_t k = offset[i]; k < offset[i + 1]; ++k) {
        if (std::exchange(stamp[larger[k]], i) != i) continue;
        return Defect{
            "two edges join " + name(v) + " and " + name(Vertex(larger[k])),
            "split one of them with CGAL::Euler::split_edge, then triangulate with "
            "CGAL::Polygon_mesh_processing::triangulate_faces"};
      }
    }
    return std::nullopt;
  }

  /// A vertex is manifold if the turn round it meets all its halfedges, and at most one border.
  std::optional<Defect> pinched_vertex() const
  {
    std::vector<std::uint32_t> incoming(index_bound(), 0);
    for (const Halfedge h : halfedges(mesh_)) ++incoming[target(h, mesh_)];
    return first_of(
        vertices(mesh_),
        [&](Vertex v) {
          std::uint32_t met = 0, borders = 0;
          Halfedge h = halfedge(v, mesh_);
          do {
            ++met;
            if (is_border(h, mesh_)) ++borders;
            h = opposite(next(h, mesh_), mesh_);
          } while (h != halfedge(v, mesh_) && met <= incoming[v]);
          return met < incoming[v] || borders > 1;
        },
        [this](Vertex v) { return name(v) + " is not manifold: several sheets meet there"; },
        "separate them with CGAL::Polygon_mesh_processing::duplicate_non_manifold_vertices");
  }

  std::optional<Defect> inconsistent_connectivity() const
  {
    if (CGAL::is_valid_polygon_mesh(mesh_)) return std::nullopt;
    return Defect{
        "the connectivity is inconsistent (CGAL::is_valid_polygon_mesh is false)",
        "rebuild it with CGAL::Polygon_mesh_processing::orient_polygon_soup and "
        "polygon_soup_to_polygon_mesh"};
  }

  /// The defect of the first element that is bad, with the number of the others.
  template <class Range, class Is_bad, class Describe>
  std::optional<Defect> first_of(
      const Range& range, const Is_bad& is_bad, const Describe& describe, const char* remedy) const
  {
    const auto first = std::find_if(range.begin(), range.end(), is_bad);
    if (first == range.end()) return std::nullopt;
    const auto others = std::count_if(std::next(first), range.end(), is_bad);
    std::string problem = describe(*first);
    if (others > 0) problem += " (and " + std::to_string(others) + " more like it)";
    return Defect{std::move(problem), remedy};
  }

  std::pair<std::uint32_t, std::uint32_t> ends(typename Graph::edge_descriptor e) const
  {
    return std::minmax(
        {static_cast<std::uint32_t>(source(e, mesh_)),
         static_cast<std::uint32_t>(target(e, mesh_))});
  }

  std::array<Vertex, 3> corners(Face f) const
  {
    const Halfedge h = halfedge(f, mesh_);
    return {source(h, mesh_), target(h, mesh_), target(next(h, mesh_), mesh_)};
  }

  std::array<double, 3> coordinates(Vertex v) const
  {
    const auto& p = get(points_, v);
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }

  Predicates::Point_3 exact_point(Vertex v) const
  {
    const auto p = coordinates(v);
    return {p[0], p[1], p[2]};
  }

  /// One past the largest index: removed vertices, which keep theirs until the mesh is compacted,
  /// are counted here though no iteration meets them.
  std::size_t index_bound() const { return num_vertices(mesh_); }

  /// Users count elements in the order of their file, which is the order of iteration.
  std::string name(Vertex v) const
  {
    return "vertex " + std::to_string(position(vertices(mesh_), v));
  }

  std::string name(Face f) const
  {
    std::string list;
    Halfedge h = halfedge(f, mesh_);
    int shown = 0;
    do {
      list += (list.empty() ? "" : ", ")
          + std::to_string(position(vertices(mesh_), target(h, mesh_)));
      h = next(h, mesh_);
    } while (h != halfedge(f, mesh_) && ++shown < 8);
    if (h != halfedge(f, mesh_)) list += ", ...";
    return "face " + std::to_string(position(faces(mesh_), f)) + " (vertices " + list + ")";
  }

  std::string place(Vertex v) const
  {
    const auto p = coordinates(v);
    std::ostringstream text;
    text.precision(17);
    text << '(' << p[0] << ", " << p[1] << ", " << p[2] << ')';
    return text.str();
  }

  template <class Range, class Element>
  static std::size_t position(const Range& range, Element element)
  {
    return std::distance(range.begin(), std::find(range.begin(), range.end(), element));
  }

  using Points = std::decay_t<decltype(CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(
          std::declval<const NamedParameters&>(), CGAL::internal_np::vertex_point),
      get(CGAL::vertex_point, std::declval<const Mesh&>())))>;

  const Mesh& mesh_;
  Points points_;
};

/// \brief The first defect of a mesh that forbids to process it; nothing if the mesh is sound.
///
/// Indices in the text are positions in iteration order. Reads `vertex_point_map`.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
std::optional<Defect> find_defect(
    const Mesh& mesh, const NamedParameters& np = CGAL::parameters::default_values())
{
  return Mesh_inspector<Mesh, NamedParameters>(mesh, np).first_defect();
}

/// Throws `Invalid_input` if the mesh has a defect.
template <class Mesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
void require_valid_mesh(
    const Mesh& mesh, const char* function, const char* argument,
    const NamedParameters& np = CGAL::parameters::default_values())
{
  if (const auto defect = find_defect(mesh, np)) {
    throw Invalid_input(function, argument, defect->problem, defect->remedy);
  }
}

/// The shortest decimal text that tells the value from its neighbours, for messages.
inline std::string to_text(double value)
{
  std::ostringstream text;
  for (const int digits : {6, 17}) {
    text.str("");
    text.precision(digits);
    text << value;
    if (!std::isfinite(value) || std::stod(text.str()) == value) break;
  }
  return text.str();
}

/// Throws `Invalid_input` unless the value is finite and greater than zero.
inline void require_positive(double value, const char* function, const char* argument)
{
  if (value > 0 && std::isfinite(value)) return;
  throw Invalid_input(function, argument, to_text(value) + " is not a finite positive number");
}

/// Throws `Invalid_input` unless low <= value <= high; a bound may be infinite, NaN is refused.
inline void require_in_range(
    double value, double low, double high, const char* function, const char* argument)
{
  if (value >= low && value <= high) return;
  throw Invalid_input(
      function, argument,
      to_text(value) + " is not in the range from " + to_text(low) + " to " + to_text(high));
}

} // namespace internal
} // namespace surety

#endif // SURETY_INTERNAL_VALIDATION_H
