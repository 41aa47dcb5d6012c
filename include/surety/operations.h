// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the operators did and why they refused: the counters that every report shows.
#ifndef SURETY_OPERATIONS_H
#define SURETY_OPERATIONS_H

#include <array>
#include <cstddef>

namespace surety {

/// Why an operation was admitted or refused, cheapest test first.
enum class Verdict {
  accept,         ///< performed
  feature,        ///< would break a ridge, a border, a corner or a constraint
  topology,       ///< link condition, or the edge exists already
  shape,          ///< a new face is worse than shape_floor and than shape_ratio times the old ones
  roughness,      ///< a new face turns away from the normals of the input
  deviation,      ///< a point would move farther than the tolerance
  correspondence, ///< the map between input and output cannot be extended over a face
  self_intersection ///< a new face meets a face that it does not touch
};

constexpr std::size_t number_of_verdicts = 8; ///< of `Verdict`

/// The name of a verdict as reports print it.
inline const char* to_string(Verdict verdict)
{
  constexpr std::array<const char*, number_of_verdicts> names
      = {"accept",    "feature",   "topology",       "shape",
         "roughness", "deviation", "correspondence", "self_intersection"};
  return names[static_cast<std::size_t>(verdict)];
}

/// Operations performed, and refusals by reason.
struct Operations {
  std::size_t collapses = 0;                             ///< of edges into one of their ends
  std::size_t flips = 0;                                 ///< of edges into the other diagonal
  std::size_t relocations = 0;                           ///< vertices moved
  std::size_t splits = 0;                                ///< of edges, in unit meshes
  std::array<std::size_t, number_of_verdicts> refused{}; ///< by `Verdict`

  /// Adds those of another run.
  Operations& operator+=(const Operations& o)
  {
    collapses += o.collapses;
    flips += o.flips;
    relocations += o.relocations;
    splits += o.splits;
    for (std::size_t i = 0; i < number_of_verdicts; ++i) refused[i] += o.refused[i];
    return *this;
  }

  /// Counts a refusal.
  void refuse(Verdict verdict) { ++refused[static_cast<std::size_t>(verdict)]; }
};

} // namespace surety

#endif // SURETY_OPERATIONS_H
