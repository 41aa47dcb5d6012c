// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a computed distance may lie below the true one, and what follows for comparisons with the
// tolerance.
//
// Let u = 2^-53 and C the largest absolute coordinate. All coordinates below are at most C, all
// differences at most 2C, each of lambda, mu, v, w lies in [0, 1], and every + - * is exact up to a
// factor 1 + e, |e| <= u.
//   x(lambda) = a + lambda (b - a):  the difference errs by 2Cu, the product by another 2Cu (and
//     carries the 2Cu), the sum by at most 3Cu: 7Cu a coordinate with second-order terms.
//   q + mu (r - q), for the point of a segment: again 7Cu. It lies on the segment exactly, since
//     mu is a stored double in [0, 1].
//   a + v ab + w ac, for the point of a triangle: the differences 2Cu each, the products 2Cu each,
//     two sums of 3Cu and 5Cu: 16Cu. The weights v = b/s and w = c/s come from s = a + b + c with
//     a, b, c >= 0, so that v + w <= 1 + 4u: the point may lie outside by 4u times an edge, 8Cu a
//     coordinate.
// Together at most 7 + 24 = 31, hence 32Cu a coordinate and 32 sqrt(3) Cu < 56Cu in length. The
// difference of the two points, its square, sum and root add a relative error below 8u. An upper
// bound of the distance of the exact x to the *element* follows, wherever on the element the
// computed point is: a wrong choice of the nearest feature costs tightness and never soundness.
//
// Underflow and overflow: T is scaled by a power of two so that C is about 1 (exchange.h). Squares
// below 2^-1022 lose absolutely at most 2^-1070, which the absolute term covers many times over.
#ifndef SURETY_INTERNAL_DEVIATION_ROUNDING_H
#define SURETY_INTERNAL_DEVIATION_ROUNDING_H

#include <cmath>

namespace surety::internal {

constexpr double unit_roundoff = 0x1p-53;

class Rounding
{
public:
  explicit Rounding(double largest_coordinate) : absolute_(64 * unit_roundoff * largest_coordinate)
  {}

  /// An upper bound of the true distance, from the square of the computed one.
  double upper_bound(double squared_distance) const
  {
    return std::sqrt(squared_distance) * (1 + 0x1p-48) + absolute_;
  }

  /// A squared distance computed as at most this is at most `tolerance` in truth. Negative where
  /// rounding alone exceeds the tolerance, so that not even a distance of zero will do.
  /// The reserve of 2^-20 keeps independent verifiers, which round too, away from ties.
  double squared_limit(double tolerance) const
  {
    const double limit = tolerance * (1 - 0x1p-20) - 2 * absolute_;
    return limit > 0 ? limit * limit * (1 - 0x1p-48) : -1;
  }

private:
  double absolute_;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_DEVIATION_ROUNDING_H
