// SPDX-License-Identifier: BSD-3-Clause
// Runs other programs that read files for a load, with limits: they may hang or use all memory.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace bubblesim {

struct ProgramResult {
  bool in_time = true;  ///< it ended by itself, not killed
  int status = 0;       ///< as returned by waitpid
  std::string output;
  std::string errors;
};

/// Runs a command, whose first word is a path, until it ends. Kills it and its child processes after `time`, when it
/// uses more than 2 GB of memory or writes more than 100 MB, and when this process ends. Throws std::runtime_error when
/// it cannot be started.
ProgramResult run_limited(std::vector<std::string> command, std::chrono::milliseconds time);

/// The path of a program on PATH; empty when it is not found.
std::string find_program(const std::string& name);

}  // namespace bubblesim
