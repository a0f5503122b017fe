// SPDX-License-Identifier: BSD-3-Clause
// Controllers of single joints: those that pass commands on, and those with a PID.
#pragma once

#include <optional>
#include <vector>

#include "bubblesim/control/controller_manager.hpp"

namespace bubblesim::control {

/// position_controllers, velocity_controllers and effort_controllers: the joint and group controllers that pass
/// commands on to the interfaces of their joints.
class ForwardCommand final : public Controller {
 public:
  /// `joints`: indices into RobotHardware::joints().
  explicit ForwardCommand(std::vector<std::size_t> joints) : joints_(std::move(joints)) {}

  /// Throws InvalidInput unless there is a finite number for each joint.
  void set_commands(std::vector<double> commands);
  void starting(RobotHardware& robot, double time) override;
  void update(RobotHardware& robot, double time, double period) override;
  void transfer(StateArchive& archive) override;
  std::vector<std::size_t> claimed() const override { return joints_; }

 private:
  std::vector<std::size_t> joints_;
  std::vector<double> commands_;
};

/// JointPositionController and JointVelocityController of effort_controllers and velocity_controllers: a PID from the
/// error of a position or velocity to the command of the joint's interface.
class PidController final : public Controller {
 public:
  enum class Kind { kPosition, kVelocity };

  /// What the topic `state` has.
  struct State {
    double set_point = 0;
    double process_value = 0;
    double process_value_dot = 0;
    double error = 0;
    double command = 0;
  };

  PidController(std::size_t joint, Kind kind, const PidGains& gains) : joint_(joint), kind_(kind), pid_(gains) {}

  /// Throws InvalidInput unless it is finite.
  void set_command(double command);
  const State& state() const { return state_; }
  const PidGains& gains() const { return pid_.gains(); }
  void starting(RobotHardware& robot, double time) override;
  void update(RobotHardware& robot, double time, double period) override;
  void transfer(StateArchive& archive) override;
  std::vector<std::size_t> claimed() const override { return {joint_}; }

 private:
  std::size_t joint_;
  Kind kind_;
  Pid pid_;
  std::optional<double> commanded_;  // since the last start
  State state_;
};

}  // namespace bubblesim::control
