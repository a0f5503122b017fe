// SPDX-License-Identifier: BSD-3-Clause
// Targets of joints that follow commands at limited rates.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

#include "bubblesim/error.hpp"
#include "bubblesim/joint_ramps.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_joint_ramps {
namespace {

constexpr double kStep = 0.005;

/// A hinge with a motor and no load.
class Ramps : public ::testing::Test {
 protected:
  std::shared_ptr<JointRamps> add(std::vector<double> rates, std::vector<double> factors,
                                  MotorMode mode = MotorMode::kVelocity, double rate = 0) {
    auto ramps = std::make_shared<JointRamps>(std::move(rates), std::vector{JointRamps::Output{hinge, mode, factors}});
    world.devices().add(ramps, kNoObject, rate);
    return ramps;
  }

  World world{jointed(joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {}, "world")), 0};
  ObjectId hinge = world.tree().find("/joint");
};

TEST_F(Ramps, ReachTheirTargetAtTheirRate) {
  const auto ramps = add({4}, {1});
  ramps->set_targets({1});
  world.advance(0.1, kStep);
  EXPECT_NEAR(world.joints().target_velocity(hinge), 0.4, 1e-9);
  EXPECT_NEAR(world.joints().velocity(hinge), 0.4, 1e-6) << "each substep has its own target";
  EXPECT_NEAR(world.joints().position(hinge), 0.4 * 0.1 / 2, 0.4 * kStep);
  world.advance(0.2, kStep);
  EXPECT_EQ(world.joints().target_velocity(hinge), 1);
  ramps->set_targets({-1});
  world.advance(0.25, kStep);
  EXPECT_NEAR(world.joints().target_velocity(hinge), 0, 1e-9);
}

TEST_F(Ramps, WithoutALimitFollowAtOnce) {
  add({kInfinity}, {1})->set_targets({-3});
  world.advance(kStep, kStep);
  EXPECT_EQ(world.joints().target_velocity(hinge), -3);
}

TEST_F(Ramps, CombineTheirInputs) {
  const auto ramps = add({kInfinity, kInfinity}, {10, -2});
  ramps->set_targets({0.3, 0.5});
  world.advance(kStep, kStep);
  EXPECT_NEAR(world.joints().target_velocity(hinge), 2, 1e-12);
}

TEST_F(Ramps, ChangeWithTheSameRateWhateverTheRateOfUpdates) {
  const auto ramps = add({4}, {1}, MotorMode::kVelocity, 50);
  ramps->set_targets({1});
  world.advance(0.1, kStep);
  EXPECT_NEAR(world.joints().target_velocity(hinge), 0.4, 1e-9);
}

TEST_F(Ramps, SetPositions) {
  const auto ramps = add({1}, {2}, MotorMode::kPosition);
  ramps->set_targets({0.5});
  world.advance(0.1, kStep);
  EXPECT_NEAR(world.joints().target_position(hinge), 0.2, 1e-9);
}

TEST_F(Ramps, LeaveTheJointAloneOnceTheyAreThere) {
  add({kInfinity}, {1})->set_targets({1});
  world.advance(kStep, kStep);
  world.joints().set_target_velocity(hinge, 0.5);
  world.advance(kStep, kStep);
  EXPECT_EQ(world.joints().target_velocity(hinge), 0.5);
}

TEST_F(Ramps, KeepToTheSpeedsOfTheWorld) {
  add({kInfinity}, {1e6})->set_targets({100});
  EXPECT_NO_THROW(world.advance(kStep, kStep));
  EXPECT_EQ(world.joints().target_velocity(hinge), 1e6);
}

TEST_F(Ramps, StartAgainAfterAReset) {
  const auto ramps = add({4}, {1});
  ramps->set_targets({1});
  world.advance(0.1, kStep);
  world.reset();
  EXPECT_EQ(ramps->inputs().front(), 0);
  world.advance(0.1, kStep);
  EXPECT_EQ(world.joints().target_velocity(hinge), 0);
}

TEST_F(Ramps, InvalidNumbersAreRefused) {
  const auto ramps = add({4}, {1});
  EXPECT_THROW(ramps->set_targets({}), InvalidInput);
  EXPECT_THROW(ramps->set_targets({kNaN}), InvalidInput);
  EXPECT_THROW(ramps->set_targets({kInfinity}), InvalidInput);
  EXPECT_THROW(JointRamps({-1}, {}), InvalidInput);
  EXPECT_THROW(JointRamps({kNaN}, {}), InvalidInput);
  EXPECT_THROW(JointRamps({1}, {{hinge, MotorMode::kVelocity, {1, 1}}}), InvalidInput);
  EXPECT_THROW(JointRamps({1}, {{hinge, MotorMode::kVelocity, {kNaN}}}), InvalidInput);
}

/// Left and right wheel of 0.5 m radius, 2 m apart; of forward and turning velocity.
const CommandMix kWheels{{{{1, -1}, 0.5}, {{1, 1}, 0.5}}, 100};

TEST(CommandMix, GivesTheSpeedsOfWheels) { EXPECT_EQ(*kWheels.inputs({3, 1}), (std::vector<double>{4, 8})); }

TEST(CommandMix, ScalesInputsDownTogether) { EXPECT_EQ(*kWheels.inputs({75, 25}), (std::vector<double>{50, 100})); }

TEST(CommandMix, HasNoInputsForCommandsThatAreNotUsable) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& commands :
       std::vector<std::vector<double>>{{kNaN, 0}, {0, kInfinity}, {101, 0}, {0, -101}, {1}, {1, 2, 3}}) {
    EXPECT_FALSE(kWheels.inputs(commands)) << commands[0];
  }
}

}  // namespace
}  // namespace bubblesim::test::test_joint_ramps
