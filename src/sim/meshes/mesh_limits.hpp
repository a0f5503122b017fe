// SPDX-License-Identifier: BSD-3-Clause
// Limits for reading a mesh file or an image. Intact files need a tenth of them.
#pragma once

#include <cstdint>

namespace bubblesim {

constexpr std::uint64_t kMegabyte = 1ULL << 20U;
constexpr std::uint64_t kLargestMeshFile = 1024 * kMegabyte;
constexpr std::uint64_t kLargestPictureFile = 1024 * kMegabyte;

/// Memory in bytes, for a file of `size` bytes.
constexpr std::uint64_t mesh_memory(std::uint64_t size) { return 256 * kMegabyte + 20 * size; }

/// CPU time in seconds.
constexpr std::uint64_t mesh_seconds(std::uint64_t size) { return 10 + size / kMegabyte; }

}  // namespace bubblesim
