// SPDX-License-Identifier: GPL-3.0-or-later
//
// Covers a convex cell: divides it until each part has all its corners within the tolerance of one
// triangle. A triangle is convex, so that the part lies within the tolerance of it as a whole.
#ifndef SURETY_INTERNAL_COVERING_COVER_MAKER_H
#define SURETY_INTERNAL_COVERING_COVER_MAKER_H

#include <surety/internal/covering/convex_cell.h>
#include <surety/internal/covering/triangles.h>

#include <algorithm>
#include <array>
#include <vector>

namespace surety::internal::covering {

using Cell = Convex_cell<Nearness>;

/// Cells as a binary tree: a leaf has a triangle, the index of a candidate; another node has two
/// parts at `child` and `child + 1`.
struct Cover_node {
  Cell cell;
  Index child = none;
  Index triangle = none;
};

class Cover_maker
{
public:
  /// Covers a cell whose corners know the candidates, `depth` cuts below its triangle. Appends the
  /// tree to `nodes`, its root first. Fails where a corner is too far from all candidates, or where
  /// cuts do not help.
  bool cover(
      const Cell& cell, int depth, const Candidates& candidates, double squared_limit,
      std::vector<Cover_node>& nodes)
  {
    const auto root = static_cast<Index>(nodes.size());
    nodes.emplace_back();
    nodes.back().cell = cell;
    const std::size_t most = nodes.size() + most_nodes;
    return divide(root, depth, candidates, squared_limit, most, nodes);
  }

  static Cell triangle_cell(const std::array<Vector, 3>& corners)
  {
    Cell cell;
    for (const Vector& p : corners) cell.append({p, {}});
    return cell;
  }

private:
  /// More nodes than this for one cell are a sign of a tolerance that is out of reach.
  static constexpr std::size_t most_nodes = 4000;

  bool divide(
      Index node, int depth, const Candidates& candidates, double squared_limit, std::size_t most,
      std::vector<Cover_node>& nodes)
  {
    const Cell cell = nodes[node].cell;
    std::uint64_t common = ~std::uint64_t(0);
    for (unsigned i = 0; i < cell.size(); ++i) {
      if (cell[i].known.within == 0) return false;
      common &= cell[i].known.within;
    }
    if (common != 0) {
      nodes[node].triangle = lowest_bit(common);
      return true;
    }
    if (depth >= deepest_cut || nodes.size() > most) return false;
    const Cut cut = best_cut(cell, candidates);
    const auto parts
        = cell.parts(cut, [&](const Vector& p) { return candidates.around(p, squared_limit); });
    const auto child = static_cast<Index>(nodes.size());
    nodes.resize(nodes.size() + 2);
    nodes[node].child = child;
    nodes[child].cell = parts.first;
    nodes[child + 1].cell = parts.second;
    return divide(child, depth + 1, candidates, squared_limit, most, nodes)
        && divide(child + 1, depth + 1, candidates, squared_limit, most, nodes);
  }

  static Index lowest_bit(std::uint64_t bits)
  {
    Index i = 0;
    while ((bits & 1) == 0) bits >>= 1, ++i;
    return i;
  }

  /// Along an edge of a triangle that is nearest to a corner, upright on the triangle: of these the
  /// plane with the most on its lesser side.
  static Cut best_cut(const Cell& cell, const Candidates& candidates)
  {
    if (cell.is_full()) return cell.halving_cut();
    std::uint64_t tried = 0;
    double most = 0;
    Vector best_origin = Vector::Zero(), best_normal = Vector::Zero();
    for (unsigned i = 0; i < cell.size(); ++i) {
      const Index nearest = cell[i].known.nearest;
      if ((tried >> nearest & 1) != 0) continue;
      tried |= std::uint64_t(1) << nearest;
      const Triangle& t = candidates[nearest];
      const auto corner = t.corners();
      for (int k = 0; k < 3; ++k) {
        const Vector normal = unit((corner[(k + 1) % 3] - corner[k]).cross(t.normal));
        const double lesser = lesser_side(cell, corner[k], normal);
        if (lesser <= most) continue;
        most = lesser, best_origin = corner[k], best_normal = normal;
      }
    }
    if (most > 0) {
      const auto cut
          = cell.cut_along([&](const Vector& p) { return best_normal.dot(p - best_origin); });
      if (cut) return *cut;
    }
    return cell.halving_cut();
  }

  static double lesser_side(const Cell& cell, const Vector& origin, const Vector& normal)
  {
    double inside = 0, outside = 0;
    for (unsigned i = 0; i < cell.size(); ++i) {
      const double height = normal.dot(cell[i].point - origin);
      inside = std::max(inside, height);
      outside = std::max(outside, -height);
    }
    // A sliver of a cell would be no progress.
    const double lesser = std::min(inside, outside), larger = std::max(inside, outside);
    return lesser > 1e-3 * larger ? lesser : 0;
  }
};

} // namespace surety::internal::covering

#endif // SURETY_INTERNAL_COVERING_COVER_MAKER_H
