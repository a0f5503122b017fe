// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/reader_program.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

namespace bubblesim {
namespace {

/// Address space of this process in bytes.
std::uint64_t memory_in_use() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  file >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void set_memory_limit(std::uint64_t bytes) {
#if !defined(__SANITIZE_ADDRESS__)  // it uses terabytes of address space
  rlimit limit{bytes, RLIM_INFINITY};
  ::setrlimit(RLIMIT_AS, &limit);
#else
  static_cast<void>(bytes);
#endif
}

bool is_socket(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
}

}  // namespace

bool begin_reading(const char* program, const char* files) {
  if (!is_socket(STDIN_FILENO)) {
    std::fprintf(stderr, "%s is started by bubblesim to read the %s of a scene; it cannot be run directly\n", program,
                 files);
    return false;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with the simulator
  ::signal(SIGINT, SIG_IGN);           // a terminal sends it to both processes
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  return true;
}

void set_limits(std::uint64_t seconds, std::uint64_t bytes) {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto until_now = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1);
  rlimit time{until_now + seconds, RLIM_INFINITY};
  ::setrlimit(RLIMIT_CPU, &time);
  set_memory_limit(memory_in_use() + bytes);
}

void lift_memory_limit() { set_memory_limit(RLIM_INFINITY); }

}  // namespace bubblesim
