// SPDX-License-Identifier: BSD-3-Clause
// What a program that reads files for a simulator does in its own process: it limits itself, and ends with the
// simulator.
#pragma once

#include <cstdint>

namespace bubblesim {

/// Prepares the process. Returns false, and prints why, if it was not started by a simulator.
bool begin_reading(const char* program, const char* files);

/// Sets limits for the next file: the kernel kills the process when it exceeds its CPU time, and denies more memory.
void set_limits(std::uint64_t seconds, std::uint64_t bytes);

void lift_memory_limit();

}  // namespace bubblesim
