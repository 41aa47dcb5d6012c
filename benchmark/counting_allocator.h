// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much memory the program holds by `new`, now and at most: exact, unlike the resident size,
// which depends on what the system's allocator keeps.
#ifndef SURETY_BENCHMARK_COUNTING_ALLOCATOR_H
#define SURETY_BENCHMARK_COUNTING_ALLOCATOR_H

#include <cstddef>

namespace surety::benchmark {

/// Bytes that are allocated now.
std::size_t live_bytes();

/// The largest value of live_bytes() since the last call of reset_peak_bytes().
std::size_t peak_bytes();
void reset_peak_bytes();

} // namespace surety::benchmark

#endif // SURETY_BENCHMARK_COUNTING_ALLOCATOR_H
