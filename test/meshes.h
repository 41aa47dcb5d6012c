// SPDX-License-Identifier: GPL-3.0-or-later
//
// Generated shapes for the tests, in groups: flat and open, smooth, polyhedral, thin, several
// components; and the modifiers that turn each into a family: noise, refinement, motions,
// renumbering. All are deterministic; what is random takes a seed. Shapes that need Booleans are in
// cad_meshes.h, which takes long to compile.
#ifndef SURETY_TEST_MESHES_H
#define SURETY_TEST_MESHES_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/generators.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace surety::test {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Face = Mesh::Face_index;

constexpr double pi = 3.14159265358979323846;

/// A polygon soup: what files hold, before it is known to be a surface.
struct Soup {
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

/// Random numbers that are the same with every standard library.
class Random
{
public:
  explicit Random(std::uint64_t seed) : engine_(seed + 1) {}
  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(unit() * double(n)); }
  Vector in_cube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  template <class Values>
  void shuffle(Values& values)
  {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  }

private:
  std::mt19937_64 engine_;
};

inline Mesh to_mesh(const Soup& soup)
{
  Mesh mesh;
  for (const Point& p : soup.points) mesh.add_vertex(p);
  for (const auto& t : soup.triangles) {
    const Face f = mesh.add_face(
        Vertex(Mesh::size_type(t[0])), Vertex(Mesh::size_type(t[1])),
        Vertex(Mesh::size_type(t[2])));
    if (f == Mesh::null_face()) throw std::logic_error("this soup is not a surface");
  }
  return mesh;
}

inline Soup to_soup(const Mesh& mesh)
{
  Soup soup;
  std::vector<std::size_t> number(mesh.num_vertices());
  for (const Vertex v : mesh.vertices()) {
    number[v] = soup.points.size();
    soup.points.push_back(mesh.point(v));
  }
  for (const Face f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    soup.triangles.push_back(
        {number[mesh.source(h)], number[mesh.target(h)], number[mesh.target(mesh.next(h))]});
  }
  return soup;
}

// ---- modifiers ----

template <class Function>
Mesh mapped(Mesh mesh, const Function& f)
{
  for (const Vertex v : mesh.vertices()) mesh.point(v) = f(mesh.point(v));
  return mesh;
}

inline Mesh scaled(const Mesh& mesh, double x, double y, double z)
{
  return mapped(mesh, [&](const Point& p) { return Point(x * p.x(), y * p.y(), z * p.z()); });
}

inline Mesh scaled(const Mesh& mesh, double s) { return scaled(mesh, s, s, s); }

inline Mesh translated(const Mesh& mesh, const Vector& t)
{
  return mapped(mesh, [&](const Point& p) { return p + t; });
}

/// By a random rotation about the origin.
inline Mesh rotated(const Mesh& mesh, std::uint64_t seed)
{
  Random random(seed);
  std::array<double, 4> q;
  double norm = 0;
  do {
    for (double& c : q) c = random.between(-1, 1);
    norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  } while (norm > 1 || norm < 0.01);
  const double w = q[0], s = 2 / norm;
  const Vector axis(q[1], q[2], q[3]);
  return mapped(mesh, [&](const Point& p) {
    const Vector v = p - CGAL::ORIGIN, c = CGAL::cross_product(axis, v);
    return p + s * (w * c + CGAL::cross_product(axis, c));
  });
}

/// The same surface with vertices and faces in another order, faces starting at other corners.
inline Mesh renumbered(const Mesh& mesh, std::uint64_t seed)
{
  Random random(seed);
  const Soup soup = to_soup(mesh);
  std::vector<std::size_t> order(soup.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  random.shuffle(order);
  Soup result;
  result.points.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) result.points[order[i]] = soup.points[i];
  for (auto t : soup.triangles) {
    for (std::size_t& corner : t) corner = order[corner];
    std::rotate(t.begin(), t.begin() + std::ptrdiff_t(random.below(3)), t.end());
    result.triangles.push_back(t);
  }
  random.shuffle(result.triangles);
  return to_mesh(result);
}

