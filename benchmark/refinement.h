// SPDX-License-Identifier: GPL-3.0-or-later
//
// Large meshes made from small ones.
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

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_REFINEMENT_H
