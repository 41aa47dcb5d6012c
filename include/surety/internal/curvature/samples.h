// SPDX-License-Identifier: GPL-3.0-or-later
//
// The samples of a neighbourhood in the frame of its centre.
#ifndef SURETY_INTERNAL_CURVATURE_SAMPLES_H
#define SURETY_INTERNAL_CURVATURE_SAMPLES_H

#include <surety/internal/curvature/jet.h>
#include <surety/internal/curvature/neighbourhood.h>

#include <array>
#include <cmath>
#include <limits>

namespace surety::internal::curvature {

using Quartic_system = Least_squares<Jet::quartic, 16>;
using Quadratic_system = Least_squares<Jet::quadratic, 8>;

/// \brief The frame of a side: a normal, and the longest edge for the first axis, so that it turns
/// with the surface and does not depend on numbering.
///
/// The unit is the mean length of the edges, zero if all have none.
inline Frame make_frame(const Side_graph& graph, Index side, const Vector& normal)
{
  Frame frame;
  frame.origin = graph.point_of(side);
  frame.normal = normal;
  frame.unit = 0;
  double longest = 0;
  for (Index i = graph.first[side]; i < graph.first[side + 1]; ++i) {
    const Vector d = graph.point_of(graph.neighbour[i]) - frame.origin;
    frame.unit += d.norm() / graph.degree(side);
    const Vector tangent = d - d.dot(normal) * normal;
    if (tangent.squaredNorm() <= longest) continue;
    longest = tangent.squaredNorm();
    frame.first = tangent;
  }
  frame.first = unit(longest > 0 ? frame.first : normal.unitOrthogonal());
  frame.second = normal.cross(frame.first);
  return frame;
}

/// The rounding of a coordinate of the centre, in the unit of the frame: heights below it are none.
inline double rounding(const Frame& frame)
{
  return std::numeric_limits<double>::epsilon() * frame.origin.cwiseAbs().maxCoeff() / frame.unit;
}

/// Monomials, height and one of each sample: the rows of the systems of equations.
class Samples
{
public:
  using Row = Quartic_system::Row;

  void read(const Side_graph& graph, const std::vector<Index>& sides, const Frame& frame)
  {
    number_ = static_cast<int>(sides.size());
    largest_height_ = 0;
    for (int i = 0; i < number_; ++i) {
      const Vector local = frame.to_local(graph.point_of(sides[std::size_t(i)]));
      Row& row = rows_[std::size_t(i)];
      write_quartic(local.x(), local.y(), row.data());
      row[Quartic_system::heights] = local.z();
      row[Quartic_system::ones] = 1;
      // The square of 1/d^2, where no sample, however near, outweighs all others.
      const double square = (std::max)(local.squaredNorm(), smallest_square_distance);
      weight_[std::size_t(i)] = 1 / square;
      largest_height_ = (std::max)(largest_height_, std::abs(local.z()));
    }
  }

  int size() const { return number_; }
  const Row& row(int i) const { return rows_[std::size_t(i)]; }
  double weight(int i) const { return weight_[std::size_t(i)]; }
  double height(int i) const { return rows_[std::size_t(i)][Quartic_system::heights]; }
  double largest_height() const { return largest_height_; }

  /// The largest over the smallest principal moment of the samples about the centre.
  double elongation() const
  {
    double xx = 0, xy = 0, yy = 0;
    for (int i = 0; i < number_; ++i) {
      xx += rows_[std::size_t(i)][2];
      xy += rows_[std::size_t(i)][3];
      yy += rows_[std::size_t(i)][4];
    }
    const double mean = (xx + yy) / 2, radius = std::hypot((xx - yy) / 2, xy);
    return (mean + radius) / (std::max)(mean - radius, std::numeric_limits<double>::min());
  }

private:
  static constexpr double smallest_square_distance = 1e-3;

  alignas(32) std::array<Row, maximum_samples> rows_;
  std::array<double, maximum_samples> weight_;
  int number_ = 0;
  double largest_height_ = 0;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_SAMPLES_H
