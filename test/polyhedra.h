// SPDX-License-Identifier: GPL-3.0-or-later
//
// The second half of meshes.h: polyhedral and thin shapes, and sets of several components. Include
// meshes.h, which includes this file.
#ifndef SURETY_TEST_POLYHEDRA_H
#define SURETY_TEST_POLYHEDRA_H

#include "meshes.h"

#include <set>

namespace surety::test {

// ---- polyhedral shapes ----

using Cell = std::array<int, 3>;

/// The surface of a solid made of unit cubes; no two of them may meet in an edge or a vertex only.
inline Mesh cubes(const std::set<Cell>& solid)
{
  Soup soup;
  std::map<Cell, std::size_t> number;
  const auto vertex = [&](const Cell& c) {
    const auto found = number.try_emplace(c, soup.points.size());
    if (found.second) soup.points.emplace_back(c[0], c[1], c[2]);
    return found.first->second;
  };
  for (const Cell& c : solid) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        Cell other = c;
        other[axis] += side == 0 ? -1 : 1;
        if (solid.count(other) > 0) continue;
        Cell p00 = c;
        p00[axis] += side;
        Cell p10 = p00, p01 = p00, p11 = p00;
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        ++p10[u], ++p11[u], ++p01[v], ++p11[v];
        if (side == 0) std::swap(p10, p01);
        const std::size_t a = vertex(p00), b = vertex(p10), d = vertex(p11), e = vertex(p01);
        soup.triangles.insert(soup.triangles.end(), {{a, b, d}, {a, d, e}});
      }
    }
  }
  return to_mesh(soup);
}

/// The box of nx x ny x nz unit cubes.
inline Mesh brick(int nx, int ny, int nz)
{
  std::set<Cell> solid;
  for (int x = 0; x < nx; ++x) {
    for (int y = 0; y < ny; ++y) {
      for (int z = 0; z < nz; ++z) solid.insert({x, y, z});
    }
  }
  return cubes(solid);
}

/// The unit cube, 12 n^2 faces.
inline Mesh cube(int n = 1) { return scaled(brick(n, n, n), 1.0 / n); }

/// A plate with a row of square holes: as many handles as holes. 2 holes: a double torus.
inline Mesh plate_with_holes(int holes)
{
  std::set<Cell> solid;
  for (int x = 0; x <= 2 * holes; ++x) {
    for (int y = 0; y < 3; ++y) {
      if (y != 1 || x % 2 == 0) solid.insert({x, y, 0});
    }
  }
  return cubes(solid);
}

/// A closed cylinder with `around` facets, cut in `along` rings, with a fan at each end.
inline Mesh cylinder(std::size_t around, std::size_t along, double radius = 1, double height = 2)
{
  Soup soup = sheet(
      along, around,
      [&](double i, double j) {
        const double phi = -2 * pi * j / double(around);
        return Point(
            radius * std::cos(phi), radius * std::sin(phi), height * (i / double(along) - 0.5));
      },
      false, true);
  const std::size_t low = soup.points.size(), high = low + 1, top = along * around;
  soup.points.emplace_back(0, 0, -height / 2);
  soup.points.emplace_back(0, 0, height / 2);
  for (std::size_t j = 0; j < around; ++j) {
    const std::size_t k = (j + 1) % around;
    soup.triangles.insert(soup.triangles.end(), {{low, j, k}, {high, top + k, top + j}});
  }
  return to_mesh(soup);
}

// ---- thin shapes ----

/// The chosen faces, a disc, are lifted by a vector; walls of `segments` stories join them to the
/// faces that stay.
inline Mesh extruded(
    const Mesh& mesh, const std::function<bool(Face)>& is_lifted, const Vector& lift,
    std::size_t segments = 1)
{
  Soup soup = to_soup(mesh);
  std::vector<bool> lifted;
  for (const Face f : mesh.faces()) lifted.push_back(is_lifted(f));

  std::map<std::pair<std::size_t, std::size_t>, std::size_t> copies;
  const auto copy = [&](std::size_t v, std::size_t story) {
    if (story == 0) return v;
    const auto found = copies.try_emplace({v, story}, soup.points.size());
    if (found.second) {
      soup.points.push_back(soup.points[v] + double(story) / double(segments) * lift);
    }
    return found.first->second;
  };

  std::set<std::pair<std::size_t, std::size_t>> sides;
  for (std::size_t f = 0; f < lifted.size(); ++f) {
    if (!lifted[f]) continue;
    const auto t = soup.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      if (sides.erase({t[(i + 1) % 3], t[i]}) == 0) sides.insert({t[i], t[(i + 1) % 3]});
    }
    for (std::size_t& corner : soup.triangles[f]) corner = copy(corner, segments);
  }
  for (const auto& [a, b] : sides) {
    for (std::size_t k = 0; k < segments; ++k) {
      const std::size_t c = copy(b, k + 1), d = copy(a, k + 1);
      soup.triangles.insert(
          soup.triangles.end(), {{copy(a, k), copy(b, k), c}, {copy(a, k), c, d}});
    }
  }
  // Points that only lifted faces used are gone.
  std::vector<bool> used(soup.points.size(), false);
  for (const auto& t : soup.triangles) {
    for (const std::size_t corner : t) used[corner] = true;
  }
  std::vector<std::size_t> number(soup.points.size());
  Soup result;
  for (std::size_t i = 0; i < used.size(); ++i) {
    number[i] = result.points.size();
    if (used[i]) result.points.push_back(soup.points[i]);
  }
  for (auto t : soup.triangles) {
    for (std::size_t& corner : t) corner = number[corner];
    result.triangles.push_back(t);
  }
  return to_mesh(result);
}

