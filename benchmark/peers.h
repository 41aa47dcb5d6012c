// SPDX-License-Identifier: GPL-3.0-or-later
//
// Other programs that simplify meshes, behind one interface.
#ifndef SURETY_BENCHMARK_PEERS_H
#define SURETY_BENCHMARK_PEERS_H

#include "models.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace surety::benchmark {

/// What a peer is asked for: some respect a tolerance, the others are given our number of faces.
struct Goal {
  double tolerance;
  std::size_t faces;
};

struct Peer {
  std::string name;
  bool has_tolerance; ///< otherwise it stops at the number of faces
  bool is_slow;       ///< may take a minute
  /// Simplifies a mesh and returns the CPU seconds of the peer's own work, without conversions.
  std::function<double(Mesh&, const Goal&)> simplify;
};

/// CGAL's edge collapse in the order and with the placement of Lindstrom and Turk, or of Garland
/// and Heckbert, down to a number of faces.
Peer cgal_lindstrom_turk();
Peer cgal_garland_heckbert();

/// All of CGAL's, then those that were found when this program was built.
std::vector<Peer> all_peers();

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_PEERS_H
