// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curvature of one side: by the method that is asked for, or by what the samples allow.
#ifndef SURETY_INTERNAL_CURVATURE_ESTIMATOR_H
#define SURETY_INTERNAL_CURVATURE_ESTIMATOR_H

#include <surety/curvature_field.h>
#include <surety/internal/curvature/adaptive_fit.h>
#include <surety/internal/curvature/fixed_fits.h>
#include <surety/internal/curvature/shifted.h>
#include <surety/parameters.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace surety::internal::curvature {

/// The kind of a point. Curvatures that their deviation or the turn of the surface along an edge
/// makes insignificant count as zero; so does one that is small next to the other.
inline Point_type classify(double smaller, double larger, double deviation, double edge)
{
  constexpr double least_turn = 1e-5;      // along an edge, in radians
  constexpr double parabolic_ratio = 0.01; // of the curvatures
  const double certain = (std::max)(2 * deviation, least_turn / edge);
  const double greatest = (std::max)(std::abs(smaller), std::abs(larger));
  const double least = (std::min)(std::abs(smaller), std::abs(larger));
  if (greatest <= certain) return Point_type::planar;
  if (least <= (std::max)(2 * deviation, parabolic_ratio * greatest)) return Point_type::parabolic;
  return (smaller > 0) == (larger > 0) ? Point_type::elliptic : Point_type::hyperbolic;
}

/// \brief Estimates the curvature of sides, one after the other, in buffers of its own.
class Side_estimator
{
public:
  Side_estimator(const Side_graph& graph, Curvature_method method, double noise_floor)
    : graph_(graph),
      method_(method),
      noise_floor_(std::ldexp(noise_floor, -graph.exponent)),
      neighbourhood_(graph),
      adaptive_(graph)
  {}

  Side_curvature operator()(Index side)
  {
    frame_ = make_frame(graph_, side, normal_of(side));
    Side_curvature result;
    result.normal = frame_.normal;
    result.min_direction = frame_.first;
    result.max_direction = frame_.second;
    if (!(frame_.unit > smallest_unit) || graph_.normal[side].isZero(0)) return result;
    auto estimate = estimate_from_inside(side);
    if (!estimate) estimate = estimate_at(side);
    if (estimate && turns_away(*estimate, side)) estimate = estimate_with_least_curvature(side);
    if (estimate) describe(*estimate, result);
    return result;
  }

  /// Whether a fit is poorer than the method asks for.
  bool is_fallback(Curvature_fit fit) const
  {
    switch (method_) {
    case Curvature_method::adaptive:
    case Curvature_method::five_coefficients:
      return fit > Curvature_fit::quadratic;
    default:
      return fit > Curvature_fit::three_coefficients;
    }
  }

private:
  /// The normal of the frame: where the faces of the side have none, that of what lies round it.
  Vector normal_of(Index side) const
  {
    if (!graph_.normal[side].isZero(0)) {
      return method_ == Curvature_method::three_coefficients
          ? side_normal(graph_, side, Normal_weights::area)
          : graph_.normal[side];
    }
    Vector sum = Vector::Zero();
    for (Index i = graph_.first[side]; i < graph_.first[side + 1]; ++i) {
      if (graph_.neighbour[i] != Sides::no_side) sum += graph_.normal[graph_.neighbour[i]];
    }
    return sum.isZero(0) ? Vector(Vector::UnitZ()) : unit(sum);
  }

  /// \brief The fit of a neighbour inside, for a side that a feature or the border bounds.
  ///
  /// One-sided samples hardly tell a term across the bound from another: on a cylinder of 24 facets
  /// such a fit at the rim misses the curvature by 38 %, this one by 3 %. Nothing if there is no
  /// such neighbour or its samples are too few; else the frame becomes that of the neighbour.
  std::optional<Estimate> estimate_from_inside(Index side)
  {
    if (method_ != Curvature_method::adaptive || graph_.is_closed[side]) return std::nullopt;
    const Index inner = inner_neighbour(graph_, side, frame_.unit);
    if (inner == Sides::no_side) return std::nullopt;
    const Frame frame = make_frame(graph_, inner, graph_.normal[inner]);
    if (!(frame.unit > smallest_unit)) return std::nullopt;
    neighbourhood_.start(inner, graph_.normal[inner]);
    auto estimate = adaptive_(neighbourhood_, frame, noise_floor_ / frame.unit);
    if (!estimate) return std::nullopt;
    const Vector at = frame.to_local(graph_.point_of(side));
    estimate->jet = shifted(estimate->jet, at.x(), at.y());
    fit_ = Curvature_fit::quadratic;
    frame_ = frame;
    return estimate;
  }

  std::optional<Estimate> estimate_at(Index side)
  {
    neighbourhood_.start(side, graph_.normal[side]);
    std::optional<Estimate> result;
    if (method_ == Curvature_method::adaptive) {
      fit_ = Curvature_fit::quadratic;
      result = adaptive_(neighbourhood_, frame_, noise_floor_ / frame_.unit);
    } else if (method_ == Curvature_method::five_coefficients) {
      while (neighbourhood_.rings() < 3 && neighbourhood_.add_ring()) {}
      read_samples();
      fit_ = Curvature_fit::quadratic;
      result = centred_quadric(samples_, areas(), quadratic_);
    }
    return result ? result : fall_back(side);
  }

