// SPDX-License-Identifier: GPL-3.0-or-later
#include "medit.h"

#include "failure.h"

namespace surety::tool::medit {

const std::array<Kind, number_of_kinds> kinds
    = {{{"Edges", 5, 2, true, "vertex"},
        {"Triangles", 6, 3, true, "vertex"},
        {"Corners", 13, 1, false, "vertex"},
        {"Ridges", 14, 1, false, "edge"},
        {"RequiredVertices", 15, 1, false, "vertex"},
        {"RequiredEdges", 16, 1, false, "edge"},
        {"RequiredTriangles", 17, 1, false, "triangle"}}};

const std::array<Refused, 5> refused = {
    {{"Quadrilaterals", 7}, {"Tetrahedra", 8}, {"Prisms", 9}, {"Hexahedra", 10}, {"Pyramids", 49}}};

void refuse(const std::string& file, std::size_t number, const Refused& elements)
{
  const bool is_surface = elements.code == refused[0].code;
  throw Bad_file(
      file,
      "there are " + std::to_string(number) + " " + elements.keyword
          + ", but only triangles can be remeshed",
      is_surface ? "split each quadrilateral into two triangles"
                 : "give a file with the triangles of the surface only");
}

namespace {

std::size_t number_referred(const Tables& tables, const Kind& kind)
{
  const std::string what = kind.referred;
  if (what == "vertex") return tables.points.size();
  const Kind_index list = what == "edge" ? edges : triangles;
  return tables.lists[list].indices.size() / kinds[list].columns;
}

std::string place(const Table& table, const Kind& kind, std::size_t entry)
{
  if (!table.lines.empty()) return "line " + std::to_string(table.lines[entry]);
  return std::string(kind.keyword) + ", entry " + std::to_string(entry + 1);
}

void require_indices(const std::string& file, const Tables& tables, Kind_index list)
{
  const Kind& kind = kinds[list];
  const Table& table = tables.lists[list];
  const std::size_t number = number_referred(tables, kind);
  for (std::size_t i = 0; i < table.indices.size(); ++i) {
    const long long index = table.indices[i];
    if (index >= 1 && static_cast<std::size_t>(index) <= number) continue;
    throw Bad_file(
        file,
        place(table, kind, i / kind.columns) + ": " + kind.referred + " " + std::to_string(index)
            + " does not exist: they are numbered from 1 to " + std::to_string(number),
        "export the file again");
  }
}

std::vector<std::size_t> from_zero(const Table& table)
{
  std::vector<std::size_t> result;
  for (const long long index : table.indices) result.push_back(static_cast<std::size_t>(index - 1));
  return result;
}

Table from_one(const std::vector<std::size_t>& indices)
{
  Table result;
  for (const std::size_t index : indices)
    result.indices.push_back(static_cast<long long>(index) + 1);
  return result;
}

} // namespace

Soup to_soup(const std::string& file, const Tables& tables)
{
  for (int list = 0; list < number_of_kinds; ++list)
    require_indices(file, tables, Kind_index(list));
  Soup soup;
  soup.points = tables.points;
  const std::vector<std::size_t> corners_of = from_zero(tables.lists[triangles]);
  for (std::size_t i = 0; i < corners_of.size(); i += 3)
    soup.polygons.push_back({corners_of[i], corners_of[i + 1], corners_of[i + 2]});

  Annotations& notes = soup.annotations.emplace();
  notes.point_references = tables.references;
  notes.polygon_references = tables.lists[triangles].references;
  const std::vector<std::size_t> ends = from_zero(tables.lists[edges]);
  for (std::size_t i = 0; i < ends.size(); i += 2)
    notes.edges.push_back({ends[i], ends[i + 1], tables.lists[edges].references[i / 2]});
  notes.corners = from_zero(tables.lists[corners]);
  notes.ridges = from_zero(tables.lists[ridges]);
  notes.required_points = from_zero(tables.lists[required_vertices]);
  notes.required_edges = from_zero(tables.lists[required_edges]);
  notes.required_polygons = from_zero(tables.lists[required_triangles]);
  return soup;
}

Tables to_tables(const Soup& soup)
{
  const Annotations notes = soup.annotations.value_or(Annotations{});
  Tables result;
  result.points = soup.points;
  result.references = notes.point_references;
  result.references.resize(soup.points.size(), 0);

  Table& faces = result.lists[triangles];
  for (const auto& polygon : soup.polygons)
    for (const std::size_t v : polygon) faces.indices.push_back(static_cast<long long>(v) + 1);
  faces.references = notes.polygon_references;
  faces.references.resize(soup.polygons.size(), 0);

  for (const Annotations::Edge& edge : notes.edges) {
    for (const std::size_t v : {edge.from, edge.to})
      result.lists[edges].indices.push_back(static_cast<long long>(v) + 1);
    result.lists[edges].references.push_back(edge.reference);
  }
  result.lists[corners] = from_one(notes.corners);
  result.lists[ridges] = from_one(notes.ridges);
  result.lists[required_vertices] = from_one(notes.required_points);
  result.lists[required_edges] = from_one(notes.required_edges);
  result.lists[required_triangles] = from_one(notes.required_polygons);
  return result;
}

} // namespace surety::tool::medit
