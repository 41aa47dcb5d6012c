// SPDX-License-Identifier: GPL-3.0-or-later
//
// The record that proves the distance of any two meshes: who covers whom.
#ifndef SURETY_COVERING_H
#define SURETY_COVERING_H

#include <cstdint>
#include <vector>

namespace surety {

/// \brief Says of each face of two meshes which faces of the other one it lies near to.
///
/// It proves that the Hausdorff distance of the meshes is at most `bound`: each face can be divided
/// into parts such that each part lies within the bound of *one* of the triangles named for the
/// face. `check_covering()` finds such parts anew, so that the record need not be trusted. It
/// serves meshes of any origin; a `Correspondence` says more about meshes that one was simplified
/// to.
///
/// Faces are numbered from 0 in the order of their mesh.
struct Covering {
  /// For each face of a mesh a list of faces of the other one.
  struct Faces {
    std::vector<std::uint32_t> first{0};  ///< where the list of a face begins; and the end of all
    std::vector<std::uint32_t> witnesses; ///< the lists, one after another
  };

  double tolerance = 0; ///< the distance that was asked for, a length
  double bound = 0;     ///< the distance that is proven, a length
  Faces of_input;       ///< of each face of the first mesh, in the second
  Faces of_output;      ///< of each face of the second mesh, in the first
};

} // namespace surety

#endif // SURETY_COVERING_H
