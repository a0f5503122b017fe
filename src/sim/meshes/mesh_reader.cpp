// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_reader.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "files/library_folder.hpp"
#include "meshes/mesh_error.hpp"
#include "meshes/mesh_limits.hpp"
#include "meshes/mesh_stream.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

/// A pair of stream sockets. This process's end is close-on-exec, also for programs started elsewhere.
struct SocketPair {
  SocketPair() {
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      throw MeshError(std::string("cannot be read: cannot create a socket (") + std::strerror(errno) + ")");
    }
  }
  ~SocketPair() {
    for (const int end : ends) {
      if (end >= 0) ::close(end);
    }
  }
  SocketPair(const SocketPair&) = delete;
  SocketPair& operator=(const SocketPair&) = delete;

  int ends[2] = {-1, -1};
};

/// Starts the program with `socket` as its input and no other open files.
pid_t start(const fs::path& program, int socket) {
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

std::string reason_of_end(int status, std::uint64_t size) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    return "it takes more than " + std::to_string(mesh_seconds(size)) + " s";
  }
  if (WIFSIGNALED(status)) {
    return "its reader crashed with signal " + std::string(::sigabbrev_np(WTERMSIG(status)));
  }
  return "its reader ended";
}

std::uint64_t digest_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  constexpr std::size_t kPart = 1U << 20U;
  std::vector<char> buffer(sizeof(std::uint64_t) + kPart);  // each part is preceded by the digest of the earlier parts
  std::uint64_t digest = 0;
  while (stream.read(buffer.data() + sizeof digest, kPart), stream.gcount() > 0) {
    std::memcpy(buffer.data(), &digest, sizeof digest);
    digest = std::hash<std::string_view>()({buffer.data(), sizeof digest + static_cast<std::size_t>(stream.gcount())});
  }
  if (stream.bad() || !stream.eof()) throw MeshError("cannot be read");
  return digest;
}

}  // namespace

class MeshReader::Process {
 public:
  Process() : child_(start(library_folder() / "bubblesim" / "mesh_reader", sockets_.ends[1])) {
    ::close(std::exchange(sockets_.ends[1], -1));
  }
  ~Process() { end(); }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Throws StreamClosed and StreamTimeout.
  MeshContent ask(const MeshQuery& query) {
    MeshStream stream(sockets_.ends[0]);
    // The reader limits its own CPU time; this limit is for a reader that waits.
    stream.set_deadline(MeshStream::Clock::now() + std::chrono::seconds(30 + 4 * mesh_seconds(query.size)));
    each_value(query, [&stream](const auto& value) { stream.send(value); });
    MeshContent content;
    const auto step = [&stream](auto& value) { stream.receive(value); };
    each_array(content, step);
    std::uint64_t materials = 0;
    stream.receive(materials);
    for (std::uint64_t i = 0; i < materials; ++i) each_part(content.materials.emplace_back(), step);
    return content;
  }

  /// Returns its status as waitpid does.
  int end() {
    if (child_ <= 0) return 0;
    ::kill(child_, SIGKILL);  // does nothing if it ended already
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = 0;
    return status;
  }

 private:
  SocketPair sockets_;
  pid_t child_;
};

MeshReader::MeshReader() = default;
MeshReader::~MeshReader() = default;

const MeshReader::Content& MeshReader::content(const std::string& file) {
  const auto [found, is_new] = contents_.try_emplace(file);
  if (!is_new) return found->second;
  try {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
      throw MeshError(fs::exists(file, error) ? "is not a regular file" : "does not exist");
    }
    const std::uint64_t size = fs::file_size(file, error);
    if (error) throw MeshError("cannot be read (" + error.message() + ")");
    if (size > kLargestMeshFile) {
      throw MeshError("is " + std::to_string(size / kMegabyte) + " MB large; the maximum is " +
                      std::to_string(kLargestMeshFile / kMegabyte) + " MB");
    }
    found->second = {size, digest_of(file)};
  } catch (const MeshError&) {
    contents_.erase(found);
    throw;
  }
  return found->second;
}

MeshContent MeshReader::read(const MeshQuery& query) {
  if (process_ == nullptr) process_ = std::make_unique<Process>();
  try {
    MeshContent content = process_->ask(query);
    if (!content.error.empty() && content.part_names.empty()) throw MeshError(content.error);
    return content;
  } catch (const StreamClosed&) {
    const int status = std::exchange(process_, nullptr)->end();
    throw MeshError("cannot be read as a mesh (" + reason_of_end(status, query.size) + "): the file is damaged");
  } catch (const StreamTimeout&) {
    process_.reset();
    throw MeshError("cannot be read as a mesh (its reader does not answer): the file is damaged, or its disk is slow");
  }
}

}  // namespace bubblesim
