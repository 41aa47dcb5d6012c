// SPDX-License-Identifier: GPL-3.0-or-later
//
// Linear finite elements on a triangulated surface: u - k div grad u = f, with cotangent weights.
#ifndef SURETY_EXAMPLE_SURFACE_FEM_H
#define SURETY_EXAMPLE_SURFACE_FEM_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <CGAL/Surface_mesh.h>
#include <Eigen/SparseCholesky>

#include <array>
#include <cmath>
#include <vector>

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Field = Mesh::Property_map<Mesh::Vertex_index, double>;

/// The corners of a face, and its area.
struct Element {
  std::array<Mesh::Vertex_index, 3> vertex;
  std::array<Eigen::Vector3d, 3> point;
  double area;

  Element(const Mesh& mesh, Mesh::Face_index f)
  {
    auto h = mesh.halfedge(f);
    for (int i = 0; i < 3; ++i, h = mesh.next(h)) {
      vertex[i] = mesh.target(h);
      const Point& p = mesh.point(vertex[i]);
      point[i] = {p.x(), p.y(), p.z()};
    }
    area = (point[1] - point[0]).cross(point[2] - point[0]).norm() / 2;
  }
};

/// The six points of Dunavant's rule of degree four: weight and barycentric coordinates.
inline std::vector<std::array<double, 4>> quadrature()
{
  std::vector<std::array<double, 4>> rule;
  for (const auto& [weight, near, far] :
       {std::array{.223381589678011, .445948490915965, .108103018168070},
        std::array{.109951743655322, .091576213509771, .816847572980459}})
    for (int i = 0; i < 3; ++i) {
      rule.push_back({weight, near, near, near});
      rule.back()[1 + i] = far;
    }
  return rule;
}

/// Calls visit(element, weights, point, area share) at all points of a quadrature of a surface.
template <class Visit>
void for_each_quadrature_point(const Mesh& mesh, const Visit& visit)
{
  static const auto rule = quadrature();
  for (const auto f : mesh.faces()) {
    const Element element(mesh, f);
    for (const auto& [share, a, b, c] : rule)
      visit(
          element, Eigen::Vector3d(a, b, c),
          Eigen::Vector3d(a * element.point[0] + b * element.point[1] + c * element.point[2]),
          share * element.area);
  }
}

/// u - diffusivity div grad u = source(x, u_before), with the source integrated by quadrature.
template <class Source>
Eigen::VectorXd solve(const Mesh& mesh, double diffusivity, const Source& source)
{
  const auto n = Eigen::Index(mesh.number_of_vertices());
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto f : mesh.faces()) {
    const Element e(mesh, f);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        // The gradient of a hat function is the opposite edge, turned, over twice the area.
        const Eigen::Vector3d a = e.point[(i + 2) % 3] - e.point[(i + 1) % 3];
        const Eigen::Vector3d b = e.point[(j + 2) % 3] - e.point[(j + 1) % 3];
        const double mass = e.area * (i == j ? 2 : 1) / 12;
        entries.emplace_back(
            int(e.vertex[i]), int(e.vertex[j]), mass + diffusivity * a.dot(b) / (4 * e.area));
      }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(n);
  for_each_quadrature_point(
      mesh, [&](const Element& e, const Eigen::Vector3d& w, const Eigen::Vector3d& x, double area) {
        const double f = source(e, w, x);
        for (int i = 0; i < 3; ++i) load[Eigen::Index(e.vertex[i])] += area * f * w[i];
      });
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(load);
}

/// The L2 distance of a field to a function.
template <class Exact>
double l2_error(const Mesh& mesh, const Eigen::VectorXd& u, const Exact& exact)
{
  double sum = 0;
  for_each_quadrature_point(
      mesh, [&](const Element& e, const Eigen::Vector3d& w, const Eigen::Vector3d& x, double area) {
        double value = -exact(x);
        for (int i = 0; i < 3; ++i) value += w[i] * u[Eigen::Index(e.vertex[i])];
        sum += area * value * value;
      });
  return std::sqrt(sum);
}

#endif // SURETY_EXAMPLE_SURFACE_FEM_H
