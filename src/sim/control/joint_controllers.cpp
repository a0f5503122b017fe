// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/joint_controllers.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "validation/limits.hpp"

namespace bubblesim::control {
namespace {

bool usable(double command) { return std::isfinite(command) && std::abs(command) <= kMaxSpeed; }

}  // namespace

void ForwardCommand::set_commands(std::vector<double> commands) {
  if (commands.size() != joints_.size() || !std::all_of(commands.begin(), commands.end(), usable)) {
    throw InvalidInput("the commands are not usable: they must be " + std::to_string(joints_.size()) +
                       " numbers of at most 1e6, one for each joint");
  }
  commands_ = std::move(commands);
}

void ForwardCommand::starting(RobotHardware& robot, double) {
  commands_.clear();
  for (const std::size_t joint : joints_) robot.release(robot.joints()[joint]);
}

void ForwardCommand::update(RobotHardware& robot, double, double) {
  for (std::size_t i = 0; i < commands_.size(); ++i) robot.joints()[joints_[i]].command = commands_[i];
}

void ForwardCommand::transfer(StateArchive& archive) { archive(commands_); }

void PidController::set_command(double command) {
  if (!usable(command)) throw InvalidInput("the command is not usable: it must be a number of at most 1e6");
  commanded_ = command;
}

void PidController::starting(RobotHardware& robot, double) {
  pid_.reset();
  commanded_.reset();
  state_ = {};
  state_.set_point = kind_ == Kind::kPosition ? robot.joints()[joint_].position : 0;
}

void PidController::update(RobotHardware& robot, double, double period) {
  ControlledJoint& joint = robot.joints()[joint_];
  if (commanded_) state_.set_point = *commanded_;
  if (kind_ == Kind::kPosition) {
    state_.set_point = std::clamp(state_.set_point, joint.lower, joint.upper);
    state_.process_value = joint.position;
    state_.process_value_dot = joint.velocity;
    state_.error = position_error(joint, state_.set_point, joint.position);
  } else {
    state_.process_value = joint.velocity;
    state_.process_value_dot = 0;
    state_.error = state_.set_point - joint.velocity;
  }
  state_.command = pid_.command(state_.error, period);
  joint.command = state_.command;
}

void PidController::transfer(StateArchive& archive) {
  archive(pid_, commanded_, state_.set_point, state_.process_value, state_.process_value_dot, state_.error,
          state_.command);
}

}  // namespace bubblesim::control
