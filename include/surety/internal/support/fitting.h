// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a support is from the original, proven; and on a geometric mesh, which has spent a part
// b(K) of the tolerance at each face, what to do with a patch that exceeds the rest: scale its
// displacements down where that leaves the surface nearly smooth, else make its creases ridges.
#ifndef SURETY_INTERNAL_SUPPORT_FITTING_H
#define SURETY_INTERNAL_SUPPORT_FITTING_H

#include <surety/internal/support/promotion.h>
#include <surety/internal/support/report.h>
#include <surety/internal/support/shape.h>
#include <surety/internal/support/surface.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace surety::internal {

/// On the mesh of the original: the largest displacement, of points as they are computed.
inline double proven_deviation(const Support_surface& surface)
{
  double largest = 0;
  for (Index f = 0; f < surface.mesh().faces(); ++f) {
    if (surface.mesh().is_face(f)) largest = (std::max)(largest, surface.reach(f));
  }
  return rounding_of(surface.mesh()).upper_bound(largest * largest);
}

/// On a geometric mesh. A point of a patch is within its displacement of its face, and the other
/// way round, and the face within b(K) of the part of the original that corresponds to it.
inline double proven_deviation(const Support_surface& surface, const std::vector<double>& deviation)
{
  double largest = 0;
  for (Index f = 0; f < surface.mesh().faces(); ++f) {
    if (!surface.mesh().is_face(f)) continue;
    largest = (std::max)(largest, deviation[f] + surface.reach(f));
  }
  return rounding_of(surface.mesh()).upper_bound(largest * largest);
}

class Fitting
{
public:
  Fitting(
      Flat_mesh& mesh, std::vector<Vector> normals, const std::vector<double>& deviation,
      double tolerance, double corner_angle)
    : mesh_(mesh),
      deviation_(deviation),
      tolerance_(tolerance * (1 - 0x1p-20)),
      shape_(mesh, std::move(normals))
  {
    measure();
    for (Index f = 0; f < mesh.faces(); ++f)
      if (mesh.is_face(f) && shape_.scale[f] < 1) faces_to_refine_.push_back(f);
    // Ends, since every round makes ridges of edges that were none.
    while (promote() > 0) {
      add_corners(mesh_, corner_angle);
      std::vector<Vector> cut = Side_cutter(mesh_).cut(shape_.normal);
      shape_ = Support_shape(mesh_, std::move(cut));
      measure();
    }
    flatten();
  }

  const Support_shape& shape() const { return shape_; }
  const std::vector<Index>& faces_to_refine() const { return faces_to_refine_; }
  std::size_t promoted_edges() const { return promoted_; }

private:
  /// What of a crease may be left beside the part of the patch that is kept.
  static constexpr double largest_left_turn = 5 * 3.14159265358979323846 / 180;

  /// By how much each face must be scaled.
  void measure()
  {
    for (Index f = 0; f < mesh_.faces(); ++f) {
      if (!mesh_.is_face(f)) continue;
      const double room = (std::max)(0., tolerance_ - deviation_[f]);
      const double bound = displacement_bound(shape_.net[f]);
      shape_.scale[f] = bound <= room ? 1 : room / bound * (1 - 0x1p-40);
    }
  }

  /// Makes ridges of the edges of faces that cannot be flattened; returns their number.
  std::size_t promote()
  {
    std::size_t number = 0;
    for (Index e = 0; e < mesh_.edges(); ++e) {
      const auto [one, other] = mesh_.places[e];
      if (mesh_.is_feature[e] || other == none) continue;
      const double turn = angle_between(flat_normal(one / 3), flat_normal(other / 3));
      if ((std::max)(loss(one / 3), loss(other / 3)) * turn <= largest_left_turn) continue;
      mesh_.is_feature[e] = true;
      ++number;
    }
    promoted_ += number;
    return number;
  }

  /// The part of the patch that is given up.
  double loss(Index f) const { return shape_.is_refused[f] ? 1 : 1 - shape_.scale[f]; }

  Vector flat_normal(Index f) const
  {
    return unit_normal(mesh_.position(f, 0), mesh_.position(f, 1), mesh_.position(f, 2));
  }

  /// Edges by the least scale of their faces, the interior by the face's own: continuous, and no
  /// control point is scaled by more than its face demands.
  void flatten()
  {
    for (Index f = 0; f < mesh_.faces(); ++f) {
      if (!mesh_.is_face(f)) continue;
      auto& net = shape_.net[f].displacement;
      for (int i = 0; i < 3; ++i) {
        const Index place = mesh_.neighbour[f][i];
        const double other = place == none ? 1 : shape_.scale[place / 3];
        const double least = (std::min)(shape_.scale[f], other);
        for (int k = 0; k < 3; ++k) net.col(Control_net::edge_column(i, k)) *= least;
        for (int k = 0; k < 2; ++k) net.col(Control_net::gregory_column(i, k)) *= shape_.scale[f];
      }
    }
  }

  Flat_mesh& mesh_;
  const std::vector<double>& deviation_;
  double tolerance_;
  Support_shape shape_;
  std::vector<Index> faces_to_refine_;
  std::size_t promoted_ = 0;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_FITTING_H
