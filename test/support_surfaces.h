// SPDX-License-Identifier: GPL-3.0-or-later
//
// Analytic surfaces with their normals and distances, and what tests of supports measure on them.
#ifndef SURETY_TEST_SUPPORT_SURFACES_H
#define SURETY_TEST_SUPPORT_SURFACES_H

#include "meshes.h"

#include <surety/geometric_support.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace surety::test {

using Vec = Eigen::Vector3d;

constexpr double no_limit = std::numeric_limits<double>::infinity();

inline Vec vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// A surface that knows itself: the outward normal at a point on it, the distance of any point.
struct Analytic {
  std::function<Vec(const Vec&)> normal;
  std::function<double(const Vec&)> distance;
};

inline Analytic unit_sphere()
{
  return {
      [](const Vec& p) { return p.normalized(); },
      [](const Vec& p) { return std::abs(p.norm() - 1); }};
}

inline Analytic analytic_torus(double major = 1, double minor = 0.4)
{
  const auto from_ring = [major](const Vec& p) {
    const double r = std::hypot(p.x(), p.y());
    return Vec(p - major * Vec(p.x() / r, p.y() / r, 0));
  };
  return {
      [from_ring](const Vec& p) { return from_ring(p).normalized(); },
      [from_ring, minor](const Vec& p) { return std::abs(from_ring(p).norm() - minor); }};
}

/// One normal a side, from a function of the point.
template <class Function>
std::vector<Vec> side_normals(const Mesh& mesh, const Features& features, const Function& normal)
{
  std::vector<Vec> result;
  for (const auto v : find_sides(mesh, features).vertex) {
    result.push_back(normal(vec(mesh.point(Vertex(Mesh::size_type(v))))));
  }
  return result;
}

inline std::vector<Vec> random_normals(
    const Mesh& mesh, const Features& features, double spread, std::uint64_t seed)
{
  Random random(seed);
  const auto corner = corner_normals(mesh, features);
  const Sides sides = find_sides(mesh, features);
  std::vector<Vec> result(sides.size());
  for (const auto h : mesh.halfedges()) {
    if (mesh.is_border(h)) continue;
    const Vector n = corner[h] + spread * random.in_cube();
    result[sides.of_corner[h]] = Vec(n.x(), n.y(), n.z()).normalized();
  }
  return result;
}

/// The barycentric coordinates of a lattice of n + 1 points a side, borders included.
inline std::vector<Vec> lattice(int n)
{
  std::vector<Vec> result;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; i + j <= n; ++j) {
      result.emplace_back(double(n - i - j) / n, double(i) / n, double(j) / n);
    }
  }
  return result;
}

inline double angle(const Vec& a, const Vec& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

inline double median(std::vector<double> values)
{
  std::nth_element(
      values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

inline double mean_edge(const Mesh& mesh)
{
  double sum = 0;
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    sum += (vec(mesh.point(mesh.target(h))) - vec(mesh.point(mesh.source(h)))).norm();
  }
  return sum / double(mesh.number_of_edges());
}

inline double diagonal_of(const Mesh& mesh)
{
  Vec low = Vec::Constant(no_limit), high = -low;
  for (const Vertex v : mesh.vertices()) {
    low = low.cwiseMin(vec(mesh.point(v)));
    high = high.cwiseMax(vec(mesh.point(v)));
  }
  return (high - low).norm();
}

/// A random point of a support, at most `far` away from it.
inline Vec random_point_near(const Geometric_support& support, double far, Random& random)
{
  double v = random.unit(), w = random.unit();
  if (v + w > 1) v = 1 - v, w = 1 - w;
  const auto face = std::uint32_t(random.below(support.number_of_faces()));
  const Vector way = random.in_cube();
  return support.position({face, Vec(1 - v - w, v, w)})
      + far * random.unit() * Vec(way.x(), way.y(), way.z()).normalized();
}

// ---- errors ----

/// Of the points of patches from the surface.
struct Errors {
  double largest, median;
};

template <class Position>
Errors errors(const Mesh& mesh, const Analytic& exact, const Position& position)
{
  std::vector<double> distances;
  for (std::uint32_t f = 0; f < mesh.number_of_faces(); ++f) {
    for (const Vec& b : lattice(6)) {
      if (b.maxCoeff() < 1) distances.push_back(exact.distance(position(f, b)));
    }
  }
  const double largest = *std::max_element(distances.begin(), distances.end());
  return {largest, median(std::move(distances))};
}

inline Errors support_errors(const Mesh& mesh, const Analytic& exact)
{
  const Features features = find_features(mesh);
  const auto support = make_geometric_support(
      mesh, no_limit, features, side_normals(mesh, features, exact.normal));
  return errors(mesh, exact, [&](std::uint32_t f, const Vec& b) {
    return support.position({f, b});
  });
}

/// PN triangles (A. Vlachos et al., Curved PN Triangles, 2001), the cubic patch of other remeshers.
inline Vec pn_point(const std::array<Vec, 3>& p, const std::array<Vec, 3>& n, const Vec& b)
{
  const auto edge
      = [&](int i, int j) { return Vec((2 * p[i] + p[j] - (p[j] - p[i]).dot(n[i]) * n[i]) / 3); };
  Vec sum = Vec::Zero(), edges = Vec::Zero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    sum += b[i] * b[i] * b[i] * p[i];
    sum += 3 * b[i] * b[i] * b[j] * edge(i, j) + 3 * b[i] * b[j] * b[j] * edge(j, i);
    edges += edge(i, j) + edge(j, i);
  }
  const Vec mean = (p[0] + p[1] + p[2]) / 3;
  return sum + 6 * b[0] * b[1] * b[2] * (edges / 6 + (edges / 6 - mean) / 2);
}

inline Errors pn_errors(const Mesh& mesh, const Analytic& exact)
{
  return errors(mesh, exact, [&](std::uint32_t f, const Vec& b) {
    const auto h = mesh.halfedge(Face(f));
    std::array<Vec, 3> corner, normal;
    const std::array<Vertex, 3> v = {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
    for (int i = 0; i < 3; ++i) {
      corner[i] = vec(mesh.point(v[i]));
      normal[i] = exact.normal(corner[i]);
    }
    return pn_point(corner, normal, b);
  });
}

/// The same torus with vertices moved along it.
inline Mesh jittered_torus(std::size_t n, std::uint64_t seed)
{
  const auto exact = analytic_torus();
  return mapped(jittered(torus(n, n / 2), 0.5 / double(n), seed), [&](const Point& q) {
    const Vec at = vec(q), normal = exact.normal(at);
    const double r = std::hypot(q.x(), q.y());
    const Vec on = Vec(at.x() / r, at.y() / r, 0) + 0.4 * normal;
    return Point(on.x(), on.y(), on.z());
  });
}

} // namespace surety::test

#endif // SURETY_TEST_SUPPORT_SURFACES_H
