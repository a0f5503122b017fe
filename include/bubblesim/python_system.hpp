// SPDX-License-Identifier: BSD-3-Clause
// Systems of a simulation that are written in Python.
#pragma once

#include <memory>
#include <string>

#include "bubblesim/messages/bridge.hpp"
#include "bubblesim/runner.hpp"

namespace bubblesim {

/// The embedded Python interpreter, and what Python's systems are made with. At most one per process; it outlives them.
class PythonEngine {
 public:
  /// `bridge` may be null: without ROS.
  PythonEngine(Runner& runner, messages::Bridge* bridge);
  ~PythonEngine();
  PythonEngine(const PythonEngine&) = delete;
  PythonEngine& operator=(const PythonEngine&) = delete;

  Runner& runner() { return runner_; }

  struct Objects;
  Objects& objects() { return *objects_; }

 private:
  Runner& runner_;
  std::unique_ptr<Objects> objects_;
};

/// Calls the methods of a Python object that are named like those of System, as far as it has them.
class PythonSystem : public System {
 public:
  ~PythonSystem() override;
  PythonSystem(const PythonSystem&) = delete;
  PythonSystem& operator=(const PythonSystem&) = delete;

  void process_input() override;
  void actuate(World& world, double time) override;
  void sense(const World& world, double time) override;
  void publish(const World& world, double time) override;
  void stop() override;
  void start() override;
  void reset() override;
  void model_added(World& world, ObjectId model) override;
  void model_removing(World& world, ObjectId model) override;

 protected:
  struct Methods;

  /// `name`: of the system, in errors.
  PythonSystem(PythonEngine& engine, std::string name);

  /// Runs with the GIL. Throws std::runtime_error for a Python exception.
  template <class Action>
  void with_python(Action action);
  /// Called with the GIL after each call.
  virtual void after_call() {}

  PythonEngine& engine_;
  const std::string name_;
  std::unique_ptr<Methods> methods_;
};

}  // namespace bubblesim
