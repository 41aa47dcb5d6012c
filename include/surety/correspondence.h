// SPDX-License-Identifier: GPL-3.0-or-later
//
// The record of the map phi from an input mesh T to an output mesh M: plain arrays that a third
// party can write, read and check.
#ifndef SURETY_CORRESPONDENCE_H
#define SURETY_CORRESPONDENCE_H

#include <array>
#include <cstdint>
#include <vector>

namespace surety {

/// \brief A continuous map phi from an input mesh T onto an output mesh M, written down on the
/// vertices and edges of T.
///
/// Vertices and faces of either mesh are named by their position in the iteration order of the
/// mesh, which is their position in a file; edges by their two end vertices, the smaller first.
///
/// phi maps a vertex of T to a vertex of M, or to the closest point of an edge or a face. An edge
/// of T that leaves a face of M has *crossings*, in order: the point (1 - lambda) x_s + lambda x_t
/// goes to the closest point of an edge of M. Between two of these *items* phi is linear, inside
/// one closed face of M. It extends over the triangles of T by cutting them into cells with corners
/// among the items, so that each cell has its corners in one closed face; the cells are not
/// recorded, whoever needs them finds them again. Where the crossings around a triangle wind once
/// about a vertex of M, to which no vertex of T goes, a point inside the triangle does: an *inner
/// item*, from which the cells about it fan out.
struct Correspondence {
  /// What a vertex of T goes to: a vertex of M, a point of an edge, or of a face.
  enum class Kind : std::uint8_t { vertex, edge, face };

  /// Where a vertex of T goes.
  struct Image {
    Kind kind = Kind::vertex; ///< what the indices count
    std::uint32_t a = 0;      ///< the vertex, the smaller end of the edge, or the face
    std::uint32_t b = 0;      ///< the larger end of the edge, otherwise 0
  };

  /// Where an edge of T crosses an edge of M.
  struct Crossing {
    std::uint32_t a = 0; ///< the smaller end of the edge of M
    std::uint32_t b = 0; ///< the larger one
    double lambda = 0;   ///< in [0, 1], never decreasing from s to t
  };

  /// Which point inside a face of T goes to a vertex of M: (1 - lambda - mu) x_a + lambda x_b +
  /// mu x_c, where a < b < c are the vertices of the face.
  struct Inner {
    std::uint32_t face = 0;   ///< of T
    std::uint32_t vertex = 0; ///< of M
    double lambda = 0;        ///< not negative
    double mu = 0;            ///< not negative; lambda + mu is at most 1
  };

  std::vector<Image> images;                        ///< one a vertex of T
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< (s, t), s < t: edges of T with crossings,
                                                    ///< sorted, each once
  std::vector<std::uint32_t> offsets;               ///< crossings of edges[i]: from offsets[i] to
                                                    ///< offsets[i + 1]; one more than edges
  std::vector<Crossing> crossings;                  ///< along each edge from s to t
  std::vector<Inner> inner;                         ///< sorted by face, at most one in each
  std::vector<std::array<std::uint32_t, 2>> ridges; ///< (s, t), s < t: interior edges of T that
                                                    ///< make up a curve which M keeps as a curve
};

} // namespace surety

#endif // SURETY_CORRESPONDENCE_H
