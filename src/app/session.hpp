// SPDX-License-Identifier: BSD-3-Clause
// A scene in the node with all its systems, and the parts of the node that stay when a client loads another scene.
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/child_scripts.hpp"
#include "bubblesim/gazebo_plugins.hpp"
#include "bubblesim/node_bridge.hpp"
#include "bubblesim/node_services.hpp"
#include "bubblesim/observers.hpp"
#include "bubblesim/remote_api_server.hpp"
#include "bubblesim/ros_system.hpp"
#include "bubblesim/runner.hpp"
#include "bubblesim/simulation.hpp"
#include "options.hpp"
#include "stop_signal.hpp"

namespace bubblesim::app {

/// The numbers of failed scripts, for threads that may outlive the scripts; after those, their last values.
class ScriptCounts {
 public:
  void watch(const ChildScripts& scripts);
  void keep();
  int failures() const;
  int disabled() const;

 private:
  mutable std::mutex mutex_;
  const ChildScripts* scripts_ = nullptr;
  int failures_ = 0;
  int disabled_ = 0;
};

/// The runner of the present scene, for the threads of the ROS bridge, which stay when the scene changes.
class CurrentRunner {
 public:
  /// Waits for those who use the last one.
  void set(Runner* runner) {
    const std::unique_lock lock(mutex_);
    runner_ = runner;
  }
  /// Calls `action` with the runner; returns `otherwise` while there is none.
  template <class Action, class Result>
  Result with(Action action, Result otherwise) {
    const std::shared_lock lock(mutex_);
    return runner_ != nullptr ? action(*runner_) : std::move(otherwise);
  }

 private:
  std::shared_mutex mutex_;
  Runner* runner_ = nullptr;
};

/// The parts of the node that stay.
struct Node {
  explicit Node(const Options& how) : options(how) {}

  const Options& options;
  std::filesystem::path first_scene;  ///< empty until the first session
  ScriptCounts counts;
  CurrentRunner runner;
  std::vector<std::unique_ptr<NodeBridge>> bridges;  ///< none without ROS; of two, the first is that to ROS 1
  std::unique_ptr<StopGuard> guard;
  std::unique_ptr<PythonEngine> python;
  std::unique_ptr<RemoteApiServer> remote_api;  ///< null without remote clients
};

/// Runs one scene in a node, which must outlive it. The first session makes the node's missing parts.
class Session {
 public:
  /// `is_first`: the scene of the command line, which starts as the options require; later ones are stopped. `failure`:
  /// see RemoteApiServer::attach().
  Session(Node& node, std::unique_ptr<Simulation> simulation, bool is_first, const std::string& failure = {});
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Runs until the end, or until a client asks for another scene, which is returned.
  std::shared_ptr<const Scene> run();
  /// Ends the node: the remote clients, then the scripts. Returns the exit code.
  int finish();

 private:
  // Each part that stays lets go of this session's by a guard, also when the constructor fails.

  /// Ends the use of the runner by the node's parts.
  struct RunnerUse {
    RunnerUse(Node& its_node, Runner& used) : node(its_node), runner(used) {}
    ~RunnerUse();
    RunnerUse(const RunnerUse&) = delete;
    RunnerUse& operator=(const RunnerUse&) = delete;
    Node& node;
    Runner& runner;
  };

  /// Lets the remote clients wait for the next session.
  struct ServedScene {
    ServedScene(RemoteApiServer& of_node, const ChildScripts& scripts, const std::string& failure) : server(of_node) {
      server.attach(scripts, failure);
    }
    ~ServedScene();
    ServedScene(const ServedScene&) = delete;
    ServedScene& operator=(const ServedScene&) = delete;
    RemoteApiServer& server;
  };

  /// Keeps the last numbers of the scripts.
  struct CountsUse {
    CountsUse(ScriptCounts& its_counts, const ChildScripts& scripts) : counts(its_counts) { counts.watch(scripts); }
    ~CountsUse() { counts.keep(); }
    CountsUse(const CountsUse&) = delete;
    CountsUse& operator=(const CountsUse&) = delete;
    ScriptCounts& counts;
  };

  Node& node_;
  std::unique_ptr<Simulation> simulation_;
  Runner runner_;
  RunnerUse runner_use_;
  std::vector<std::unique_ptr<RosSystem>> ros_;
  std::unique_ptr<Observers> observers_;
  std::unique_ptr<GazeboPlugins> plugins_;
  std::unique_ptr<ChildScripts> scripts_;
  std::unique_ptr<NodeServices> services_;
  std::unique_ptr<ServedScene> served_scene_;
  std::unique_ptr<CountsUse> counts_use_;
};

}  // namespace bubblesim::app
