// SPDX-License-Identifier: BSD-3-Clause
// Force-torque and contact sensors, compared with theory.
#include <gtest/gtest.h>

#include <cmath>

#include "bubblesim/simulation.hpp"
#include "near.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_forces {
namespace {

constexpr double kGravity = 9.81;

template <class Kind>
SensorDescription sensor(const std::string& name, const Kind& kind) {
  SensorDescription made;
  made.name = name;
  made.kind = kind;
  return made;
}

/// An arm that turns about z, and a hand of 1 kg at 0.5 m from the axis on a fixed joint with a sensor.
ModelDescription turning_hand(const ForceTorqueDescription& kind) {
  ModelDescription robot = model("Robot", link("arm"));
  LinkDescription hand = link("hand");
  hand.centre_of_mass = {0.5, 0, 0};
  robot.links.push_back(hand);
  robot.joints.push_back(joint("continuous", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {}, "world", "arm"));
  JointDescription wrist = joint("fixed", {}, {}, "arm", "hand");
  wrist.name = "wrist";
  wrist.sensors.push_back(sensor("Wrist", kind));
  robot.joints.push_back(wrist);
  return robot;
}

TEST(ForceTorque, FastTurnIsMeasuredInItsAxesAtEachMoment) {
  constexpr double kTurn = 10;  // rad/s: half a radian in a simulation step
  for (const auto frame : {ForceTorqueDescription::Frame::kChild, ForceTorqueDescription::Frame::kParent,
                           ForceTorqueDescription::Frame::kSensor}) {
    for (const Solver solver : {Solver::kOde, Solver::kBubblesim}) {
      ForceTorqueDescription kind;
      kind.frame = frame;
      SceneDescription described = scene({turning_hand(kind)}, Vector3::Zero());
      described.solver = solver;
      Simulation simulation(described);
      const SceneTree& tree = simulation.world().tree();
      simulation.world().joints().set_target_velocity(tree.find("/joint"), kTurn);
      for (int i = 0; i < 7; ++i) simulation.step();
      const auto reading = simulation.measure(tree.find("/Wrist"))->measurement.get<ForceTorqueReading>();
      expect_near(reading.force, {kTurn * kTurn * 0.5, 0, 0}, 0.02 * 50);  // m w^2 r, outwards
      expect_near(reading.torque, {}, 0.02 * 50 * 0.5);
    }
  }
}

TEST(ForceTorque, MeasuresTheWeightAndTheContactsBehindItsJoint) {
  for (const Solver solver : {Solver::kOde, Solver::kBubblesim}) {
    ModelDescription robot = turning_hand({});
    robot.joints[0].axes[0] = axis(Vector3::UnitY());  // a free hinge: the floor bears all of the hand
    robot.links[1].collisions.push_back(shape(Sphere{0.1}, 0));
    robot.links[1].collisions.back().pose = at(0.5, 0, 0);
    robot.pose = at(0, 0, 0.1);
    SceneDescription described = scene({floor(), robot});
    described.solver = solver;
    Simulation simulation(described);
    const SceneTree& tree = simulation.world().tree();
    for (int i = 0; i < 40; ++i) simulation.step();
    const auto force = [&] {
      return simulation.measure(tree.find("/Wrist"))->measurement.get<ForceTorqueReading>().force;
    };
    expect_near(force(), {}, 1e-3);
    simulation.world().wrenches().apply(tree.find("/Robot/*", kNoObject, 0), {{0, 0, 0}, {0, -3, 0}});
    simulation.step();  // the arm lifts 3 N m / 0.5 m from the floor: the wrist bears them
    expect_near(force(), {0, 0, -6}, 1e-2);
  }
}

TEST(ForceTorque, BandwidthIsThatOfAFirstOrderLowPass) {
  constexpr double kBandwidth = 2;  // Hz
  ForceTorqueDescription kind;
  kind.bandwidth = kBandwidth;
  Simulation simulation(scene({turning_hand(kind)}, Vector3::Zero()));
  const SceneTree& tree = simulation.world().tree();
  simulation.step();
  for (int i = 1; i <= 3; ++i) {
    simulation.world().wrenches().apply(tree.find("/Robot/*", kNoObject, 1), {{0, 0, 4}, {}});
    simulation.step();
    const auto reading = simulation.measure(tree.find("/Wrist"))->measurement.get<ForceTorqueReading>();
    EXPECT_NEAR(reading.force.z(), 4 * (1 - std::exp(-2 * M_PI * kBandwidth * 0.05 * i)), 1e-6);
  }
}

/// A box of 1 kg and 0.2 m with a contact sensor, at a height above the floor.
ModelDescription box(const std::string& name, double z) {
  LinkDescription described = link(name);
  described.inertia_diagonal = Vector3::Ones() * (1.0 / 150);
  described.collisions.push_back(shape(Box{{0.2, 0.2, 0.2}}));
  described.sensors.push_back(sensor(name + "_bumper", ContactDescription{}));
  return model(name, described, at(0, 0, z));
}

Vector3 force_between(Simulation& simulation, const std::string& sensor, const std::string& other) {
  const SceneTree& tree = simulation.world().tree();
  const auto reading = simulation.measure(tree.find(sensor))->measurement.get<ContactReading>();
  Vector3 sum;
  for (const Contact& contact : reading.contacts) {
    if (tree.path(tree.outermost_model_of(contact.other_link)) == other) sum += contact.force;
  }
  return sum;
}

TEST(ContactSensor, BothSidesOfAContactMeasureTheSameForce) {
  Simulation simulation(scene({floor(), box("Low", 0.1), box("High", 0.3), box("Top", 0.5)}));
  for (int i = 0; i < 40; ++i) simulation.step();
  for (int i = 0; i < 20; ++i) {
    simulation.step();
    const Vector3 on_low = force_between(simulation, "/Low_bumper", "/High");
    expect_near(force_between(simulation, "/High_bumper", "/Low"), -on_low, 1e-12);
    const Vector3 on_high = force_between(simulation, "/High_bumper", "/Top");
    expect_near(force_between(simulation, "/Top_bumper", "/High"), -on_high, 1e-12);
  }
  expect_near(force_between(simulation, "/Low_bumper", "/Floor"), {0, 0, 3 * kGravity}, 0.02 * 3 * kGravity);
  expect_near(force_between(simulation, "/High_bumper", "/Low"), {0, 0, 2 * kGravity}, 0.02 * 2 * kGravity);
  expect_near(force_between(simulation, "/Top_bumper", "/High"), {0, 0, kGravity}, 0.02 * kGravity);
}

}  // namespace
}  // namespace bubblesim::test::test_forces
