// SPDX-License-Identifier: BSD-3-Clause
// The command line of the node.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bubblesim::app {

/// What the process returns to its caller.
enum ExitCode {
  kFine = 0,
  kCheckFailed = 1,
  kBadInput = 2,
  kScriptFailed = 3,  ///< with --strict
  kDiverged = 4,
};

struct Options {
  std::string scene;
  std::uint64_t seed = 0;
  std::optional<double> until;  ///< s of simulation time
  double speed = 1;             ///< simulated seconds per second; infinity: as fast as it can
  bool paused = false;
  bool ros = true;
  bool strict = false;
  bool state_hash = false;
  std::vector<std::pair<std::string, std::filesystem::path>> child_scripts;
  std::vector<std::filesystem::path> script_paths;
  bool gazebo_compat = false;
  bool lua_unsafe = false;
  bool watch = false;
  std::filesystem::path record;
  std::vector<std::string> lockstep;  ///< topics
};

/// Reads the command line. When it asks for nothing but a text (--help, --list-scenes) or cannot be used, the text is
/// printed and the exit code is returned in its place.
struct ParsedOptions {
  std::optional<Options> options;
  int exit_code = kFine;
};
ParsedOptions parse_options(int argc, char** argv);

}  // namespace bubblesim::app
