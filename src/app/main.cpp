// SPDX-License-Identifier: BSD-3-Clause
// The node: runs a scene, its child scripts and the ROS bridge at the requested speed, until the time limit or a stop,
// and the other scenes that remote clients load.
#include <malloc.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bridges.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/warnings.hpp"
#include "options.hpp"
#include "output.hpp"
#include "ros_args.hpp"
#include "session.hpp"
#include "stop_signal.hpp"
#include "web_server.hpp"

namespace bubblesim::app {
namespace {

/// Every step allocates and frees images and point clouds. Keep that memory in the process: getting it from the kernel
/// page by page costs more than copying the message.
void keep_freed_memory() {
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
  mallopt(M_TRIM_THRESHOLD, 64 * kMegabyte);
}

/// NumPy sets these variables while it is imported, if nobody has. Then other threads run, and one that reads the
/// environment while another changes it crashes.
void set_variables_of_numpy() {
  for (const char* name : {"OPENBLAS_MAIN_FREE", "GOTOBLAS_MAIN_FREE"}) setenv(name, "1", 0);
}

/// A session with a scene that a client has asked for; if it cannot run, one with the empty scene.
std::unique_ptr<Session> next_session(Node& node, const std::shared_ptr<const Scene>& scene) {
  print_warnings(scene->warnings());
  const auto session_of = [&node](const std::shared_ptr<const Scene>& its_scene, const std::string& failure) {
    return std::make_unique<Session>(node, std::make_unique<Simulation>(its_scene, node.options.seed), false, failure);
  };
  try {
    return session_of(scene, "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return session_of(empty_scene(), error.what());
  }
}

int run_node(Options& options, int& argc, char** argv) {
  const std::shared_ptr<const Scene> scene =
      options.scene.empty() ? empty_scene() : load_scene(options.scene, options.arguments);
  print_warnings(scene->warnings());
  auto simulation = std::make_unique<Simulation>(scene, options.seed);
  const WebServer web(options);
  watch_stop_signals();  // before this there is nothing to shut down
  Node node(options);
  node.bridges = make_bridges(node, argc, argv);
  if (stop_requested()) return kFine;
  auto session = std::make_unique<Session>(node, std::move(simulation), true);
  while (const std::shared_ptr<const Scene> next = session->run()) {
    session.reset();
    session = next_session(node, next);
  }
  return session->finish();
}

int run(int given, char** given_arguments) {
  try {
    std::vector<std::string> arguments = with_plain_ros_args(given, given_arguments);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    int argc = static_cast<int>(pointers.size());
    pointers.push_back(nullptr);
    char** argv = pointers.data();
    ParsedOptions parsed = parse_options(argc, argv);
    if (parsed.options) remove_xacro_arguments(*parsed.options, argc, argv);
    const int exit_code = parsed.options ? run_node(*parsed.options, argc, argv) : parsed.exit_code;
    return flush_output() || exit_code != kFine ? exit_code : kOutputLost;
  } catch (const Diverged& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return kDiverged;
  } catch (const SceneError& error) {
    print_warnings(error.warnings);
    std::fprintf(stderr, "error: %s\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return kBadInput;
  }
}

}  // namespace
}  // namespace bubblesim::app

int main(int argc, char** argv) {
  using namespace bubblesim::app;
  keep_freed_memory();
  set_variables_of_numpy();
  occupy_closed_descriptors();
  std::signal(SIGPIPE, SIG_IGN);  // readers of stdout or of a script's socket may close it
  std::signal(SIGXFSZ, SIG_IGN);  // the write to a file at its size limit fails instead
  const int exit_code = run(argc, argv);
  std::fflush(nullptr);
  // Not std::exit(): it destroys static objects that threads of roscpp and log4cxx may still use, which then crash.
  std::quick_exit(exit_code);
}
