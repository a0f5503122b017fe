// SPDX-License-Identifier: BSD-3-Clause
// The joints of a robot as ros_control's controllers see them: states, commands, limits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bubblesim/control/pid.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim::control {

constexpr double kTurn = 2 * 3.14159265358979323846;  ///< rad

/// What a controller commands of a joint.
enum class CommandInterface { kPosition, kVelocity, kEffort };

struct ControlledJoint {
  std::string name;
  ObjectId id = kNoObject;
  CommandInterface interface = CommandInterface::kEffort;
  /// Turns the error of a position or velocity into an effort, as gazebo_ros_control does with gains; without it a
  /// motor follows the command.
  std::optional<Pid> pid{};
  // Read at the start: whether it turns without limits, and what the file limits.
  bool is_continuous = false;
  bool is_angle = true;
  double lower = 0;  ///< rad or m; infinite without a limit
  double upper = 0;
  double max_velocity = 0;
  double max_effort = 0;

  // The state: rad or m, with full turns; rad/s or m/s; N m or N
  double position = 0;
  double velocity = 0;
  double effort = 0;
  double command = 0;
};

/// Reads states from a world, and gives commands to its motors. Commands beyond a joint's limits are clamped.
class RobotHardware {
 public:
  /// `joints`: name, id, interface and pid are given. Throws WrongObject for what is no joint with one axis.
  RobotHardware(World& world, std::vector<ControlledJoint> joints);

  std::vector<ControlledJoint>& joints() { return joints_; }
  const std::vector<ControlledJoint>& joints() const { return joints_; }

  void read(const World& world);
  /// `period`: s since the last call.
  void write(World& world, double period);
  /// Changes what is commanded of a joint, and releases it.
  void set_interface(World& world, std::size_t joint, CommandInterface interface);
  /// Holds the positions of the state, and sets velocities and efforts to zero.
  void release(ControlledJoint& joint);
  /// Sets the modes of the motors, and releases all joints; after a reset of the world.
  void reset(World& world);
  void transfer(StateArchive& archive);

 private:
  std::vector<ControlledJoint> joints_;
};

/// Difference of two positions of a joint, goal - position: the shorter way around when it turns without limits.
double position_error(const ControlledJoint& joint, double goal, double position);

}  // namespace bubblesim::control
