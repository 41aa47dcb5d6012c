// SPDX-License-Identifier: GPL-3.0-or-later
//
// The complexity of a metric, the integral of sqrt(det M) over the surface: how much area it sees.
#ifndef SURETY_INTERNAL_SOLUTION_METRIC_COMPLEXITY_H
#define SURETY_INTERNAL_SOLUTION_METRIC_COMPLEXITY_H

#include <surety/features.h>
#include <surety/internal/linear.h>
#include <surety/internal/metric/tensor.h>

#include <CGAL/boost/graph/helpers.h>

#include <Eigen/LU>

#include <array>
#include <vector>

namespace surety::internal::solution_metric {

/// Of a unit triangulation: equilateral faces of the area sqrt(3)/4, two a vertex.
constexpr double vertices_per_complexity = 1.1547005383792515;

/// \brief Integrates over the faces of a mesh, tensors of sizes being linear inside them.
///
/// That is how the unit mesh reads a metric. The values at the vertices alone would see a front
/// that is one face wide too large by much.
class Complexity
{
public:
  /// Lengths of the mesh are multiplied by `scale`.
  template <class Mesh, class Points>
  Complexity(const Mesh& mesh, const Points& points, const Sides& sides, double scale)
  {
    for (const auto f : faces(mesh)) {
      Face face;
      std::array<Vector, 3> p;
      auto h = halfedge(f, mesh);
      for (int i = 0; i < 3; ++i, h = next(h, mesh)) {
        p[i] = scale * to_vector(get(points, target(h, mesh)));
        face.side[i] = sides.of_corner[h];
      }
      const Vector n = (p[1] - p[0]).cross(p[2] - p[0]);
      face.area = n.norm() / 2;
      const auto [u, v] = metric::tangent_basis(unit(n));
      face.plane.col(0) = u;
      face.plane.col(1) = v;
      faces_.push_back(face);
    }
  }

  /// \param sizes by side: tensors whose eigenvalues are sizes
  double operator()(const std::vector<metric::Tensor>& sizes) const
  {
    double sum = 0;
    for (const Face& face : faces_) {
      std::array<Eigen::Matrix2d, 3> corner;
      for (int i = 0; i < 3; ++i)
        corner[i] = face.plane.transpose() * sizes[face.side[i]] * face.plane;
      for (const auto& [weight, near, far] : rule)
        for (int i = 0; i < 3; ++i)
          sum += face.area * weight
              / (far * corner[i] + near * (corner[(i + 1) % 3] + corner[(i + 2) % 3]))
                    .determinant();
    }
    return sum;
  }

private:
  struct Face {
    std::array<Index, 3> side;
    double area;
    Eigen::Matrix<double, 3, 2> plane;
  };
  /// A weight, and the barycentric coordinates of three points: two are `near`, one is `far`.
  struct Orbit {
    double weight, near, far;
  };
  /// D. A. Dunavant, High degree efficient symmetrical Gaussian quadrature rules for the triangle,
  /// 1985: the rule of degree four.
  static constexpr std::array<Orbit, 2> rule
      = {{{.223381589678011, .445948490915965, .108103018168070},
          {.109951743655322, .091576213509771, .816847572980459}}};

  std::vector<Face> faces_;
};

} // namespace surety::internal::solution_metric

#endif // SURETY_INTERNAL_SOLUTION_METRIC_COMPLEXITY_H
