// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/omnidirectional_controllers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bubblesim::control {
namespace {

using Four = std::array<double, 4>;

Four rims_of(const RobotHardware& robot, const std::array<std::size_t, 4>& joints, double radius) {
  Four rims{};
  for (std::size_t i = 0; i < rims.size(); ++i) rims[i] = robot.joints()[joints[i]].position * radius;
  return rims;
}

/// What has been added to `before`, which becomes `now`.
Four change(Four& before, const Four& now) {
  Four changes{};
  for (std::size_t i = 0; i < changes.size(); ++i) changes[i] = now[i] - std::exchange(before[i], now[i]);
  return changes;
}

}  // namespace

MecanumDriveController::MecanumDriveController(const Wheels& wheels, const Settings& settings)
    : BaseController(settings), wheels_(wheels) {
  require_length("distance of the wheels", wheels_.k);
  require_length("radius of the wheels", wheels_.radius);
}

void MecanumDriveController::begin(const RobotHardware& robot) {
  rims_ = rims_of(robot, wheels_.joints, wheels_.radius);
}

PlanarMotion MecanumDriveController::moved(const RobotHardware& robot) {
  const auto [a, b, c, d] = change(rims_, rims_of(robot, wheels_.joints, wheels_.radius));
  return {(a + b + c + d) / 4, (-a + b - c + d) / 4, (-a - b + c + d) / 4 / wheels_.k};
}

void MecanumDriveController::command_wheels(RobotHardware& robot, const Command& command) {
  const auto [x, y, w] = command;
  const double turn = wheels_.k * w;
  const Four speeds{x - y - turn, x + y - turn, x - y + turn, x + y + turn};
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    robot.joints()[wheels_.joints[i]].command = speeds[i] / wheels_.radius;
  }
}

void MecanumDriveController::transfer_wheels(StateArchive& archive) {
  for (double& rim : rims_) archive(rim);
}

FourWheelSteeringController::FourWheelSteeringController(const Wheels& wheels, const Settings& settings)
    : BaseController(settings), wheels_(wheels) {
  require_length("track", wheels_.track);
  require_length("wheel base", wheels_.base);
  require_length("radius of the wheels", wheels_.radius);
}

std::vector<std::size_t> FourWheelSteeringController::claimed() const {
  std::vector<std::size_t> joints(wheels_.driven.begin(), wheels_.driven.end());
  joints.insert(joints.end(), wheels_.steered.begin(), wheels_.steered.end());
  return joints;
}

std::array<double, 2> FourWheelSteeringController::place(std::size_t wheel) const {
  return {wheel < 2 ? wheels_.base / 2 : -wheels_.base / 2, wheel % 2 == 0 ? wheels_.track / 2 : -wheels_.track / 2};
}

void FourWheelSteeringController::begin(const RobotHardware& robot) {
  rims_ = rims_of(robot, wheels_.driven, wheels_.radius);
}

/// The rigid motion with the least squares of differences to those of the wheels.
PlanarMotion FourWheelSteeringController::moved(const RobotHardware& robot) {
  const Four rolled = change(rims_, rims_of(robot, wheels_.driven, wheels_.radius));
  PlanarMotion motion;
  for (std::size_t i = 0; i < rolled.size(); ++i) {
    const double angle = robot.joints()[wheels_.steered[i]].position;
    const double forward = rolled[i] * std::cos(angle);
    const double left = rolled[i] * std::sin(angle);
    const auto [x, y] = place(i);
    motion.forward += forward / 4;
    motion.left += left / 4;
    motion.turn += (x * left - y * forward) / (wheels_.base * wheels_.base + wheels_.track * wheels_.track);
  }
  return motion;
}

PlanarMotion FourWheelSteeringController::commanded(const Command& command, double period) const {
  const double forward = command[0] * period;
  if (!wheels_.by_angles) return {forward, 0, command[2] * period};
  constexpr double kMost = kTurn / 4 - 1e-3;  // rad
  const double front = std::tan(std::clamp(command[1], -kMost, kMost));
  const double rear = std::tan(std::clamp(command[2], -kMost, kMost));
  return {forward, forward * (front + rear) / 2, forward * (front - rear) / wheels_.base};
}

void FourWheelSteeringController::command_wheels(RobotHardware& robot, const Command& command) {
  // The angles do not depend on the speed: at rest, the wheels turn to where they must point to drive.
  Command moving = command;
  if (wheels_.by_angles && command[0] == 0) moving[0] = 1;
  const PlanarMotion motion = commanded(moving, 1);
  for (std::size_t i = 0; i < wheels_.driven.size(); ++i) {
    const auto [x, y] = place(i);
    const double forward = motion.forward - motion.turn * y;
    const double left = motion.left + motion.turn * x;
    const double speed = command[0] == moving[0] ? std::copysign(std::hypot(forward, left), forward) : 0;
    robot.joints()[wheels_.driven[i]].command = speed / wheels_.radius;
    robot.joints()[wheels_.steered[i]].command = forward == 0 && left == 0 ? 0 : std::atan(left / forward);
  }
}

void FourWheelSteeringController::transfer_wheels(StateArchive& archive) {
  for (double& rim : rims_) archive(rim);
}

}  // namespace bubblesim::control
