// SPDX-License-Identifier: BSD-3-Clause
// Measures how long controllers of a six-joint arm take before a physics substep, by joint, and the switch from one
// controller to another.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "bubblesim/control/joint_controllers.hpp"
#include "bubblesim/control/trajectory_controller.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/world.hpp"

namespace {

using namespace bubblesim;
using namespace bubblesim::control;

constexpr std::size_t kJoints = 6;
constexpr double kStep = 0.001;  // s
constexpr int kUpdates = 20000;
constexpr int kSwitches = 1000;
constexpr int kRounds = 21;

std::string arm() {
  std::string text = "<sdf version='1.9'><model name='arm'><link name='link_0'/>";
  text += "<joint name='base' type='fixed'><parent>world</parent><child>link_0</child></joint>";
  for (std::size_t i = 1; i <= kJoints; ++i) {
    const std::string here = std::to_string(i);
    text += "<link name='link_" + here + "'><pose>0 0 " + here + " 0 0 0</pose></link><joint name='joint_" + here +
            "' type='revolute'><parent>link_" + std::to_string(i - 1) + "</parent><child>link_" + here +
            "</child><axis><xyz>0 1 0</xyz></axis></joint>";
  }
  return text + "</model></sdf>";
}

struct Arm {
  Arm() : world(scene(), 0) {
    std::vector<ControlledJoint> joints(kJoints);
    for (std::size_t i = 0; i < kJoints; ++i) {
      joints[i].name = "joint_" + std::to_string(i + 1);
      joints[i].id = world.tree().find("/arm/" + joints[i].name);
      joints[i].interface = CommandInterface::kEffort;
    }
    manager = std::make_shared<ControllerManager>(RobotHardware(world, joints));
    world.devices().add(manager);
  }

  static SceneDescription scene() {
    SceneDescription scene;
    scene.models.push_back(load_model(arm(), "."));
    return scene;
  }

  World world;
  std::shared_ptr<ControllerManager> manager;
};

/// The median over rounds of the mean time of a call, in us.
double microseconds(int calls, const std::function<void(int)>& call) {
  std::vector<double> rounds;
  for (int round = 0; round < kRounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; ++i) call(i);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    rounds.push_back(took.count() / calls);
  }
  std::nth_element(rounds.begin(), rounds.begin() + kRounds / 2, rounds.end());
  return rounds[kRounds / 2];
}

std::shared_ptr<TrajectoryController> trajectory() {
  TrajectoryController::Settings settings;
  settings.joints.resize(kJoints);
  std::iota(settings.joints.begin(), settings.joints.end(), 0);
  settings.gains.assign(kJoints, PidGains{100, 1, 10, 1, -1, false});
  auto made = std::make_shared<TrajectoryController>(settings);
  return made;
}

TrajectoryController::Knots sine(double seconds) {
  TrajectoryController::Knots knots(kJoints);
  for (std::vector<JointKnot>& of_joint : knots) {
    for (double t = 0.1; t < seconds; t += 0.1) of_joint.push_back({t, std::sin(3 * t), 3 * std::cos(3 * t), {}});
  }
  return knots;
}

void report(const char* what, double us) { std::printf("%-48s %8.3f us\n", what, us); }

}  // namespace

int main() {
  Arm arm;
  auto pids = std::vector<std::shared_ptr<PidController>>();
  for (std::size_t i = 0; i < kJoints; ++i) {
    pids.push_back(
        std::make_shared<PidController>(i, PidController::Kind::kPosition, PidGains{100, 1, 10, 1, -1, false}));
    arm.manager->start(pids.back());
  }
  const auto update = [&](int i) { arm.manager->update(arm.world, i * kStep, kStep); };
  report("PID of a joint, by substep and joint", microseconds(kUpdates, update) / kJoints);
  for (const auto& pid : pids) arm.manager->stop(*pid);

  auto follower = trajectory();
  arm.manager->start(follower);
  update(0);
  follower->follow(sine(kUpdates * kStep), 0, 0, {});
  report("trajectory of 200 points, by substep and joint", microseconds(kUpdates, update) / kJoints);

  auto other = trajectory();
  report("switch to another trajectory controller", microseconds(kSwitches, [&](int i) {
           auto& stopping = i % 2 == 0 ? follower : other;
           auto& starting = i % 2 == 0 ? other : follower;
           arm.manager->stop(*stopping);
           arm.manager->start(starting);
           arm.manager->update(arm.world, i * kStep, kStep);
         }));
  return arm.manager->runs(*follower) && !arm.manager->runs(*other) ? EXIT_SUCCESS : EXIT_FAILURE;
}
