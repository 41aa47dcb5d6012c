// SPDX-License-Identifier: GPL-3.0-or-later
//
// From curvatures to sizes (section 3.3 of the paper): how long the edges of a triangle may be for
// the triangle to lie within a gap of the surface.
//
// Near a point the surface is z = (k1 x^2 + k2 y^2) / 2. In coordinates X = x / h1, Y = y / h2 an
// equilateral triangle of side 1 has the gap c(s) k1 h1^2 with s = k2 h2^2 / (k1 h1^2), whatever
// its orientation. On a cylinder or a saddle (s <= 0) an edge is farthest: c = 1/8, the chord's. On
// a sphere (s = 1) the centre is: c = 1/6. Between, 1/8 + max(0, (s - 0.4) / 0.6) / 24 is a
// majorant.
#ifndef SURETY_INTERNAL_METRIC_SIZES_H
#define SURETY_INTERNAL_METRIC_SIZES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace surety::internal::metric {

/// c(s): the gap of an equilateral triangle with sides of length 1, for unit curvature.
inline double triangle_gap_constant(double s)
{
  return 1. / 8 + (std::min)(1., (std::max)(0., (s - 0.4) / 0.6)) / 24;
}

/// \brief The sizes that follow from the curvature along a direction, and from nothing else.
///
/// What is absent does not count; of what is present the least size does.
struct Size_law {
  std::optional<double> tolerance;     ///< absolute gap
  std::optional<double> relative_gap;  ///< in units of the radius of curvature
  std::optional<double> turning_angle; ///< of the normal, in radians
  std::optional<double> gap_constant;  ///< in place of c(s)

  /// \brief The length of an edge where the surface has the curvature k >= 0; infinite on a plane.
  ///
  /// A chord of sagitta eps rho on a circle of radius rho measures 2 rho sqrt(eps (2 - eps)); one
  /// absolute gap for both directions is eps = tolerance / rho in each, at most 1. A face's gap is
  /// 8 c times that of its chord.
  double size(double k, double s) const
  {
    double result = std::numeric_limits<double>::infinity();
    if (!(k > 0)) return result;
    const double chord = std::sqrt(0.125 / gap_constant.value_or(triangle_gap_constant(s)));
    const auto with_gap
        = [&](double gap) { return chord * 2 * std::sqrt((gap / k) * (2 - gap * k)); };
    if (tolerance) result = (std::min)(result, with_gap((std::min)(*tolerance, 1 / k)));
    if (relative_gap) result = (std::min)(result, with_gap(*relative_gap / k));
    if (turning_angle) result = (std::min)(result, 2 / k * std::sin(*turning_angle / 2));
    return result;
  }

  /// The length of an edge on a curve of features, with its ends on it. It has no inside that
  /// could make up for what the chord cuts off, so that no smaller constant than a chord's will do.
  double size_on_curve(double k) const
  {
    constexpr double chord = 1. / 8;
    Size_law law = *this;
    law.gap_constant = (std::max)(chord, gap_constant.value_or(chord));
    return law.size(k, 0);
  }
};

/// The range of sizes, and of the ratio between the two sizes at one place.
struct Size_range {
  double minimum;
  double maximum;
  double aspect_ratio;

  double clamp(double size) const { return std::clamp(size, minimum, maximum); }
};

/// \brief The principal curvatures of a side, in the order of their magnitude, and how fast they
/// grow. None is negative.
struct Curvature_and_growth {
  double larger;
  double smaller;
  bool is_elliptic;            ///< both of one sign
  double larger_along_its_own; ///< derivative of the larger along its own direction
  double larger_across;        ///< and along the other's
  double smaller_along_its_own;
  double smaller_across;
};

/// The curvature at a distance.
inline double ahead(double k, double growth, double distance)
{
  return growth > 0 ? k + growth * distance : k;
}

/// s of the file's comment, with 0 for a saddle.
inline double shape_ratio_of_sizes(const Curvature_and_growth& c, double h1, double h2)
{
  const double first = c.larger * h1 * h1, second = c.smaller * h2 * h2;
  return c.is_elliptic && first > 0 ? (std::min)(1., second / first) : 0;
}

/// \brief The largest s within reach, given both terms k h^2 ahead and the smaller one's here.
///
/// Where the smaller curvature changes its sign the surface is elliptic on one hand: what it has
/// grown to beyond zero counts.
inline double shape_ratio_ahead(
    const Curvature_and_growth& c, double first, double second, double second_here)
{
  if (!c.is_elliptic) second -= 2 * second_here;
  return first > 0 ? std::clamp(second / first, 0., 1.) : 0;
}

/// Sizes are fixed points, since curvature counts where the edge ends. In each step the logarithm
/// of an error shrinks at least fourfold under a tolerance and vanishes to first order under the
/// other laws, so that this number of steps leaves nothing to double precision.
constexpr int fixed_point_steps = 24;

/// \brief The sizes along the directions of the larger and of the smaller curvature.
///
/// A metric of second order is blind where a curvature vanishes on a line only, as on top of a
/// torus: there the curvature within the triangle decides. An edge from here leads to distance h1
/// in one direction, and the mean of the curvature along itself is that half-way.
inline std::array<double, 2> principal_sizes(
    const Curvature_and_growth& c, const Size_law& law, const Size_range& range)
{
  double h1 = range.clamp(law.size(c.larger, 0));
  double h2 = range.clamp(law.size(c.smaller, 0));
  for (int step = 0; step < fixed_point_steps; ++step) {
    const double k1 = ahead(c.larger, c.larger_along_its_own, h1 / 2);
    const double k2
        = ahead(ahead(c.smaller, c.smaller_along_its_own, h2 / 2), c.smaller_across, h1);
    const double s = shape_ratio_ahead(c, k1 * h1 * h1, k2 * h2 * h2, c.smaller * h2 * h2);
    h1 = std::sqrt(h1 * range.clamp(law.size(k1, s)));
    const double next_2 = range.clamp(law.size(k2, s));
    h2 = (std::min)(std::sqrt(h2 * next_2), range.aspect_ratio * h1);
  }
  return {h1, h2};
}

/// The size for all directions.
inline double isotropic_size(
    const Curvature_and_growth& c, const Size_law& law, const Size_range& range)
{
  const double s = shape_ratio_of_sizes(c, 1, 1);
  const double growth = (std::max)(c.larger_along_its_own, c.larger_across);
  double h = range.clamp(law.size(c.larger, s));
  for (int step = 0; step < fixed_point_steps; ++step) {
    const double next = range.clamp(law.size(ahead(c.larger, growth, h / 2), s));
    h = std::sqrt(h * next);
  }
  return h;
}

} // namespace surety::internal::metric

#endif // SURETY_INTERNAL_METRIC_SIZES_H
