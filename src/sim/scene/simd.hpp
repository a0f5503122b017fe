// SPDX-License-Identifier: BSD-3-Clause
// Functions compiled for several instruction sets; the program takes the best that the processor has. Their files are
// compiled without fused multiply-adds (src/sim/CMakeLists.txt), so all variants compute the same bits.
#pragma once

// The loader chooses before the run-time libraries of sanitizers are ready: their builds have one variant.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define BUBBLESIM_SIMD __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define BUBBLESIM_SIMD
#endif
