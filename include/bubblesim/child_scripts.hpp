// SPDX-License-Identifier: BSD-3-Clause
// Child scripts in an embedded Python interpreter, which also runs the Lua scripts, as a system of a simulation.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/python_system.hpp"

namespace bubblesim {

struct ScriptOptions {
  /// Pairs of object path and file. The file replaces the object's child script, or becomes its child script.
  std::vector<std::pair<std::string, std::filesystem::path>> replacements;
  /// Folders that are searched for included and required files, after the folder of the script itself.
  std::vector<std::filesystem::path> search_paths;
  /// Lua scripts may use os, io, debug and package.
  bool lua_unsafe = false;
  /// Programs (names or paths) and folders of programs that Lua scripts may start, besides those of ROS packages.
  std::vector<std::string> allowed_programs;
  /// Reloads a script when its file changes.
  bool watch = false;
  /// Runs the Python scripts of files of CoppeliaSim, too: they may do whatever the user may.
  bool python_of_foreign_scenes = false;
};

/// Runs the child scripts of a scene's models. A script that fails is reported on stderr once, with file:line and
/// object path, and is disabled; the others keep running.
class ChildScripts final : public PythonSystem {
 public:
  /// Loads the scripts. Without a bridge, simROS is false in scripts. Throws InvalidInput for files and objects that do
  /// not exist.
  ChildScripts(PythonEngine& engine, const ScriptOptions& options);
  /// Calls finish().
  ~ChildScripts() override;

  /// Loads the model's script, if it has one. The script runs from the next actuation on.
  void model_added(World& world, ObjectId model) override;
  /// Calls sysCall_cleanup of all scripts and ends the programs they started.
  void finish();

  /// Number of script failures so far. Thread-safe.
  int failures() const { return failures_; }
  /// Number of loaded scripts that are disabled after a failure. Thread-safe.
  int disabled() const { return disabled_; }
  /// Whether output of a script could not be written; valid after finish().
  bool output_lost() const { return output_lost_; }

 private:
  friend class NodeServices;
  friend class RemoteApiServer;

  void after_call() override;

  bool python_of_foreign_scenes_;
  bool finished_ = false;
  std::atomic<int> failures_{0};
  std::atomic<int> disabled_{0};
  bool output_lost_ = false;
};

/// Raises KeyboardInterrupt in the running script; after that, only sysCall_cleanup is called. Does nothing while no
/// script runs. For a signal handler on the simulation's thread; Python does not react when another thread calls it.
void interrupt_scripts();

}  // namespace bubblesim
