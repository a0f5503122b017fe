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

/// The exit code of the process.
enum ExitCode {
  kFine = 0,
  kOutputLost = 1,  ///< stdout is full or closed
  kBadInput = 2,
  kScriptFailed = 3,
  kDiverged = 4,
};

/// The versions of ROS that the node uses.
enum class Ros { kNone, kRos1, kRos2, kBoth };

struct Options {
  std::string scene;
  std::uint64_t seed = 0;
  std::optional<double> until;  ///< s of simulation time
  double speed = 1;             ///< simulated seconds per second; infinity: as fast as possible
  bool paused = false;
  Ros ros = Ros::kRos1;
  bool replace = false;  ///< shut down a node of the same name
  bool strict = false;
  bool state_hash = false;
  std::filesystem::path load_state;  ///< empty: begin at the start of the scene
  std::filesystem::path save_state;  ///< empty: none
  std::vector<std::pair<std::string, std::filesystem::path>> child_scripts;
  std::vector<std::filesystem::path> script_paths;
  bool gazebo_compat = false;
  bool lua_unsafe = false;
  bool python_of_foreign_scenes = false;
  std::vector<std::string> allowed_programs;
  bool watch = false;
  std::filesystem::path record;
  std::vector<std::string> lockstep;  ///< topics
  std::optional<int> remote_port;     ///< of the remote API server
  std::string remote_address = "127.0.0.1";
  std::filesystem::path remote_token;   ///< file with the text that remote clients must know; empty: none
  std::filesystem::path window_socket;  ///< of the remote API for the window, in a folder of this user; empty: none
  bool remote_trusted = false;          ///< clients may start all programs and use all files
  bool start = false;                   ///< with the remote API server, which otherwise leaves the start to a client
  bool web = false;                     ///< start the server of the window
  std::optional<int> web_port;          ///< default: 8080, or the next free one
  std::string web_address = "127.0.0.1";
  bool web_edit = true;                ///< pages may change the simulation and files
  std::vector<std::string> arguments;  ///< NAME:=VALUE, for a xacro scene

  bool has_remote_api() const { return remote_port || !window_socket.empty(); }
};

/// Parses the command line. On --help, --list-scenes, --version or an error, prints the text and returns the exit code
/// instead of options.
struct ParsedOptions {
  std::optional<Options> options;
  int exit_code = kFine;
};
ParsedOptions parse_options(int argc, char** argv);

/// Removes the xacro arguments that are not ROS remappings from the command line, because roscpp rejects them.
void remove_xacro_arguments(const Options& options, int& argc, char** argv);

}  // namespace bubblesim::app
