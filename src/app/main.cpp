// SPDX-License-Identifier: BSD-3-Clause
// The node: runs a scene, its child scripts and the ROS bridge at the requested speed, until the time limit or a stop.
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "bubblesim/child_scripts.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/gazebo_plugins.hpp"
#include "bubblesim/node_services.hpp"
#include "bubblesim/observers.hpp"
#include "bubblesim/remote_door.hpp"
#include "bubblesim/ros_bridge.hpp"
#include "bubblesim/ros_system.hpp"
#include "bubblesim/runner.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/warnings.hpp"
#include "options.hpp"
#include "output.hpp"
#include "stop_signal.hpp"

namespace bubblesim::app {
namespace {

/// Every step allocates and frees images and point clouds. Keep that memory in the process: getting it from the kernel
/// page by page costs more than copying the message.
void keep_freed_memory() {
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
  mallopt(M_TRIM_THRESHOLD, 64 * kMegabyte);
}

/// For people who watch the run; programs use /diagnostics.
void summarize(Runner& runner) {
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "%s\n", runner.summary().c_str());
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

/// Calls a function at the end of its scope.
class Finally {
 public:
  explicit Finally(std::function<void()> action) : action_(std::move(action)) {}
  ~Finally() { action_(); }
  Finally(const Finally&) = delete;
  Finally& operator=(const Finally&) = delete;

 private:
  const std::function<void()> action_;
};

/// The numbers of failed scripts, for threads that may outlive the scripts; after those, their last values.
class ScriptCounts {
 public:
  void watch(const ChildScripts& scripts) {
    const std::lock_guard lock(mutex_);
    scripts_ = &scripts;
  }
  void keep() {
    const std::lock_guard lock(mutex_);
    failures_ = scripts_->failures();
    disabled_ = scripts_->disabled();
    scripts_ = nullptr;
  }
  int failures() const {
    const std::lock_guard lock(mutex_);
    return scripts_ != nullptr ? scripts_->failures() : failures_;
  }
  int disabled() const {
    const std::lock_guard lock(mutex_);
    return scripts_ != nullptr ? scripts_->disabled() : disabled_;
  }

 private:
  mutable std::mutex mutex_;
  const ChildScripts* scripts_ = nullptr;
  int failures_ = 0;
  int disabled_ = 0;
};

RunnerOptions runner_options(const Options& options, const ScriptCounts& counts) {
  RunnerOptions how;
  how.speed = options.speed;
  how.initial = options.paused ? RunState::kPaused : RunState::kRunning;
  if (options.remote_port && !options.start && !options.paused) how.initial = RunState::kStopped;
  if (options.until) how.until = *options.until;
  how.ends_at_stop = (!options.ros && !options.remote_port) || options.until;  // nothing can or should start it again
  how.is_ending = [&counts, strict = options.strict] { return stop_requested() || (strict && counts.failures() > 0); };
  how.on_divergence = [](const std::string& why) {
    std::fprintf(stderr, "error: %s; paused until reset or stopped\n", why.c_str());
  };
  return how;
}

RosBridgeOptions ros_options(const Options& options, Runner& runner, const ScriptCounts& counts) {
  RosBridgeOptions how;
  how.on_pause = [&runner](bool paused) { paused ? runner.pause() : runner.start(); };
  how.on_step = [&runner](std::uint32_t steps) -> StepAnswer {
    try {
      return {"", runner.step(steps).get()};
    } catch (const std::exception& error) {
      return {error.what(), runner.frame()->time};
    }
  };
  how.on_arrival = [&runner] { runner.wake(); };
  how.is_ending = stop_requested;
  how.replace = options.replace;
  how.on_shutdown = [](const std::string& why) {
    std::fprintf(stderr, "info: shutdown requested: %s\n", why.c_str());
    request_stop();
  };
  how.take_report = [&runner, &counts] {
    RunReport report = runner.take_report();
    report.script_errors = counts.failures();
    report.disabled_scripts = counts.disabled();
    return report;
  };
  return how;
}

int run_scene(const Options& options, int& argc, char** argv) {
  const std::shared_ptr<const Scene> scene = load_scene(options.scene, options.arguments);
  print_warnings(scene->warnings());
  Simulation simulation(scene, options.seed);
  watch_stop_signals();  // before this there is nothing to shut down
  ScriptCounts counts;
  Runner runner(simulation, runner_options(options, counts));

  std::unique_ptr<RosBridge> bridge;
  std::unique_ptr<RosSystem> ros;
  if (options.ros) {
    bridge = std::make_unique<RosBridge>(argc, argv, ros_options(options, runner, counts));
    ros = std::make_unique<RosSystem>(*bridge, simulation);
    simulation.add(*ros);
  }
  const Finally end_of_commands([&runner] { runner.finish(); });  // before the bridge, whose threads wait for them
  if (stop_requested()) return kFine;
  auto guard = std::make_unique<StopGuard>(&interrupt_scripts, [&bridge] {
    if (bridge) bridge->leave();
  });
  PythonEngine python(runner, bridge.get());
  std::unique_ptr<Observers> observers;
  if (bridge && (!options.record.empty() || !options.lockstep.empty())) {
    observers = std::make_unique<Observers>(python, ObserverOptions{options.record, options.lockstep});
  }
  std::unique_ptr<GazeboPlugins> plugins;
  if (bridge || has_plugins(simulation.scene())) {  // without ROS, the skipped plugins are reported
    plugins = std::make_unique<GazeboPlugins>(python);
    simulation.add(*plugins);
  }
  ChildScripts scripts(python, {options.child_scripts, options.script_paths, options.lua_unsafe,
                                options.allowed_programs, options.watch});
  simulation.add(scripts);
  std::unique_ptr<NodeServices> services;
  if (bridge) {
    services = std::make_unique<NodeServices>(python, scripts, options.gazebo_compat);
    simulation.add(*services);
  }
  if (observers) simulation.add(*observers);
  std::unique_ptr<RemoteDoor> door;
  if (options.remote_port) {
    door = std::make_unique<RemoteDoor>(python, scripts, options.remote_address, *options.remote_port);
    simulation.add(*door);
  }
  counts.watch(scripts);
  const Finally end_of_scripts([&counts] { counts.keep(); });

  try {
    runner.run();
  } catch (const Diverged& error) {
    runner.report_failure(error.what());
    if (bridge) bridge->publish_diagnostics();
    summarize(runner);
    throw;
  }
  if (door) door->close();
  scripts.finish();
  guard.reset();
  summarize(runner);
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
