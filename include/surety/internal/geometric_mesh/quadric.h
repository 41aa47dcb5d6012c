// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quadric error (Garland and Heckbert, 1997): the order in which collapses are tried, and where a
// free vertex goes. It is a cost and never a bound.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_QUADRIC_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_QUADRIC_H

#include <surety/internal/linear.h>

#include <Eigen/Cholesky>

namespace surety::internal {

/// The weighted sum of squared distances to planes, as x^T A x - 2 b^T x + c.
class Quadric
{
public:
  /// The plane through p with unit normal n.
  static Quadric of_plane(const Vector& p, const Vector& n, double weight)
  {
    Quadric q;
    const double d = n.dot(p);
    q.xx_ = weight * n.x() * n.x(), q.xy_ = weight * n.x() * n.y(), q.xz_ = weight * n.x() * n.z();
    q.yy_ = weight * n.y() * n.y(), q.yz_ = weight * n.y() * n.z();
    q.zz_ = weight * n.z() * n.z();
    q.b_ = weight * d * n;
    q.c_ = weight * d * d;
    return q;
  }

  Quadric& operator+=(const Quadric& o)
  {
    xx_ += o.xx_, xy_ += o.xy_, xz_ += o.xz_, yy_ += o.yy_, yz_ += o.yz_, zz_ += o.zz_;
    b_ += o.b_;
    c_ += o.c_;
    return *this;
  }
  friend Quadric operator+(Quadric a, const Quadric& b) { return a += b; }

  double operator()(const Vector& p) const
  {
    const double x = p.x(), y = p.y(), z = p.z();
    return x * (xx_ * x + 2 * (xy_ * y + xz_ * z)) + y * (yy_ * y + 2 * yz_ * z) + zz_ * z * z
        - 2 * b_.dot(p) + c_;
  }

  /// Where it is least, with a pull towards p of 1e-4 of its weight, which decides where the planes
  /// leave a choice.
  Vector minimum_near(const Vector& p) const
  {
    Eigen::Matrix3d a;
    a << xx_, xy_, xz_, xy_, yy_, yz_, xz_, yz_, zz_;
    const double pull = 1e-4 * a.trace();
    if (!(pull > 0)) return p;
    a.diagonal().array() += pull;
    return a.ldlt().solve(b_ + pull * p);
  }

private:
  double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
  Vector b_ = Vector::Zero();
  double c_ = 0;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_QUADRIC_H
