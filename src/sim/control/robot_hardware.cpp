// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/robot_hardware.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bubblesim/error.hpp"
#include "validation/limits.hpp"

namespace bubblesim::control {
namespace {

MotorMode mode_of(const ControlledJoint& joint) {
  return joint.interface == CommandInterface::kEffort || joint.pid ? MotorMode::kEffort : MotorMode::kVelocity;
}

double clamped(double value, double most) { return std::clamp(value, -most, most); }

}  // namespace

double position_error(const ControlledJoint& joint, double goal, double position) {
  const double error = goal - position;
  return joint.is_continuous ? std::remainder(error, kTurn) : error;
}

RobotHardware::RobotHardware(World& world, std::vector<ControlledJoint> joints) : joints_(std::move(joints)) {
  for (ControlledJoint& joint : joints_) {
    if (world.joints().axes(joint.id) != 1) {
      throw InvalidInput("the joint " + joint.name + " cannot be controlled: it must have one axis");
    }
    const JointDescription& description = world.joints().description(joint.id);
    const AxisDescription& axis = description.axes.front();
    joint.is_angle = description.type != "prismatic" && description.type != "screw";
    joint.lower = axis.lower;
    joint.upper = axis.upper;
    joint.is_continuous = joint.is_angle && std::isinf(axis.lower) && std::isinf(axis.upper);
    joint.max_velocity = std::min(axis.max_velocity, kMaxSpeed);
    joint.max_effort = axis.max_force;
  }
  reset(world);
}

void RobotHardware::read(const World& world) {
  for (ControlledJoint& joint : joints_) {
    const double position = world.joints().position(joint.id);
    joint.position = joint.is_continuous ? joint.position + std::remainder(position - joint.position, kTurn) : position;
    joint.velocity = world.joints().velocity(joint.id);
    joint.effort = world.joints().motor_effort(joint.id);
  }
}

void RobotHardware::write(World& world, double period) {
  for (ControlledJoint& joint : joints_) {
    double effort = joint.command;
    if (joint.interface == CommandInterface::kPosition) {
      const double goal = std::clamp(joint.command, joint.lower, joint.upper);
      const double error = position_error(joint, goal, joint.position);
      if (joint.pid) {
        effort = joint.pid->command(error, period);
      } else {
        world.joints().set_target_velocity(joint.id, clamped(error / period, joint.max_velocity));
      }
    } else if (joint.interface == CommandInterface::kVelocity) {
      const double velocity = clamped(joint.command, joint.max_velocity);
      if (joint.pid) {
        effort = joint.pid->command(velocity - joint.velocity, period);
      } else {
        world.joints().set_target_velocity(joint.id, velocity);
      }
    }
    if (mode_of(joint) == MotorMode::kEffort) {
      world.joints().set_target_effort(joint.id, clamped(effort, joint.max_effort));
    }
  }
}

void RobotHardware::set_interface(World& world, std::size_t index, CommandInterface interface) {
  ControlledJoint& joint = joints_.at(index);
  joint.interface = interface;
  if (joint.pid) joint.pid->reset();
  world.joints().set_motor_mode(joint.id, mode_of(joint));
  release(joint);
}

void RobotHardware::release(ControlledJoint& joint) {
  joint.command = joint.interface == CommandInterface::kPosition ? joint.position : 0;
}

void RobotHardware::reset(World& world) {
  for (ControlledJoint& joint : joints_) {
    world.joints().set_motor_mode(joint.id, mode_of(joint));
    joint.position = world.joints().position(joint.id);
    joint.velocity = world.joints().velocity(joint.id);
    joint.effort = 0;
    if (joint.pid) joint.pid->reset();
    release(joint);
  }
}

void RobotHardware::transfer(StateArchive& archive) {
  archive.require(joints_.size(), "number of joints of a robot");
  for (ControlledJoint& joint : joints_) {
    archive(joint.interface, joint.position, joint.velocity, joint.effort, joint.command);
    if (joint.pid) archive(*joint.pid);
  }
}

}  // namespace bubblesim::control
