// SPDX-License-Identifier: GPL-3.0-or-later
//
// The control net of one patch: a quartic triangle with Gregory points (D. J. Walton and D. S.
// Meek, A triangular G1 patch from boundary curves, 1996). Along an edge the cross derivative of
// both faces is a combination of the same two fields, the derivative W of the curve and a field A
// that depends on the curve and on the normals at its ends only: so the patches share tangent
// planes.
#ifndef SURETY_INTERNAL_SUPPORT_CONTROL_NET_H
#define SURETY_INTERNAL_SUPPORT_CONTROL_NET_H

#include <surety/internal/support/edge_curve.h>
#include <surety/internal/support/flat_mesh.h>

#include <Eigen/Core>

#include <array>

namespace surety::internal {

/// \brief The control points of a patch minus the same points of its flat triangle.
///
/// A point of the patch is the point of the triangle plus the weighted sum of the columns: three a
/// corner i for its edge i (the quartic's inner points), then two for the Gregory points near the
/// two ends of edge i.
struct Control_net {
  Eigen::Matrix<double, 3, 15> displacement = Eigen::Matrix<double, 3, 15>::Zero();

  static constexpr int edge_column(int i, int k) { return 3 * i + k; }        // k = 0, 1, 2
  static constexpr int gregory_column(int i, int k) { return 9 + 2 * i + k; } // k = 0, 1

  auto edge_point(int i, int k) const { return displacement.col(edge_column(i, k)); }
  auto gregory_point(int i, int k) const { return displacement.col(gregory_column(i, k)); }
};

/// What a net is made of.
struct Patch_data {
  std::array<Vector, 3> chord;     ///< of edge i
  std::array<Vector, 3> normal;    ///< at corner i
  std::array<Edge_curve, 3> curve; ///< of edge i, in the face's direction
};

/// The arms of the curve of edge i; of a straight one, thirds of its chord.
struct Arms {
  Arms(const Patch_data& data, int i)
    : start(data.curve[i].is_straight ? data.chord[i] / 3 : data.curve[i].start),
      end(data.curve[i].is_straight ? data.chord[i] / 3 : data.curve[i].end)
  {}
  Vector start, end;
};

/// The inner two of the four Bezier points of the cross derivative along edge i, given the outer.
inline std::array<Vector, 2> inner_cross_derivatives(
    const Patch_data& data, int i, const Arms& arms, const Vector& d0, const Vector& d3)
{
  if (data.curve[i].is_straight) return {(2 * d0 + d3) / 3, (d0 + 2 * d3) / 3};
  const Vector &w0 = arms.start, &w2 = arms.end;
  const Vector w1 = data.chord[i] - w0 - w2;
  const Vector a0 = unit(data.normal[i].cross(w0)),
               a2 = unit(data.normal[next_corner(i)].cross(w2));
  // In the middle A is (a0 + 2 a1 + a2)/4; it is made perpendicular to the normal there.
  Vector a1 = unit(a0 + a2);
  const Vector& m = data.curve[i].middle_normal;
  a1 -= (a0 + 2 * a1 + a2).dot(m) / 2 * m;
  const double lambda0 = d0.dot(w0) / w0.squaredNorm(), lambda1 = d3.dot(w2) / w2.squaredNorm();
  const double mu0 = d0.dot(a0), mu1 = d3.dot(a2);
  return {
      (2 * lambda0 * w1 + lambda1 * w0 + 2 * mu0 * a1 + mu1 * a0) / 3,
      (lambda0 * w2 + 2 * lambda1 * w1 + mu0 * a2 + 2 * mu1 * a1) / 3};
}

inline Control_net make_net(const Patch_data& data)
{
  const std::array<Arms, 3> arms = {Arms(data, 0), Arms(data, 1), Arms(data, 2)};
  Control_net net;
  bool is_flat = true;
  for (int i = 0; i < 3; ++i) {
    const auto points = data.curve[i].displacements(data.chord[i]);
    for (int k = 0; k < 3; ++k) net.displacement.col(Control_net::edge_column(i, k)) = points[k];
    is_flat = is_flat && data.curve[i].is_straight;
  }
  if (is_flat) return net;
  for (int i = 0; i < 3; ++i) {
    const int j = next_corner(i), p = previous_corner(i);
    const Vector &chord = data.chord[i], &w0 = arms[i].start, &w2 = arms[i].end;
    // As seen from the ends of the edge.
    const Vector d0 = -0.75 * arms[p].end - 0.375 * w0, d3 = 0.75 * arms[j].start + 0.375 * w2;
    const auto [d1, d2] = inner_cross_derivatives(data, i, arms[i], d0, d3);
    const Vector middle = (w0 - w2) / 2;
    const Vector from_start = (0.75 * w0 + chord / 2 + middle) / 2 + d1;
    const Vector from_end = (middle - chord / 2 - 0.75 * w2) / 2 + d2;
    net.displacement.col(Control_net::gregory_column(i, 0))
        = from_start - (chord - data.chord[p]) / 4;
    net.displacement.col(Control_net::gregory_column(i, 1))
        = from_end - (data.chord[j] - chord) / 4;
  }
  return net;
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_CONTROL_NET_H
