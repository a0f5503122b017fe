// SPDX-License-Identifier: BSD-3-Clause
// An arm with six joints, which carries its links: it follows a trajectory, also when its controllers are switched.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "bubblesim/control/trajectory_controller.hpp"
#include "bubblesim/scene_loader.hpp"
#include "bubblesim/world.hpp"

namespace bubblesim::test::test_arm {
namespace {

using namespace control;  // NOLINT(google-build-using-namespace): all of it is tested here

constexpr std::size_t kJoints = 6;
constexpr double kStep = 0.001;                             // s, as in Gazebo's worlds
constexpr double kRate = 2 * 3.14159265358979323846 * 0.5;  // rad/s, of 0.5 Hz
constexpr double kAmplitude = 0.4;                          // rad

/// Links of 1 kg and 0.2 m, one above the other, on joints about y and z in turn.
std::string arm() {
  std::string text = "<sdf version='1.9'><model name='arm'><link name='link_0'/>";
  text += "<joint name='base' type='fixed'><parent>world</parent><child>link_0</child></joint>";
  for (std::size_t i = 1; i <= kJoints; ++i) {
    const std::string here = std::to_string(i);
    text += "<link name='link_" + here + "'><pose>0 0 " + std::to_string(0.2 * static_cast<double>(i)) +
            " 0 0 0</pose><inertial><pose>0 0 0.1 0 0 0</pose><mass>1</mass><inertia><ixx>0.0033</ixx><iyy>0.0033</iyy>"
            "<izz>0.001</izz></inertia></inertial></link><joint name='joint_" +
            here + "' type='revolute'><parent>link_" + std::to_string(i - 1) + "</parent><child>link_" + here +
            "</child><axis><xyz>" + (i % 2 == 0 ? "0 1 0" : "0 0 1") +
            "</xyz><limit><lower>-3</lower><upper>3</upper><effort>150</effort><velocity>3</velocity></limit></axis>"
            "</joint>";
  }
  return text + "</model></sdf>";
}

SceneDescription scene_of_arm() {
  SceneDescription described;
  described.models.push_back(load_model(arm(), "."));
  return described;
}

double wanted(std::size_t joint, double time) {
  return kAmplitude * std::sin(kRate * time + 0.5 * static_cast<double>(joint)) -
         kAmplitude * std::sin(0.5 * static_cast<double>(joint));
}

double wanted_velocity(std::size_t joint, double time) {
  return kAmplitude * kRate * std::cos(kRate * time + 0.5 * static_cast<double>(joint));
}

class Arm : public ::testing::Test {
 protected:
  Arm() {
    std::vector<ControlledJoint> joints(kJoints);
    for (std::size_t i = 0; i < kJoints; ++i) {
      joints[i].name = "joint_" + std::to_string(i + 1);
      joints[i].id = world.tree().find("/arm/" + joints[i].name);
      joints[i].interface = CommandInterface::kPosition;
    }
    manager = std::make_shared<ControllerManager>(RobotHardware(world, joints));
    world.devices().add(manager);
  }

  static std::shared_ptr<TrajectoryController> controller() {
    TrajectoryController::Settings settings;
    settings.joints.resize(kJoints);
    std::iota(settings.joints.begin(), settings.joints.end(), 0);
    return std::make_shared<TrajectoryController>(settings);
  }

  /// The sine with a knot each 40 ms; `start` is the time of its first one.
  static TrajectoryController::Knots sine(double start, double seconds) {
    TrajectoryController::Knots knots(kJoints);
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      for (double t = start; t < start + seconds; t += 0.04) {
        knots[joint].push_back({t, wanted(joint, t), wanted_velocity(joint, t)});
      }
    }
    return knots;
  }

  /// The largest error of the joints at a time, rad.
  double error(double time) const {
    double largest = 0;
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      const double position = world.joints().position(manager->robot().joints()[joint].id);
      largest = std::max(largest, std::abs(position - wanted(joint, time)));
    }
    return largest;
  }

  World world{scene_of_arm(), 0};
  std::shared_ptr<ControllerManager> manager;
};

TEST_F(Arm, FollowsASineTo2Milliradians) {
  const auto trajectory = controller();
  manager->start(trajectory);
  world.advance(kStep, kStep);
  trajectory->follow(sine(0.5, 5), kStep, kStep, {});
  world.advance(1.0 - kStep, kStep);
  double largest = 0;
  for (int i = 1; i <= 4000; ++i) {
    world.advance(kStep, kStep);
    largest = std::max(largest, error(1.0 + i * kStep));
  }
  EXPECT_LT(largest, 2e-3);
}

TEST_F(Arm, LosesNothingIn1000Switches) {
  const std::vector<std::shared_ptr<TrajectoryController>> two{controller(), controller()};
  manager->start(two[0]);
  world.advance(kStep, kStep);
  two[0]->follow(sine(0.5, 2), kStep, kStep, {});
  world.advance(1.0 - kStep, kStep);
  double largest = 0;
  for (int i = 0; i < 1000; ++i) {  // each takes over in the middle of the motion
    const double now = 1.0 + i * 4 * kStep;
    manager->stop(*two[i % 2]);
    const auto& next = two[(i + 1) % 2];
    manager->start(next);
    ASSERT_TRUE(manager->runs(*next));
    ASSERT_FALSE(manager->runs(*two[i % 2]));
    world.advance(kStep, kStep);
    next->follow(sine(now + 2 * kStep, 0.5), now + kStep, now + kStep, {});
    world.advance(3 * kStep, kStep);
    largest = std::max(largest, error(now + 4 * kStep));
  }
  EXPECT_LT(largest, 10e-3);
  const double end = 5.0;
  world.advance(0.4, kStep);
  EXPECT_LT(error(end + 0.4), 2e-3) << "the last one has its whole trajectory";
}

}  // namespace
}  // namespace bubblesim::test::test_arm
