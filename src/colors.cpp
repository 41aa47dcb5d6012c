// SPDX-License-Identifier: GPL-3.0-or-later
#include "colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace surety::tool {
namespace {

/// Linear between samples that are spread evenly over [0, 1].
template <std::size_t N>
CGAL::IO::Color interpolate(const std::array<std::array<double, 3>, N>& samples, double value)
{
  const double position = std::clamp(value, 0., 1.) * (N - 1);
  const auto i = std::min(static_cast<std::size_t>(position), N - 2);
  const double t = position - double(i);
  const auto channel = [&](std::size_t c) {
    return static_cast<unsigned char>(std::lround((1 - t) * samples[i][c] + t * samples[i + 1][c]));
  };
  return {channel(0), channel(1), channel(2)};
}

} // namespace

CGAL::IO::Color heat(double value)
{
  constexpr std::array<std::array<double, 3>, 6> samples = {
      {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  return interpolate(samples, value);
}

CGAL::IO::Color diverging(double value)
{
  constexpr std::array<std::array<double, 3>, 5> samples
      = {{{59, 76, 192}, {141, 176, 254}, {221, 221, 221}, {244, 152, 122}, {180, 4, 38}}};
  return interpolate(samples, (value + 1) / 2);
}

} // namespace surety::tool
