// SPDX-License-Identifier: BSD-3-Clause
// Mecanum wheels and four steered wheels: commands against the kinematics of rigid bodies, odometry as their inverse.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bubblesim/control/omnidirectional_controllers.hpp"
#include "bubblesim/error.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_omnidirectional_controllers {
namespace {

using namespace control;  // NOLINT(google-build-using-namespace): all of it is tested here

constexpr double kStep = 0.001;
constexpr double kPi = kTurn / 2;

class FreeJoints : public ::testing::Test {
 protected:
  RobotHardware joints(std::size_t driven, std::size_t steered) {
    ControlledJoint wheel;
    wheel.id = world.tree().find("/joint");
    wheel.interface = CommandInterface::kVelocity;
    ControlledJoint steering = wheel;
    steering.interface = CommandInterface::kPosition;
    std::vector<ControlledJoint> all(driven, wheel);
    all.insert(all.end(), steered, steering);
    return RobotHardware(world, all);
  }

  static double command(const RobotHardware& robot, std::size_t joint) { return robot.joints()[joint].command; }

  /// The joints move as commanded for a second.
  static void obey(RobotHardware& robot, std::size_t driven) {
    for (std::size_t i = 0; i < robot.joints().size(); ++i) {
      ControlledJoint& joint = robot.joints()[i];
      joint.position = i < driven ? joint.position + joint.command : joint.command;
    }
  }

  World world{jointed(joint("continuous", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {}, "world")), 0};
  BaseController::Settings settings;
};

class Mecanum : public FreeJoints {
 protected:
  RobotHardware robot = joints(4, 0);
  MecanumDriveController drive{{{0, 1, 2, 3}, 0.7, 0.1}, settings};
};

TEST_F(Mecanum, TurnsItsWheelsInOneDirectionToDriveAhead) {
  drive.starting(robot, 0);
  EXPECT_TRUE(drive.set_command({0.5, 0, 0}));
  drive.update(robot, 0, kStep);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(command(robot, i), 0.5 / 0.1, 1e-12);
}

TEST_F(Mecanum, TurnsOppositeCornersAlikeToDriveToTheLeft) {
  drive.starting(robot, 0);
  drive.set_command({0, 0.5, 0});
  drive.update(robot, 0, kStep);
  const double signs[] = {-1, 1, -1, 1};  // front left, back left, back right, front right
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(command(robot, i), signs[i] * 0.5 / 0.1, 1e-12);
}

TEST_F(Mecanum, ReportsTheMotionOfItsWheels) {
  drive.starting(robot, 0);
  drive.set_command({0.3, -0.2, 0.4});
  drive.update(robot, 0, 1);
  obey(robot, 4);
  drive.update(robot, 0.1, 1);
  const PlanarMotion& velocity = drive.odometry().velocity();
  EXPECT_NEAR(2 * velocity.forward, 0.3, 1e-12) << "the mean of rest and motion";
  EXPECT_NEAR(2 * velocity.left, -0.2, 1e-12);
  EXPECT_NEAR(2 * velocity.turn, 0.4, 1e-12);
  EXPECT_NEAR(drive.odometry().heading(), 0.4, 1e-12);
}

TEST_F(Mecanum, LimitsEachDirectionByItself) {
  settings.limits[1].velocity = {-0.1, 0.1};
  MecanumDriveController limited({{0, 1, 2, 3}, 0.7, 0.1}, settings);
  limited.starting(robot, 0);
  limited.set_command({0.5, 0.5, 0});
  limited.update(robot, 0, kStep);
  EXPECT_EQ(limited.limited_command(), (BaseController::Command{0.5, 0.1, 0}));
}

TEST_F(Mecanum, RefusesLengthsOfZero) {
  EXPECT_THROW(MecanumDriveController({{0, 1, 2, 3}, 0, 0.1}, settings), InvalidInput);
  EXPECT_THROW(MecanumDriveController({{0, 1, 2, 3}, 0.7, 0}, settings), InvalidInput);
}

class FourWheelSteering : public FreeJoints {
 protected:
  static constexpr double kTrack = 0.8;
  static constexpr double kBase = 1.2;
  static constexpr double kRadius = 0.25;

