// SPDX-License-Identifier: BSD-3-Clause
// Controllers of a joint without load: commands, limits, trajectories, switching, saved states.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/control/base_controllers.hpp"
#include "bubblesim/control/joint_controllers.hpp"
#include "bubblesim/control/trajectory_controller.hpp"
#include "bubblesim/error.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_controllers {
namespace {

using namespace control;  // NOLINT(google-build-using-namespace): all of it is tested here

constexpr double kStep = 0.001;

AxisDescription limited_axis() {
  AxisDescription limited = axis(Vector3::UnitZ(), MotorMode::kEffort);
  limited.lower = -2;
  limited.upper = 2;
  limited.max_velocity = 3;
  limited.max_force = 5000;
  return limited;
}

class OneJoint : public ::testing::Test {
 protected:
  void make(CommandInterface interface) {
    ControlledJoint joint;
    joint.name = "joint";
    joint.id = hinge;
    joint.interface = interface;
    manager = std::make_shared<ControllerManager>(RobotHardware(world, {joint}));
    world.devices().add(manager);
  }

  double position() const { return world.joints().position(hinge); }

  World world{jointed(joint("revolute", {limited_axis()}, {}, "world")), 0};
  ObjectId hinge = world.tree().find("/joint");
  std::shared_ptr<ControllerManager> manager;
};

TEST_F(OneJoint, MovesToACommandedPositionAtItsVelocityLimit) {
  make(CommandInterface::kPosition);
  auto forward = std::make_shared<ForwardCommand>(std::vector<std::size_t>{0});
  manager->start(forward);
  world.advance(kStep, kStep);
  forward->set_commands({1.5});
  world.advance(0.25, kStep);
  EXPECT_NEAR(position(), 3 * 0.25, 0.02);
  world.advance(0.5, kStep);
  EXPECT_NEAR(position(), 1.5, 1e-6);
  forward->set_commands({9});
  world.advance(0.5, kStep);
  EXPECT_NEAR(position(), 2, 1e-3) << "the limit of the joint";
}

TEST_F(OneJoint, HoldsItsPositionWhenItsControllerStops) {
  make(CommandInterface::kPosition);
  auto forward = std::make_shared<ForwardCommand>(std::vector<std::size_t>{0});
  manager->start(forward);
  world.advance(kStep, kStep);
  forward->set_commands({1.5});
  world.advance(0.2, kStep);
  const double here = position();
  manager->stop(*forward);
  world.advance(0.5, kStep);
  EXPECT_NEAR(position(), here, 0.01);
  EXPECT_FALSE(manager->runs(*forward));
}

TEST_F(OneJoint, HasOneControllerAtATime) {
  make(CommandInterface::kVelocity);
  auto first = std::make_shared<ForwardCommand>(std::vector<std::size_t>{0});
  auto second = std::make_shared<ForwardCommand>(std::vector<std::size_t>{0});
  manager->start(first);
  EXPECT_THROW(manager->start(second), InvalidInput);
  EXPECT_THROW(manager->start(first), InvalidInput);
  manager->stop(*first);
  manager->start(second);
  EXPECT_TRUE(manager->runs(*second));
}

TEST_F(OneJoint, RefusesCommandsThatAreNotUsable) {
  ForwardCommand forward({0});
  EXPECT_THROW(forward.set_commands({}), InvalidInput);
  EXPECT_THROW(forward.set_commands({std::nan("")}), InvalidInput);
  EXPECT_THROW(forward.set_commands({1e9}), InvalidInput);
}

TEST_F(OneJoint, ReachesASetPointByEfforts) {
  make(CommandInterface::kEffort);
  auto pid = std::make_shared<PidController>(0, PidController::Kind::kPosition, PidGains{100, 0, 20, 0, 0, false});
  manager->start(pid);
  world.advance(kStep, kStep);
  pid->set_command(0.7);
  world.advance(3, kStep);
  EXPECT_NEAR(position(), 0.7, 1e-3);
  EXPECT_EQ(pid->state().set_point, 0.7);
  EXPECT_NEAR(pid->state().error, 0, 1e-3);
}

TEST_F(OneJoint, FollowsASineTo2Milliradians) {
  make(CommandInterface::kPosition);
  TrajectoryController::Settings settings;
  settings.joints = {0};
  auto trajectory = std::make_shared<TrajectoryController>(settings);
  manager->start(trajectory);
  world.advance(kStep, kStep);
  std::vector<JointKnot> knots;
  const double rate = 2 * 3.14159265358979323846 * 0.5;
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.04 * i;
    knots.push_back({kStep + t, 0.8 * std::sin(rate * t), 0.8 * rate * std::cos(rate * t)});
  }
  trajectory->follow({knots}, kStep, kStep, GoalTolerances{{{0.05, 0, 0}}, {{0.01, 0, 0}}, 0.1});
  world.advance(0.1, kStep);
  double largest = 0;
  for (int i = 0; i < 3800; ++i) {
    world.advance(kStep, kStep);
    largest = std::max(largest, std::abs(position() - 0.8 * std::sin(rate * (0.1 + kStep * (i + 1)))));
  }
  EXPECT_LT(largest, 2e-3);
  world.advance(0.3, kStep);
  EXPECT_EQ(trajectory->goal_status(), GoalStatus::kReached);
}

