// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the apex of a closed fan should lie so that T stays near the fan. It looks at samples of T:
// the vertices that map to the disc, the points of the crossings of its old spokes, and the point
// of T next to the apex itself. It proposes; the deviation policy decides.
//
// With x a sample, y(w) its closest point on the fan about w, r = x - y, d = |r|, n = r/d and u the
// weight of the apex in y, a step dw changes d by -u <n, dw> to first order. Least squares with
// weights (d/tolerance)^6 then lowers the sum of (d/tolerance)^8, a smooth stand-in for the largest
// distance; with weights (d/d_max)^8, the largest distance itself.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_FAN_OPTIMIZER_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_FAN_OPTIMIZER_H

#include <surety/internal/deviation/direct_bound.h>
#include <surety/internal/geometric_mesh/surface_walk.h>

#include <Eigen/Cholesky>

#include <vector>

namespace surety::internal {

enum class Objective { sum, largest };

class Fan_optimizer
{
public:
  Fan_optimizer(
      const Reference& reference, const Working_mesh& mesh, const Direct_bound& bound,
      bool on_surface)
    : reference_(reference), mesh_(mesh), bound_(bound), walk_(reference), on_surface_(on_surface)
  {}

  /// Collects the samples of a closed disc.
  void look_at(const Disc& disc)
  {
    disc_ = &disc;
    samples_.clear();
    const Map& map = bound_.map();
    if (disc.keeps_pin)
      add_vertex(map.pin(disc.apex), Kind::pin, 0);
    else if (map.pin(disc.apex) != none)
      add_vertex(map.pin(disc.apex), Kind::face, 0);
    for (int k = 0; k < 2 && disc.ridge[k] != none; ++k)
      for (const Index old : disc.old_ridge[k]) {
        if (old == none) continue;
        map.for_each_vertex_on_edge(
            old, [&](Index v) { add_vertex(v, Kind::spoke, disc.ridge[k]); });
        if (disc.removed != none && old == mesh_.edge(disc.halfedge))
          add_vertex(map.pin(disc.removed), Kind::spoke, disc.ridge[k]);
      }
    if (disc.removed != none && disc.ridge[0] == none && map.pin(disc.removed) != none)
      add_vertex(map.pin(disc.removed), Kind::face, 0);
    for (Index i = 0; i < disc.old_face.size(); ++i)
      if (!mesh_.is_ghost_face(disc.old_face[i]))
        map.for_each_vertex_on_face(
            disc.old_face[i], [&](Index v) { add_vertex(v, Kind::face, disc.old_place[i]); });
    for (Index i = 0; i < disc.old_spoke.size(); ++i)
      map.for_each_node_on_m(
          disc.old_spoke[i], [&](Index n) { add_node(n, disc.old_spoke_place[i]); });
    for (Sample& sample : samples_)
      if (sample.kind == Kind::face) sample.face = nearest_face(sample, disc.apex_point);
    start_face_ = walk_.face_at(disc.anchor);
  }

  bool has_samples() const { return !samples_.empty(); }

  /// The objective with the apex at a point: a ratio to the tolerance, squared, or a sum of eighth
  /// powers of ratios.
  double evaluate(const Vector& w, Objective objective)
  {
    Vector place = w;
    Foot foot;
    return evaluate(place, foot, objective);
  }

  /// Puts the apex of the disc to a better place, starting from a given one; tells the objective.
  /// What comes too slowly to a goal is given up.
  double optimize(
      Disc& disc, const Vector& start, Objective objective,
      double goal = std::numeric_limits<double>::infinity())
  {
    Vector best = start;
    Foot best_foot;
    double least = evaluate(best, best_foot, objective);
    Vector step = newton_step(best_foot);
    double factor = objective == Objective::sum ? 2.0 / 7 : 1.0;
    for (int evaluations = 1; factor >= smallest_factor && evaluations < most_evaluations;
         ++evaluations) {
      Vector next = best + factor * step;
      Foot foot = best_foot;
      const double value = evaluate(next, foot, objective, least);
      if (!(value < least)) {
        factor /= 2;
        continue;
      }
      const bool settled = value > (value > goal ? 0.9 : 0.995) * least;
      best = next, best_foot = foot, least = value;
      if (settled) break;
      step = newton_step(best_foot);
      factor = std::min(1.0, 1.7 * factor);
    }
    disc.apex_point = best;
    disc.anchor = best_foot.nearest;
    return least;
  }

private:
  static constexpr double smallest_factor = 0.02, apex_share = 0.05, regularisation = 1e-4;
  static constexpr int most_evaluations = 24;

