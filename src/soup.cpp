// SPDX-License-Identifier: GPL-3.0-or-later
//
// The checks of a soup, each linear or nearly so, each naming the first offender by its index in
// the file, counted from 0, and its coordinates.
#include "soup.h"

#include "failure.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <tuple>

namespace surety::tool {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

/// A side of a polygon, with its end vertices in order of index.
struct Side {
  std::size_t low, high, polygon;

  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
  bool operator<(const Side& other) const
  {
    return std::tie(low, high, polygon) < std::tie(other.low, other.high, other.polygon);
  }
};

std::vector<Side> sorted_sides(const Soup& soup)
{
  std::vector<Side> sides;
  sides.reserve(3 * soup.polygons.size());
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const auto& polygon = soup.polygons[i];
    for (std::size_t j = 0; j < polygon.size(); ++j) {
      const auto [low, high] = std::minmax(polygon[j], polygon[(j + 1) % polygon.size()]);
      sides.push_back({low, high, i});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

std::string describe_vertex(const Soup& soup, std::size_t v)
{
  std::ostringstream text;
  text.precision(9);
  text << "vertex " << v << " (" << soup.points[v] << ")";
  return text.str();
}

std::string describe_edge(const Soup& soup, const Side& side)
{
  return "the edge from " + describe_vertex(soup, side.low) + " to "
      + describe_vertex(soup, side.high);
}

std::string describe_face(std::size_t f) { return "face " + std::to_string(f); }

void require_faces(const Soup& soup, const std::string& file)
{
  if (soup.polygons.empty()) {
    throw Bad_file(file, "there are no faces", "give a file with a surface mesh");
  }
}

void require_valid_indices(const Soup& soup, const std::string& file, bool admit_polygons)
{
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const auto& polygon = soup.polygons[i];
    const std::string face = describe_face(i);
    for (const std::size_t v : polygon) {
      if (v < soup.points.size()) continue;
      throw Bad_file(
          file,
          face + " refers to a vertex that does not exist: there are "
              + std::to_string(soup.points.size()) + " vertices",
          "export the file again");
    }
    if (polygon.size() < 3) {
      throw Bad_file(
          file, face + " has " + std::to_string(polygon.size()) + " corners", "remove it");
    }
    if (polygon.size() > 3 && !admit_polygons) {
      throw Bad_file(
          file, face + " has " + std::to_string(polygon.size()) + " corners, not three",
          "use --triangulate to split such faces");
    }
  }
}

void require_no_vertex_twice(const Soup& soup, const std::string& file)
{
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    auto sorted = soup.polygons[i];
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice == sorted.end()) continue;
    throw Bad_file(
        file,
        describe_face(i) + " is degenerate: it has " + describe_vertex(soup, *twice) + " twice",
        "remove it");
  }
}

void require_finite(const Soup& soup, const std::string& file)
{
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const Point& p = soup.points[v];
    if (std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z())) continue;
    throw Bad_file(
        file, "the coordinates of " + describe_vertex(soup, v) + " are not finite",
        "correct or remove it");
  }
}

void require_no_isolated_vertex(const Soup& soup, const std::string& file)
{
  std::vector<bool> used(soup.points.size(), false);
  for (const auto& polygon : soup.polygons) {
    for (const std::size_t v : polygon) used[v] = true;
  }
  const auto found = std::find(used.begin(), used.end(), false);
  if (found == used.end()) return;
  const auto v = static_cast<std::size_t>(found - used.begin());
  throw Bad_file(
      file, describe_vertex(soup, v) + " is isolated: no face uses it",
      "remove it (MeshLab: Remove Unreferenced Vertices; CGAL: "
      "Polygon_mesh_processing::remove_isolated_points_in_polygon_soup)");
}

/// Faces with the same vertices share all their edges, so neighbours are compared, not all pairs.
/// (Of three faces at an edge this may miss two; then the edge is refused.)
void require_no_face_twice(
    const Soup& soup, const std::vector<Side>& sides, const std::string& file)
{
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (!sides[i - 1].same_edge(sides[i])) continue;
    const auto &a = soup.polygons[sides[i - 1].polygon], &b = soup.polygons[sides[i].polygon];
    if (a.size() != b.size() || !std::is_permutation(a.begin(), a.end(), b.begin())) continue;
    throw Bad_file(
        file,
        describe_face(sides[i - 1].polygon) + " and " + describe_face(sides[i].polygon)
            + " have the same vertices",
        "remove one of them, or both if they enclose nothing");
  }
}

