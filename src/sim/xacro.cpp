// SPDX-License-Identifier: BSD-3-Clause
#include "xacro.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>

#include "bubblesim/error.hpp"

namespace bubblesim {
namespace {

/// A file without a name that holds what a program writes: it may write as much as it likes before anybody reads.
class Output {
 public:
  Output() : file_(std::tmpfile()) {}
  /// -1 when there is no room for it.
  int descriptor() const { return file_ != nullptr ? ::fileno(file_.get()) : -1; }
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

/// The exit status of `program FILE`, or nothing when there is no such program.
bool run(const std::string& program, const std::string& file, const Output& output, const Output& errors, int& status) {
  std::string arguments[] = {program, file};
  char* const argv[] = {arguments[0].data(), arguments[1].data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, output.descriptor(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, errors.descriptor(), STDERR_FILENO);
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, argv, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return false;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return true;
}

std::string last_line(std::string text) {
  text.erase(text.find_last_not_of('\n') + 1);
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

std::string run_xacro(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& message) { throw SceneError({{file.string(), 0, "", message}}); };
  const Output output;
  const Output errors;
  if (output.descriptor() < 0 || errors.descriptor() < 0) fail("there is no room for what xacro writes");
  int status = 0;
  if (!run("xacro", file.string(), output, errors, status) &&
      !run(BUBBLESIM_VIRTUAL_ENV "/bin/xacro", file.string(), output, errors, status)) {
    fail("needs the program xacro, which is not on PATH: pip install xacro==1.13.3");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    fail("xacro cannot expand it: " + last_line(errors.text()) + " ('xacro " + file.string() + "' says more)");
  }
  return output.text();
}

}  // namespace bubblesim
