// SPDX-License-Identifier: BSD-3-Clause
#include "load/urdf/xacro.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include "bubblesim/error.hpp"
#include "load/find/scene_folders.hpp"
#include "load/limited_program.hpp"

namespace bubblesim {
namespace {

constexpr const char* kTimeVariable = "BUBBLESIM_XACRO_SECONDS";

/// `env PYTHONPATH=...`, with which xacro finds packages as ROS 1 does.
std::vector<std::string> with_packages() {
  const char* given = std::getenv("PYTHONPATH");
  const std::string path = shared_folder("xacro_packages", BUBBLESIM_XACRO_PACKAGES).string();
  return {"/usr/bin/env", "PYTHONPATH=" + path + (given != nullptr ? ":" + std::string(given) : "")};
}

/// The last line, without those in which xacro lists the files of an error.
std::string last_line(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    const bool is_place = line.rfind("when ", 0) == 0 || line.rfind("included from", 0) == 0;
    if (!line.empty() && !is_place) last = line;
  }
  return last;
}

/// Time limit of xacro.
std::chrono::milliseconds time_limit() {
  const char* given = std::getenv(kTimeVariable);
  const double seconds = given != nullptr ? std::atof(given) : 0;
  return seconds > 0 && seconds < 1e6 ? std::chrono::milliseconds(static_cast<long>(1000 * seconds))
                                      : std::chrono::seconds(30);
}

/// The program on PATH, or else that of the virtual environment of this build.
std::string program() {
  std::string found = find_program("xacro");
  std::string own = BUBBLESIM_VIRTUAL_ENV "/bin/xacro";
  if (!found.empty() || !std::filesystem::is_regular_file(own)) return found;
  return own;
}

}  // namespace

std::string run_xacro(const std::filesystem::path& file, const XacroArguments& arguments) {
  const auto fail = [&](const std::string& message) { throw SceneError({{file.string(), 0, "", message}}); };
  const std::string xacro = program();
  if (xacro.empty()) fail("the program xacro is not on PATH; install it: pip install xacro==2.1.1");
  const std::chrono::milliseconds time = time_limit();
  std::vector<std::string> command = with_packages();
  command.insert(command.end(), {xacro, file.string()});
  command.insert(command.end(), arguments.begin(), arguments.end());
  const ProgramResult result = run_limited(command, time);
  if (!result.in_time) {
    fail("xacro did not end within " + std::to_string(std::chrono::duration<double>(time).count()).substr(0, 4) +
         " s and was killed; " + kTimeVariable + " sets the limit");
  }
  if (!WIFEXITED(result.status) || WEXITSTATUS(result.status) != 0) {
    const std::string reason = WIFSIGNALED(result.status)
                                   ? "it was killed by signal " + std::string(::sigabbrev_np(WTERMSIG(result.status)))
                                   : last_line(result.errors);
    fail("xacro failed: " + reason + " (run 'xacro " + file.string() + "' for details)");
  }
  return result.output;
}

}  // namespace bubblesim
