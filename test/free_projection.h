// SPDX-License-Identifier: GPL-3.0-or-later
//
// Central projections onto meshes whose vertices are not among those of the input: they go to inner
// items of the faces below them.
#ifndef SURETY_TEST_FREE_PROJECTION_H
#define SURETY_TEST_FREE_PROJECTION_H

#include "overlay.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace surety::test {

/// The point of a face of the input on the ray of direction d, if it hits the face.
inline std::optional<Correspondence::Inner> inner_item(
    const Mesh& input, Face f, const Point& d, std::uint32_t vertex)
{
  std::vector<std::uint32_t> corners;
  for (const Vertex v : CGAL::vertices_around_face(input.halfedge(f), input)) corners.push_back(v);
  std::sort(corners.begin(), corners.end());
  const Point o(0, 0, 0);
  const auto at = [&](int k) { return input.point(Vertex(corners[std::size_t(k)])); };
  const auto volume = [&](const Point& p, const Point& q, const Point& r) {
    return CGAL::to_double(CGAL::determinant(p - o, q - o, r - o));
  };
  const double a = volume(d, at(1), at(2)), b = volume(at(0), d, at(2)),
               c = volume(at(0), at(1), d);
  const bool same_side
      = volume(at(0), at(1), at(2)) > 0 ? a >= 0 && b >= 0 && c >= 0 : a <= 0 && b <= 0 && c <= 0;
  if (!same_side) return std::nullopt;
  return Correspondence::Inner{std::uint32_t(f), vertex, b / (a + b + c), c / (a + b + c)};
}

/// Adds an inner item for every vertex of the output from `first` on. Returns whether no two of
/// them are in one face.
inline bool add_inner_items(Mapped_pair& pair, std::uint32_t first)
{
  std::map<std::uint32_t, Correspondence::Inner> in_face;
  for (std::uint32_t w = first; w < pair.output.num_vertices(); ++w) {
    bool found = false;
    for (const Face f : pair.input.faces()) {
      const auto inner = inner_item(pair.input, f, pair.output.point(Vertex(w)), w);
      if (!inner) continue;
      found = in_face.emplace(f, *inner).second;
      break;
    }
    if (!found) return false;
  }
  for (const auto& [f, inner] : in_face) pair.record.inner.push_back(inner);
  return true;
}

/// Two spheres of any fineness, whose vertices have nothing to do with each other; the seed is
/// tried further until no two vertices of the output are above one face of the input.
inline Mapped_pair free_spheres(const Mesh& input, const Mesh& output, std::uint64_t seed)
{
  for (;; seed += 1000) {
    Mapped_pair pair{rotated(input, seed), rotated(output, seed + 500), {}};
    pair.record = Central_projection(pair.input, pair.output, {}).record();
    if (add_inner_items(pair, 0)) return pair;
  }
}

/// Two triangulations of a square at height 1, whose vertices on the border are common.
inline Mapped_pair free_squares(std::size_t n, std::size_t ratio, std::uint64_t seed)
{
  for (;; seed += 1000) {
    Random random(seed);
    const auto jitter = [&](std::size_t cells) {
      return mapped(grid(cells), [&](const Point& p) {
        const bool moves = p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1;
        const Vector by = (moves ? 0.2 / double(cells) : 0) * random.in_cube();
        return Point(p.x() + by.x(), p.y() + by.y(), 1);
      });
    };
    Mapped_pair pair{jitter(n * ratio), {}, {}};
    // The vertices on the border first.
    Soup soup = to_soup(jitter(n)), sorted;
    std::vector<std::size_t> number(soup.points.size());
    std::vector<std::uint32_t> pins;
    for (const bool on_border : {true, false}) {
      for (std::size_t v = 0; v < soup.points.size(); ++v) {
        std::optional<std::uint32_t> pin;
        for (const Vertex w : pair.input.vertices())
          if (pair.input.point(w) == soup.points[v]) pin = std::uint32_t(w);
        if (pin.has_value() != on_border) continue;
        if (pin) pins.push_back(*pin);
        number[v] = sorted.points.size();
        sorted.points.push_back(soup.points[v]);
      }
    }
    for (const auto& t : soup.triangles)
      sorted.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    pair.output = to_mesh(sorted);
    pair.record = Central_projection(pair.input, pair.output, pins).record();
    if (add_inner_items(pair, std::uint32_t(pins.size()))) return pair;
  }
}

} // namespace surety::test

#endif // SURETY_TEST_FREE_PROJECTION_H
