// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface near a vertex as section 2 of the paper has it: z = a x^2 + b x y + c y^2 in the
// frame of the vertex and its normal, fitted to the vertices around it.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_LOCAL_QUADRIC_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_LOCAL_QUADRIC_H

#include <surety/internal/operators/disc.h>

#include <Eigen/QR>

namespace surety::internal {

class Local_quadric
{
public:
  /// For the apex of a closed disc, where it is now.
  Local_quadric(const Working_mesh& mesh, const Disc& disc) : origin_(mesh.point(disc.apex))
  {
    Vector normal = Vector::Zero();
    for (Index i = 0; i < disc.size(); ++i)
      if (!mesh.is_ghost_face(disc.face[i]))
        normal += (mesh.point(disc.ring[i]) - origin_)
                      .cross(mesh.point(disc.ring[disc.after(i)]) - origin_);
    z_ = unit(normal);
    x_ = z_.unitOrthogonal();
    y_ = z_.cross(x_);
    fit(mesh, disc);
  }

  /// The point of the quadric above or below a place.
  Vector project(const Vector& place) const
  {
    const double x = (place - origin_).dot(x_), y = (place - origin_).dot(y_);
    return origin_ + x * x_ + y * y_ + row(x, y).dot(coefficients_) * z_;
  }

private:
  static Eigen::RowVector3d row(double x, double y) { return {x * x, x * y, y * y}; }

  /// Where the neighbours are too few, or lie on two lines, the flattest of the quadrics that fit.
  void fit(const Working_mesh& mesh, const Disc& disc)
  {
    Eigen::Matrix<double, Eigen::Dynamic, 3> rows(disc.size(), 3);
    Eigen::VectorXd heights(disc.size());
    int number = 0;
    for (const Index v : disc.ring) {
      if (mesh.is_ghost_vertex(v)) continue;
      const Vector d = mesh.point(v) - origin_;
      rows.row(number) = row(d.dot(x_), d.dot(y_));
      heights[number++] = d.dot(z_);
    }
    coefficients_
        = rows.topRows(number).completeOrthogonalDecomposition().solve(heights.head(number));
  }

  Vector origin_, x_, y_, z_;
  Vector coefficients_; ///< a, b, c
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_LOCAL_QUADRIC_H
