// SPDX-License-Identifier: GPL-3.0-or-later
//
// How the faces of M cover T: a binary tree of convex cells a triangle of T, whose leaves know the
// face that covers them, and for each face the list of its leaves.
#ifndef SURETY_INTERNAL_COVERING_FOREST_H
#define SURETY_INTERNAL_COVERING_FOREST_H

#include <surety/internal/covering/cover_maker.h>

#include <array>
#include <vector>

namespace surety::internal::covering {

class Forest
{
public:
  /// Every triangle of T is a leaf that the face of the same index covers.
  explicit Forest(Index triangles) : triangles_(triangles)
  {
    nodes_.resize(triangles);
    first_leaf_.resize(triangles);
    for (Index t = 0; t < triangles; ++t) {
      nodes_[t].triangle = t;
      nodes_[t].face = first_leaf_[t] = t;
    }
  }

  /// \name A node
  /// @{
  /// Whether it is a triangle of T as a whole, which has the same index.
  bool is_whole(Index node) const { return node < triangles_; }
  Index triangle_of(Index node) const { return nodes_[node].triangle; }
  int depth(Index node) const { return nodes_[node].depth; }
  Index face_of(Index leaf) const { return nodes_[leaf].face; }
  /// The corners of one that is not a whole triangle.
  const std::vector<Vector>& corners(Index node) const { return corners_[node - triangles_]; }
  /// @}

  template <class Visit>
  void for_each_leaf_of(Index face, Visit visit) const
  {
    if (face >= first_leaf_.size()) return;
    for (Index leaf = first_leaf_[face]; leaf != none; leaf = nodes_[leaf].next) visit(leaf);
  }

  /// The fewest nodes that hold the leaves of some faces and nothing else, in the order of the
  /// leaves. Merging where both parts go keeps cells from fragmenting for ever.
  void gather(const std::vector<Index>& faces, std::vector<Index>& roots)
  {
    roots.clear();
    ++now_;
    for (const Index f : faces) for_each_leaf_of(f, [&](Index leaf) { roots.push_back(leaf); });
    for (const Index leaf : roots) nodes_[leaf].mark = now_;
    // Parents are appended as they are found to be complete, and looked at in their turn.
    for (std::size_t i = 0; i < roots.size(); ++i) {
      const Index node = roots[i], parent = nodes_[node].parent;
      if (parent == none) continue;
      const Index first = nodes_[parent].child;
      if (nodes_[first].mark != now_ || nodes_[first + 1].mark != now_) continue;
      if (nodes_[parent].mark == now_) continue;
      nodes_[parent].mark = now_;
      roots.push_back(parent);
    }
    std::size_t kept = 0;
    for (const Index node : roots) {
      const Index parent = nodes_[node].parent;
      if (parent == none || nodes_[parent].mark != now_) roots[kept++] = node;
    }
    roots.resize(kept);
  }

  /// Forgets all leaves of a face; what held them is to be planted anew.
  void clear_leaves_of(Index face)
  {
    if (face < first_leaf_.size()) first_leaf_[face] = none;
  }

  /// Puts a cover in the place of a node, which becomes the root of it.
  /// \param face_of_triangle the face that each candidate is
  template <class Face_of>
  void plant(
      Index node, const std::vector<Cover_node>& cover, Index root, const Face_of& face_of_triangle)
  {
    cut_down(node);
    grow(node, cover, root, face_of_triangle);
  }

private:
  struct Node {
    Index triangle = none;
    Index parent = none;
    Index child = none; ///< the first of two parts, or none
    Index face = none;  ///< of a leaf
    Index next = none;  ///< leaf of the same face, or free node
    Index mark = 0;
    int depth = 0;
  };

  void cut_down(Index node)
  {
    const Index child = nodes_[node].child;
    if (child == none) return;
    cut_down(child);
    cut_down(child + 1);
    nodes_[child].next = free_;
    free_ = child;
    nodes_[node].child = none;
  }

  template <class Face_of>
  void grow(
      Index node, const std::vector<Cover_node>& cover, Index at, const Face_of& face_of_triangle)
  {
    const Cover_node& from = cover[at];
    if (from.child == none) {
      const Index face = face_of_triangle(from.triangle);
      if (face >= first_leaf_.size()) first_leaf_.resize(face + 1, none);
      nodes_[node].face = face;
      nodes_[node].next = first_leaf_[face];
      first_leaf_[face] = node;
      return;
    }
    nodes_[node].face = none;
    const Index child = new_pair();
    nodes_[node].child = child;
    for (Index k = 0; k < 2; ++k) {
      Node& part = nodes_[child + k];
      part.triangle = nodes_[node].triangle;
      part.parent = node;
      part.child = none;
      part.depth = nodes_[node].depth + 1;
      const Cell& cell = cover[from.child + k].cell;
      auto& corners = corners_[child + k - triangles_];
      corners.clear();
      for (unsigned i = 0; i < cell.size(); ++i) corners.push_back(cell[i].point);
      grow(child + k, cover, from.child + k, face_of_triangle);
    }
  }

  Index new_pair()
  {
    if (free_ != none) {
      const Index pair = free_;
      free_ = nodes_[pair].next;
      return pair;
    }
    const auto pair = static_cast<Index>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    corners_.resize(corners_.size() + 2);
    return pair;
  }

  Index triangles_;
  std::vector<Node> nodes_; ///< the triangles of T come first
  std::vector<std::vector<Vector>> corners_;
  std::vector<Index> first_leaf_; ///< by face of M
  Index free_ = none;             ///< first of the pairs of nodes that are not used
  Index now_ = 0;
};

} // namespace surety::internal::covering

#endif // SURETY_INTERNAL_COVERING_FOREST_H
