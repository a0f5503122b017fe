// SPDX-License-Identifier: BSD-3-Clause
// Systems of a simulation that are written in Python.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bubblesim/messages/bridge.hpp"
#include "bubblesim/runner.hpp"

namespace bubblesim {

/// The embedded Python interpreter, and what Python's systems are made with. At most one per process; it outlives them.
class PythonEngine {
 public:
  PythonEngine();
  ~PythonEngine();
  PythonEngine(const PythonEngine&) = delete;
  PythonEngine& operator=(const PythonEngine&) = delete;

  /// The systems that are made from here on belong to this runner. `bridges`: none without ROS; of two, the first is
  /// that to ROS 1 and the second that to ROS 2.
  void begin(Runner& runner, const std::vector<messages::Bridge*>& bridges);
  /// Call it before the runner is destroyed. Systems that stay may not use the simulation any more.
  void end();
  /// Throws std::logic_error between end() and begin().
  Runner& runner();
  /// Null between end() and begin().
  Simulation* simulation();

  struct Objects;
  Objects& objects() { return *objects_; }

 private:
  Runner* runner_ = nullptr;
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
  std::string state_name() const override;
  std::string save_state() override;
  void restore_state(std::string_view state) override;

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
