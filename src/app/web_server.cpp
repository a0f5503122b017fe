// SPDX-License-Identifier: BSD-3-Clause
#include "web_server.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace bubblesim::app {
namespace {

constexpr int kLifelineOfServer = 3;

}  // namespace

PrivateFolder::PrivateFolder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  for (const std::filesystem::path parent : {runtime != nullptr ? runtime : "", "/tmp"}) {
    std::string name = (parent / "bubblesim-XXXXXX").string();
    if (!parent.is_absolute() || mkdtemp(name.data()) == nullptr) continue;  // its mode is 0700
    path_ = name;
    return;
  }
  throw std::runtime_error(std::string("--web: no folder in /tmp for the window's socket: ") + std::strerror(errno));
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

WebServer::WebServer(Options& options) {
  if (!options.web) return;
  options.window_socket = folder_.emplace().path() / "api";
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "bubblesim";
  std::vector<std::string> arguments = {program.string(), "view",
                                        "--remote",       options.window_socket.string(),
                                        "--until-closed", std::to_string(kLifelineOfServer),
                                        "--address",      options.web_address};
  if (options.web_port) arguments.insert(arguments.end(), {"--port", std::to_string(*options.web_port)});
  if (!options.remote_token.empty())
    arguments.insert(arguments.end(), {"--remote-token", options.remote_token.string()});
  if (!options.web_edit) arguments.emplace_back("--read-only");
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::runtime_error(std::string("--web: ") + std::strerror(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[0], kLifelineOfServer);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setpgroup(&attributes, 0);  // Ctrl-C is for the node, which ends the server
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process = 0;
  const int error = posix_spawn(&process, program.c_str(), &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe[0]);
  lifeline_ = pipe[1];
  if (error != 0) {
    close(lifeline_);
    throw std::runtime_error("--web: cannot start " + program.string() + ": " + std::strerror(error));
  }
}

WebServer::~WebServer() {
  if (lifeline_ >= 0) close(lifeline_);
}

}  // namespace bubblesim::app
