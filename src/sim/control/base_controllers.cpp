// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/base_controllers.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "bubblesim/error.hpp"
#include "scene/describe.hpp"
#include "validation/limits.hpp"

namespace bubblesim::control {
namespace {

double mean_position(const RobotHardware& robot, const std::vector<std::size_t>& joints) {
  double sum = 0;
  for (const std::size_t joint : joints) sum += robot.joints()[joint].position;
  return sum / static_cast<double>(joints.size());
}

}  // namespace

void require_length(const char* what, double length) {
  if (std::isfinite(length) && length > 0) return;
  throw InvalidInput(std::string("the ") + what + " of " + text(length) + " m is not usable: it must be above 0");
}

bool BaseController::set_command(const Command& command) {
  const auto usable = [](double number) { return std::abs(number) <= kMaxSpeed; };
  if (!std::all_of(command.begin(), command.end(), usable)) return false;
  command_ = command;
  is_new_ = true;
  return true;
}

void BaseController::starting(RobotHardware& robot, double time) {
  command_ = last_ = second_last_ = {};
  is_new_ = false;
  received_ = time;
  odometry_.reset();
  begin(robot);
}

void BaseController::update(RobotHardware& robot, double time, double period) {
  if (std::exchange(is_new_, false)) received_ = time;
  odometry_.move(settings_.open_loop ? commanded(last_, period) : moved(robot), period);
  const bool is_late = settings_.timeout > 0 && time - received_ > settings_.timeout;
  const Command wanted = is_late ? Command{} : command_;
  Command next{};
  for (std::size_t i = 0; i < next.size(); ++i) {
    next[i] = settings_.limits[i].limit(wanted[i], last_[i], second_last_[i], period);
  }
  second_last_ = std::exchange(last_, next);
  command_wheels(robot, next);
}

PlanarMotion BaseController::commanded(const Command& command, double period) const {
  return {command[0] * period, command[1] * period, command[2] * period};
}

void BaseController::transfer(StateArchive& archive) {
  archive(odometry_, is_new_, received_);
  for (Command* command : {&command_, &last_, &second_last_}) {
    for (double& number : *command) archive(number);
  }
  transfer_wheels(archive);
}

DiffDriveController::DiffDriveController(Wheels wheels, const Settings& settings)
    : BaseController(settings), wheels_(std::move(wheels)) {
  if (wheels_.left.empty() || wheels_.left.size() != wheels_.right.size()) {
    throw InvalidInput("there are " + std::to_string(wheels_.left.size()) + " left and " +
                       std::to_string(wheels_.right.size()) + " right wheels: they must be as many");
  }
  require_length("wheel separation", wheels_.separation);
  require_length("radius of the left wheels", wheels_.left_radius);
  require_length("radius of the right wheels", wheels_.right_radius);
}

std::vector<std::size_t> DiffDriveController::claimed() const {
  std::vector<std::size_t> joints = wheels_.left;
  joints.insert(joints.end(), wheels_.right.begin(), wheels_.right.end());
  return joints;
}

void DiffDriveController::begin(const RobotHardware& robot) {
  left_ = mean_position(robot, wheels_.left) * wheels_.left_radius;
  right_ = mean_position(robot, wheels_.right) * wheels_.right_radius;
}

PlanarMotion DiffDriveController::moved(const RobotHardware& robot) {
  const double left_before = left_;
  const double right_before = right_;
  begin(robot);
  const double left = left_ - left_before;
  const double right = right_ - right_before;
  return {(left + right) / 2, 0, (right - left) / wheels_.separation};
}

void DiffDriveController::command_wheels(RobotHardware& robot, const Command& command) {
  const double difference = command[2] * wheels_.separation / 2;
  for (const std::size_t joint : wheels_.left) {
    robot.joints()[joint].command = (command[0] - difference) / wheels_.left_radius;
  }
  for (const std::size_t joint : wheels_.right) {
    robot.joints()[joint].command = (command[0] + difference) / wheels_.right_radius;
  }
}

void DiffDriveController::transfer_wheels(StateArchive& archive) { archive(left_, right_); }

AckermannSteeringController::AckermannSteeringController(const Wheels& wheels, const Settings& settings)
    : BaseController(settings), wheels_(wheels) {
  require_length("distance of the axles", wheels_.wheel_base);
  require_length("radius of the rear wheel", wheels_.radius);
}

void AckermannSteeringController::begin(const RobotHardware& robot) {
  rear_ = robot.joints()[wheels_.rear].position * wheels_.radius;
}

PlanarMotion AckermannSteeringController::moved(const RobotHardware& robot) {
  const double now = robot.joints()[wheels_.rear].position * wheels_.radius;
  const double distance = now - std::exchange(rear_, now);
  return {distance, 0, distance * std::tan(robot.joints()[wheels_.steer].position) / wheels_.wheel_base};
}

PlanarMotion AckermannSteeringController::commanded(const Command& command, double period) const {
  const double distance = command[0] * period;
  return {distance, 0, distance * std::tan(command[2]) / wheels_.wheel_base};
}

void AckermannSteeringController::command_wheels(RobotHardware& robot, const Command& command) {
  robot.joints()[wheels_.rear].command = command[0] / wheels_.radius;
  robot.joints()[wheels_.steer].command = command[2];
}

void AckermannSteeringController::transfer_wheels(StateArchive& archive) { archive(rear_); }

}  // namespace bubblesim::control