  /// What a sample maps to: a face on its side of the ridge, a ridge spoke, or the apex.
  enum class Kind { face, spoke, pin };

  struct Sample {
    Vector point;
    double inverse_limit; ///< 1 / squared tolerance
    Kind kind;
    Disc::Side side;
    Index face; ///< of the fan, where its closest point was last; or the spoke
    Vector residual;
    double apex_weight, ratio;
  };

  void add(const Vector& point, double squared_limit, Kind kind, Index place)
  {
    samples_.push_back(
        {point, 1 / squared_limit, kind, disc_->side_of_place(place), place, Vector::Zero(), 0, 0});
  }
  void add_vertex(Index v, Kind kind, Index place)
  {
    const Tolerance& tolerance = bound_.tolerance();
    const double limit
        = kind == Kind::face ? tolerance.squared_limit(v) : tolerance.squared_limit_on_curve(v);
    add(reference_.point(v), limit, kind, place);
  }
  void add_node(Index n, Index place)
  {
    const Node& node = bound_.map().node(n);
    const auto [s, t] = reference_.vertices_of_edge(node.t_edge);
    const Vector& a = reference_.point(s);
    add(a + node.lambda * (reference_.point(t) - a),
        bound_.tolerance().squared_limit(s, t, node.lambda), Kind::face, place);
  }

  Index nearest_face(const Sample& sample, const Vector& w) const
  {
    double least = std::numeric_limits<double>::infinity();
    Index nearest = sample.side.low, i = sample.side.low;
    Vector ab = mesh_.point(disc_->ring[i]) - w;
    for (Index left = sample.side.count; left > 0; --left) {
      const Index next = disc_->after(i);
      const Vector ac = mesh_.point(disc_->ring[next]) - w;
      const double squared = squared_distance_to_triangle(sample.point, w, ab, ac);
      if (squared < least) least = squared, nearest = i;
      ab = ac;
      i = next;
    }
    return nearest;
  }

  /// Ends early, with any value that is not less, where the objective is not less than `least`.
  double evaluate(
      Vector& w, Foot& foot, Objective objective,
      double least = std::numeric_limits<double>::infinity())
  {
    foot = walk_.closest(w, foot.face != none ? foot.face : start_face_);
    if (on_surface_) w = foot.point;
    along_.resize(disc_->size());
    for (Index i = 0; i < disc_->size(); ++i) along_[i] = mesh_.point(disc_->ring[i]) - w;
    apex_residual_ = foot.point - w;
    apex_ratio_ = on_surface_
        ? 0
        : apex_residual_.squaredNorm() / bound_.tolerance().squared_limit(foot.nearest);
    double largest = apex_ratio_;
    double sum = apex_share * static_cast<double>(samples_.size()) * eighth_power(apex_ratio_);
    std::size_t worst = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      Sample& sample = samples_[i];
      measure(sample, w);
      if (sample.ratio > largest) largest = sample.ratio, worst = i;
      sum += eighth_power(sample.ratio);
      if ((objective == Objective::largest ? largest : sum) >= least) break;
    }
    // What is worst here will most likely be first to tell that a place nearby is no better.
    if (worst > 0) std::swap(samples_[0], samples_[worst]);
    largest_ = largest;
    objective_ = objective;
    return objective == Objective::largest ? largest : sum;
  }
  /// Of the distance, from its square.
  static double eighth_power(double squared)
  {
    const double fourth = squared * squared;
    return fourth * fourth;
  }

