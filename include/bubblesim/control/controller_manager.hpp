// SPDX-License-Identifier: BSD-3-Clause
// Runs controllers before each physics substep: reads the joints, updates the controllers, gives commands to the
// motors.
#pragma once

#include <memory>
#include <vector>

#include "bubblesim/control/robot_hardware.hpp"
#include "bubblesim/device.hpp"

namespace bubblesim::control {

/// A controller sets commands of joints that it alone has. Its functions are called by the thread that advances the
/// world; others may call its own functions between steps, or with World::access().
class Controller {
 public:
  virtual ~Controller() = default;
  /// Called before the first update after each start. `time`: simulation time, s.
  virtual void starting(RobotHardware& robot, double time);
  /// `period`: s since the last update.
  virtual void update(RobotHardware& robot, double time, double period) = 0;
  /// Called after the last update. The joints are released afterwards.
  virtual void stopping(RobotHardware& robot);
  /// Saves or restores what changes while it runs.
  virtual void transfer(StateArchive& archive);
  /// Indices into RobotHardware::joints() of the joints that it commands.
  virtual std::vector<std::size_t> claimed() const = 0;
};

class ControllerManager final : public Device {
 public:
  explicit ControllerManager(RobotHardware robot) : robot_(std::move(robot)) {}

  const RobotHardware& robot() const { return robot_; }
  RobotHardware& robot() { return robot_; }
  /// Runs it from the next update on, after those that were started before. Throws InvalidInput when it runs, and when
  /// a running controller has one of its joints.
  void start(std::shared_ptr<Controller> controller);
  /// Ends it and releases its joints. Does nothing when it does not run.
  void stop(const Controller& controller);
  bool runs(const Controller& controller) const;

  void update(World& world, double time, double duration) override;
  /// The controllers that run start again.
  void reset(World& world) override;
  void transfer(StateArchive& archive) override;

 private:
  struct Running {
    std::shared_ptr<Controller> controller;
    bool is_new = true;
  };

  RobotHardware robot_;
  std::vector<Running> running_;
};

}  // namespace bubblesim::control
