// SPDX-License-Identifier: GPL-3.0-or-later
//
// The normal at the middle of an edge, one order better than the mean of the normals at its ends:
// from a cubic height over the two faces, with the heights and slopes of their four vertices.
//
// With x along the edge from -1/2 to 1/2 (its length is the unit) and y across, the height is
//   F(x) + y (a + b x + c x^2) + y^2 (d + e x) + g y^3,
// F and b from the ends, and a = (mean slope f_y of the ends) - c/4: the mean errs by the change
// across the edge of the curvature along it. c, d, e, g solve six equations, a height and two
// slopes at each opposite vertex, by least squares.
#ifndef SURETY_INTERNAL_SUPPORT_MIDDLE_NORMAL_H
#define SURETY_INTERNAL_SUPPORT_MIDDLE_NORMAL_H

#include <surety/internal/linear.h>

#include <Eigen/Core>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>

namespace surety::internal {

/// A vertex seen from the middle of an edge.
struct Seen_vertex {
  Vector offset;
  Vector normal;
};

class Middle_normal
{
public:
  Middle_normal(const Seen_vertex& start, const Seen_vertex& end)
    : length_((end.offset - start.offset).norm()),
      x_((end.offset - start.offset) / length_),
      y_(unit((start.normal + end.normal).cross(x_))),
      z_(x_.cross(y_)),
      slope_{slope(start.normal), slope(end.normal)}
  {}

  /// The normal, or zero where the four vertices do not determine it: a thin face, or normals too
  /// far apart for heights.
  Vector with(const Seen_vertex& left, const Seen_vertex& right) const
  {
    Eigen::Matrix<double, 6, 4> matrix;
    Eigen::Matrix<double, 6, 1> residual;
    const bool is_determined
        = !is_steep_ && add_rows<0>(left, matrix, residual) && add_rows<3>(right, matrix, residual);
    if (!is_determined) return Vector::Zero();
    const double c = matrix.householderQr().solve(residual)[0];
    const double turn = (std::max)(
        {std::abs(slope_[0][0] - slope_[1][0]), std::abs(slope_[0][1] - slope_[1][1])});
    // On a smooth surface c falls faster than the turn; where it does not, it is noise.
    const double correction = std::clamp(c / 4, -turn / 2, turn / 2);
    const double across = (slope_[0][1] + slope_[1][1]) / 2 - correction;
    const double along = -(slope_[0][0] + slope_[1][0]) / 4; // F'(0)
    return unit(z_ - along * x_ - across * y_);
  }

private:
  static constexpr double least_cosine = 0.5;  // between normals
  static constexpr double least_height = 0.15; // of a face, over the edge's length

  /// The slopes f_x, f_y of a plane with this normal.
  Eigen::Vector2d slope(const Vector& normal)
  {
    const double z = normal.dot(z_);
    if (!(z > least_cosine)) {
      is_steep_ = true;
      return {0, 0};
    }
    return {-normal.dot(x_) / z, -normal.dot(y_) / z};
  }

  template <int row>
  bool add_rows(
      const Seen_vertex& vertex, Eigen::Matrix<double, 6, 4>& matrix,
      Eigen::Matrix<double, 6, 1>& residual) const
  {
    const double nz = vertex.normal.dot(z_);
    const double x = vertex.offset.dot(x_) / length_, y = vertex.offset.dot(y_) / length_;
    if (!(nz > least_cosine) || !(std::abs(y) > least_height)) return false;
    const double fx = -vertex.normal.dot(x_) / nz, fy = -vertex.normal.dot(y_) / nz;
    const double f = vertex.offset.dot(z_) / length_;
    const double p0 = slope_[0][0], p1 = slope_[1][0], t = x + 0.5;
    const double mean = (slope_[0][1] + slope_[1][1]) / 2, b = slope_[1][1] - slope_[0][1];
    const double along = p0 * t * (1 - t) * (1 - t) - p1 * t * t * (1 - t);
    const double along_x = p0 * (1 - t) * (1 - 3 * t) - p1 * t * (2 - 3 * t);
    const double bubble = x * x - 0.25;
    matrix.row(row) << y * bubble, y * y, x * y * y, y * y * y;
    matrix.row(row + 1) << 2 * x * y, 0, y * y, 0;
    matrix.row(row + 2) << bubble, 2 * y, 2 * x * y, 3 * y * y;
    residual[row] = f - along - y * (mean + b * x);
    residual[row + 1] = fx - along_x - y * b;
    residual[row + 2] = fy - mean - b * x;
    return true;
  }

  double length_;
  bool is_steep_ = false; // an end's normal is too far from the mean
  Vector x_, y_, z_;
  std::array<Eigen::Vector2d, 2> slope_; // at start and end
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_SUPPORT_MIDDLE_NORMAL_H
