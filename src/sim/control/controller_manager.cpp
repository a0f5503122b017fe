// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/control/controller_manager.hpp"

#include <algorithm>
#include <utility>

#include "bubblesim/error.hpp"

namespace bubblesim::control {

void Controller::starting(RobotHardware&, double) {}
void Controller::stopping(RobotHardware&) {}
void Controller::transfer(StateArchive&) {}

void ControllerManager::start(std::shared_ptr<Controller> controller) {
  const std::vector<std::size_t> wanted = controller->claimed();
  for (const Running& each : running_) {
    if (each.controller == controller) throw InvalidInput("the controller runs already");
    for (const std::size_t taken : each.controller->claimed()) {
      if (std::find(wanted.begin(), wanted.end(), taken) == wanted.end()) continue;
      throw InvalidInput("the joint " + robot_.joints().at(taken).name + " is commanded by another running controller");
    }
  }
  running_.push_back({std::move(controller)});
}

void ControllerManager::stop(const Controller& controller) {
  const auto is_it = [&](const Running& each) { return each.controller.get() == &controller; };
  const auto found = std::find_if(running_.begin(), running_.end(), is_it);
  if (found == running_.end()) return;
  found->controller->stopping(robot_);
  for (const std::size_t joint : found->controller->claimed()) robot_.release(robot_.joints().at(joint));
  running_.erase(found);
}

bool ControllerManager::runs(const Controller& controller) const {
  return std::any_of(running_.begin(), running_.end(),
                     [&](const Running& each) { return each.controller.get() == &controller; });
}

void ControllerManager::update(World& world, double time, double duration) {
  robot_.read(world);
  for (Running& each : running_) {
    if (std::exchange(each.is_new, false)) each.controller->starting(robot_, time);
    each.controller->update(robot_, time, duration);
  }
  robot_.write(world, duration);
}

void ControllerManager::reset(World& world) {
  robot_.reset(world);
  for (Running& each : running_) each.is_new = true;
}

void ControllerManager::transfer(StateArchive& archive) {
  archive(robot_);
  archive.require(running_.size(), "number of running controllers");
  for (Running& each : running_) archive(each.is_new, *each.controller);
}

}  // namespace bubblesim::control