inline Mesh reversed(const Mesh& mesh)
{
  Soup soup = to_soup(mesh);
  for (auto& t : soup.triangles) std::swap(t[1], t[2]);
  return to_mesh(soup);
}

/// Every vertex moves by up to `amplitude` along each axis.
inline Mesh jittered(const Mesh& mesh, double amplitude, std::uint64_t seed)
{
  Random random(seed);
  return mapped(mesh, [&](const Point& p) { return p + amplitude * random.in_cube(); });
}

inline Mesh joined(const std::vector<Mesh>& meshes)
{
  Soup all;
  for (const Mesh& mesh : meshes) {
    const Soup soup = to_soup(mesh);
    const std::size_t first = all.points.size();
    all.points.insert(all.points.end(), soup.points.begin(), soup.points.end());
    for (const auto& t : soup.triangles) {
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  return to_mesh(all);
}

/// Every face cut in four at the midpoints of its edges, `times` times; the surface is the same.
inline Mesh subdivided(const Mesh& mesh, int times = 1)
{
  Soup soup = to_soup(mesh);
  for (; times > 0; --times) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middle;
    Soup finer{soup.points, {}};
    const auto midpoint = [&](std::size_t a, std::size_t b) {
      const auto found = middle.try_emplace(std::minmax({a, b}), finer.points.size());
      if (found.second) finer.points.push_back(CGAL::midpoint(soup.points[a], soup.points[b]));
      return found.first->second;
    };
    for (const auto& [a, b, c] : soup.triangles) {
      const std::size_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      for (const auto& t : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
        finer.triangles.push_back(t);
      }
    }
    soup = std::move(finer);
  }
  return to_mesh(soup);
}

/// An irregular refinement: random edges split in their middle part. New points lie on the edges up
/// to rounding.
inline Mesh split_at_random(Mesh mesh, std::size_t splits, std::uint64_t seed)
{
  Random random(seed);
  for (std::size_t i = 0; i < splits; ++i) {
    const Mesh::Halfedge_index h(Mesh::size_type(random.below(mesh.number_of_halfedges())));
    const Point p = mesh.point(mesh.source(h)), q = mesh.point(mesh.target(h));
    const auto first = CGAL::Euler::split_edge(h, mesh);
    mesh.point(mesh.target(first)) = p + random.between(0.4, 0.6) * (q - p);
    for (const auto side : {first, mesh.opposite(h)}) {
      if (!mesh.is_border(side)) {
        CGAL::Euler::split_face(side, mesh.next(mesh.next(side)), mesh);
      }
    }
  }
  return mesh;
}

// ---- flat and open shapes ----

/// A sheet of nu x nv cells, each two faces: f(i, j) with i = 0..nu and j = 0..nv. A direction that
/// wraps closes on itself: its last line of points is the first.
template <class Function>
Soup sheet(
    std::size_t nu, std::size_t nv, const Function& f, bool wrap_u = false, bool wrap_v = false)
{
  Soup soup;
  const std::size_t columns = nv + (wrap_v ? 0 : 1), rows = nu + (wrap_u ? 0 : 1);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) soup.points.push_back(f(double(i), double(j)));
  }
  const auto at = [&](std::size_t i, std::size_t j) { return i % rows * columns + j % columns; };
  for (std::size_t i = 0; i < nu; ++i) {
    for (std::size_t j = 0; j < nv; ++j) {
      const std::size_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      // Diagonals alternate, so that no direction is preferred.
      if ((i + j) % 2 == 0) {
        soup.triangles.insert(soup.triangles.end(), {{a, b, c}, {a, c, d}});
      } else {
        soup.triangles.insert(soup.triangles.end(), {{a, b, d}, {b, c, d}});
      }
    }
  }
  return soup;
}

