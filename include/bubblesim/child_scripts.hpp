// SPDX-License-Identifier: BSD-3-Clause
// Child scripts in an embedded Python, which runs those in Lua too, as systems of a simulation.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/messages/bridge.hpp"
#include "bubblesim/simulation.hpp"

namespace bubblesim {

struct ScriptOptions {
  /// Pairs of object path and file: the file takes the place of the object's script, or gives it one.
  std::vector<std::pair<std::string, std::filesystem::path>> replacements;
  /// Where what a script includes or requires is looked for, after the folder of the script itself.
  std::vector<std::filesystem::path> search_paths;
  /// Lets scripts in Lua use os, io, debug and package.
  bool lua_unsafe = false;
  /// Programs by name or path, and folders of programs, that scripts in Lua may start beside those of ROS packages.
  std::vector<std::string> allowed_programs;
  /// Offers Gazebo's services and topics beside the node's own.
  bool gazebo_compat = false;
  /// Loads a script again as soon as its file changes.
  bool watch = false;
  /// A bag for the messages that scripts publish and hear; empty: none.
  std::filesystem::path record;
  /// Topics on which each step waits for messages that answer the last one.
  std::vector<std::string> lockstep;
};

/// Runs the scripts that a scene's models name. A script that fails is reported on stderr once, with file:line and
/// object path, and does not run again; the others go on.
class ChildScripts : public System {
 public:
  /// Starts the interpreter, of which there can be one in a process, and loads the scripts; `bridge` may be null,
  /// then simROS is false in scripts. Throws InvalidInput for files and objects that do not exist.
  ChildScripts(Simulation& simulation, messages::Bridge* bridge, const ScriptOptions& options);
  ~ChildScripts() override;

  void process_input() override;
  void actuate(World& world, double time) override;
  void sense(const World& world, double time) override;
  void publish(const World& world, double time) override;
  /// finish(), and forgets the scripts.
  void stop() override;
  /// Loads the scripts afresh, from their files.
  void start() override;
  /// Calls sysCall_reset of all scripts.
  void reset() override;
  /// Loads the script of a model that has one: it runs from the next actuation on.
  void model_added(World& world, ObjectId model) override;
  /// Calls sysCall_cleanup of a model's scripts and ends what they started.
  void model_removing(World& world, ObjectId model) override;
  /// Calls sysCall_cleanup of all scripts and ends the programs they started.
  void finish();

  /// How many scripts failed so far. Any thread may call it.
  int failures() const { return failures_; }
  /// How many of those that are loaded now have failed. Any thread may call it.
  int disabled() const { return disabled_; }
  /// Whether something that a script printed could not be written; known after finish().
  bool output_lost() const { return output_lost_; }

 private:
  friend class GazeboPlugins;  // which use the same interpreter and bridge
  struct Python;

  template <class Action>
  void with_host(Action action);

  Simulation& simulation_;
  std::unique_ptr<Python> python_;
  std::atomic<int> failures_{0};
  std::atomic<int> disabled_{0};
  bool output_lost_ = false;
};

/// Makes the code of a script that is running raise KeyboardInterrupt, and all scripts be called no more but for
/// sysCall_cleanup. Does nothing while no script runs. For a signal
/// handler on the simulation's thread: Python would not notice it from another.
void interrupt_scripts();

}  // namespace bubblesim
