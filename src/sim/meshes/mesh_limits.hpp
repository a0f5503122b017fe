// SPDX-License-Identifier: BSD-3-Clause
// What reading a mesh file may take. Intact files take a tenth of it.
#pragma once

#include <cstdint>

namespace bubblesim {

constexpr std::uint64_t kMegabyte = 1ULL << 20U;
constexpr std::uint64_t kLargestMeshFile = 1024 * kMegabyte;

/// Of a file of `size` bytes, in bytes.
constexpr std::uint64_t mesh_memory(std::uint64_t size) { return 256 * kMegabyte + 20 * size; }

/// Of the processor, in seconds.
constexpr std::uint64_t mesh_seconds(std::uint64_t size) { return 10 + size / kMegabyte; }

}  // namespace bubblesim