  FourWheelSteeringController make(bool by_angles) {
    return {{{0, 1, 2, 3}, {4, 5, 6, 7}, kTrack, kBase, kRadius, by_angles}, settings};
  }

  RobotHardware robot = joints(4, 4);
};

TEST_F(FourWheelSteering, PointsItsWheelsAlongCirclesAboutOneCentre) {
  FourWheelSteeringController drive = make(false);
  drive.starting(robot, 0);
  drive.set_command({1, 0, 0.5});  // the centre is 2 m to the left
  drive.update(robot, 0, kStep);
  const double inner = 2 - kTrack / 2;
  const double outer = 2 + kTrack / 2;
  EXPECT_NEAR(command(robot, 4), std::atan(kBase / 2 / inner), 1e-12) << "front left";
  EXPECT_NEAR(command(robot, 5), std::atan(kBase / 2 / outer), 1e-12) << "front right";
  EXPECT_NEAR(command(robot, 6), -std::atan(kBase / 2 / inner), 1e-12) << "rear left";
  EXPECT_NEAR(command(robot, 7), -std::atan(kBase / 2 / outer), 1e-12) << "rear right";
  EXPECT_NEAR(command(robot, 0), 0.5 * std::hypot(inner, kBase / 2) / kRadius, 1e-12);
  EXPECT_NEAR(command(robot, 3), 0.5 * std::hypot(outer, kBase / 2) / kRadius, 1e-12);
}

TEST_F(FourWheelSteering, TurnsInPlaceWithTheWheelsAlongItsCircle) {
  FourWheelSteeringController drive = make(false);
  drive.starting(robot, 0);
  drive.set_command({0, 0, 1});
  drive.update(robot, 0, kStep);
  const double speed = std::hypot(kBase / 2, kTrack / 2) / kRadius;
  EXPECT_NEAR(command(robot, 0), -speed, 1e-12) << "the left wheels turn backward";
  EXPECT_NEAR(command(robot, 1), speed, 1e-12);
  EXPECT_NEAR(command(robot, 5), std::atan(kBase / kTrack), 1e-12);
}

TEST_F(FourWheelSteering, MovesSidewaysWithEqualAngles) {
  FourWheelSteeringController drive = make(true);
  drive.starting(robot, 0);
  drive.set_command({1, kPi / 4, kPi / 4});
  drive.update(robot, 0, kStep);
  for (std::size_t i = 4; i < 8; ++i) EXPECT_NEAR(command(robot, i), kPi / 4, 1e-12);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(command(robot, i), std::sqrt(2) / kRadius, 1e-12);
}

TEST_F(FourWheelSteering, SteersAtRest) {
  FourWheelSteeringController drive = make(true);
  drive.starting(robot, 0);
  drive.set_command({0, 0.3, -0.3});
  drive.update(robot, 0, kStep);
  EXPECT_EQ(command(robot, 0), 0);
  EXPECT_GT(command(robot, 4), 0.3) << "the inner wheel turns more than the middle of the axle";
  EXPECT_LT(command(robot, 5), 0.3);
}

TEST_F(FourWheelSteering, ReportsTheMotionOfItsWheels) {
  FourWheelSteeringController drive = make(true);
  drive.starting(robot, 0);
  drive.set_command({0.5, 0.4, 0.1});
  drive.update(robot, 0, 1);
  obey(robot, 4);
  drive.update(robot, 0.1, 1);
  const PlanarMotion& velocity = drive.odometry().velocity();
  EXPECT_NEAR(2 * velocity.forward, 0.5, 1e-12) << "the mean of rest and motion";
  EXPECT_NEAR(2 * velocity.left, 0.5 * (std::tan(0.4) + std::tan(0.1)) / 2, 1e-12);
  EXPECT_NEAR(2 * velocity.turn, 0.5 * (std::tan(0.4) - std::tan(0.1)) / kBase, 1e-12);
}

}  // namespace
}  // namespace bubblesim::test::test_omnidirectional_controllers
