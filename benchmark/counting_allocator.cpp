// SPDX-License-Identifier: GPL-3.0-or-later
//
// Replaces the global operators new and delete; the forms that are not replaced call these. Sizes
// are what malloc really set aside. For programs of one thread.
#include "counting_allocator.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

std::size_t live = 0;
std::size_t peak = 0;

void* count(void* memory)
{
  if (memory == nullptr) throw std::bad_alloc();
  live += malloc_usable_size(memory);
  peak = std::max(peak, live);
  return memory;
}

void release(void* memory)
{
  if (memory != nullptr) live -= malloc_usable_size(memory);
  std::free(memory);
}

} // namespace

void* operator new(std::size_t size) { return count(std::malloc(std::max<std::size_t>(size, 1))); }

void* operator new(std::size_t size, std::align_val_t alignment)
{
  const auto multiple = static_cast<std::size_t>(alignment);
  return count(std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple));
}

void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

namespace surety::benchmark {

std::size_t live_bytes() { return live; }
std::size_t peak_bytes() { return peak; }
void reset_peak_bytes() { peak = live; }

} // namespace surety::benchmark
