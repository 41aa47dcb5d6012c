// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps between meshes made without the library: the identity, nested refinements, and the central
// projection of one mesh onto a coarser one whose vertices are among its own. They are the sound
// certificates that the tests of the checker start from.
#ifndef SURETY_TEST_OVERLAY_H
#define SURETY_TEST_OVERLAY_H

#include "meshes.h"

#include <surety/correspondence.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/convex_hull_3.h>

#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace surety::test {

using Image = Correspondence::Image;
using Kind = Correspondence::Kind;

struct Mapped_pair {
  Mesh input, output;
  Correspondence record;
};

inline Image at_vertex(std::uint32_t v) { return {Kind::vertex, v, 0}; }
inline Image at_face(std::uint32_t f) { return {Kind::face, f, 0}; }
inline Image on_edge(std::uint32_t u, std::uint32_t v)
{
  return {Kind::edge, std::min(u, v), std::max(u, v)};
}

inline Mapped_pair identity(const Mesh& mesh)
{
  Mapped_pair pair{mesh, mesh, {}};
  for (std::uint32_t v = 0; v < mesh.num_vertices(); ++v) {
    pair.record.images.push_back(at_vertex(v));
  }
  pair.record.offsets = {0};
  return pair;
}

/// A mesh without edges that are crossed: every face cut in four, `times` times. Which old edge or
/// face a new point is on follows from the two ends of the edge that it halves.
inline Mapped_pair refinement(const Mesh& coarse, int times)
{
  Mapped_pair pair = identity(coarse);
  Soup soup = to_soup(coarse);
  std::vector<std::size_t> home(soup.triangles.size());
  std::iota(home.begin(), home.end(), 0);
  for (int i = 0; i < times; ++i) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middle;
    Soup fine{soup.points, {}};
    std::vector<std::size_t> fine_home;
    const auto corners = [&](const Image& image, std::size_t f) {
      if (image.kind == Kind::vertex) return std::vector<std::uint32_t>{image.a};
      if (image.kind == Kind::edge) return std::vector<std::uint32_t>{image.a, image.b};
      const auto h = coarse.halfedge(Face(std::uint32_t(f)));
      return std::vector<std::uint32_t>{
          coarse.source(h), coarse.target(h), coarse.target(coarse.next(h))};
    };
    const auto half = [&](std::size_t u, std::size_t v, std::size_t f) {
      const auto [it, is_new] = middle.try_emplace(std::minmax(u, v), fine.points.size());
      if (!is_new) return it->second;
      fine.points.push_back(CGAL::midpoint(soup.points[u], soup.points[v]));
      auto all = corners(pair.record.images[u], f);
      for (const auto c : corners(pair.record.images[v], f)) all.push_back(c);
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      pair.record.images.push_back(
          all.size() == 2 ? on_edge(all[0], all[1]) : at_face(std::uint32_t(f)));
      return it->second;
    };
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const auto [a, b, c] = soup.triangles[t];
      const std::size_t f = home[t], ab = half(a, b, f), bc = half(b, c, f), ca = half(c, a, f);
      fine.triangles.insert(
          fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
      fine_home.insert(fine_home.end(), 4, f);
    }
    soup = fine;
    home = fine_home;
  }
  pair.input = to_mesh(soup);
  return pair;
}

/// Makes all edges of the input ridges whose ends lie in one of the given edges of the output.
template <class Is_ridge>
void record_ridges(Mapped_pair& pair, const Is_ridge& is_ridge)
{
  for (const auto e : pair.input.edges()) {
    if (pair.input.is_border(e)) continue;
    const std::uint32_t u = pair.input.vertex(e, 0), v = pair.input.vertex(e, 1);
    std::set<std::uint32_t> ends;
    for (const auto w : {u, v}) {
      const Image& image = pair.record.images[w];
      ends.insert(image.a);
      if (image.kind == Kind::edge) ends.insert(image.b);
      if (image.kind == Kind::face) ends.insert({~0u, ~1u});
    }
    if (ends.size() == 2 && is_ridge(*ends.begin(), *ends.rbegin())) {
      pair.record.ridges.push_back({std::min(u, v), std::max(u, v)});
    }
  }
}

/// Projects `input` from the origin onto `output`, whose vertex j is the vertex pins[j] of `input`.
/// Both must be star-shaped about the origin and cover the same directions.
class Central_projection
{
public:
  Central_projection(const Mesh& input, const Mesh& output, const std::vector<std::uint32_t>& pins)
    : input_(input), output_(output)
  {
    record_.images.resize(input.num_vertices(), at_vertex(~0u));
    pinned_.resize(input.num_vertices(), ~0u);
    for (std::uint32_t j = 0; j < pins.size(); ++j) {
      record_.images[pins[j]] = at_vertex(j);
      pinned_[pins[j]] = j;
    }
    for (const Vertex v : input.vertices()) {
      if (pinned_[v] == ~0u) record_.images[v] = image(v);
    }
    add_crossings();
  }

  const Correspondence& record() const { return record_; }

private:
  static int turn(const Point& p, const Point& q, const Point& r)
  {
    return CGAL::orientation(Point(0, 0, 0), p, q, r);
  }

  Image image(Vertex v) const
  {
    const Point& x = input_.point(v);
    for (const Face f : output_.faces()) {
      int inside = 0;
      std::optional<Image> edge;
      for (const auto h : CGAL::halfedges_around_face(output_.halfedge(f), output_)) {
        const Vertex p = output_.source(h), q = output_.target(h);
        const int side = turn(output_.point(p), output_.point(q), x);
        if (side == 0) edge = on_edge(p, q);
        inside += side >= 0;
      }
      if (inside == 3) return edge ? *edge : at_face(f);
    }
    throw std::logic_error("the output does not cover this direction");
  }

