// SPDX-License-Identifier: BSD-3-Clause
// Wrenches and efforts that act for a time: their impulse is exact, whatever the step.
#include <gtest/gtest.h>

#include <memory>

#include "bubblesim/error.hpp"
#include "bubblesim/timed_efforts.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_timed_efforts {
namespace {

constexpr double kStep = 0.005;
constexpr double kPass = 0.05;

class TimedWrenches : public ::testing::Test {
 protected:
  TimedWrenches() { world.devices().add(device); }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) world.advance(kPass, kStep);
  }
  double speed() const { return world.velocity(link).linear.x(); }

  World world{scene({model("Body", test::link("link"))}, Vector3::Zero()), 0};
  ObjectId link = world.tree().find("/Body/link");
  std::shared_ptr<TimedEfforts> device = std::make_shared<TimedEfforts>();
};

TEST_F(TimedWrenches, GiveTheirImpulseExactly) {
  for (const double duration : {0.05, 0.1234, 0.0011, 0.5}) {
    for (const double start : {0.0, 0.0333, 0.2}) {
      world.reset();
      device->add_wrench(world, link, {{3, 0, 0}, {}}, {}, {start, duration});
      run(20);
      EXPECT_NEAR(speed(), 3 * duration, 1e-9) << duration << " s from " << start << " s on";
    }
  }
}

TEST_F(TimedWrenches, BeginAndEndWithTheirInterval) {
  device->add_wrench(world, link, {{1, 0, 0}, {}}, {}, {0.1, 0.1});
  run(2);
  EXPECT_EQ(speed(), 0);
  run(1);
  EXPECT_NEAR(speed(), 0.05, 1e-12);
  run(10);
  EXPECT_NEAR(speed(), 0.1, 1e-12);
}

TEST_F(TimedWrenches, WithANegativeDurationActUntilTheyAreCleared) {
  device->add_wrench(world, link, {{1, 0, 0}, {}}, {}, {0, -1});
  run(20);
  EXPECT_NEAR(speed(), 1, 1e-9);
  device->clear_wrenches(link);
  run(20);
  EXPECT_NEAR(speed(), 1, 1e-9);
}

TEST_F(TimedWrenches, ActAtAPointOfTheLink) {
  device->add_wrench(world, link, {{0, 1, 0}, {}}, Vector3(0.2, 0, 0), {0, kStep});
  run(1);
  EXPECT_NEAR(world.velocity(link).angular.z(), 0.2 * kStep, 1e-12);
}

TEST_F(TimedWrenches, AddUp) {
  device->add_wrench(world, link, {{1, 0, 0}, {}}, {}, {0, 1});
  device->add_wrench(world, link, {{2, 0, 0}, {}}, {}, {0, 0.5});
  run(40);
  EXPECT_NEAR(speed(), 2, 1e-9);
}

TEST_F(TimedWrenches, EndWithAResetAndWithTheirModel) {
  device->add_wrench(world, link, {{1, 0, 0}, {}}, {}, {0, -1});
  world.reset();
  run(1);
  EXPECT_EQ(speed(), 0);
  device->add_wrench(world, link, {{1, 0, 0}, {}}, {}, {0, -1});
  world.models().remove(world.tree().find("/Body"));
  EXPECT_NO_THROW(run(1));
}

TEST_F(TimedWrenches, AreState) {
  const std::uint64_t before = world.state_hash();
  device->add_wrench(world, link, {{1, 0, 0}, {}}, {}, {0, 1});
  EXPECT_NE(world.state_hash(), before);
}

TEST_F(TimedWrenches, InvalidOnesAreRefused) {
  EXPECT_THROW(device->add_wrench(world, link, {{kNaN, 0, 0}, {}}, {}, {0, 1}), InvalidInput);
  EXPECT_THROW(device->add_wrench(world, link, {{1, 0, 0}, {}}, {}, {kNaN, 1}), InvalidInput);
  EXPECT_THROW(device->add_wrench(world, link, {{1, 0, 0}, {}}, {}, {0, kInfinity}), InvalidInput);
  EXPECT_THROW(device->add_wrench(world, 12345, {{1, 0, 0}, {}}, {}, {0, 1}), NoSuchObject);
  EXPECT_THROW(device->add_effort(world, link, 1, {0, 1}), WrongObject);
  EXPECT_NO_THROW(run(1));
}

class TimedJointEfforts : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Kinds, TimedJointEfforts, ::testing::Values("revolute", "prismatic"));

TEST_P(TimedJointEfforts, AccelerateBothLinks) {
  World world(jointed(joint(GetParam(), {axis(Vector3::UnitZ())})), 0);
  auto device = std::make_shared<TimedEfforts>();
  world.devices().add(device);
  const ObjectId id = world.tree().find("/joint");
  device->add_effort(world, id, 0.5, {0, 0.123});
  world.advance(0.5, kStep);
  EXPECT_NEAR(world.joints().velocity(id), 2 * 0.5 * 0.123, 1e-6) << "two bodies of 1 kg and 1 kg m^2";
  const Twist both[] = {world.velocity(world.tree().find("/base")), world.velocity(world.tree().find("/arm"))};
  EXPECT_NEAR((both[0].linear + both[1].linear).norm(), 0, 1e-9) << "there is no force from outside";
  EXPECT_NEAR((both[0].angular + both[1].angular).norm(), 0, 1e-9);
}

TEST_P(TimedJointEfforts, KeepToTheLimitOfTheJoint) {
  AxisDescription weak = axis(Vector3::UnitZ());
  weak.max_force = 0.25;
  World world(jointed(joint(GetParam(), {weak}, {}, "world")), 0);
  auto device = std::make_shared<TimedEfforts>();
  world.devices().add(device);
  const ObjectId id = world.tree().find("/joint");
  device->add_effort(world, id, -7, {0, -1});
  world.advance(1, kStep);
  EXPECT_NEAR(world.joints().velocity(id), -0.25, 1e-6);
  device->clear_efforts(id);
  world.advance(1, kStep);
  EXPECT_NEAR(world.joints().velocity(id), -0.25, 1e-6);
}

}  // namespace
}  // namespace bubblesim::test::test_timed_efforts
