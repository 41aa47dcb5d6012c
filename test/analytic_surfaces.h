// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smooth surfaces with exact curvatures, and meshes of them with vertices on the surface: regular,
// jittered, random and stretched; and noise.
#ifndef SURETY_TEST_ANALYTIC_SURFACES_H
#define SURETY_TEST_ANALYTIC_SURFACES_H

#include "meshes.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace surety::test {

/// A function of two variables with its derivatives up to order two, which arithmetic carries on.
struct Second_order {
  double f = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;

  /// g(this), for a function with value and first two derivatives at f.
  Second_order chain(double g0, double g1, double g2) const
  {
    return {g0, g1 * u, g1 * v, g2 * u * u + g1 * uu, g2 * u * v + g1 * uv, g2 * v * v + g1 * vv};
  }
};

inline Second_order constant(double c) { return {c, 0, 0, 0, 0, 0}; }
inline Second_order operator+(const Second_order& a, const Second_order& b)
{
  return {a.f + b.f, a.u + b.u, a.v + b.v, a.uu + b.uu, a.uv + b.uv, a.vv + b.vv};
}
inline Second_order operator*(const Second_order& a, const Second_order& b)
{
  return {
      a.f * b.f,
      a.u * b.f + a.f * b.u,
      a.v * b.f + a.f * b.v,
      a.uu * b.f + 2 * a.u * b.u + a.f * b.uu,
      a.uv * b.f + a.u * b.v + a.v * b.u + a.f * b.uv,
      a.vv * b.f + 2 * a.v * b.v + a.f * b.vv};
}
inline Second_order operator*(double s, const Second_order& a) { return constant(s) * a; }
inline Second_order sin(const Second_order& a)
{
  return a.chain(std::sin(a.f), std::cos(a.f), -std::sin(a.f));
}
inline Second_order cos(const Second_order& a)
{
  return a.chain(std::cos(a.f), -std::sin(a.f), -std::cos(a.f));
}
/// max(a, 0)^3, twice continuously differentiable.
inline Second_order positive_cube(const Second_order& a)
{
  const double t = (std::max)(a.f, 0.0);
  return a.chain(t * t * t, 3 * t * t, 6 * t);
}

/// Exact shape at a point. Curvatures are positive where the surface bends towards `normal`, which
/// is r_u x r_v, as the faces of the meshes are oriented.
struct Exact_shape {
  Eigen::Vector3d point, normal, min_direction, max_direction;
  double min_curvature, max_curvature;
  double largest() const { return (std::max)(std::abs(min_curvature), std::abs(max_curvature)); }
};

/// A patch over the square [-1, 1]^2.
struct Analytic_surface {
  std::string name;
  std::function<std::array<Second_order, 3>(const Second_order&, const Second_order&)> map;
  bool is_smooth = true; ///< more than twice continuously differentiable

  Exact_shape at(double u, double v) const
  {
    const auto r = map({u, 1, 0, 0, 0, 0}, {v, 0, 1, 0, 0, 0});
    const auto vector = [&r](double Second_order::*member) {
      return Eigen::Vector3d(r[0].*member, r[1].*member, r[2].*member);
    };
    const Eigen::Vector3d ru = vector(&Second_order::u), rv = vector(&Second_order::v);
    Exact_shape shape;
    shape.point = vector(&Second_order::f);
    shape.normal = ru.cross(rv).normalized();
    Eigen::Matrix2d first, second;
    first << ru.dot(ru), ru.dot(rv), ru.dot(rv), rv.dot(rv);
    const double uv = shape.normal.dot(vector(&Second_order::uv));
    second << shape.normal.dot(vector(&Second_order::uu)), uv, uv,
        shape.normal.dot(vector(&Second_order::vv));
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(second, first);
    shape.min_curvature = solver.eigenvalues()[0];
    shape.max_curvature = solver.eigenvalues()[1];
    const Eigen::Vector2d a = solver.eigenvectors().col(0), b = solver.eigenvectors().col(1);
    shape.min_direction = (a[0] * ru + a[1] * rv).normalized();
    shape.max_direction = (b[0] * ru + b[1] * rv).normalized();
    return shape;
  }

  Point point(double u, double v) const
  {
    const auto r = map(constant(u), constant(v));
    return Point(r[0].f, r[1].f, r[2].f);
  }
};

inline std::vector<Analytic_surface> analytic_surfaces()
{
  using S = Second_order;
  const auto spheroid = [](double a, double b, double c) {
    return [=](const S& u, const S& v) {
      return std::array{a * (cos(u) * cos(v)), b * (sin(u) * cos(v)), c * sin(v)};
    };
  };
  const auto torus = [](const S& u, const S& v) {
    const S angle = 2.5 * v, r = constant(1) + 0.4 * cos(angle);
    return std::array{r * cos(u), r * sin(u), 0.4 * sin(angle)};
  };
  const auto paraboloid = [](const S& u, const S& v) {
    return std::array{u, v, 0.5 * (u * u) + -0.5 * (v * v)};
  };
  const auto cylinder = [](const S& u, const S& v) { return std::array{cos(u), sin(u), v}; };
  const auto blend = [](const S& u, const S& v) {
    return std::array{u, v, 0.3 * positive_cube(u + constant(0.137)) + 0.2 * (v * v)};
  };
  return {
      {"sphere", spheroid(1, 1, 1)},
      {"ellipsoid", spheroid(1, 0.8, 0.6)},
      {"torus", torus},
      {"hyperbolic_paraboloid", paraboloid},
      {"cylinder", cylinder},
      {"blend", blend, false}};
}