/// A needle of triangular section stands in the middle of a face, along its normal.
inline Mesh with_needle(
    const Mesh& mesh, Face face, double thickness, double height, std::size_t segments = 4)
{
  Soup soup = to_soup(mesh);
  const auto t = soup.triangles[face];
  const Point a = soup.points[t[0]], b = soup.points[t[1]], c = soup.points[t[2]];
  const Point centre = CGAL::centroid(a, b, c);
  const std::size_t n = soup.points.size();
  for (const Point& p : {a, b, c}) {
    const Vector v = p - centre;
    soup.points.push_back(centre + thickness / 2 / std::sqrt(v.squared_length()) * v);
  }
  soup.triangles[face] = {n, n + 1, n + 2};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    soup.triangles.insert(soup.triangles.end(), {{t[i], t[j], n + j}, {t[i], n + j, n + i}});
  }
  const Vector normal = CGAL::normal(a, b, c);
  return extruded(
      to_mesh(soup), [face](Face f) { return f == face; },
      height / std::sqrt(normal.squared_length()) * normal, segments);
}

/// A needle on the open unit square, and one on the unit sphere.
inline Mesh needle_on_plate(double thickness, double height, std::size_t n = 9)
{
  return with_needle(grid(n), Face(Mesh::size_type(n * n)), thickness, height);
}

inline Mesh needle_on_sphere(double thickness, double height, int levels = 3)
{
  return with_needle(icosphere(levels), Face(0), thickness, height);
}

/// A thin upright wall in the middle of the open unit square, clear of its border.
inline Mesh fin(double thickness, double height, std::size_t n = 8)
{
  const auto x = [&](double i) {
    const double half = double(n);
    if (i <= half) return (0.5 - thickness / 2) * i / half;
    return 1 - (0.5 - thickness / 2) * (2 * half + 1 - i) / half;
  };
  const Mesh plate = to_mesh(sheet(
      2 * n + 1, 2 * n, [&](double i, double j) { return Point(x(i), j / double(2 * n), 0); }));
  const auto is_wall = [&](Face f) {
    const auto h = plate.halfedge(f);
    const Point c = CGAL::centroid(
        plate.point(plate.source(h)), plate.point(plate.target(h)),
        plate.point(plate.target(plate.next(h))));
    return std::abs(c.x() - 0.5) < thickness / 2 && std::abs(c.y() - 0.5) < 0.25;
  };
  return extruded(plate, is_wall, Vector(0, 0, height), 4);
}

// ---- several components ----

/// Two parallel unit squares that face away from each other.
inline Mesh two_sheets(std::size_t n, double gap)
{
  return joined({reversed(grid(n)), translated(grid(n), Vector(0, 0, gap))});
}

/// A spherical shell of the given thickness; the inner sphere faces inwards.
inline Mesh two_spheres(int levels, double gap)
{
  return joined({icosphere(levels), reversed(icosphere(levels, 1 - gap))});
}

/// Spheres of radius 1, 1/10, 1/100, ... side by side.
inline Mesh spheres_at_scales(int number, int levels = 2)
{
  std::vector<Mesh> spheres;
  double radius = 1, x = 0;
  for (int i = 0; i < number; ++i, radius /= 10) {
    spheres.push_back(translated(icosphere(levels, radius), Vector(x, 0, 0)));
    x += 1.5 * radius;
  }
  return joined(spheres);
}

/// One of the shapes above, of a random kind, noisy or not, rotated: at most some thousand faces.
inline Mesh random_shape(std::uint64_t seed)
{
  Random random(seed);
  const auto shape = [&]() -> Mesh {
    switch (random.below(10)) {
    case 0:
      return jittered_sphere(3, seed);
    case 1:
      return torus(12 + random.below(30), 8 + random.below(12));
    case 2:
      return ellipsoid(3, 1, random.between(0.2, 1), random.between(0.1, 1));
    case 3:
      return saddle(6 + random.below(20));
    case 4:
      return subdivided(plate_with_holes(1 + int(random.below(3))), 2);
    case 5:
      return cylinder(8 + random.below(40), 1 + random.below(10));
    case 6:
      return needle_on_sphere(random.between(0.001, 0.05), random.between(0.1, 2));
    case 7:
      return fin(random.between(0.001, 0.05), random.between(0.1, 1));
    case 8:
      return annulus(12 + random.below(30), 2 + random.below(8));
    default:
      return split_at_random(cube(2 + int(random.below(4))), 300, seed);
    }
  }();
  const double noise = random.below(2) == 0 ? 0 : 1e-4;
  return rotated(jittered(shape, noise, seed), seed);
}

} // namespace surety::test

#endif // SURETY_TEST_POLYHEDRA_H