TEST_F(OneJoint, ReportsThatItCannotKeepItsPath) {
  make(CommandInterface::kPosition);
  TrajectoryController::Settings settings;
  settings.joints = {0};
  auto trajectory = std::make_shared<TrajectoryController>(settings);
  manager->start(trajectory);
  world.advance(kStep, kStep);
  trajectory->follow({{{0.1, 1.5}}}, kStep, kStep, GoalTolerances{{{0.1, 0, 0}}, {{0.1, 0, 0}}, 0});
  world.advance(0.1, kStep);
  EXPECT_EQ(trajectory->goal_status(), GoalStatus::kPathViolated);
}

TEST_F(OneJoint, ReplacesATrajectoryFromTheStartOfTheNewOne) {
  make(CommandInterface::kPosition);
  TrajectoryController::Settings settings;
  settings.joints = {0};
  auto trajectory = std::make_shared<TrajectoryController>(settings);
  manager->start(trajectory);
  world.advance(kStep, kStep);
  trajectory->follow({{{2, 1}}}, 0, kStep, std::nullopt);
  trajectory->follow({{{3, 0}}}, 1, kStep, std::nullopt);  // from 0.5 at 1 s
  EXPECT_NEAR(trajectory->at(0.5)[0].position, 0.25, 1e-3);
  EXPECT_NEAR(trajectory->at(1)[0].position, 0.5, 1e-3);
  EXPECT_NEAR(trajectory->at(2)[0].position, 0.25, 1e-3);
  EXPECT_NEAR(trajectory->at(4)[0].position, 0, 1e-12);
  EXPECT_THROW(trajectory->follow({{{0.5, 1}}}, 0, 1, std::nullopt), InvalidInput) << "it is over";
  EXPECT_THROW(trajectory->follow({{{5, 1}, {4, 1}}}, 0, 1, std::nullopt), InvalidInput) << "its times decrease";
  EXPECT_THROW(trajectory->follow({{{5, std::nan("")}}}, 0, 1, std::nullopt), InvalidInput);
}

TEST_F(OneJoint, StopsWithinItsDuration) {
  make(CommandInterface::kPosition);
  TrajectoryController::Settings settings;
  settings.joints = {0};
  settings.stop_duration = 0.5;
  auto trajectory = std::make_shared<TrajectoryController>(settings);
  manager->start(trajectory);
  world.advance(kStep, kStep);
  trajectory->follow({{{2, 1}}}, 0, kStep, std::nullopt);
  world.advance(1 - kStep, kStep);
  trajectory->hold(1);
  EXPECT_NEAR(trajectory->at(1)[0].velocity, 0.5, 1e-3);
  EXPECT_NEAR(trajectory->at(1.5)[0].velocity, 0, 1e-9);
  EXPECT_NEAR(trajectory->at(1.5)[0].position, 0.5 + 0.5 * 0.5 / 2, 1e-3);
}

TEST_F(OneJoint, ContinuesFromASavedState) {
  make(CommandInterface::kPosition);
  TrajectoryController::Settings settings;
  settings.joints = {0};
  auto trajectory = std::make_shared<TrajectoryController>(settings);
  manager->start(trajectory);
  world.advance(kStep, kStep);
  trajectory->follow({{{1, 1, 0.0}}}, 0, kStep, GoalTolerances{{{0.1, 0, 0}}, {{0.1, 0, 0}}, 0});
  world.advance(0.3, kStep);
  std::string bytes;
  StateArchive saving(bytes);
  manager->transfer(saving);
  trajectory->hold(0.3);
  StateArchive restoring{std::string_view(bytes)};
  manager->transfer(restoring);
  EXPECT_EQ(trajectory->goal_status(), GoalStatus::kActive);
  EXPECT_NEAR(trajectory->at(2)[0].position, 1, 1e-12);
}

TEST(DiffDriveController, TurnsTheWheelsByTheVelocityOfTheRobot) {
  World world{jointed(joint("continuous", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {}, "world")), 0};
  ControlledJoint wheel;
  wheel.id = world.tree().find("/joint");
  wheel.interface = CommandInterface::kVelocity;
  RobotHardware robot(world, {wheel, wheel});
  DiffDriveController::Wheels wheels{{0}, {1}, 0.5, 0.1, 0.2};
  BaseController::Settings settings;
  settings.timeout = 0.25;
  DiffDriveController drive(wheels, settings);
  drive.starting(robot, 0);
  EXPECT_TRUE(drive.set_command({1, 0, 2}));
  EXPECT_FALSE(drive.set_command({std::nan(""), 0, 2}));
  drive.update(robot, 0, kStep);
  EXPECT_NEAR(robot.joints()[0].command, (1 - 2 * 0.25) / 0.1, 1e-12);
  EXPECT_NEAR(robot.joints()[1].command, (1 + 2 * 0.25) / 0.2, 1e-12);
  robot.joints()[0].position = 1;    // 0.1 m
  robot.joints()[1].position = 1.5;  // 0.3 m
  drive.update(robot, 0.2, kStep);
  EXPECT_NEAR(drive.odometry().heading(), (0.3 - 0.1) / 0.5, 1e-12);
  drive.update(robot, 0.26, kStep);
  EXPECT_EQ(robot.joints()[0].command, 0) << "no command came for 0.25 s";
  EXPECT_THROW(DiffDriveController({{0}, {1}, 0, 0.1, 0.1}, settings), InvalidInput);
  EXPECT_THROW(DiffDriveController({{0}, {}, 1, 0.1, 0.1}, settings), InvalidInput);
}

}  // namespace
}  // namespace bubblesim::test::test_controllers
