// SPDX-License-Identifier: BSD-3-Clause
#include "session.hpp"

#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <utility>

#include "bubblesim/error.hpp"
#include "state_files.hpp"

namespace bubblesim::app {
namespace {

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

RunnerOptions runner_options(const Options& options, const ScriptCounts& counts, bool is_first) {
  RunnerOptions how;
  how.speed = options.speed;
  how.initial = options.paused ? RunState::kPaused : RunState::kRunning;
  if (options.remote_port && !options.start && !options.paused) how.initial = RunState::kStopped;
  if (!is_first) how.initial = RunState::kStopped;
  if (options.until) how.until = *options.until;
  how.ends_at_stop = (options.ros == Ros::kNone && !options.has_remote_api()) ||
                     options.until;  // nothing can or should start it again
  how.is_ending = [&counts, strict = options.strict] { return stop_requested() || (strict && counts.failures() > 0); };
  how.on_divergence = [](const std::string& why) {
    std::fprintf(stderr, "error: %s; paused until reset or stopped\n", why.c_str());
  };
  return how;
}

/// From here on, a signal ends scripts that do not return. Not earlier: Python and its modules load for longer than a
/// script may take, on a slow machine.
void guard_scripts(Node& node) {
  if (node.guard) return;
  node.guard = std::make_unique<StopGuard>(&interrupt_scripts, [&bridges = node.bridges] {
    for (const auto& bridge : bridges) bridge->leave();
  });
}

/// Why clients cannot load another scene.
std::string fixed_scene(const Options& options) {
  if (!options.record.empty()) return "the node records messages (--record), which ends with the scene";
  if (!options.lockstep.empty()) return "the node was started with --lockstep";
  if (options.until) return "the node was started with --until, and ends when this scene stops";
  return {};
}

}  // namespace

void ScriptCounts::watch(const ChildScripts& scripts) {
  const std::lock_guard lock(mutex_);
  scripts_ = &scripts;
}

void ScriptCounts::keep() {
  const std::lock_guard lock(mutex_);
  if (scripts_ == nullptr) return;
  failures_ = scripts_->failures();
  disabled_ = scripts_->disabled();
  scripts_ = nullptr;
}

int ScriptCounts::failures() const {
  const std::lock_guard lock(mutex_);
  return scripts_ != nullptr ? scripts_->failures() : failures_;
}

int ScriptCounts::disabled() const {
  const std::lock_guard lock(mutex_);
  return scripts_ != nullptr ? scripts_->disabled() : disabled_;
}

Session::RunnerUse::~RunnerUse() {
  if (node.python) node.python->end();
  for (const auto& bridge : node.bridges) bridge->shutdown_endpoints();
  runner.finish();  // it runs in no background, so this does not throw; the bridge's threads wait for commands
  node.runner.set(nullptr);
}

Session::ServedScene::~ServedScene() {
  try {
    server.detach();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
}

Session::Session(Node& node, std::unique_ptr<Simulation> simulation, bool is_first, const std::string& failure)
    : node_(node),
      simulation_(std::move(simulation)),
      runner_(*simulation_, runner_options(node.options, node.counts, is_first)),
      runner_use_(node, runner_) {
  const Options& options = node.options;
  node.runner.set(&runner_);
  const bool with_ros = !node.bridges.empty();
  std::vector<messages::Bridge*> bridges;
  for (const auto& bridge : node.bridges) {
    ros_.push_back(std::make_unique<RosSystem>(*bridge, *simulation_));
    simulation_->add(*ros_.back());
    bridges.push_back(bridge.get());
  }
  if (!node.python) node.python = std::make_unique<PythonEngine>();
  PythonEngine& python = *node.python;
  python.begin(runner_, bridges);
  if (with_ros && (!options.record.empty() || !options.lockstep.empty())) {
    observers_ = std::make_unique<Observers>(python, ObserverOptions{options.record, options.lockstep});
  }
  if (with_ros || has_plugins(simulation_->scene())) {  // without ROS, the skipped plugins are reported
    plugins_ = std::make_unique<GazeboPlugins>(python, options.gazebo_compat);
    simulation_->add(*plugins_);
  }
  ScriptOptions how{{},
                    options.script_paths,
                    options.lua_unsafe,
                    options.allowed_programs,
                    options.watch,
                    options.python_of_foreign_scenes};
  if (is_first) node.first_scene = simulation_->scene().file;
  if (simulation_->scene().file == node.first_scene) how.replacements = options.child_scripts;  // they name its objects
  guard_scripts(node);
  scripts_ = std::make_unique<ChildScripts>(python, how);
  simulation_->add(*scripts_);
  if (with_ros) {
    services_ =
        std::make_unique<NodeServices>(python, *scripts_, options.gazebo_compat, node.bridges.front()->node_name());
    simulation_->add(*services_);
  }
  if (observers_) simulation_->add(*observers_);
  if (options.has_remote_api() && !node.remote_api) {
    node.remote_api = std::make_unique<RemoteApiServer>(
        python, RemoteApiOptions{options.remote_address, options.remote_port, options.window_socket,
                                 options.remote_token, options.remote_trusted, fixed_scene(options)});
  }
  if (node.remote_api) {
    simulation_->add(*node.remote_api);
    served_scene_ = std::make_unique<ServedScene>(*node.remote_api, *scripts_, failure);
  }
  if (is_first && options.remote_port && !options.start && !options.paused) {
    std::fprintf(
        stderr,
        "info: the simulation is stopped until a remote client or ~unpause starts it; --start begins at once\n");
  }
  counts_use_ = std::make_unique<CountsUse>(node.counts, *scripts_);
  if (is_first && !options.load_state.empty()) load_state(*simulation_, options.load_state);
}

std::shared_ptr<const Scene> Session::run() {
  try {
    runner_.run();
  } catch (const Diverged& error) {
    runner_.report_failure(error.what());
    for (const auto& bridge : node_.bridges) bridge->publish_diagnostics();
    summarize(runner_);
    throw;
  }
  return node_.remote_api && !stop_requested() ? node_.remote_api->take_next_scene() : nullptr;
}

int Session::finish() {
  if (node_.remote_api) node_.remote_api->close();
  scripts_->finish();
  node_.guard.reset();
  summarize(runner_);
  if (!node_.options.save_state.empty()) save_state(*simulation_, node_.options.save_state);
  if (node_.options.state_hash) std::printf("%016" PRIx64 "\n", simulation_->state_hash());
  // With --watch, a script that was repaired does not count as failed.
  if ((node_.options.watch ? scripts_->disabled() : scripts_->failures()) > 0) return kScriptFailed;
  return scripts_->output_lost() ? kOutputLost : kFine;
}

}  // namespace bubblesim::app
