// SPDX-License-Identifier: GPL-3.0-or-later
//
// Errors of curvatures on meshes of analytic surfaces, for this library and for CGAL's jets.
#ifndef SURETY_TEST_CURVATURE_ERRORS_H
#define SURETY_TEST_CURVATURE_ERRORS_H

#include "analytic_surfaces.h"

#include <surety/curvature.h>

#include <CGAL/Monge_via_jet_fitting.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <vector>

namespace surety::test {

/// The smaller and the larger principal curvature.
using Two_curvatures = std::array<double, 2>;
/// Estimates the curvature of the vertices of a patch that are asked for.
using Estimator
    = std::function<std::vector<Two_curvatures>(const Mesh&, const std::vector<Vertex>&)>;

/// Relative to the largest curvature of the surface.
struct Errors {
  double median, tail; ///< tail: 95 % of the errors are smaller
};

inline Estimator by_method(Curvature_method method)
{
  return [method](const Mesh& mesh, const std::vector<Vertex>& wanted) {
    const auto field = estimate_curvatures(mesh, parameters::curvature_method(method));
    std::vector<Two_curvatures> result;
    for (const Vertex v : wanted) {
      const auto& side = field.side[field.sides.first[v]];
      result.push_back({side.min_curvature, side.max_curvature});
    }
    return result;
  };
}

/// CGAL's fit of a jet of some degree to the vertex and some rings round it.
inline Estimator by_jets(int degree, int rings)
{
  return [=](const Mesh& mesh, const std::vector<Vertex>& wanted) {
    std::vector<Two_curvatures> result;
    for (const Vertex v : wanted) {
      std::vector<Vertex> near(1, v);
      std::set<Vertex> seen(near.begin(), near.end());
      std::size_t next = 0;
      for (int ring = 0; ring < rings; ++ring) {
        for (const std::size_t end = near.size(); next < end; ++next) {
          for (const Vertex w : mesh.vertices_around_target(mesh.halfedge(near[next]))) {
            if (seen.insert(w).second) near.push_back(w);
          }
        }
      }
      std::vector<Point> points;
      for (const Vertex w : near) points.push_back(mesh.point(w));
      result.push_back({0, 0});
      if (int(points.size()) < (degree + 1) * (degree + 2) / 2) continue;
      CGAL::Monge_via_jet_fitting<Kernel> fit;
      auto form = fit(points.begin(), points.end(), std::size_t(degree), 2);
      Vector normal(0, 0, 0);
      for (const auto h : mesh.halfedges_around_target(mesh.halfedge(v))) {
        if (mesh.is_border(h)) continue;
        normal = normal
            + CGAL::normal(
                     mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                     mesh.point(mesh.target(mesh.next(h))));
      }
      form.comply_wrt_given_normal(normal);
      result.back() = {form.principal_curvatures(1), form.principal_curvatures(0)};
    }
    return result;
  };
}

/// Noise is a standard deviation, relative to the mean length of the edges.
inline Errors errors_on(
    const Analytic_surface& surface, Layout layout, int n, double noise, const Estimator& estimate,
    std::uint64_t seed = 1)
{
  const Patch patch = make_patch(surface, layout, n, seed);
  const Mesh mesh = noise > 0
      ? with_noise(patch.mesh, noise * mean_edge_length(patch.mesh), seed + 1)
      : patch.mesh;
  std::vector<Vertex> inner;
  double largest = 0;
  for (const Vertex v : mesh.vertices()) {
    const auto& p = patch.parameter[v];
    largest = (std::max)(largest, surface.at(p[0], p[1]).largest());
    if (patch.is_inner(v)) inner.push_back(v);
  }
  const auto found = estimate(mesh, inner);
  std::vector<double> errors;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const auto& p = patch.parameter[inner[i]];
    const Exact_shape exact = surface.at(p[0], p[1]);
    errors.push_back(
        (std::max)(
            std::abs(found[i][0] - exact.min_curvature),
            std::abs(found[i][1] - exact.max_curvature))
        / largest);
  }
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors[errors.size() * 95 / 100]};
}

/// The geometric mean over surfaces.
inline Errors mean_errors(
    const std::vector<Analytic_surface>& surfaces, Layout layout, int n, double noise,
    const Estimator& estimate, std::uint64_t seed = 1)
{
  double median = 0, tail = 0;
  for (const auto& surface : surfaces) {
    const Errors errors = errors_on(surface, layout, n, noise, estimate, seed);
    median += std::log(errors.median) / double(surfaces.size());
    tail += std::log(errors.tail) / double(surfaces.size());
  }
  return {std::exp(median), std::exp(tail)};
}

} // namespace surety::test

#endif // SURETY_TEST_CURVATURE_ERRORS_H
