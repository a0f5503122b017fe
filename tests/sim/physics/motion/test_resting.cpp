// SPDX-License-Identifier: BSD-3-Clause
// Piles and resting bodies: the solver of large contact islands, and sleep.
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <string>

#include "bubblesim/world_measurements.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_resting {
namespace {

constexpr double kStep = 0.005;

ModelDescription box(const std::string& name, const Vector3& position) {
  ModelDescription made = model(name, link_with(Box{{0.5, 0.5, 0.5}}), Pose(position, Quaternion()));
  made.links[0].inertia_diagonal = Vector3(0.042, 0.042, 0.042);
  return made;
}

/// A wall of `rows` of boxes, which all touch.
SceneDescription wall(int rows) {
  std::vector<ModelDescription> models{floor()};
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < 4; ++i) {
      models.push_back(box("Box" + std::to_string(row) + "_" + std::to_string(i),
                           {0.5 * i + 0.25 * (row % 2), 0, 0.25 + 0.5 * row}));
    }
  }
  return scene(std::move(models));
}

TEST(Pile, StandsAndRepeatsBitByBit) {
  World first(wall(4), 3);
  first.advance(1, kStep);
  for (int row = 0; row < 4; ++row) {
    const ObjectId id = first.tree().find("/Box" + std::to_string(row) + "_1");
    EXPECT_NEAR(first.pose(id).position.z(), 0.25 + 0.5 * row, 0.03);
  }
  World second(wall(4), 3);
  second.advance(1, kStep);
  EXPECT_EQ(second.state_hash(), first.state_hash());
  first.reset();
  first.advance(1, kStep);
  EXPECT_EQ(first.state_hash(), second.state_hash());
}

TEST(Pile, DoesNotDependOnOtherWorlds) {
  World alone(wall(3), 3);
  alone.advance(0.5, kStep);
  World one(wall(3), 3);
  World other(wall(4), 9);
  dRandSetSeed(12345);
  for (int i = 0; i < 10; ++i) {
    one.advance(0.05, kStep);
    other.advance(0.05, kStep);
  }
  EXPECT_EQ(dRandGetSeed(), 12345u) << "the random state of others is unchanged";
  EXPECT_EQ(one.state_hash(), alone.state_hash());
}

struct Sleeper {
  Sleeper() { world.advance(3, kStep); }
  bool moves() {
    const Pose before = world.pose(top);
    world.advance(0.2, kStep);
    return world.pose(top) != before;
  }

  World world{scene({floor(), box("Base", {0, 0, 0.25}), box("Top", {0, 0, 0.75}),
                     model("Ball", link_with(Sphere{0.2}), at(-5, 0, 0.8))}),
              0};
  ObjectId top = world.tree().find("/Top");
};

TEST(Sleep, ThingsThatLieStillStayBitByBit) {
  Sleeper sleeper;
  EXPECT_FALSE(sleeper.moves());
}

TEST(Sleep, EndsWhenItIsTouched) {
  Sleeper sleeper;
  const ObjectId ball = sleeper.world.tree().find("/Ball");
  sleeper.world.set_pose(ball, at(-1, 0, 0.8));
  sleeper.world.advance(2, kStep);
  sleeper.world.set_state(ball, at(-1, 0, 0.8), {{8, 0, 0}, {}});
  sleeper.world.advance(0.3, kStep);
  EXPECT_GT(sleeper.world.pose(sleeper.top).position.x(), 0.01);
}

TEST(Sleep, EndsWhenWhatLiesBelowIsTakenAway) {
  for (const bool removed : {true, false}) {
    Sleeper sleeper;
    const ObjectId base = sleeper.world.tree().find("/Base");
    removed ? sleeper.world.models().remove(base) : sleeper.world.set_pose(base, at(3, 0, 0.25));
    sleeper.world.advance(1, kStep);
    EXPECT_NEAR(sleeper.world.pose(sleeper.top).position.z(), 0.25, 0.01);
  }
}

