// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is known of the curvature of a surface: once a side of every vertex, and along the curves of
// features.
#ifndef SURETY_CURVATURE_FIELD_H
#define SURETY_CURVATURE_FIELD_H

#include <surety/features.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace surety {

/// The shape of a surface near a point, from the signs of its principal curvatures.
enum class Point_type {
  planar,    ///< both vanish
  parabolic, ///< one vanishes: cylinders, cones, and curves on most surfaces
  elliptic,  ///< of one sign: convex or concave
  hyperbolic ///< of opposite signs: saddles
};

/// From which local fit of the surface a curvature comes, the richer ones first.
enum class Curvature_fit {
  quartic,            ///< all terms up to order four
  cubic,              ///< up to order three
  quadratic,          ///< up to order two, linear terms included
  underdetermined,    ///< up to order two, least curvature where the samples leave a choice
  three_coefficients, ///< second order alone, with the normal taken from the faces
  none                ///< too few samples: taken for planar
};

/// \brief Second-order shape of a surface at one side of a vertex.
///
/// Curvatures are in 1/length, derivatives in 1/length^2. They are positive where the surface bends
/// towards its normal: a sphere whose faces are oriented outwards has curvature -1/radius. The
/// directions and the normal are of unit length and orthogonal to each other.
struct Side_curvature {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();        ///< of unit length
  Eigen::Vector3d min_direction = Eigen::Vector3d::Zero(); ///< that of `min_curvature`
  Eigen::Vector3d max_direction = Eigen::Vector3d::Zero(); ///< that of `max_curvature`
  double min_curvature = 0;                                ///< the smaller one, with its sign
  double max_curvature = 0;                                ///< the larger one, with its sign
  double min_derivative = 0;                               ///< of min_curvature along min_direction
  double max_derivative = 0;                               ///< of max_curvature along max_direction
  double min_cross_derivative = 0;                         ///< of min_curvature along max_direction
  double max_cross_derivative = 0;                         ///< of max_curvature along min_direction
  double standard_deviation = 0;        ///< of the curvatures, as the residuals of the fit tell it
  Point_type type = Point_type::planar; ///< what the surface is like there
  Curvature_fit fit = Curvature_fit::none; ///< how it was found

  /// Half the sum of the principal curvatures.
  double mean_curvature() const { return (min_curvature + max_curvature) / 2; }
  /// Their product.
  double gaussian_curvature() const { return min_curvature * max_curvature; }
};

/// A curve of features where it passes a vertex; both members vanish at corners and off features.
struct Curve_curvature {
  Eigen::Vector3d tangent = Eigen::Vector3d::Zero(); ///< of unit length
  double curvature = 0;                              ///< of the space curve, not negative
};

/// The curvature of a surface, one entry a side and one a vertex.
struct Curvature_field {
  Sides sides;                        ///< that the values belong to
  std::vector<Side_curvature> side;   ///< by side
  std::vector<Curve_curvature> curve; ///< by vertex
  std::size_t fallbacks = 0;          ///< sides with a poorer fit than the method asks for
};

} // namespace surety

#endif // SURETY_CURVATURE_FIELD_H
