// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles within the faces of a mesh, cut by their longest edges until nobody asks for more. Only
// connectivity and barycentric coordinates; where the points lie is somebody else's.
#ifndef SURETY_INTERNAL_ENRICH_REFINEMENT_H
#define SURETY_INTERNAL_ENRICH_REFINEMENT_H

#include <surety/internal/support/location.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace surety::internal::enrichment {

using Vector = Eigen::Vector3d;
using Index = std::uint32_t;

/// A triangle within a face. Coordinates are dyadic, so they are exact.
struct Piece {
  Index face;
  std::array<Index, 3> corner;
  std::array<Vector, 3> barycentric; ///< of the corners, in the face
};

/// The name of an edge, the same from both sides.
inline std::uint64_t edge_name(Index a, Index b)
{
  return std::uint64_t((std::min)(a, b)) << 32 | (std::max)(a, b);
}

/// The pieces of all faces, conforming: neighbours share whole edges.
class Refinement
{
public:
  /// Starts with one piece a face; vertices are numbered from 0.
  Refinement(std::vector<Piece> pieces, Index vertices)
    : pieces_(std::move(pieces)), vertices_(vertices)
  {}

  const std::vector<Piece>& pieces() const { return pieces_; }
  Index vertices() const { return vertices_; }

  /// \brief Halves the edges that `is_long(piece, i)` says, edge i from corner i to the next, and
  /// those that keep the shapes good; returns whether there were any.
  ///
  /// Where an edge is halved, so is the longest one of each piece there (Rivara), by
  /// `length(a, b)` of two vertices. `make(vertex, location)` is told each new vertex, in order.
  template <class Is_long, class Length, class Make>
  bool refine(const Is_long& is_long, const Length& length, const Make& make)
  {
    middle_.clear();
    for (const Piece& piece : pieces_) {
      for (int i = 0; i < 3; ++i) {
        if (is_long(piece, i)) middle_[name(piece, i)] = none;
      }
    }
    if (middle_.empty()) return false;
    const std::vector<int> longest = longest_edges(length);
    close(longest);
    std::vector<Piece> old = std::move(pieces_);
    pieces_.clear();
    for (std::size_t k = 0; k < old.size(); ++k) cut(old[k], longest[k], length, make);
    return true;
  }

private:
  static std::uint64_t name(const Piece& piece, int i)
  {
    return edge_name(piece.corner[i], piece.corner[(i + 1) % 3]);
  }

  template <class Length>
  std::vector<int> longest_edges(const Length& length) const
  {
    std::vector<int> result;
    for (const Piece& piece : pieces_) {
      // Of edges that are as long, the one with the least name: the same from both sides.
      std::array<std::pair<double, std::uint64_t>, 3> rank;
      for (int i = 0; i < 3; ++i)
        rank[i] = {-length(piece.corner[i], piece.corner[(i + 1) % 3]), name(piece, i)};
      result.push_back(int(std::min_element(rank.begin(), rank.end()) - rank.begin()));
    }
    return result;
  }

  void close(const std::vector<int>& longest)
  {
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        bool is_cut = false;
        for (int i = 0; i < 3; ++i) is_cut = is_cut || middle_.count(name(pieces_[k], i)) != 0;
        if (is_cut && middle_.emplace(name(pieces_[k], longest[k]), none).second)
          has_changed = true;
      }
    }
  }

  /// The middle of an edge of a piece, made by whoever comes first.
  template <class Make>
  Index middle(const Piece& piece, int i, const Make& make)
  {
    const auto found = middle_.find(name(piece, i));
    if (found == middle_.end()) return none;
    if (found->second == none) {
      found->second = vertices_++;
      make(found->second, Support_location{piece.face, half_way(piece, i)});
    }
    return found->second;
  }

  static Vector half_way(const Piece& piece, int i)
  {
    return (piece.barycentric[i] + piece.barycentric[(i + 1) % 3]) / 2;
  }

  void add(
      Index face, const std::array<std::pair<Index, Vector>, 6>& at,
      const std::array<int, 3>& which)
  {
    Piece piece{face, {}, {}};
    for (int i = 0; i < 3; ++i)
      std::tie(piece.corner[i], piece.barycentric[i]) = at[std::size_t(which[i])];
    pieces_.push_back(piece);
  }

  /// Turned so that edge 0 is the longest: corners 0, 1, 2 and middles 3, 4, 5 of edges 0, 1, 2.
  template <class Length, class Make>
  void cut(const Piece& piece, int longest, const Length& length, const Make& make)
  {
    std::array<std::pair<Index, Vector>, 6> at;
    std::array<double, 3> size{};
    for (int i = 0; i < 3; ++i) {
      const int j = (longest + i) % 3;
      at[i] = {piece.corner[j], piece.barycentric[j]};
      at[std::size_t(i + 3)] = {middle(piece, j, make), half_way(piece, j)};
      size[i] = length(piece.corner[j], piece.corner[(j + 1) % 3]);
    }
    const bool has_4 = at[4].first != none, has_5 = at[5].first != none;
    if (at[3].first == none) {
      pieces_.push_back(piece);
    } else if (has_4 && has_5 && size[0] * size[0] < size[1] * size[1] + size[2] * size[2]) {
      // No angle is obtuse: four similar ones.
      for (const auto& which : {std::array<int, 3>{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
        add(piece.face, at, which);
    } else {
      if (has_4) add(piece.face, at, {3, 1, 4});
      add(piece.face, at, {3, has_4 ? 4 : 1, 2});
      if (has_5) add(piece.face, at, {3, 5, 0});
      add(piece.face, at, {3, 2, has_5 ? 5 : 0});
    }
  }

  std::vector<Piece> pieces_;
  Index vertices_;
  std::unordered_map<std::uint64_t, Index> middle_; ///< of each edge to be halved
};

} // namespace surety::internal::enrichment

#endif // SURETY_INTERNAL_ENRICH_REFINEMENT_H
