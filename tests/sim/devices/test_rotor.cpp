// SPDX-License-Identifier: BSD-3-Clause
// Rotors: thrust, reaction torque, drag and response, compared with the formulas of Gazebo's motor model.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/rotor.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_rotor {
namespace {

constexpr double kStep = 0.001;
constexpr double kGravity = 9.81;
constexpr double kMass = 1.5;        // kg, of all links
constexpr double kRotorMass = 0.01;  // kg, of each propeller

JointDescription spindle(const std::string& name, const Vector3& place) {
  JointDescription made = joint("continuous", {axis(Vector3::UnitZ())}, place, "frame", name);
  made.name = name + "_joint";
  return made;
}

/// A frame with four propellers at the corners of a square of 0.4 m, which turn in alternating directions.
SceneDescription quadcopter(const Vector3& gravity = {0, 0, -kGravity}, const Vector3& wind = {}) {
  ModelDescription robot = model("Quad", link("frame"), at(0, 0, 10));
  robot.links[0].mass = kMass - 4 * kRotorMass;
  robot.links[0].inertia_diagonal = {0.02, 0.02, 0.04};
  for (int i = 0; i < 4; ++i) {
    const Vector3 place(i < 2 ? 0.2 : -0.2, i % 2 == 0 ? 0.2 : -0.2, 0);
    LinkDescription propeller = link("propeller" + std::to_string(i), place);
    propeller.mass = kRotorMass;
    propeller.inertia_diagonal = {1e-5, 1e-5, 2e-5};
    robot.links.push_back(propeller);
    robot.joints.push_back(spindle(propeller.name, place));
  }
  SceneDescription made = scene({robot}, gravity);
  made.substep = kStep;
  made.environment.wind = wind;
  return made;
}

class Quadcopter : public ::testing::Test {
 protected:
  void make(const SceneDescription& description, RotorDescription rotor = {}) {
    simulation = std::make_unique<Simulation>(description);
    rotors.clear();
    for (int i = 0; i < 4; ++i) {
      rotor.joint = joint_of(i);
      rotor.clockwise = i == 1 || i == 2;
      rotors.push_back(std::make_shared<Rotor>(world(), rotor, simulation->wind()));
      world().devices().add(rotors.back(), world().tree().find("/Quad"));
    }
  }
  World& world() { return simulation->world(); }
  ObjectId joint_of(int i) { return world().tree().find("/Quad/propeller" + std::to_string(i) + "_joint"); }
  ObjectId frame() { return world().tree().find("/Quad/frame"); }
  void run(double seconds) {
    for (int i = 0; i < std::lround(seconds / simulation->time_step()); ++i) simulation->step();
  }
  void command(double speed) {
    for (auto& rotor : rotors) rotor->set_speed(speed);
  }