/// The graph of a function over the square [-1, 1]^2.
template <class Function>
Mesh height_field(std::size_t n, const Function& height)
{
  return to_mesh(sheet(n, n, [&](double i, double j) {
    const double x = 2 * i / double(n) - 1, y = 2 * j / double(n) - 1;
    return Point(x, y, height(x, y));
  }));
}

/// The unit square [0, 1]^2 in n x n cells.
inline Mesh grid(std::size_t n)
{
  return to_mesh(
      sheet(n, n, [&](double i, double j) { return Point(i / double(n), j / double(n), 0); }));
}

inline Mesh saddle(std::size_t n)
{
  return height_field(n, [](double x, double y) { return x * x - y * y; });
}

/// A flat ring with two border loops.
inline Mesh annulus(std::size_t around, std::size_t across, double inner = 0.5, double outer = 1)
{
  return to_mesh(sheet(
      across, around,
      [&](double i, double j) {
        const double r = inner + (outer - inner) * i / double(across);
        const double phi = 2 * pi * j / double(around);
        return Point(r * std::cos(phi), r * std::sin(phi), 0);
      },
      false, true));
}

/// An open Moebius strip, cut along one line: a band with half a twist whose ends coincide as
/// points, but not as vertices.
inline Mesh moebius_cut(std::size_t around, std::size_t across)
{
  return to_mesh(sheet(around, across, [&](double i, double j) {
    const double phi = 2 * pi * i / double(around), t = 0.4 * (2 * j / double(across) - 1);
    const double r = 1 + t * std::cos(phi / 2);
    return Point(r * std::cos(phi), r * std::sin(phi), t * std::sin(phi / 2));
  }));
}

/// The Moebius strip itself: manifold, but no orientation of its faces agrees.
inline Soup moebius(std::size_t around, std::size_t across)
{
  Soup soup = to_soup(moebius_cut(around, across));
  const std::size_t last = around * (across + 1);
  for (auto& t : soup.triangles) {
    for (std::size_t& corner : t) {
      if (corner >= last) corner = across - (corner - last);
    }
  }
  soup.points.resize(last);
  return soup;
}

// ---- smooth closed shapes ----

/// A geodesic sphere of 20 * 4^levels faces.
inline Mesh icosphere(int levels, double radius = 1)
{
  Mesh mesh;
  CGAL::make_icosahedron(mesh, Point(0, 0, 0), 1.0);
  const auto on_sphere = [](const Point& p) {
    const Vector v = p - CGAL::ORIGIN;
    return CGAL::ORIGIN + v / std::sqrt(v.squared_length());
  };
  for (; levels > 0; --levels) mesh = mapped(subdivided(mesh), on_sphere);
  return scaled(mapped(mesh, on_sphere), radius);
}

/// A geodesic sphere whose vertices have moved along it by up to `amount` of an edge.
inline Mesh jittered_sphere(int levels, std::uint64_t seed, double amount = 0.25)
{
  const double edge = 1.1 / std::pow(2, levels);
  return mapped(jittered(icosphere(levels), amount * edge, seed), [](const Point& p) {
    const Vector v = p - CGAL::ORIGIN;
    return CGAL::ORIGIN + v / std::sqrt(v.squared_length());
  });
}

inline Mesh ellipsoid(int levels, double a, double b, double c)
{
  return scaled(icosphere(levels), a, b, c);
}

inline Mesh torus(std::size_t around, std::size_t across, double major = 1, double minor = 0.4)
{
  const auto point = [&](double i, double j) {
    const double u = 2 * pi * i / double(around), v = 2 * pi * j / double(across);
    const double r = major + minor * std::cos(v);
    return Point(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
  };
  return to_mesh(sheet(around, across, point, true, true));
}

} // namespace surety::test

#include "polyhedra.h"

#endif // SURETY_TEST_MESHES_H
