// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tree of bounding boxes over the faces of M that follows the mesh as it changes: neighbours in
// index are neighbours in space and share a leaf, and a changed face refits the boxes above it.
// Static trees (CGAL's AABB tree) would have to be rebuilt, and a dynamic R-tree takes several
// times the memory.
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
  // Without short cuts: six comparisons cost less than one misprediction.
  bool meets(const Float_box& box) const
  {
    bool result = true;
    for (int i = 0; i < 3; ++i) result = result & (low[i] <= box.high[i]) & (box.low[i] <= high[i]);
    return result;
  }
  bool operator==(const Float_box& box) const
  {
    return (low == box.low).all() && (high == box.high).all();
  }
};

class Box_tree
{
public:
  /// Builds the tree anew over some faces; box_of(face) gives the box of each. The faces of a mesh
  /// that has lost most of them are found faster in a new tree than among the gaps of the old one.
  template <class Box_of>
  void build(std::vector<Index> faces, std::size_t largest_face, const Box_of& box_of)
  {
    face_at_ = std::move(faces);
    place_of_.assign(largest_face + 1, none);
    boxes_.clear();
    boxes_.reserve(face_at_.size());
    for (const Index f : face_at_) {
      place_of_[f] = static_cast<Index>(boxes_.size());
      boxes_.push_back(box_of(f));
    }
    leaves_ = 1;
    while (leaves_ * leaf_size < boxes_.size()) leaves_ *= 2;
    nodes_.resize(2 * leaves_);
    for (std::size_t leaf = 0; leaf < leaves_; ++leaf) nodes_[leaves_ + leaf] = box_of_leaf(leaf);
    for (std::size_t node = leaves_ - 1; node > 0; --node) nodes_[node] = box_of_children(node);
  }

  /// The number of faces that the tree was built over.
  std::size_t size() const { return face_at_.size(); }

  /// Whether a face has a place, be it empty.
  bool has(Index face) const { return face < place_of_.size() && place_of_[face] != none; }

  /// Gives a face a place after all others; false where there is no room.
  bool add(Index face)
  {
    if (boxes_.size() == leaves_ * leaf_size) return false;
    if (face >= place_of_.size()) place_of_.resize(face + 1, none);
    place_of_[face] = static_cast<Index>(boxes_.size());
    face_at_.push_back(face);
    boxes_.emplace_back();
    return true;
  }

  /// Gives a face a new box; the default box removes it.
  void set(Index face, const Float_box& box)
  {
    boxes_[place_of_[face]] = box;
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
      const std::size_t last = std::min(first + leaf_size, boxes_.size());
      for (std::size_t i = first; i < last; ++i)
        if (boxes_[i].meets(box)) visit(face_at_[i]);
    }
  }

private:
  static constexpr std::size_t leaf_size = 4;

  Float_box box_of_leaf(std::size_t leaf) const
  {
    Float_box box;
    const std::size_t last = std::min((leaf + 1) * leaf_size, boxes_.size());
    for (std::size_t i = leaf * leaf_size; i < last; ++i) box.add(boxes_[i]);
    return box;
  }
  Float_box box_of_children(std::size_t node) const
  {
    Float_box box = nodes_[2 * node];
    box.add(nodes_[2 * node + 1]);
    return box;
  }

  std::vector<Index> face_at_, place_of_;
  std::vector<Float_box> boxes_, nodes_;
  std::size_t leaves_ = 1;
};

} // namespace surety::internal

#endif // SURETY_INTERNAL_GEOMETRIC_MESH_BOX_TREE_H
