// SPDX-License-Identifier: BSD-3-Clause
#include "load/limited_program.hpp"

#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "load/find/scene_folders.hpp"

namespace bubblesim {
namespace {

[[maybe_unused]] constexpr rlim_t kMostMemory = 2ULL << 30U;  // bytes
constexpr rlim_t kMostOutput = 100ULL << 20U;

/// A temporary file for the output of a program, which may be of any size and is read after the program ended.
class Output {
 public:
  Output() : file_(std::tmpfile()) {
    if (file_ == nullptr) throw std::runtime_error(std::string("cannot create a temporary file: ") + strerror(errno));
  }
  int descriptor() const { return ::fileno(file_.get()); }
  std::string text() const {
    std::string all;
    char part[4096];
    std::rewind(file_.get());
    while (const std::size_t size = std::fread(part, 1, sizeof part, file_.get())) all.append(part, size);
    return all;
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

/// A running program, in a process group with all its child processes.
class Running {
 public:
  Running(std::vector<std::string> command, const Output& output, const Output& errors) {
    // The kernel kills it when this process ends, which may have happened before the kernel was asked to.
    command.insert(command.begin(), {"setpriv", "--pdeathsig", "KILL", "sh", "-c", R"([ "$PPID" = "$0" ] && exec "$@")",
                                     std::to_string(::getpid())});
    std::vector<char*> argv;
    argv.reserve(command.size() + 1);
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, output.descriptor(), STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, errors.descriptor(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int failed = ::posix_spawnp(&child_, argv[0], &actions, &attributes, argv.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("cannot start setpriv: " + std::string(strerror(failed)));
#if !defined(__SANITIZE_ADDRESS__)  // it uses terabytes of address space
    limit(RLIMIT_AS, kMostMemory);
#endif
    limit(RLIMIT_FSIZE, kMostOutput);
  }
  ~Running() { end(); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  bool ends_within(std::chrono::milliseconds time) const {
    using Clock = std::chrono::steady_clock;
    const auto deadline = Clock::now() + time;
    const auto handle = static_cast<int>(::syscall(SYS_pidfd_open, child_, 0));  // a file descriptor for poll()
    pollfd ending{handle, POLLIN, 0};
    int ready = -1;
    do {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
      ready = ::poll(&ending, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
    } while (ready < 0 && errno == EINTR);
    ::close(handle);
    return ready > 0;
  }

  /// Returns its status as waitpid does. Also kills its child processes.
  int end() {
    if (child_ > 0) {
      ::kill(-child_, SIGKILL);
      while (::waitpid(child_, &status_, 0) < 0 && errno == EINTR) {
      }
    }
    child_ = 0;
    return status_;
  }

 private:
  void limit(int resource, rlim_t most) const {
    const rlimit limits{most, most};
    ::prlimit(child_, static_cast<__rlimit_resource>(resource), &limits, nullptr);
  }

  pid_t child_ = 0;
  int status_ = 0;
};

}  // namespace

ProgramResult run_limited(std::vector<std::string> command, std::chrono::milliseconds time) {
  const Output output;
  const Output errors;
  Running program(std::move(command), output, errors);
  const bool in_time = program.ends_within(time);
  const int status = program.end();
  return {in_time, status, output.text(), errors.text()};
}

std::string find_program(const std::string& name) {
  for (const std::filesystem::path& folder : folders_of("PATH")) {
    const std::filesystem::path found = folder / name;
    std::error_code error;
    if (std::filesystem::is_regular_file(found, error) && ::access(found.c_str(), X_OK) == 0) return found;
  }
  return {};
}

}  // namespace bubblesim
