// SPDX-License-Identifier: BSD-3-Clause
// Other programs that read files for a load: they may never end, or take all memory.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace bubblesim {

struct ProgramResult {
  bool in_time = true;  ///< it ended by itself
  int status = 0;       ///< as waitpid gives it
  std::string output;
  std::string errors;
};

/// Runs a command, whose first word is a path, to its end, or ends it after `time`, when it takes 2 GB of memory,
/// writes over 100 MB, or this process ends; with all that it started. Throws std::runtime_error when it cannot be
/// started.
ProgramResult run_limited(std::vector<std::string> command, std::chrono::milliseconds time);

/// The path of a program on PATH; empty when there is none.
std::string find_program(const std::string& name);

}  // namespace bubblesim
