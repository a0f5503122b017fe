// SPDX-License-Identifier: BSD-3-Clause
// Runs the scene `tricycle` with a script like the node, one simulation step per period, for disturbance.py:
//   step_times SCRIPT PERIOD_IN_MS
// For each line on standard input it prints the median and the 99th percentile of the step times since the last line,
// in microseconds.
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "bubblesim/child_scripts.hpp"
#include "bubblesim/ros_bridge.hpp"
#include "bubblesim/ros_system.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"

namespace {

using namespace bubblesim;
using Clock = std::chrono::steady_clock;

double percentile(std::vector<double>& values, double part) {
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

bool has_input() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  return poll(&input, 1, 0) > 0;
}

}  // namespace

int main(int argc, char** argv) {
  RosBridge bridge(argc, argv);
  if (argc != 3) return 2;
  const std::chrono::milliseconds period(std::atoi(argv[2]));
  Simulation simulation(load_scene("tricycle"));
  RosSystem ros(bridge, simulation);
  simulation.add(ros);
  ScriptOptions script;
  script.replacements = {{"/Tricycle", argv[1]}};
  Runner runner(simulation);
  PythonEngine python;
  python.begin(runner, {&bridge});
  ChildScripts scripts(python, script);
  simulation.add(scripts);

  std::vector<double> took;
  for (Clock::time_point next = Clock::now();; next += period) {
    std::this_thread::sleep_until(next);
    const Clock::time_point begin = Clock::now();
    simulation.step();
    took.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    if (!has_input()) continue;
    if (std::getchar() == EOF || scripts.failures() > 0) break;
    std::printf("%f %f\n", percentile(took, 0.5), percentile(took, 0.99));
    std::fflush(stdout);
    took.clear();
  }
  return scripts.failures();
}
