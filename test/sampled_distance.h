// SPDX-License-Identifier: GPL-3.0-or-later
//
// The third, weakest witness: distances measured at sample points. Every figure is a lower bound of
// the Hausdorff distance, up to rounding. Shares no code with the library, nor with CGAL's trees.
#ifndef SURETY_TEST_SAMPLED_DISTANCE_H
#define SURETY_TEST_SAMPLED_DISTANCE_H

#include "meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace surety::test {

/// Closest points on a fixed set of triangles, by a hierarchy of boxes.
class Closest_triangle
{
  struct Box {
    std::array<double, 3> low{}, high{};
  };
  struct Node {
    Box box;
    std::size_t begin, end; ///< triangles
    std::size_t right;      ///< the left child follows the node; 0 for a leaf
  };

public:
  explicit Closest_triangle(const Mesh& mesh) : soup_(to_soup(mesh)) { build(0, size()); }

  double distance(const Point& p) const
  {
    double best = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> pending(1, 0);
    while (!pending.empty()) {
      const std::size_t current = pending.back();
      pending.pop_back();
      const Node& node = nodes_[current];
      if (squared_distance(p, node.box) >= best) continue;
      if (node.right == 0) {
        for (std::size_t t = node.begin; t < node.end; ++t) {
          best = (std::min)(best, squared_distance(p, t));
        }
      } else {
        const double left = squared_distance(p, nodes_[current + 1].box);
        const bool left_first = left < squared_distance(p, nodes_[node.right].box);
        pending.push_back(left_first ? node.right : current + 1);
        pending.push_back(left_first ? current + 1 : node.right);
      }
    }
    return std::sqrt(best);
  }

private:
  std::size_t size() const { return soup_.triangles.size(); }
  const Point& corner(std::size_t t, std::size_t i) const
  {
    return soup_.points[soup_.triangles[t][i]];
  }

  std::size_t build(std::size_t begin, std::size_t end)
  {
    const std::size_t index = nodes_.size();
    nodes_.push_back({bounding_box(begin, end), begin, end, 0});
    if (end - begin <= 4) return index;
    const Box box = nodes_[index].box;
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (box.high[i] - box.low[i] > box.high[axis] - box.low[axis]) axis = i;
    }
    const auto middle = [&](const std::array<std::size_t, 3>& t) {
      return soup_.points[t[0]][axis] + soup_.points[t[1]][axis] + soup_.points[t[2]][axis];
    };
    const auto first = soup_.triangles.begin();
    const std::size_t half = begin + (end - begin) / 2;
    std::nth_element(
        first + std::ptrdiff_t(begin), first + std::ptrdiff_t(half), first + std::ptrdiff_t(end),
        [&](const auto& a, const auto& b) { return middle(a) < middle(b); });
    build(begin, half);
    nodes_[index].right = build(half, end);
    return index;
  }

  Box bounding_box(std::size_t begin, std::size_t end) const
  {
    Box box;
    box.low.fill(std::numeric_limits<double>::infinity());
    box.high.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t t = begin; t < end; ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i) {
          box.low[i] = (std::min)(box.low[i], corner(t, k)[i]);
          box.high[i] = (std::max)(box.high[i], corner(t, k)[i]);
        }
      }
    }
    return box;
  }

  static double squared_distance(const Point& p, const Box& box)
  {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const double outside = (std::max)({box.low[i] - p[i], p[i] - box.high[i], 0.0});
      sum += outside * outside;
    }
    return sum;
  }

  static double squared_distance_to_segment(const Point& p, const Point& a, const Point& b)
  {
    const Vector ab = b - a;
    const double t = std::clamp((p - a) * ab / ab.squared_length(), 0.0, 1.0);
    return (p - (a + t * ab)).squared_length();
  }

  /// The foot on the plane if it lies inside the triangle, else the nearest of the three sides.
  double squared_distance(const Point& p, std::size_t t) const
  {
    const Point &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
    const Vector n = CGAL::cross_product(b - a, c - a);
    const bool is_inside = CGAL::cross_product(b - a, p - a) * n >= 0
        && CGAL::cross_product(c - b, p - b) * n >= 0 && CGAL::cross_product(a - c, p - c) * n >= 0;
    if (is_inside && n.squared_length() > 0) {
      const double height = (p - a) * n;
      return height * height / n.squared_length();
    }
    return (std::min)(
        {squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
         squared_distance_to_segment(p, c, a)});
  }

  Soup soup_;
  std::vector<Node> nodes_;
};

/// Largest distance from sample points of `from` to `to`: vertices, a lattice on every face whose
/// sides are cut in `cuts`, and as many random points as the lattice has.
inline double sampled_distance_to(
    const Mesh& from, const Mesh& to, std::uint64_t seed = 0, int cuts = 4)
{
  Random random(seed);
  const Closest_triangle closest(to);
  const Soup soup = to_soup(from);
  double largest = 0;
  for (const auto& t : soup.triangles) {
    const Point a = soup.points[t[0]];
    const Vector u = soup.points[t[1]] - a, v = soup.points[t[2]] - a;
    for (int i = 0; i <= cuts; ++i) {
      for (int j = 0; i + j <= cuts; ++j) {
        double s = random.unit(), r = random.unit();
        if (s + r > 1) s = 1 - s, r = 1 - r;
        const double x = double(i) / cuts, y = double(j) / cuts;
        largest = (std::max)(
            {largest, closest.distance(a + x * u + y * v), closest.distance(a + s * u + r * v)});
      }
    }
  }
  return largest;
}

/// The two-sided sampled distance: a lower bound of the Hausdorff distance.
inline double sampled_distance(const Mesh& a, const Mesh& b, std::uint64_t seed = 0, int cuts = 4)
{
  return (std::max)(sampled_distance_to(a, b, seed, cuts), sampled_distance_to(b, a, seed, cuts));
}

} // namespace surety::test

#endif // SURETY_TEST_SAMPLED_DISTANCE_H
