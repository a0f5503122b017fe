// SPDX-License-Identifier: BSD-3-Clause
#include "run/last_states_file.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <mutex>
#include <sstream>
#include <string_view>

#include "bubblesim/write_all.hpp"

namespace bubblesim {
namespace {

constexpr std::string_view kSuffix = ".csv";

/// Closes a file descriptor.
struct Descriptor {
  explicit Descriptor(int number_) : number(number_) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  const int number;
};

/// Creates a file that did not exist, with a name that others cannot foresee: the folder is everybody's. Returns its
/// path, empty on failure.
std::string create_file() {
  std::error_code failed;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(failed);
  if (failed) return "";
  std::string path = folder / ("bubblesim_diverged_" + std::to_string(::getpid()) + "_XXXXXX");
  path += kSuffix;
  const Descriptor made(::mkostemps(path.data(), static_cast<int>(kSuffix.size()), O_CLOEXEC));
  return made.number >= 0 ? path : "";
}

bool replace_contents(const std::string& path, std::string_view text) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_TRUNC | O_NOFOLLOW | O_CLOEXEC));
  return file.number >= 0 && write_all(file.number, text);
}

}  // namespace

std::string write_last_states(const World& world) {
  static std::mutex mutex;
  static std::string path;
  static pid_t process = 0;
  std::ostringstream states;
  world.write_last_states(states);
  const std::lock_guard lock(mutex);
  const auto is_written = [&] { return process == ::getpid() && replace_contents(path, states.str()); };
  if (is_written()) return path;
  path = create_file();  // at first, in the child of a fork, and when the file was removed
  process = ::getpid();
  return is_written() ? path : "";
}

}  // namespace bubblesim
