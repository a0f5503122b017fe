// SPDX-License-Identifier: BSD-3-Clause
#include "web_server.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <spawn.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace bubblesim::app {
namespace {

constexpr int kLifelineOfServer = 3;

/// A port that nobody else is given. Its socket stays open: a port that is only looked at may be taken by another
/// process before the door listens. The door may share it (SO_REUSEADDR), since this socket does not listen.
int free_port() {
  const int probe = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  const int shared = 1;
  const bool found = probe >= 0 && setsockopt(probe, SOL_SOCKET, SO_REUSEADDR, &shared, sizeof shared) == 0 &&
                     bind(probe, generic, size) == 0 && getsockname(probe, generic, &size) == 0;
  if (!found) throw std::runtime_error(std::string("--web: no free port for the door: ") + std::strerror(errno));
  return ntohs(address.sin_port);
}

}  // namespace

void complete_for_web(Options& options) {
  if (!options.web) return;
  if (!options.remote_port) {
    options.remote_port = free_port();
    options.start = !options.paused;
  } else if (*options.remote_port == 0) {
    options.remote_port = free_port();
  }
}

WebServer::WebServer(const Options& options) {
  if (!options.web) return;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "bubblesim";
  std::vector<std::string> arguments = {program.string(), "view",
                                        "--door",         std::to_string(*options.remote_port),
                                        "--until-closed", std::to_string(kLifelineOfServer),
                                        "--address",      options.web_address};
  if (options.web_port) arguments.insert(arguments.end(), {"--port", std::to_string(*options.web_port)});
  if (!options.web_edit) arguments.emplace_back("--look");
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
