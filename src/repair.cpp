// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace surety::tool {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

using Polygon = Soup::Polygon;
using Ends = std::pair<std::size_t, std::size_t>; ///< of an edge, the lower one first

void note(Repairs& done, const char* what, std::size_t count)
{
  if (count > 0) done.emplace_back(what, count);
}

bool has_a_corner_twice(Polygon polygon)
{
  std::sort(polygon.begin(), polygon.end());
  return std::adjacent_find(polygon.begin(), polygon.end()) != polygon.end();
}

std::size_t remove_collapsed(std::vector<Polygon>& polygons)
{
  const auto end = std::remove_if(polygons.begin(), polygons.end(), has_a_corner_twice);
  const auto count = static_cast<std::size_t>(std::distance(end, polygons.end()));
  polygons.erase(end, polygons.end());
  return count;
}

template <class Visit>
void for_each_side(const std::vector<Polygon>& polygons, const Visit& visit)
{
  for (const Polygon& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i)
      visit(Ends(std::minmax(polygon[i], polygon[(i + 1) % polygon.size()])));
}

/// Edges of three polygons and more.
std::set<Ends> branchings(const std::vector<Polygon>& polygons)
{
  std::map<Ends, std::size_t> degree;
  for_each_side(polygons, [&](const Ends& ends) { ++degree[ends]; });
  std::set<Ends> result;
  for (const auto& [ends, number] : degree)
    if (number > 2) result.insert(ends);
  return result;
}

/// How many polygons are the other way round.
std::size_t turned(const std::vector<Polygon>& before, const std::vector<Polygon>& after)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    // Corners may have other numbers by now: their order is what counts.
    const auto first = std::find(after[i].begin(), after[i].end(), before[i][0]);
    if (first == after[i].end()) continue;
    const auto place = static_cast<std::size_t>(first - after[i].begin());
    const std::size_t next = after[i][(place + 1) % after[i].size()];
    if (next == before[i].back()) ++count;
  }
  return count;
}

/// Marks the sides that were branchings, all sheets' copies of them, as required edges.
void require_branchings(
    Soup& soup, const std::set<Ends>& branching, const std::vector<std::size_t>& origin)
{
  std::set<Ends> wanted;
  for_each_side(soup.polygons, [&](const Ends& ends) {
    if (branching.count(std::minmax(origin[ends.first], origin[ends.second])) != 0)
      wanted.insert(ends);
  });
  Annotations notes;
  notes.point_references.assign(soup.points.size(), 0);
  notes.polygon_references.assign(soup.polygons.size(), 0);
  for (const auto& [from, to] : wanted) {
    notes.ridges.push_back(notes.edges.size());
    notes.required_edges.push_back(notes.edges.size());
    notes.edges.push_back({from, to, 0});
  }
  soup.annotations = std::move(notes);
}

/// Which point each one is a copy of; those before `size` are none.
std::vector<std::size_t> origins(const std::vector<Point>& points, std::size_t size)
{
  std::map<Point, std::size_t> index;
  for (std::size_t i = 0; i < size; ++i) index.emplace(points[i], i);
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < points.size(); ++i)
    result.push_back(i < size ? i : index.at(points[i]));
  return result;
}

} // namespace

void repair(Soup& soup, Repairs& done)
{
  note(
      done, "equal points merged",
      PMP::merge_duplicate_points_in_polygon_soup(soup.points, soup.polygons));
  note(done, "faces with a corner twice removed", remove_collapsed(soup.polygons));
  note(
      done, "faces removed that were there already",
      PMP::merge_duplicate_polygons_in_polygon_soup(soup.points, soup.polygons));
  note(
      done, "points without faces removed",
      PMP::remove_isolated_points_in_polygon_soup(soup.points, soup.polygons));
  if (PMP::is_polygon_soup_a_polygon_mesh(soup.polygons)) return;

  const auto branching = branchings(soup.polygons);
  note(done, "edges of three faces or more fixed, their sheets separated", branching.size());
  const std::size_t size = soup.points.size();
  const auto before = soup.polygons;
  PMP::orient_polygon_soup(soup.points, soup.polygons);
  note(done, "faces turned round", turned(before, soup.polygons));
  note(done, "points doubled", soup.points.size() - size);
  if (!branching.empty()) require_branchings(soup, branching, origins(soup.points, size));
}

void repair(Mesh& mesh, Repairs& done)
{
  note(done, "vertices split", PMP::duplicate_non_manifold_vertices(mesh));
  std::vector<Mesh::Face_index> degenerate;
  PMP::degenerate_faces(mesh, std::back_inserter(degenerate));
  if (degenerate.empty()) return;
  note(done, "faces without area removed", degenerate.size());
  PMP::remove_degenerate_faces(mesh);
  mesh.collect_garbage();
}

Json to_json(const Repairs& repairs)
{
  Json json = Json::object();
  for (const auto& [what, count] : repairs) json[what] = count;
  return json;
}

std::string to_text(const Repairs& repairs, const std::string& indentation)
{
  std::string text;
  for (const auto& [what, count] : repairs)
    text += indentation + "repaired: " + to_text(count) + ' ' + what + '\n';
  return text;
}

} // namespace surety::tool
