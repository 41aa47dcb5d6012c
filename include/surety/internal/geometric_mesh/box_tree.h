// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tree of bounding boxes over the faces of M that follows the mesh as it changes: the leaves are
// ordered once, and a changed face refits the boxes above it. Static trees (CGAL's AABB tree) would
// have to be rebuilt, and a dynamic R-tree takes several times the memory.
#ifndef SURETY_INTERNAL_GEOMETRIC_MESH_BOX_TREE_H
#define SURETY_INTERNAL_GEOMETRIC_MESH_BOX_TREE_H

#include <surety/internal/linear.h>

#include <algorithm>
#include <array>
#include <vector>

namespace surety::internal {

/// A box in single precision. Coordinates are rounded by a monotone function, relative to a common
/// origin, so that closed boxes which meet still meet.
struct Float_box {
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array3f high = -low;

  void add(const Eigen::Array3f& p)
  {
    low = low.min(p);
    high = high.max(p);
  }
  void add(const Float_box& box)
  {
    low = low.min(box.low);
    high = high.max(box.high);
  }
  bool meets(const Float_box& box) const
  {
    return (low <= box.high).all() && (box.low <= high).all();
  }
  bool operator==(const Float_box& box) const
  {
    return (low == box.low).all() && (high == box.high).all();
  }
};

class Box_tree
{
public:
  /// `boxes` holds one box a face.
  explicit Box_tree(const std::vector<Float_box>& boxes)
    : face_at_(boxes.size()), place_of_(boxes.size()), box_of_face_(boxes)
  {
    order_leaves();
    leaves_ = 1;
    while (leaves_ * leaf_size < face_at_.size()) leaves_ *= 2;
    nodes_.resize(2 * leaves_);
    for (std::size_t leaf = 0; leaf < leaves_; ++leaf) nodes_[leaves_ + leaf] = box_of_leaf(leaf);
    for (std::size_t node = leaves_ - 1; node > 0; --node) nodes_[node] = box_of_children(node);
  }

  /// Gives a face a new box; the default box removes it.
  void set(Index face, const Float_box& box)
  {
    box_of_face_[face] = box;
    const std::size_t leaf = place_of_[face] / leaf_size;
    std::size_t node = leaves_ + leaf;
    Float_box fitted = box_of_leaf(leaf);
    while (!(nodes_[node] == fitted)) {
      nodes_[node] = fitted;
      if (node == 1) return;
      node /= 2;
      fitted = box_of_children(node);
    }
  }

  /// Calls visit(face) for every face whose box meets `box`.
  template <class Visit>
  void for_each_meeting(const Float_box& box, Visit visit) const
  {
    std::array<std::size_t, 64> stack;
    std::size_t size = 0;
    stack[size++] = 1;
    while (size > 0) {
      const std::size_t node = stack[--size];
      if (!nodes_[node].meets(box)) continue;
      if (node < leaves_) {
        stack[size++] = 2 * node;
        stack[size++] = 2 * node + 1;
        continue;
      }
      const std::size_t first = (node - leaves_) * leaf_size;
      const std::size_t last = std::min(first + leaf_size, face_at_.size());
      for (std::size_t i = first; i < last; ++i)
        if (box_of_face_[face_at_[i]].meets(box)) visit(face_at_[i]);
    }
  }

private:
  static constexpr std::size_t leaf_size = 4;

  Float_box box_of_leaf(std::size_t leaf) const
  {
    Float_box box;
    const std::size_t last = std::min((leaf + 1) * leaf_size, face_at_.size());
    for (std::size_t i = leaf * leaf_size; i < last; ++i) box.add(box_of_face_[face_at_[i]]);
    return box;
  }
  Float_box box_of_children(std::size_t node) const
  {
    Float_box box = nodes_[2 * node];
    box.add(nodes_[2 * node + 1]);
    return box;
  }

  // Faces along the Morton curve of their centres.
  void order_leaves()
  {
    Float_box all;
    for (const Float_box& box : box_of_face_) all.add(box);
    const Eigen::Array3f extent = (all.high - all.low).max(std::numeric_limits<float>::min());
    std::vector<std::pair<std::uint64_t, Index>> order(box_of_face_.size());
    for (Index f = 0; f < order.size(); ++f) {
      const Float_box& box = box_of_face_[f];
      const Eigen::Array3f place = ((box.low - all.low) / 2 + (box.high - all.low) / 2) / extent;
      std::uint64_t key = 0;
      for (int i = 0; i < 3; ++i) key |= spread(place[i]) << i;
      order[f] = {key, f};
    }
    std::sort(order.begin(), order.end());
    for (Index i = 0; i < order.size(); ++i) {
      face_at_[i] = order[i].second;
      place_of_[order[i].second] = i;
    }
  }

  // 21 bits of a number in [0, 1], with two zeros after each.
  static std::uint64_t spread(float x)
  {
    auto bits = static_cast<std::uint64_t>(std::clamp(x, 0.0F, 1.0F) * 2097151.0F) & 0x1fffff;
    bits = (bits | bits << 32) & 0x1f00000000ffff;
    bits = (bits | bits << 16) & 0x1f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    return (bits | bits << 2) & 0x1249249249249249;
  }

  std::vector<Index> face_at_, place_of_;
  std::vector<Float_box> box_of_face_;
  std::vector<Float_box> nodes_;
  std::size_t leaves_ = 1;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_BOX_TREE_H