  void add_crossings()
  {
    std::map<std::array<std::uint32_t, 2>, std::vector<Correspondence::Crossing>> sorted;
    for (const auto e : input_.edges()) {
      const auto [s, t] = std::minmax({input_.vertex(e, 0), input_.vertex(e, 1)});
      std::vector<Correspondence::Crossing> crossings;
      for (const auto m : output_.edges()) {
        const auto [a, b] = std::minmax({output_.vertex(m, 0), output_.vertex(m, 1)});
        if (const auto lambda = crossing(s, t, a, b)) crossings.push_back({a, b, *lambda});
      }
      std::sort(crossings.begin(), crossings.end(), [](const auto& c, const auto& d) {
        return c.lambda < d.lambda;
      });
      if (!crossings.empty()) sorted[{s, t}] = crossings;
    }
    record_.offsets = {0};
    for (const auto& [edge, crossings] : sorted) {
      record_.edges.push_back(edge);
      record_.crossings.insert(record_.crossings.end(), crossings.begin(), crossings.end());
      record_.offsets.push_back(std::uint32_t(record_.crossings.size()));
    }
  }

  std::optional<double> crossing(Vertex s, Vertex t, Vertex a, Vertex b) const
  {
    for (const Vertex v : {s, t}) {
      if (pinned_[v] == a || pinned_[v] == b) return std::nullopt;
    }
    const Point &p = input_.point(s), &q = input_.point(t);
    const Point &x = output_.point(a), &y = output_.point(b);
    const int side = turn(x, p, y);
    if (side == 0 || turn(p, y, q) != side || turn(y, q, x) != side || turn(q, x, p) != side) {
      return std::nullopt;
    }
    const auto height = [&](const Point& r) {
      const Vector normal = CGAL::cross_product(x - CGAL::ORIGIN, y - CGAL::ORIGIN);
      return normal * (r - CGAL::ORIGIN);
    };
    return height(p) / (height(p) - height(q));
  }

  const Mesh &input_, &output_;
  std::vector<std::uint32_t> pinned_;
  Correspondence record_;
};

/// A random sphere, and the convex hull of some of its vertices, six at least.
inline Mapped_pair sphere_on_hull(int levels, std::size_t vertices, std::uint64_t seed)
{
  Mapped_pair pair{jittered_sphere(levels, seed), {}, {}};
  Random random(seed);
  std::vector<std::uint32_t> chosen(pair.input.num_vertices());
  std::iota(chosen.begin(), chosen.end(), 0);
  random.shuffle(chosen);
  // The six extreme ones first: then the hull surrounds the origin.
  for (int k = 0; k < 6; ++k) {
    const auto along
        = [&](std::uint32_t v) { return (k % 2 ? 1 : -1) * pair.input.point(Vertex(v))[k / 2]; };
    const auto rest = chosen.begin() + k;
    std::iter_swap(
        rest, std::max_element(rest, chosen.end(), [&](std::uint32_t u, std::uint32_t v) {
          return along(u) < along(v);
        }));
  }
  chosen.resize(vertices);
  std::vector<Point> points;
  std::map<Point, std::uint32_t> number;
  for (const auto v : chosen) {
    points.push_back(pair.input.point(Vertex(v)));
    number[points.back()] = v;
  }
  CGAL::convex_hull_3(points.begin(), points.end(), pair.output);
  std::vector<std::uint32_t> pins;
  for (const Vertex v : pair.output.vertices()) pins.push_back(number.at(pair.output.point(v)));
  pair.record = Central_projection(pair.input, pair.output, pins).record();
  return pair;
}

/// A random triangulation of a square at height 1, and the Delaunay triangulation of some of its
/// vertices, the corners of the square among them.
inline Mapped_pair square_on_square(std::size_t n, double keep, std::uint64_t seed)
{
  Random random(seed);
  Mapped_pair pair;
  pair.input = mapped(grid(n), [&](const Point& p) {
    const bool moves = p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1;
    const double step = moves ? 0.2 / double(n) : 0;
    const Vector by = random.in_cube();
    return Point(p.x() + step * by.x(), p.y() + step * by.y(), 1);
  });
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
  using Delaunay
      = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex_base>>;
  Delaunay delaunay;
  for (const Vertex v : pair.input.vertices()) {
    const Point& p = pair.input.point(v);
    const bool corner = (p.x() == 0 || p.x() == 1) && (p.y() == 0 || p.y() == 1);
    if (corner || random.unit() < keep) {
      delaunay.insert(Kernel::Point_2(p.x(), p.y()))->info() = std::uint32_t(v);
    }
  }
  std::map<std::uint32_t, Vertex> number;
  std::vector<std::uint32_t> pins;
  for (const auto v : delaunay.finite_vertex_handles()) {
    number[v->info()] = pair.output.add_vertex(pair.input.point(Vertex(v->info())));
    pins.push_back(v->info());
  }
  for (const auto f : delaunay.finite_face_handles()) {
    pair.output.add_face(
        number[f->vertex(0)->info()], number[f->vertex(1)->info()], number[f->vertex(2)->info()]);
  }
  pair.record = Central_projection(pair.input, pair.output, pins).record();
  return pair;
}

} // namespace surety::test

#endif // SURETY_TEST_OVERLAY_H
