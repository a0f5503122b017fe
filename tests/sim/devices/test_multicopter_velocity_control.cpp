// SPDX-License-Identifier: BSD-3-Clause
// A multicopter that flies at commanded velocities, with the gains of gz-sim's X3.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/multicopter_velocity_control.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_multicopter_velocity_control {
namespace {

SceneDescription x3() {
  ModelDescription robot = model("X3", link("frame"), at(0, 0, 10));
  robot.links[0].mass = 1.5;
  robot.links[0].inertia_diagonal = {0.0347563, 0.0458929, 0.0977};
  const std::vector<Vector3> places = {
      {0.13, -0.22, 0.023}, {-0.13, 0.2, 0.023}, {0.13, 0.22, 0.023}, {-0.13, -0.2, 0.023}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    LinkDescription propeller = link("propeller" + std::to_string(i), places[i]);
    propeller.mass = 0.005;
    propeller.inertia_diagonal = {9.75e-7, 4.17041e-5, 4.26041e-5};
    robot.links.push_back(propeller);
    JointDescription spindle = joint("continuous", {axis(Vector3::UnitZ())}, places[i], "frame", propeller.name);
    spindle.name = propeller.name + "_joint";
    robot.joints.push_back(spindle);
  }
  return scene({robot});
}

class X3 : public ::testing::Test {
 protected:
  X3() {
    gains.link = world.tree().find("/X3/frame");
    gains.velocity_gain = {2.7, 2.7, 2.7};
    gains.attitude_gain = {2, 3, 0.15};
    gains.rate_gain = {0.4, 0.52, 0.18};
    gains.max_acceleration = {2, 2, 2};
    for (int i = 0; i < 4; ++i) {
      RotorDescription rotor;
      rotor.joint = world.tree().find("/X3/propeller" + std::to_string(i) + "_joint");
      rotor.clockwise = i >= 2;
      rotor.max_speed = 800;
      rotor.drag_coefficient = rotor.rolling_coefficient = 0;  // they leave an error: there is no integral part
      rotors.push_back(std::make_shared<Rotor>(world, rotor, simulation.wind()));
      world.devices().add(rotors.back());
    }
    control = std::make_shared<MulticopterVelocityControl>(world, gains, rotors);
    world.devices().add(control);
  }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / simulation.time_step()); ++i) simulation.step();
  }
  Twist velocity() { return world.velocity(gains.link); }

  Simulation simulation{x3()};
  World& world = simulation.world();
  VelocityControlDescription gains;
  std::vector<std::shared_ptr<Rotor>> rotors;
  std::shared_ptr<MulticopterVelocityControl> control;
};

TEST_F(X3, Hovers) {
  control->set_velocity({}, 0);
  run(20);
  EXPECT_LT(velocity().linear.norm(), 1e-3);
  const double hover = std::sqrt(1.52 * 9.81 / 4 / rotors[0]->description().thrust_coefficient);
  double sum = 0;
  for (const auto& rotor : rotors) sum += rotor->speed() / 4;
  EXPECT_NEAR(sum, hover, 1e-3 * hover);
}

TEST_F(X3, FliesAtTheCommandedVelocityAlongItsAxes) {
  world.set_pose(world.tree().find("/X3"), Pose(0, 0, 10, 0, 0, M_PI / 2));
  control->set_velocity({1, 0, 0.5}, 0);
  run(20);
  EXPECT_NEAR(velocity().linear.y(), 1, 1e-3);
  EXPECT_NEAR(velocity().linear.x(), 0, 1e-3);
  EXPECT_NEAR(velocity().linear.z(), 0.5, 1e-3);
}

TEST_F(X3, TurnsAtTheCommandedRate) {
  control->set_velocity({}, 0.4);
  run(20);
  EXPECT_NEAR(velocity().angular.z(), 0.4, 1e-3);
  EXPECT_LT(velocity().linear.norm(), 0.02);
}

TEST_F(X3, AccelerationIsLimited) {
  control->set_velocity({}, 0);
  run(5);
  control->set_velocity({100, 0, 0}, 0);
  run(1);
  EXPECT_LT(velocity().linear.x(), 2.2);
}

TEST_F(X3, FallsAfterAStopAndWithoutACommand) {
  run(0.5);
  EXPECT_NEAR(velocity().linear.z(), -9.81 * 0.5, 0.03);
  control->set_velocity({}, 0);
  run(1);
  control->stop();
  run(2);
  EXPECT_EQ(rotors[0]->speed(), 0);
}

TEST_F(X3, InvalidParametersAreRefused) {
  EXPECT_THROW(control->set_velocity({kNaN, 0, 0}, 0), InvalidInput);
  EXPECT_THROW(control->set_velocity({}, kInfinity), InvalidInput);
  VelocityControlDescription bad = gains;
  bad.attitude_gain = {-1, 0, 0};
  EXPECT_THROW(MulticopterVelocityControl(world, bad, rotors), InvalidInput);
  VelocityControlDescription endless = gains;
  endless.max_acceleration.y() = kNaN;
  EXPECT_THROW(MulticopterVelocityControl(world, endless, rotors), InvalidInput);
  EXPECT_THROW(MulticopterVelocityControl(world, gains, {rotors[0], rotors[1]}), InvalidInput);
}

}  // namespace
}  // namespace bubblesim::test::test_multicopter_velocity_control
