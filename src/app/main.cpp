// SPDX-License-Identifier: BSD-3-Clause
// The node: runs a scene, its child scripts and the ROS bridge at the requested speed, until the time limit or a stop.
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <thread>

#include "bubblesim/child_scripts.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/gazebo_plugins.hpp"
#include "bubblesim/ros_bridge.hpp"
#include "bubblesim/ros_system.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/warnings.hpp"
#include "options.hpp"
#include "output.hpp"
#include "pacer.hpp"
#include "run_meter.hpp"
#include "stop_signal.hpp"

namespace bubblesim::app {
namespace {

constexpr double kIdlePeriod = 0.02;  // s, longest wait for input

/// Every step allocates and frees images and point clouds. Keep that memory in the process: getting it from the kernel
/// page by page costs more than copying the message.
void keep_freed_memory() {
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
  mallopt(M_TRIM_THRESHOLD, 64 * kMegabyte);
}

bool time_is_up(const Options& options, const Simulation& simulation) {
  // The tolerance keeps rounding from adding a step.
  return options.until && simulation.time() > *options.until - 1e-6 * simulation.time_step();
}

void wait(RosBridge* bridge) {
  if (bridge != nullptr) return bridge->wait_for_arrival(kIdlePeriod);
  std::this_thread::sleep_for(std::chrono::duration<double>(kIdlePeriod));
}

/// For people who watch the run; programs use /diagnostics.
void summarize(RunMeter& meter) {
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "%s\n", meter.summary().c_str());
}

void run(const Options& options, Simulation& simulation, RosBridge* bridge, const ChildScripts& scripts,
         RunMeter& meter) {
  Pacer pacer(options.speed);
  while (!stop_requested() && !time_is_up(options, simulation)) {
    simulation.carry_out_requests();
    meter.note(simulation, scripts);
    if (simulation.ending()) break;
    if (simulation.state() != RunState::kRunning) pacer.restart();
    if (!simulation.step_is_due()) {
      simulation.process_input();
      if (!simulation.step_is_due() && !simulation.has_requests()) wait(bridge);
    } else if (pacer.wait_for(simulation.time())) {
      try {
        meter.run_step(simulation);
      } catch (const Diverged& error) {
        if (simulation.ends_at_a_stop()) throw;  // nothing can reset it
        std::fprintf(stderr, "error: %s; paused until reset or stopped\n", error.what());
        meter.fail(error.what());
      }
    } else {
      simulation.process_input();  // also in a slow simulation
    }
    if (options.strict && scripts.failures() > 0) return;
  }
}

bool has_plugins(const SceneDescription& scene) {
  const auto plugged = [](const auto& owner) { return !owner.plugins.empty(); };
  const auto any = [&](const auto& owners) { return std::any_of(owners.begin(), owners.end(), plugged); };
  const auto any_sensor = [&](const auto& carriers) {
    return std::any_of(carriers.begin(), carriers.end(), [&](const auto& carrier) { return any(carrier.sensors); });
  };
  return plugged(scene) || any(scene.models) ||
         std::any_of(scene.models.begin(), scene.models.end(), [&](const ModelDescription& model) {
           return any(model.nested) || any_sensor(model.links) || any_sensor(model.joints);
         });
}

int run_scene(const Options& options, int& argc, char** argv) {
  const std::shared_ptr<const Scene> scene = load_scene(options.scene, options.arguments);
  print_warnings(scene->warnings());
  Simulation simulation(scene, options.seed);
  watch_stop_signals();  // before this there is nothing to shut down
  if (options.paused) simulation.pause();
  if (!options.ros || options.until) simulation.end_at_stop();  // nothing can or should start it again

  const auto meter = std::make_shared<RunMeter>(simulation, options.speed);
  std::unique_ptr<RosBridge> bridge;
  std::unique_ptr<RosSystem> ros;
  if (options.ros) {
    RosBridgeOptions ros_options;
    ros_options.on_pause = [&simulation](bool paused) { paused ? simulation.pause() : simulation.start(); };
    ros_options.is_ending = stop_requested;
    ros_options.replace = options.replace;
    ros_options.on_shutdown = [](const std::string& why) {
      std::fprintf(stderr, "info: shutdown requested: %s\n", why.c_str());
      request_stop();
    };
    ros_options.take_report = [meter] { return meter->take(); };
    bridge = std::make_unique<RosBridge>(argc, argv, ros_options);
    ros = std::make_unique<RosSystem>(*bridge, simulation);
    simulation.add(*ros);
  }
  if (stop_requested()) return kFine;
  auto guard = std::make_unique<StopGuard>(&interrupt_scripts, [&bridge] {
    if (bridge) bridge->leave();
  });
  ChildScripts scripts(simulation, bridge.get(),
                       {options.child_scripts, options.script_paths, options.lua_unsafe, options.allowed_programs,
                        options.gazebo_compat, options.watch, options.record, options.lockstep});
  std::unique_ptr<GazeboPlugins> devices;
  if (bridge || has_plugins(simulation.scene())) {  // without ROS, the skipped plugins are reported
    devices = std::make_unique<GazeboPlugins>(simulation, scripts);
    simulation.add(*devices);
  }
  simulation.add(scripts);

  try {
    run(options, simulation, bridge.get(), scripts, *meter);
  } catch (const Diverged& error) {
    meter->fail(error.what());
    if (bridge) bridge->publish_diagnostics();
    summarize(*meter);
    throw;
  }
  scripts.finish();
  guard.reset();
  summarize(*meter);
  if (options.state_hash) std::printf("%016" PRIx64 "\n", simulation.state_hash());
  // With --watch, a script that was repaired does not count as failed.
  if ((options.watch ? scripts.disabled() : scripts.failures()) > 0) return kScriptFailed;
  return scripts.output_lost() ? kOutputLost : kFine;
}

}  // namespace
}  // namespace bubblesim::app

int main(int argc, char** argv) {
  using namespace bubblesim::app;
  keep_freed_memory();
  occupy_closed_descriptors();
  std::signal(SIGPIPE, SIG_IGN);  // readers of stdout or of a script's socket may close it
  std::signal(SIGXFSZ, SIG_IGN);  // the write to a file at its size limit fails instead
  try {
    const ParsedOptions parsed = parse_options(argc, argv);
    if (parsed.options) remove_xacro_arguments(*parsed.options, argc, argv);
    const int exit_code = parsed.options ? run_scene(*parsed.options, argc, argv) : parsed.exit_code;
    return flush_output() || exit_code != kFine ? exit_code : kOutputLost;
  } catch (const bubblesim::Diverged& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return kDiverged;
  } catch (const bubblesim::SceneError& error) {
    bubblesim::print_warnings(error.warnings);
    std::fprintf(stderr, "error: %s\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return kBadInput;
  }
}
