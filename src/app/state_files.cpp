// SPDX-License-Identifier: BSD-3-Clause
#include "state_files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bubblesim/error.hpp"
#include "bubblesim/write_all.hpp"

namespace bubblesim::app {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int error) {
  throw std::runtime_error(file.string() + ": cannot write the state: " + std::strerror(error));
}

/// Writes a file that is not there, or sets errno and leaves none: in a folder of everybody, what has its name may be a
/// link to another file of this user.
bool write_new_file(const std::filesystem::path& file, std::string_view text) {
  constexpr mode_t kAsOthers = 0666;  // less the umask, as any file that the user names
  ::unlink(file.c_str());
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kAsOthers);
  if (descriptor < 0) return false;
  const bool is_written = write_all(descriptor, text);
  int error = errno;
  const bool is_closed = ::close(descriptor) == 0;
  if (is_written && is_closed) return true;
  if (is_written) error = errno;
  ::unlink(file.c_str());
  errno = error;
  return false;
}

}  // namespace

void load_state(Simulation& simulation, const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string state((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) throw std::runtime_error(file.string() + ": cannot read the saved state: " + std::strerror(errno));
  try {
    simulation.restore(state);
  } catch (const InvalidInput& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

void save_state(Simulation& simulation, const std::filesystem::path& file) {
  const std::string state = simulation.save();
  std::filesystem::path part = file;
  part += "." + std::to_string(::getpid()) + ".part";
  if (!write_new_file(part, state)) fail(file, errno);
  if (std::rename(part.c_str(), file.c_str()) == 0) return;
  const int error = errno;
  ::unlink(part.c_str());
  fail(file, error);
}

}  // namespace bubblesim::app