  /// Samples that do not determine a quadric: wider neighbourhoods and least curvature, then the
  /// first ring and the normal of the faces.
  std::optional<Estimate> fall_back(Index side)
  {
    if (method_ != Curvature_method::three_coefficients) {
      neighbourhood_.start(side, graph_.normal[side]);
      while (neighbourhood_.rings() < 3 && neighbourhood_.add_ring()) {}
      read_samples();
      if (samples_.size() >= Jet::quadratic) {
        fit_ = Curvature_fit::quadratic;
        if (const auto estimate = five_coefficients(samples_, quadratic_)) return estimate;
        fit_ = Curvature_fit::underdetermined;
        return underdetermined_quadric(samples_);
      }
    }
    neighbourhood_.start(side, graph_.normal[side]);
    neighbourhood_.add_ring();
    read_samples();
    fit_ = Curvature_fit::three_coefficients;
    return three_coefficients(samples_);
  }

  /// Whether the fit leans away from the faces, and farther than the sides around do. On a tube of
  /// long facets, which has no vertex between its rims, the samples nearby lie on a circle, and
  /// they say nothing of the direction along the tube.
  bool turns_away(const Estimate& estimate, Index side) const
  {
    double least_cosine = 0.9;
    for (Index i = graph_.first[side]; i < graph_.first[side + 1]; ++i) {
      const Index next = graph_.neighbour[i];
      if (next != Sides::no_side)
        least_cosine = (std::min)(least_cosine, graph_.normal[next].dot(graph_.normal[side]));
    }
    const Vector normal = unit(frame_.to_world(Principal_solver(estimate.jet).normal()));
    return !(normal.dot(graph_.normal[side]) >= least_cosine);
  }

  /// What the samples do not tell is taken to be flat. Nothing if that leans away as well.
  std::optional<Estimate> estimate_with_least_curvature(Index side)
  {
    frame_ = make_frame(graph_, side, graph_.normal[side]);
    neighbourhood_.start(side, graph_.normal[side]);
    while (neighbourhood_.rings() < 2 && neighbourhood_.add_ring()) {}
    read_samples();
    fit_ = Curvature_fit::underdetermined;
    constexpr double certainty = 0.05;
    const Estimate estimate = underdetermined_quadric(samples_, certainty);
    if (turns_away(estimate, side)) return std::nullopt;
    return estimate;
  }

  /// Of the samples.
  const std::vector<double>& areas()
  {
    areas_.clear();
    for (const Index side : neighbourhood_.sides()) areas_.push_back(graph_.area[side]);
    return areas_;
  }

  void read_samples() { samples_.read(graph_, neighbourhood_.sides(), frame_); }

  void describe(const Estimate& estimate, Side_curvature& result) const
  {
    const Principal_solver solver(estimate.jet);
    const Vector normal = frame_.to_world(solver.normal());
    const Vector first = frame_.to_world(solver.smaller().direction);
    const Vector second = frame_.to_world(solver.larger().direction);
    if (!normal.allFinite() || !first.allFinite() || !second.allFinite()) return;
    result.normal = unit(normal);
    result.min_direction = unit(first - first.dot(result.normal) * result.normal);
    result.max_direction = result.normal.cross(result.min_direction);
    const double sign = second.dot(result.max_direction) < 0 ? -1 : 1;

    const double deviation = 2 * estimate.noise * std::sqrt(estimate.jet.largest_variance());
    result.min_curvature = per_length(solver.smaller().curvature, 1);
    result.max_curvature = per_length(solver.larger().curvature, 1);
    result.min_derivative = per_length(solver.smaller().derivative, 2);
    result.max_derivative = per_length(sign * solver.larger().derivative, 2);
    result.min_cross_derivative = per_length(sign * solver.smaller().cross_derivative, 2);
    result.max_cross_derivative = per_length(solver.larger().cross_derivative, 2);
    result.standard_deviation = per_length(deviation, 1);
    result.type = classify(solver.smaller().curvature, solver.larger().curvature, deviation, 1);
    result.fit = estimate.jet.terms == Jet::quartic ? Curvature_fit::quartic
        : estimate.jet.terms == Jet::cubic          ? Curvature_fit::cubic
                                                    : fit_;
  }

  /// From the unit of the frame to that of the mesh; what is too large for a double is cut off.
  double per_length(double value, int power) const
  {
    constexpr double largest = std::numeric_limits<double>::max();
    for (int i = 0; i < power; ++i) value = std::ldexp(value / frame_.unit, -graph_.exponent);
    return std::isnan(value) ? 0 : std::clamp(value, -largest, largest);
  }

  /// Edges so short in units of the extent of the mesh vanish when squared twice.
  static constexpr double smallest_unit = 1e-75;

  const Side_graph& graph_;
  const Curvature_method method_;
  const double noise_floor_;
  Neighbourhood neighbourhood_;
  Adaptive_fit adaptive_;
  Frame frame_;
  Samples samples_;
  std::vector<double> areas_;
  Quadratic_system quadratic_;
  Curvature_fit fit_ = Curvature_fit::none;
};

} // namespace surety::internal::curvature

#endif // SURETY_INTERNAL_CURVATURE_ESTIMATOR_H
