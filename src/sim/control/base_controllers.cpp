// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/base_controllers.hpp"

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

void require_length(const char* what, double length) {
  if (std::isfinite(length) && length > 0) return;
  throw InvalidInput(std::string("the ") + what + " of " + text(length) + " m is not usable: it must be above 0");
}

}  // namespace

bool BaseController::set_command(double linear, double angular) {
  if (!(std::abs(linear) <= kMaxSpeed && std::abs(angular) <= kMaxSpeed)) return false;
  command_ = {linear, angular};
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
  const auto [distance, angle] = settings_.open_loop ? commanded(last_, period) : moved(robot, period);
  odometry_.move(distance, angle, period);
  const bool is_late = settings_.timeout > 0 && time - received_ > settings_.timeout;
  const Command wanted = is_late ? Command{} : command_;
  const Command next{settings_.linear.limit(wanted.linear, last_.linear, second_last_.linear, period),
                     settings_.angular.limit(wanted.angular, last_.angular, second_last_.angular, period)};
  second_last_ = std::exchange(last_, next);
  command_wheels(robot, next);
}

std::array<double, 2> BaseController::commanded(const Command& command, double period) const {
  return {command.linear * period, command.angular * period};
}

void BaseController::transfer(StateArchive& archive) {
  archive(odometry_, is_new_, received_);
  for (Command* command : {&command_, &last_, &second_last_}) archive(command->linear, command->angular);
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

std::array<double, 2> DiffDriveController::moved(const RobotHardware& robot, double) {
  const double left_before = left_;
  const double right_before = right_;
  begin(robot);
  const double left = left_ - left_before;
  const double right = right_ - right_before;
  return {(left + right) / 2, (right - left) / wheels_.separation};
}

void DiffDriveController::command_wheels(RobotHardware& robot, const Command& command) {
  const double difference = command.angular * wheels_.separation / 2;
  for (const std::size_t joint : wheels_.left) {
    robot.joints()[joint].command = (command.linear - difference) / wheels_.left_radius;
  }
  for (const std::size_t joint : wheels_.right) {
    robot.joints()[joint].command = (command.linear + difference) / wheels_.right_radius;
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

std::array<double, 2> AckermannSteeringController::moved(const RobotHardware& robot, double) {
  const double now = robot.joints()[wheels_.rear].position * wheels_.radius;
  const double distance = now - std::exchange(rear_, now);
  return {distance, distance * std::tan(robot.joints()[wheels_.steer].position) / wheels_.wheel_base};
}

std::array<double, 2> AckermannSteeringController::commanded(const Command& command, double period) const {
  const double distance = command.linear * period;
  return {distance, distance * std::tan(command.angular) / wheels_.wheel_base};
}

void AckermannSteeringController::command_wheels(RobotHardware& robot, const Command& command) {
  robot.joints()[wheels_.rear].command = command.linear / wheels_.radius;
  robot.joints()[wheels_.steer].command = command.angular;
}

void AckermannSteeringController::transfer_wheels(StateArchive& archive) { archive(rear_); }

}  // namespace bubblesim::control