  std::unique_ptr<Simulation> simulation;
  std::vector<std::shared_ptr<Rotor>> rotors;
};

/// 4 k w^2 = m g
double hover_speed(const RotorDescription& rotor) {
  return std::sqrt(kMass * kGravity / (4 * rotor.thrust_coefficient));
}

TEST_F(Quadcopter, HoversAtTheSpeedAtWhichTheThrustIsTheWeight) {
  RotorDescription rotor;
  rotor.time_up = rotor.time_down = 0;
  make(quadcopter(), rotor);
  command(hover_speed(rotor));
  run(0.1);
  const double start = world().pose(frame()).position.z();
  const double speed = world().velocity(frame()).linear.z();  // it fell while the propellers stood still
  EXPECT_NEAR(speed, -kGravity * kStep, kGravity * kStep);
  run(10);
  EXPECT_NEAR(world().pose(frame()).position.z(), start + 10 * speed, 1e-3);
  EXPECT_NEAR(to_rpy(world().pose(frame()).orientation).z(), 0, 1e-3) << "the reaction torques cancel";
}

TEST_F(Quadcopter, ThrustAcceleratesItByItsExcess) {
  RotorDescription rotor;
  rotor.time_up = rotor.time_down = 0;
  make(quadcopter(), rotor);
  command(hover_speed(rotor) * std::sqrt(1.2));
  run(0.1);
  const double before = world().velocity(frame()).linear.z();
  run(1);
  EXPECT_NEAR(world().velocity(frame()).linear.z() - before, 0.2 * kGravity, 1e-4);
}

TEST_F(Quadcopter, SpeedApproachesTheCommandExponentially) {
  RotorDescription rotor;
  rotor.time_up = 0.2;
  rotor.time_down = 0.5;
  make(quadcopter(Vector3::Zero()), rotor);
  command(500);
  run(0.2);
  EXPECT_NEAR(rotors[0]->speed(), 500 * (1 - std::exp(-1)), 1e-6);
  run(10);
  command(100);
  run(0.5);
  EXPECT_NEAR(rotors[0]->speed(), 100 + 400 * std::exp(-1), 1e-2);
  EXPECT_NEAR(world().joints().velocity(joint_of(0)) * rotor.slowdown, rotors[0]->speed(), 1);
}

TEST_F(Quadcopter, SpeedIsLimited) {
  RotorDescription rotor;
  rotor.time_up = 0;
  make(quadcopter(Vector3::Zero()), rotor);
  command(1e5);
  run(0.05);
  EXPECT_EQ(rotors[0]->speed(), rotor.max_speed);
}

TEST_F(Quadcopter, ReactionTorqueTurnsTheFrameAgainstThePropellers) {
  RotorDescription rotor;
  rotor.time_up = rotor.time_down = 0;
  rotor.drag_coefficient = 0;
  make(quadcopter(Vector3::Zero()), rotor);
  const double speed = 400;
  rotors[0]->set_speed(speed);
  rotors[3]->set_speed(speed);  // both counter-clockwise, at opposite corners
  run(0.1);
  const double before = world().velocity(frame()).angular.z();
  run(0.2);
  const double torque = -2 * rotor.thrust_coefficient * speed * speed * rotor.torque_length;
  // The propellers keep their speed relative to the frame, so they turn with it.
  const double inertia = 0.04 + 4 * (2e-5 + kRotorMass * 0.08);
  EXPECT_NEAR((world().velocity(frame()).angular.z() - before) / 0.2, torque / inertia,
              1e-3 * std::abs(torque) / inertia);
}

TEST_F(Quadcopter, RotorDragIsProportionalToSpeedAndVelocityRelativeToTheWind) {
  RotorDescription rotor;
  rotor.time_up = rotor.time_down = 0;
  rotor.rolling_coefficient = 0;
  make(quadcopter(Vector3::Zero(), {3, 0, 0}), rotor);
  const double speed = 500;
  for (int i = 0; i < 4; ++i) rotors[static_cast<std::size_t>(i)]->set_speed(i % 2 == 0 ? speed : -speed);
  run(0.1);  // without thrust as a whole
  const double before = world().velocity(frame()).linear.x();
  run(0.05);
  const double acceleration = (world().velocity(frame()).linear.x() - before) / 0.05;
  EXPECT_NEAR(acceleration, 4 * rotor.drag_coefficient * speed * (3 - before) / kMass, 2e-3);
}

TEST_F(Quadcopter, ATargetVelocityOfTheJointIsACommand) {
  RotorDescription rotor;
  rotor.time_up = 0.05;
  make(quadcopter(Vector3::Zero()), rotor);
  world().joints().set_target_velocity(joint_of(0), 30);
  world().joints().set_target_velocity(joint_of(1), -40);  // clockwise
  run(1);
  EXPECT_NEAR(rotors[0]->speed(), 300, 1e-2);
  EXPECT_NEAR(rotors[1]->speed(), 400, 1e-2);
}

TEST_F(Quadcopter, StopsOnAReset) {
  make(quadcopter(Vector3::Zero()));
  run(0.05);
  simulation->reset();
  const std::uint64_t fresh = simulation->state_hash();
  command(500);
  run(0.5);
  simulation->reset();
  EXPECT_EQ(simulation->state_hash(), fresh);
  EXPECT_EQ(rotors[0]->speed(), 0);
}

TEST_F(Quadcopter, InvalidParametersAreRefused) {
  make(quadcopter());
  RotorDescription rotor;
  rotor.joint = joint_of(0);
  const auto refuses = [&](auto&& change) {
    RotorDescription changed = rotor;
    change(changed);
    EXPECT_THROW(Rotor(world(), changed, nullptr), InvalidInput);
  };
  refuses([](RotorDescription& r) { r.thrust_coefficient = -1; });
  refuses([](RotorDescription& r) { r.max_speed = 0; });
  refuses([](RotorDescription& r) { r.time_up = kNaN; });
  refuses([](RotorDescription& r) { r.slowdown = 0; });
  refuses([](RotorDescription& r) { r.torque_length = kInfinity; });
  EXPECT_THROW(rotors[0]->set_speed(kNaN), InvalidInput);
  World fixed(jointed(joint("fixed", {})), 0);
  rotor.joint = fixed.tree().find("/joint");
  EXPECT_THROW(Rotor(fixed, rotor, nullptr), WrongObject);
}

}  // namespace
}  // namespace bubblesim::test::test_rotor
