// SPDX-License-Identifier: GPL-3.0-or-later
//
// Closest points in double precision. Every function constructs a point of the element and measures
// to it, so that an inexact decision yields a larger distance and never too small a one (rounding.h
// bounds the rest).
#ifndef SURETY_INTERNAL_DEVIATION_CLOSEST_POINT_H
#define SURETY_INTERNAL_DEVIATION_CLOSEST_POINT_H

#include <surety/internal/linear.h>

#include <algorithm>

namespace surety::internal {

/// Squared distance of p to the segment from a along ab.
inline double squared_distance_to_segment(const Vector& p, const Vector& a, const Vector& ab)
{
  const Vector ap = p - a;
  const double length = ab.squaredNorm();
  const double mu = length > 0 ? std::clamp(ap.dot(ab) / length, 0.0, 1.0) : 0.0;
  return (ap - mu * ab).squaredNorm();
}

/// The point a + v ab + w ac of a triangle, v, w >= 0, v + w <= 1.
struct Triangle_weights {
  double v, w;
};

/// The closest point of the triangle a, a + ab, a + ac to p, by the Voronoi region of p (Ericson,
/// Real-Time Collision Detection, section 5.1.5).
inline Triangle_weights closest_weights(
    const Vector& p, const Vector& a, const Vector& ab, const Vector& ac)
{
  const Vector ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {0, 0};

  const Vector bp = ap - ab;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {d1 / (d1 - d3), 0};

  const Vector cp = ap - ac;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {0, d2 / (d2 - d6)};

  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1 - w, w};
  }
  const double scale = 1 / (va + vb + vc);
  const double v = vb * scale;
  return {v, std::min(vc * scale, 1 - v)};
}

/// Squared distance of p to the triangle a, a + ab, a + ac.
inline double squared_distance_to_triangle(
    const Vector& p, const Vector& a, const Vector& ab, const Vector& ac)
{
  const auto [v, w] = closest_weights(p, a, ab, ac);
  return (p - a - v * ab - w * ac).squaredNorm();
}

/// The parameter in [low, high] of the point of a + lambda d closest to the segment from q along e
/// (same book, section 5.1.9; parallel segments take the middle of what they share).
inline double closest_parameter(
    const Vector& a, const Vector& d, double low, double high, const Vector& q, const Vector& e)
{
  const Vector r = a - q;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e);
  const double dr = d.dot(r), er = e.dot(r);
  const double determinant = dd * ee - de * de;
  if (!(dd > 0) || !(ee > 0)) return low;
  double lambda
      = determinant > 1e-14 * dd * ee ? (de * er - dr * ee) / determinant : (low + high) / 2;
  lambda = std::clamp(lambda, low, high);
  const double mu = std::clamp((de * lambda + er) / ee, 0.0, 1.0);
  return std::clamp((de * mu - dr) / dd, low, high);
}

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_CLOSEST_POINT_H