TEST(Sleep, EndsByACommand) {
  Sleeper sleeper;
  sleeper.world.set_velocity(sleeper.top, {{0, 0, 2}, {}});
  sleeper.world.advance(0.1, kStep);
  EXPECT_GT(sleeper.world.pose(sleeper.top).position.z(), 0.8);
}

/// A bat on a motor, which never sleeps, beside a tower of two boxes that sleep.
SceneDescription bat_and_tower() {
  ModelDescription bat = model("Bat", link("base"), at(-1.5, 0, 0.75));
  bat.links.push_back(link("arm", {0.5, 0, 0}));
  bat.links[1].collisions.push_back(shape(Box{{1, 0.1, 0.1}}));
  bat.joints = {joint("fixed", {}, {}, "world", "base"),
                joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {-0.5, 0, 0}, "base", "arm")};
  bat.joints[1].name = "motor";
  bat.joints[1].axes[0].max_force = 100;
  return scene({floor(), box("Base", {-0.8, 0.6, 0.25}), box("Top", {-0.8, 0.6, 0.75}), bat});
}

void swing(World& world) { world.joints().set_target_velocity(world.tree().find("/motor"), 3); }

TEST(Sleep, EndsWhenAModelThatStayedAwakeTouchesIt) {
  World world(bat_and_tower(), 0);
  world.advance(3, kStep);
  swing(world);
  world.advance(1, kStep);
  EXPECT_GT((world.pose(world.tree().find("/Top")).position - Vector3(-0.8, 0.6, 0.75)).norm(), 0.05);
}

TEST(Sleep, ContinuesFromASavedStateBitByBit) {
  World world(bat_and_tower(), 0);
  world.advance(3, kStep);
  World other(bat_and_tower(), 0);
  restore(saved(world), other);
  for (World* each : {&world, &other}) {
    swing(*each);
    each->advance(1, kStep);
  }
  EXPECT_EQ(other.state_hash(), world.state_hash());
}

TEST(Sleep, KeepsItsContactsListed) {
  Sleeper sleeper;
  double load = 0;
  for (const TouchPoint& point : sleeper.world.measurements().contact_points()) {
    if (point.second == sleeper.world.tree().find("/Floor/link")) load += point.force.z();
  }
  EXPECT_NEAR(load, 3 * 9.81, 1e-3);
}

TEST(Sleep, BearsAModelThatIsAdded) {
  Sleeper sleeper;
  sleeper.world.models().add(box("Third", {0, 0, 1.3}));
  sleeper.world.advance(1, kStep);
  EXPECT_NEAR(sleeper.world.pose(sleeper.world.tree().find("/Third")).position.z(), 1.25, 0.01);
}

TEST(Sleep, HasNoAccelerationFromTheFirstSubstepOn) {
  World world(scene({floor(), box("Box", {0, 0, 0.2501})}), 0);
  const ObjectId id = world.tree().find("/Box");
  for (int i = 0; i < 40; ++i) world.advance(0.05, kStep);
  EXPECT_EQ(world.velocity(id).linear, Vector3::Zero());
  EXPECT_EQ(world.acceleration(id), Vector3::Zero());
}

TEST(Sleep, IsNotForModelsWithJoints) {
  ModelDescription robot = model("Robot", link("base", {0, 0, 1}));
  robot.links.push_back(link("arm", {0, 0, 1}));
  robot.joints = {joint("fixed", {}, {}, "world", "base"),
                  joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {}, "base", "arm")};
  robot.joints[1].name = "motor";
  World world(scene({robot}), 0);
  world.advance(5, kStep);
  const ObjectId motor = world.tree().find("/motor");
  world.joints().set_target_velocity(motor, 1);
  world.advance(0.1, kStep);
  EXPECT_NEAR(world.joints().velocity(motor), 1, 1e-3);
}

}  // namespace
}  // namespace bubblesim::test::test_resting
