// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gradation of tensors. Each hands its own to its neighbours, grown with the distance and turned
// into their tangent planes, and they take the intersection. The tensors are settled in the order
// of their sizes, each once: first by the small size, then by the large one. So the result depends
// on the metric and not on the numbering of the mesh, and no number of sweeps has to be guessed.
#ifndef SURETY_INTERNAL_GRADATION_ANISOTROPIC_H
#define SURETY_INTERNAL_GRADATION_ANISOTROPIC_H

#include <surety/internal/gradation/plane_tensor.h>
#include <surety/internal/gradation/side_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <vector>

namespace surety::internal::grading {

/// The direction at one node, given in its basis, as seen in the basis of another: turned by the
/// least rotation that takes one normal to the other.
inline std::array<double, 2> transported(
    const std::array<double, 2>& direction, const Node& from, const Node& to)
{
  const Vector d = direction[0] * from.basis[0] + direction[1] * from.basis[1];
  const double denominator = 1 + from.normal.dot(to.normal);
  // Opposite normals leave the rotation open. Then d lies in both planes.
  const Vector turned = denominator > 1e-12
      ? Vector(d - to.normal.dot(d) / denominator * (from.normal + to.normal))
      : d;
  const double x = turned.dot(to.basis[0]), y = turned.dot(to.basis[1]);
  const double length = std::sqrt(x * x + y * y);
  return length > 0 ? std::array{x / length, y / length} : std::array{1., 0.};
}

/// \brief By which factor a size h grows on an edge of Euclidean length e and metric length l.
///
/// (1 + ln(beta) e / h)^t (1 + ln(beta) l)^(1-t) with t = 1/8. With t = 1 each size would grow as
/// if the metric were isotropic, and a layer would lose its large sizes; with t = 0 both sizes grow
/// by one factor, and a layer would never lose its anisotropy. Roots are exact to rounding on every
/// machine, which powers are not.
inline double growth(double slope, double e, double h, double l)
{
  const double physical = 1 + slope * (e / h), metric = 1 + slope * l;
  return metric * std::sqrt(std::sqrt(std::sqrt(physical / metric)));
}

class Anisotropic_gradation
{
  struct Entry {
    double key;
    std::uint32_t side;
  };

public:
  enum class Order { by_small_size, by_large_size };

  /// \param slope ln(beta)
  Anisotropic_gradation(const Side_graph& graph, double slope) : graph_(graph), slope_(slope) {}

  void limit(std::vector<Plane_tensor>& tensors) const
  {
    pass(tensors, Order::by_small_size);
    pass(tensors, Order::by_large_size);
  }

private:
  /// Large eigenvalues are small sizes.
  static double key(const Plane_tensor& m, Order order)
  {
    const Plane_axes axes(m);
    return order == Order::by_small_size ? axes.larger : axes.smaller;
  }

  void pass(std::vector<Plane_tensor>& tensors, Order order) const
  {
    const auto later = [this](const Entry& a, const Entry& b) {
      return a.key != b.key ? a.key < b.key : graph_.comes_first(b.side, a.side);
    };
    std::vector<Entry> entries;
    std::vector<double> current;
    for (std::uint32_t s = 0; s < graph_.size(); ++s) {
      current.push_back(key(tensors[s], order));
      entries.push_back({current[s], s});
    }
    std::priority_queue<Entry, std::vector<Entry>, decltype(later)> queue(
        later, std::move(entries));
    std::vector<bool> is_settled(graph_.size(), false);
    while (!queue.empty()) {
      const Entry next = queue.top();
      queue.pop();
      if (is_settled[next.side] || next.key != current[next.side]) continue;
      is_settled[next.side] = true;
      hand_over(
          next.side, tensors,
          [&](std::uint32_t to, const Plane_tensor& m) {
            if (is_settled[to]) return;
            tensors[to] = m;
            const double changed = key(m, order);
            if (changed == current[to]) return;
            current[to] = changed;
            queue.push({changed, to});
          },
          is_settled);
    }
  }

  template <class Assign>
  void hand_over(
      std::uint32_t side, const std::vector<Plane_tensor>& tensors, const Assign& assign,
      const std::vector<bool>& is_settled) const
  {
    const Node& from = graph_.node(side);
    const Plane_tensor m = tensors[side];
    const Plane_axes axes(m);
    graph_.for_each_neighbour(side, [&](std::uint32_t to) {
      if (is_settled[to]) return;
      const Plane_tensor grown = grown_towards(from, m, axes, graph_.node(to));
      if (asks_more(grown, tensors[to])) assign(to, combined(tensors[to], grown));
    });
    graph_.for_each_crossing(side, [&](const Crossing& crossing) {
      if (is_settled[crossing.to]) return;
      const double wanted = along(m, from, crossing.tangent);
      const Plane_tensor& other = tensors[crossing.to];
      const Node& to = graph_.node(crossing.to);
      if (wanted > slack * along(other, to, crossing.tangent)) {
        assign(crossing.to, with_size_along(other, to, crossing.tangent, wanted));
      }
    });
  }

  Plane_tensor grown_towards(
      const Node& from, const Plane_tensor& m, const Plane_axes& axes, const Node& to) const
  {
    const Vector e = to.position - from.position;
    const double x = e.dot(from.basis[0]), y = e.dot(from.basis[1]), z = e.dot(from.normal);
    const double length = e.norm();
    const double l = std::sqrt(m.of(x, y) + axes.smaller * z * z);
    const double h1 = 1 / std::sqrt(axes.larger), h2 = 1 / std::sqrt(axes.smaller);
    const double f1 = growth(slope_, length, h1, l), f2 = growth(slope_, length, h2, l);
    return from_axes(
        axes.larger / (f1 * f1), axes.smaller / (f2 * f2), transported(axes.axis, from, to));
  }

  static Plane_tensor combined(const Plane_tensor& m, const Plane_tensor& g)
  {
    const double limit = (std::max)(Plane_axes(m).larger, Plane_axes(g).larger);
    return clamped(intersection(m, g), limit);
  }

  /// A tangent of a curve, in the basis of a side of it.
  static std::array<double, 2> in_plane(const Node& node, const Vector& tangent)
  {
    const double x = tangent.dot(node.basis[0]), y = tangent.dot(node.basis[1]);
    const double length = std::sqrt(x * x + y * y);
    return length > 0 ? std::array{x / length, y / length} : std::array{1., 0.};
  }

  static double along(const Plane_tensor& m, const Node& node, const Vector& tangent)
  {
    const auto [x, y] = in_plane(node, tangent);
    return m.of(x, y);
  }

  /// The tensor with a larger eigenvalue along a tangent and as little change as possible.
  static Plane_tensor with_size_along(
      const Plane_tensor& m, const Node& node, const Vector& tangent, double wanted)
  {
    const auto t = in_plane(node, tangent);
    const double more = wanted - m.of(t[0], t[1]);
    const Plane_tensor sum{
        m.a + more * t[0] * t[0], m.b + more * t[0] * t[1], m.c + more * t[1] * t[1]};
    return clamped(sum, (std::max)(Plane_axes(m).larger, wanted));
  }

  const Side_graph& graph_;
  double slope_;
};

} // namespace surety::internal::grading

#endif // SURETY_INTERNAL_GRADATION_ANISOTROPIC_H
