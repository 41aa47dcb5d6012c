// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes made from others: finer, noisy, turned.
#ifndef SURETY_BENCHMARK_REFINEMENT_H
#define SURETY_BENCHMARK_REFINEMENT_H

#include "models.h"

#include <cstddef>

namespace surety::benchmark {

/// Splits each face in four, at the midpoints of its edges.
Mesh split_in_four(const Mesh& mesh);

/// Splits each face in four and smooths, as Loop's subdivision does.
Mesh smoothed_in_four(const Mesh& mesh);

/// Moves every vertex by a random vector of at most this length along each axis.
void add_noise(Mesh& mesh, double length, unsigned seed);

/// A copy that is turned about an axis and by an angle that follow from the seed.
Mesh rotated(const Mesh& mesh, unsigned seed);

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_REFINEMENT_H