void require_manifold_edges(
    const Soup& soup, const std::vector<Side>& sides, const std::string& file)
{
  for (std::size_t i = 2; i < sides.size(); ++i) {
    if (!sides[i - 2].same_edge(sides[i])) continue;
    const auto faces = std::count_if(
        sides.begin(), sides.end(), [&](const Side& side) { return side.same_edge(sides[i]); });
    throw Bad_file(
        file,
        describe_edge(soup, sides[i]) + " is not manifold: " + std::to_string(faces)
            + " faces share it",
        "separate the sheets that meet there (MeshLab: Repair Non Manifold Edges; CGAL: "
        "Polygon_mesh_processing::orient_polygon_soup)");
  }
}

/// The faces of a manifold vertex hang together through the edges at it. Corners of polygons are
/// joined across shared edges; a vertex with more than one group of corners is not manifold.
class Fans
{
public:
  Fans(const Soup& soup, const std::vector<Side>& sides) : soup_(soup)
  {
    first_.resize(soup.polygons.size() + 1, 0);
    for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
      first_[i + 1] = first_[i] + soup.polygons[i].size();
    }
    parent_.resize(first_.back());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t i = 1; i < sides.size(); ++i) {
      if (!sides[i - 1].same_edge(sides[i])) continue;
      join(sides[i - 1].polygon, sides[i].polygon, sides[i].low);
      join(sides[i - 1].polygon, sides[i].polygon, sides[i].high);
    }
  }

  /// A vertex with two fans or more; the number of points if there is none.
  std::size_t find_pinched_vertex()
  {
    constexpr auto none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> fan(soup_.points.size(), none);
    std::size_t pinched = soup_.points.size();
    for (std::size_t i = 0; i < soup_.polygons.size(); ++i) {
      for (std::size_t j = 0; j < soup_.polygons[i].size(); ++j) {
        const std::size_t v = soup_.polygons[i][j], root = find(first_[i] + j);
        if (fan[v] == none) fan[v] = root;
        if (fan[v] != root) pinched = std::min(pinched, v);
      }
    }
    return pinched;
  }

private:
  void join(std::size_t polygon_a, std::size_t polygon_b, std::size_t v)
  {
    parent_[find(corner(polygon_a, v))] = find(corner(polygon_b, v));
  }

  std::size_t corner(std::size_t polygon, std::size_t v) const
  {
    const auto& corners = soup_.polygons[polygon];
    const auto found = std::find(corners.begin(), corners.end(), v);
    return first_[polygon] + static_cast<std::size_t>(found - corners.begin());
  }

  std::size_t find(std::size_t corner)
  {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }

  const Soup& soup_;
  std::vector<std::size_t> first_;
  std::vector<std::size_t> parent_;
};

void require_manifold_vertices(
    const Soup& soup, const std::vector<Side>& sides, const std::string& file)
{
  const std::size_t v = Fans(soup, sides).find_pinched_vertex();
  if (v == soup.points.size()) return;
  throw Bad_file(
      file,
      describe_vertex(soup, v) + " is not manifold: parts of the surface meet in this point only",
      "give each part its own vertex (MeshLab: Repair Non Manifold Vertices; CGAL: "
      "Polygon_mesh_processing::duplicate_non_manifold_vertices)");
}

} // namespace

void stitch_if_unconnected(Soup& soup)
{
  std::size_t corners = 0;
  for (const auto& polygon : soup.polygons) corners += polygon.size();
  std::vector<bool> used(soup.points.size(), false);
  for (const auto& polygon : soup.polygons) {
    for (const std::size_t v : polygon) {
      if (v >= used.size() || used[v]) return;
      used[v] = true;
    }
  }
  if (corners > 0) PMP::merge_duplicate_points_in_polygon_soup(soup.points, soup.polygons);
}

void orient(Soup& soup, const std::string& file)
{
  if (PMP::is_polygon_soup_a_polygon_mesh(soup.polygons)) return;
  const std::size_t size = soup.points.size();
  if (PMP::orient_polygon_soup(soup.points, soup.polygons)) return;
  std::ostringstream where;
  where.precision(9);
  where << soup.points[size];
  throw Bad_file(
      file, "the surface has one side only: it cannot be oriented at (" + where.str() + ")",
      "cut it open there, so that it has two sides");
}

void require_polygons(const Soup& soup, const std::string& file, bool admit_polygons)
{
  require_faces(soup, file);
  require_valid_indices(soup, file, admit_polygons);
  require_finite(soup, file);
}

void require_manifold(const Soup& soup, const std::string& file)
{
  require_no_vertex_twice(soup, file);
  require_no_isolated_vertex(soup, file);
  const auto sides = sorted_sides(soup);
  require_no_face_twice(soup, sides, file);
  require_manifold_edges(soup, sides, file);
  require_manifold_vertices(soup, sides, file);
}

} // namespace surety::tool
