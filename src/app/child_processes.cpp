// SPDX-License-Identifier: BSD-3-Clause
#include "child_processes.hpp"

#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace bubblesim::app {

void signal_child_processes(int signal) {
  std::error_code error;  // the folder of a thread that ends meanwhile disappears
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", error)) {
    std::ifstream children(thread.path() / "children");
    for (pid_t child = 0; children >> child;) kill(getpgid(child) == child ? -child : child, signal);
  }
}

}  // namespace bubblesim::app
