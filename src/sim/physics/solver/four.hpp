// SPDX-License-Identifier: BSD-3-Clause
// Four numbers with which GCC and clang compute at once, with two or one instruction: for functions that are compiled
// for several instruction sets (scene/simd.hpp).
#pragma once

#include <cstring>

// Functions that take or return groups must become part of their callers: the instruction sets pass groups differently,
// of which GCC and clang warn also where nothing is passed in the end.
#define BUBBLESIM_INLINE __attribute__((always_inline)) inline
#pragma GCC diagnostic ignored "-Wpsabi"

namespace bubblesim {

/// Aligned also where a file is compiled without AVX: functions compiled for AVX rely on it.
using Four = double __attribute__((vector_size(32), aligned(32), may_alias));

/// Four of the numbers of an array, which may start anywhere: a reference to them would have to be aligned to 32 bytes,
/// and clang reads it so.
BUBBLESIM_INLINE Four load_four(const double* numbers) {
  Four four;
  std::memcpy(&four, numbers, sizeof four);
  return four;
}
BUBBLESIM_INLINE void store_four(double* numbers, const Four& four) { std::memcpy(numbers, &four, sizeof four); }

/// 0 and -0 differ.
BUBBLESIM_INLINE bool has_same_bits(const Four& a, const Four& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace bubblesim
