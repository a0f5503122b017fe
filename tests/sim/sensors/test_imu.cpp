// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "bubblesim/simulation.hpp"
#include "near.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_imu {
namespace {

constexpr double kGravity = 9.81;

/// A model with an IMU at `place` on its only link.
ModelDescription with_imu(LinkDescription link, const Pose& place, const Pose& pose = {},
                          const ImuDescription& imu = {}) {
  SensorDescription sensor;
  sensor.name = "Imu";
  sensor.pose = place;
  sensor.kind = imu;
  link.sensors.push_back(sensor);
  return model("Robot", std::move(link), pose);
}

ImuReading measured(Simulation& simulation) {
  return simulation.measure(simulation.world().tree().find("/Imu"))->measurement.get<ImuReading>();
}

TEST(Imu, AtRestMeasuresWhatHoldsItAgainstGravity) {
  Simulation simulation(scene({floor(), with_imu(link_with(Box{{1, 1, 1}}), {}, at(0, 0, 0.499))}));
  for (int i = 0; i < 20; ++i) simulation.step();
  const ImuReading reading = measured(simulation);
  expect_near(reading.linear_acceleration, {0, 0, kGravity}, 1e-3);
  expect_near(reading.angular_velocity, {}, 1e-3);
}

TEST(Imu, MeasuresInItsOwnFrame) {
  const Pose leaning(0, 0, 0, 0.5, 0, 0);  // about x: its y axis points up by as much
  Simulation simulation(scene({still(with_imu(link("link"), leaning))}));
  const ImuReading reading = measured(simulation);
  expect_near(reading.linear_acceleration, {0, kGravity * std::sin(0.5), kGravity * std::cos(0.5)}, 1e-9);
  expect_near(reading.orientation, leaning.orientation, 1e-9);
}

TEST(Imu, FallingMeasuresNothing) {
  Simulation simulation(scene({with_imu(link_with(Sphere{0.1}), at(0.3, 0, 0))}));
  for (int i = 0; i < 5; ++i) simulation.step();
  expect_near(measured(simulation).linear_acceleration, {}, 1e-6);
}

TEST(Imu, AwayFromTheAxisMeasuresTheRotation) {
  constexpr double kTurn = 2;     // rad/s
  constexpr double kLever = 0.5;  // m
  Simulation simulation(scene({with_imu(link("link"), Pose(kLever, 0, 0, 0, 0, 0))}, Vector3::Zero()));
  simulation.world().set_velocity(simulation.world().tree().find("/Robot"), {{}, {0, 0, kTurn}});
  for (int i = 0; i < 7; ++i) simulation.step();
  const ImuReading reading = measured(simulation);
  expect_near(reading.angular_velocity, {0, 0, kTurn}, 1e-6);
  expect_near(reading.linear_acceleration, {-kTurn * kTurn * kLever, 0, 0}, 1e-6);
}

TEST(Imu, FastTurnIsMeasuredInItsAxesAtEachMoment) {
  constexpr double kTurn = 10;    // rad/s: half a radian in a simulation step
  constexpr double kLever = 0.5;  // m
  Simulation simulation(scene({with_imu(link("link"), Pose(kLever, 0, 0, 0, 0, 0))}, Vector3::Zero()));
  simulation.world().set_velocity(simulation.world().tree().find("/Robot"), {{}, {0, 0, kTurn}});
  for (int i = 0; i < 7; ++i) simulation.step();
  const ImuReading reading = measured(simulation);
  expect_near(reading.linear_acceleration, {-kTurn * kTurn * kLever, 0, 0}, 1e-6);
}

TEST(Imu, OffTheCentreOfMassOfAHingedLink) {
  constexpr double kTurn = 10;  // rad/s
  LinkDescription arm = link("arm");
  arm.centre_of_mass = {0.5, 0, 0};
  ModelDescription robot = with_imu(arm, Pose(0.5, 0, 0, 0, 0, 0));
  robot.joints.push_back(joint("continuous", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {}, "world", "arm"));
  for (const Solver solver : {Solver::kOde, Solver::kBubblesim}) {
    SceneDescription described = scene({robot}, Vector3::Zero());
    described.solver = solver;
    Simulation simulation(described);
    simulation.world().joints().set_target_velocity(simulation.world().tree().find("/joint"), kTurn);
    for (int i = 0; i < 7; ++i) simulation.step();
    expect_near(measured(simulation).linear_acceleration, {-kTurn * kTurn * 0.5, 0, 0}, 0.02 * 50);
  }
}

TEST(Imu, BandwidthIsThatOfAFirstOrderLowPass) {
  constexpr double kBandwidth = 2;  // Hz
  constexpr double kForce = 3;      // N on 1 kg
  ImuDescription slow;
  slow.bandwidth = kBandwidth;
  Simulation simulation(scene({with_imu(link("link"), {}, {}, slow)}, Vector3::Zero()));
  simulation.step();
  for (int i = 1; i <= 4; ++i) {
    simulation.world().wrenches().apply(simulation.world().tree().find("/Robot"), {{kForce, 0, 0}, {}});
    simulation.step();
    const double wanted = kForce * (1 - std::exp(-2 * M_PI * kBandwidth * 0.05 * i));
    expect_near(measured(simulation).linear_acceleration, {wanted, 0, 0}, 1e-9);
  }
}

TEST(Imu, HasNoiseOnEachAxisForItself) {
  ImuDescription noisy;
  noisy.angular_velocity_noise[1].mean = 0.25;
  noisy.linear_acceleration_noise[0].mean = 0.5;
  noisy.linear_acceleration_noise[2].stddev = 0.1;
  Simulation simulation(scene({still(with_imu(link("link"), {}, {}, noisy))}), 5);
  const ImuReading reading = measured(simulation);
  expect_near(reading.angular_velocity, {0, 0.25, 0}, 1e-12);
  EXPECT_NEAR(reading.linear_acceleration.x(), 0.5, 1e-12);
  EXPECT_EQ(reading.linear_acceleration.y(), 0);
  EXPECT_NE(reading.linear_acceleration.z(), kGravity);
  EXPECT_NEAR(reading.linear_acceleration.z(), kGravity, 0.5) << "five standard deviations";
}

}  // namespace
}  // namespace bubblesim::test::test_imu
