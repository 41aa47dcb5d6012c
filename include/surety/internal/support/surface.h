// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface that queries see: the points of the faces plus the saturated displacements of the
// patches, with derivatives and bounds. Nothing changes after construction.
#ifndef SURETY_INTERNAL_SUPPORT_SURFACE_H
#define SURETY_INTERNAL_SUPPORT_SURFACE_H

#include <surety/internal/support/evaluation.h>
#include <surety/internal/support/flat_mesh.h>
#include <surety/internal/support/saturation.h>
#include <surety/internal/support/shape.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace surety::internal {

class Support_surface
{
public:
  Support_surface(Flat_mesh mesh, const Support_shape& shape, double limit)
    : mesh_(std::move(mesh)), net_(shape.net), saturation_(limit), limit_(limit)
  {
    reach_.assign(mesh_.faces(), 0);
    derivatives_.assign(mesh_.faces(), {});
    for (Index f = 0; f < mesh_.faces(); ++f) {
      if (mesh_.is_face(f)) set_bounds(f);
    }
  }

  const Flat_mesh& mesh() const { return mesh_; }
  const Control_net& net(Index f) const { return net_[f]; }
  const Saturation& saturation() const { return saturation_; }

  /// No point of the face's patch is farther from the point of the face that it belongs to.
  double reach(Index f) const { return (std::min)(reach_[f], limit_); }
  /// Whether a displacement of this face may be larger than the start of saturation.
  bool may_saturate(Index f) const { return reach_[f] > saturation_.start(); }
  /// Bounds the change of displacements along directions inside the triangle.
  const Derivative_bounds& derivative_bounds(Index f) const { return derivatives_[f]; }

  Vector flat_point(Index f, const Vector& barycentric) const
  {
    const Corners& c = mesh_.corner[f];
    return barycentric[0] * mesh_.point[c[0]] + barycentric[1] * mesh_.point[c[1]]
        + barycentric[2] * mesh_.point[c[2]];
  }

  /// Before saturation.
  Vector displacement(Index f, const Vector& barycentric) const
  {
    return Patch_weights(barycentric).point(net_[f]);
  }

  Vector point(Index f, const Vector& barycentric) const
  {
    return flat_point(f, barycentric) + saturation_(displacement(f, barycentric));
  }

  Jet first_order(Index f, const Vector& barycentric) const { return jet(f, barycentric, false); }
  Jet second_order(Index f, const Vector& barycentric) const { return jet(f, barycentric, true); }

  /// Of unit length; that of the triangle where the patch has none.
  Vector normal(Index f, const Jet& jet) const
  {
    const Vector n = jet.v.cross(jet.w);
    const Vector flat = mesh_.chord(f, 0).cross(-mesh_.chord(f, 2));
    const double least = 1e-20 * flat.squaredNorm();
    return unit(n.squaredNorm() > least ? n : flat);
  }

private:
  Jet jet(Index f, const Vector& barycentric, bool to_second_order) const
  {
    const Patch_weights weights(barycentric);
    Jet result;
    result.point = weights.point(net_[f]);
    weights.first(net_[f], result);
    if (to_second_order) weights.second(net_[f], result);
    if (may_saturate(f)) saturation_.apply(result, to_second_order);
    result.point += flat_point(f, barycentric);
    result.v += mesh_.chord(f, 0);
    result.w -= mesh_.chord(f, 2);
    return result;
  }

  void set_bounds(Index f)
  {
    reach_[f] = displacement_bound(net_[f]);
    derivatives_[f] = Mean_net(net_[f]).bounds();
  }

  Flat_mesh mesh_;
  std::vector<Control_net> net_;               // by face
  std::vector<double> reach_;                  // by face: before saturation
  std::vector<Derivative_bounds> derivatives_; // by face: of displacements before saturation
  Saturation saturation_;
  double limit_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_SURFACE_H