  /// Follows the closest point from face to face while it lies on a spoke.
  void measure(Sample& sample, const Vector& w) const
  {
    if (sample.kind != Kind::face) {
      measure_on_ridge(sample, w);
      return;
    }
    measure_on(sample, w, sample.face);
    for (int turn = 0; turn < 2; ++turn)
      for (Index steps = disc_->size(); steps > 0; --steps) {
        const double at_before = last_weights_.v, at_after = last_weights_.w;
        // Weights are those of ring vertices i and i + 1: without the latter it lies on spoke i.
        Index next = none;
        if (turn == 0 && at_after == 0) next = disc_->before(sample.face);
        if (turn == 1 && at_before == 0) next = disc_->after(sample.face);
        if (next == none
            || (next + disc_->size() - sample.side.low) % disc_->size() >= sample.side.count)
          break;
        Sample other = sample;
        const Triangle_weights weights = last_weights_;
        measure_on(other, w, next);
        if (!(other.ratio < sample.ratio)) {
          last_weights_ = weights;
          break;
        }
        sample = other;
      }
  }
  void measure_on_ridge(Sample& sample, const Vector& w) const
  {
    double mu = 0;
    if (sample.kind == Kind::spoke) {
      const Vector& along = along_[sample.face];
      mu = std::clamp((sample.point - w).dot(along) / along.squaredNorm(), 0.0, 1.0);
      sample.residual = sample.point - w - mu * along;
    } else {
      sample.residual = sample.point - w;
    }
    sample.apex_weight = 1 - mu;
    sample.ratio = sample.residual.squaredNorm() * sample.inverse_limit;
  }
  void measure_on(Sample& sample, const Vector& w, Index face) const
  {
    const Vector &ab = along_[face], &ac = along_[disc_->after(face)];
    last_weights_ = closest_weights(sample.point, w, ab, ac);
    const auto [v, z] = last_weights_;
    sample.face = face;
    sample.residual = sample.point - w - v * ab - z * ac;
    sample.apex_weight = 1 - v - z;
    sample.ratio = sample.residual.squaredNorm() * sample.inverse_limit;
  }

  Vector newton_step(const Foot& foot) const
  {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Vector b = Vector::Zero();
    const auto add = [&](const Vector& residual, double ratio, double u, double share) {
      const double squared = residual.squaredNorm();
      if (!(squared > 0) || u <= 0) return;
      double weight = share;
      if (objective_ == Objective::sum) {
        weight *= ratio * ratio * ratio;
      } else {
        const double fourth = ratio / largest_ * (ratio / largest_);
        weight *= fourth * fourth;
      }
      // omega u^2 n n^T and omega u d n, with n = r / d.
      a.noalias() += (weight * u * u / squared) * residual * residual.transpose();
      b += weight * u * residual;
    };
    for (const Sample& sample : samples_) add(sample.residual, sample.ratio, sample.apex_weight, 1);
    if (!on_surface_)
      add(apex_residual_, apex_ratio_, 1, apex_share * static_cast<double>(samples_.size()));
    const double trace = a.trace();
    if (!(trace > 0)) return Vector::Zero();
    a.diagonal().array() += regularisation * trace;
    if (on_surface_) {
      const Vector n = reference_.normal_of_face(foot.face);
      a.noalias() += 100 * trace * n * n.transpose();
    }
    return a.ldlt().solve(b);
  }

  const Reference& reference_;
  const Working_mesh& mesh_;
  const Direct_bound& bound_;
  Surface_walk walk_;
  bool on_surface_;

  const Disc* disc_ = nullptr;
  std::vector<Sample> samples_;
  std::vector<Vector> along_;
  Index start_face_ = none;
  Vector apex_residual_;
  double apex_ratio_ = 0, largest_ = 0;
  Objective objective_ = Objective::sum;
  mutable Triangle_weights last_weights_{};
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_FAN_OPTIMIZER_H
