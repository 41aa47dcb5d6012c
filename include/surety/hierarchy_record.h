// SPDX-License-Identifier: GPL-3.0-or-later
//
// The record of a hierarchy: the operations that lead from the input to the coarsest level, as
// plain arrays that a third party can write, read and make again.
#ifndef SURETY_HIERARCHY_RECORD_H
#define SURETY_HIERARCHY_RECORD_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace surety {

/// \brief The operations of a hierarchy in their order, and where its levels are among them.
///
/// Vertices are named by their position in the iteration order of the input, which is their
/// position in a file, and keep that name as long as they live. Twelve bytes an operation, and 24
/// more where a vertex moves.
struct Hierarchy_record {
  /// What an operation does to its source and target.
  enum class Kind : std::uint8_t {
    collapse,  ///< the source goes to the target and is gone
    flip,      ///< the edge becomes the other diagonal of its two faces
    placement, ///< a collapse, then the target moves to a point
    relocation ///< the source moves to a point; the target is the source
  };

  /// One operation, by the names of the vertices.
  struct Operation {
    std::uint32_t source = 0;   ///< the vertex that goes or moves
    std::uint32_t target = 0;   ///< the other end of the edge
    Kind kind = Kind::collapse; ///< what becomes of them
    /// Whether the mesh is within the tolerance afterwards. It need not be inside a transaction,
    /// which exceeds the tolerance and comes back.
    bool is_boundary = true;
  };

  /// A level, and where it is among the operations.
  struct Level {
    double tolerance = 0;         ///< the distance that was asked for, a length
    double bound = 0;             ///< the distance that is proven, a length
    std::uint32_t operations = 0; ///< how many lead to it, from the input
  };

  std::uint64_t fingerprint = 0;             ///< of the input's points and faces
  std::uint32_t vertices = 0;                ///< of the input
  std::vector<Level> levels;                 ///< from fine to coarse
  std::vector<Operation> operations;         ///< in their order
  std::vector<std::array<double, 3>> points; ///< of placements and relocations, in their order
};

} // namespace surety

#endif // SURETY_HIERARCHY_RECORD_H
