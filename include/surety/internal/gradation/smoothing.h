// SPDX-License-Identifier: GPL-3.0-or-later
//
// Log-Euclidean means of tensors (V. Arsigny et al., 2006). Noisy directions make gradation cross
// thin tensors at random angles, which leaves round ones; means restore the directions first.
#ifndef SURETY_INTERNAL_GRADATION_SMOOTHING_H
#define SURETY_INTERNAL_GRADATION_SMOOTHING_H

#include <surety/internal/gradation/anisotropic.h>
#include <surety/internal/gradation/plane_tensor.h>
#include <surety/internal/gradation/side_graph.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace surety::internal::grading {

/// \brief Replaces tensors by the means of the logarithms of theirs and their neighbours'.
///
/// Eigenvalues stay between the least and the greatest of those averaged. Sides that are not
/// `is_smooth`, those on curves of features, stay as they are.
class Tensor_smoothing
{
public:
  Tensor_smoothing(const Side_graph& graph, const std::vector<bool>& is_smooth)
    : graph_(graph), is_smooth_(is_smooth)
  {}

  void smooth(std::vector<Plane_tensor>& tensors, unsigned rounds) const
  {
    for (; rounds > 0; --rounds) {
      std::vector<Plane_tensor> result = tensors;
      for (std::uint32_t s = 0; s < graph_.size(); ++s) {
        if (is_smooth_[s]) result[s] = mean(tensors, s);
      }
      tensors = std::move(result);
    }
  }

private:
  Plane_tensor mean(const std::vector<Plane_tensor>& tensors, std::uint32_t s) const
  {
    // In the order of their places, so that the sum does not depend on the numbering.
    std::vector<std::uint32_t> summed(1, s);
    graph_.for_each_neighbour(s, [&](std::uint32_t t) { summed.push_back(t); });
    std::sort(summed.begin(), summed.end(), [this](std::uint32_t a, std::uint32_t b) {
      return graph_.comes_first(a, b);
    });
    Plane_tensor sum{0, 0, 0};
    for (const std::uint32_t t : summed) {
      const Plane_axes axes(tensors[t]);
      const Plane_tensor logarithm = from_axes(
          std::log(axes.larger), std::log(axes.smaller),
          transported(axes.axis, graph_.node(t), graph_.node(s)));
      sum = {sum.a + logarithm.a, sum.b + logarithm.b, sum.c + logarithm.c};
    }
    const double n = static_cast<double>(summed.size());
    return exponential({sum.a / n, sum.b / n, sum.c / n});
  }

  /// Of a symmetric matrix that need not be positive: its eigenvalues are shifted apart.
  static Plane_tensor exponential(const Plane_tensor& m)
  {
    const double mean = (m.a + m.c) / 2, half = (m.a - m.c) / 2;
    const double radius = std::sqrt(half * half + m.b * m.b);
    const Plane_axes axes({half + 2 * radius, m.b, 2 * radius - half});
    return from_axes(std::exp(mean + radius), std::exp(mean - radius), axes.axis);
  }

  const Side_graph& graph_;
  const std::vector<bool>& is_smooth_;
};

} // namespace surety::internal::grading

#endif // SURETY_INTERNAL_GRADATION_SMOOTHING_H