/// How the vertices of a patch lie.
enum class Layout { regular, jittered, random, stretched };

inline const char* to_string(Layout layout)
{
  switch (layout) {
  case Layout::regular:
    return "regular";
  case Layout::jittered:
    return "jittered";
  case Layout::random:
    return "random";
  default:
    return "stretched";
  }
}

/// A mesh of a patch, and the parameters of its vertices.
struct Patch {
  Mesh mesh;
  std::vector<std::array<double, 2>> parameter;

  /// Away from the border, where estimates are one-sided.
  bool is_inner(Vertex v) const
  {
    const auto& p = parameter[v];
    return (std::max)(std::abs(p[0]), std::abs(p[1])) < 0.7;
  }
};

namespace patch {

using Parameters = std::vector<std::array<double, 2>>;

/// A grid of spacing `du` and `dv` over [-ru, ru] x [-rv, rv] whose inner points move by up to
/// `amount` of the spacing.
inline Parameters jittered_grid(
    double ru, double rv, double du, double dv, double amount, Random& random)
{
  Parameters points;
  const int nu = int(std::round(2 * ru / du)), nv = int(std::round(2 * rv / dv));
  for (int i = 0; i <= nu; ++i) {
    for (int j = 0; j <= nv; ++j) {
      const double a = i % nu == 0 ? 0 : random.between(-amount, amount);
      const double b = j % nv == 0 ? 0 : random.between(-amount, amount);
      points.push_back({-ru + (i + a) * du, -rv + (j + b) * dv});
    }
  }
  return points;
}

/// As many points as a grid of n x n cells has.
inline Parameters random_points(int n, Random& random)
{
  Parameters points;
  for (int i = 0; i <= n; ++i) {
    const double t = -1 + 2.0 * i / n;
    points.insert(points.end(), {{t, -1}, {t, 1}});
    if (i % n != 0) points.insert(points.end(), {{-1, t}, {1, t}});
  }
  while (int(points.size()) < (n + 1) * (n + 1))
    points.push_back({random.between(-1, 1), random.between(-1, 1)});
  return points;
}

/// The Delaunay triangulation of the images of the points under a linear map.
template <class Linear_map>
Soup triangulated(const Parameters& points, const Linear_map& map)
{
  using Base = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>;
  using Structure = CGAL::Triangulation_data_structure_2<Base>;
  CGAL::Delaunay_triangulation_2<Kernel, Structure> delaunay;
  std::vector<std::pair<Kernel::Point_2, std::size_t>> input;
  for (std::size_t i = 0; i < points.size(); ++i) input.emplace_back(map(points[i]), i);
  delaunay.insert(input.begin(), input.end());
  Soup soup;
  for (const auto f : delaunay.finite_face_handles())
    soup.triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
  return soup;
}

} // namespace patch

/// A mesh of about n x n cells. The edges of a stretched one are ten times as long in one
/// direction, which is oblique, as across it.
inline Patch make_patch(const Analytic_surface& surface, Layout layout, int n, std::uint64_t seed)
{
  Random random(seed);
  const double h = 2.0 / n;
  Patch result;
  Soup soup;
  const auto identity = [](const std::array<double, 2>& p) { return Kernel::Point_2(p[0], p[1]); };
  if (layout == Layout::stretched) {
    const double stretch = std::sqrt(10.0), c = std::cos(0.5), s = std::sin(0.5);
    for (const auto& [x, y] :
         patch::jittered_grid(1.5, 1.5, h * stretch, h / stretch, 0.3, random)) {
      const double u = c * x - s * y, v = s * x + c * y;
      if ((std::max)(std::abs(u), std::abs(v)) <= 1) result.parameter.push_back({u, v});
    }
    soup = patch::triangulated(result.parameter, [=](const std::array<double, 2>& p) {
      return Kernel::Point_2((c * p[0] + s * p[1]) / stretch, (-s * p[0] + c * p[1]) * stretch);
    });
  } else {
    result.parameter = layout == Layout::random
        ? patch::random_points(n, random)
        : patch::jittered_grid(1, 1, h, h, layout == Layout::jittered ? 0.3 : 0, random);
    if (layout == Layout::regular) {
      soup = sheet(std::size_t(n), std::size_t(n), [](double, double) { return Point(0, 0, 0); });
      soup.points.clear();
    } else {
      soup = patch::triangulated(result.parameter, identity);
    }
  }
  for (const auto& [u, v] : result.parameter) soup.points.push_back(surface.point(u, v));
  result.mesh = to_mesh(soup);
  return result;
}

inline double mean_edge_length(const Mesh& mesh)
{
  double sum = 0;
  for (const auto e : mesh.edges()) {
    sum += std::sqrt(
        CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  }
  return sum / double(mesh.number_of_edges());
}

/// Every coordinate gets Gaussian noise of this standard deviation.
inline Mesh with_noise(const Mesh& mesh, double deviation, std::uint64_t seed)
{
  Random random(seed);
  const auto gaussian = [&random] {
    const double r = std::sqrt(-2 * std::log(1 - random.unit()));
    return r * std::cos(2 * pi * random.unit());
  };
  return mapped(mesh, [&](const Point& p) {
    const double x = gaussian(), y = gaussian(), z = gaussian();
    return p + deviation * Vector(x, y, z);
  });
}

} // namespace surety::test

#endif // SURETY_TEST_ANALYTIC_SURFACES_H
