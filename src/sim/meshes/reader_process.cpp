// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/reader_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "files/library_folder.hpp"
#include "meshes/mesh_error.hpp"

namespace bubblesim {
namespace {

/// Starts the program with `socket` as its input and no other open files.
pid_t start(const std::filesystem::path& program, int socket) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  sigset_t signals;
  sigemptyset(&signals);
  ::posix_spawnattr_setsigmask(&attributes, &signals);
  sigfillset(&signals);
  ::posix_spawnattr_setsigdefault(&attributes, &signals);
  std::string name = program.string();
  char* const argv[] = {name.data(), nullptr};
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, name.c_str(), &actions, &attributes, argv, environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) {
    throw MeshError("cannot be read: the program " + name + " cannot be started (" + std::strerror(failed) +
                    "): rebuild and install bubblesim");
  }
  return child;
}

}  // namespace

ReaderProcess::SocketPair::SocketPair() {
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw MeshError(std::string("cannot be read: cannot create a socket (") + std::strerror(errno) + ")");
  }
}

ReaderProcess::SocketPair::~SocketPair() {
  for (const int end : ends) {
    if (end >= 0) ::close(end);
  }
}

ReaderProcess::ReaderProcess(const std::string& name)
    : child_(start(library_folder() / "bubblesim" / name, sockets_.ends[1])) {
  ::close(std::exchange(sockets_.ends[1], -1));
}

std::string ReaderProcess::reason_of_end(std::uint64_t seconds) {
  const int status = end();
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) return "it takes more than " + std::to_string(seconds) + " s";
  if (WIFSIGNALED(status)) {
    return "its reader crashed with signal " + std::string(::sigabbrev_np(WTERMSIG(status)));
  }
  return "its reader ended";
}

int ReaderProcess::end() {
  if (child_ <= 0) return 0;
  ::kill(child_, SIGKILL);  // does nothing if it ended already
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = 0;
  return status;
}

}  // namespace bubblesim
