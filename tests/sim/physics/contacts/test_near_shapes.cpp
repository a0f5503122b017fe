// SPDX-License-Identifier: BSD-3-Clause
// A model stays in the region in which shapes were searched, and those shapes come, go and move.
#include <gtest/gtest.h>

#include <string>

#include "scenes.hpp"

namespace bubblesim::test::test_near_shapes {
namespace {

constexpr double kStep = 0.005;

ModelDescription box(const std::string& name, const Pose& pose) {
  return model(name, link_with(Box{{0.5, 0.5, 0.5}}), pose);
}

/// A ball on a floor at the origin, searched once, and a static box.
struct BallAndWall {
  explicit BallAndWall(const Pose& wall_pose) : world{scene({floor(), ball(), still(box("Wall", wall_pose))}), 0} {
    world.advance(0.1, kStep);
  }

  static ModelDescription ball() { return model("Ball", link_with(Sphere{0.25}), at(0, 0, 0.25)); }

  /// Lets the ball run along x for half a metre and more.
  double run() {
    world.set_velocity(world.tree().find("/Ball"), {{2, 0, 0}, {0, 8, 0}});
    world.advance(0.5, kStep);
    return world.pose(world.tree().find("/Ball")).position.x();
  }

  World world;
};

TEST(NearShapes, AStaticShapeThatIsMovedNearIsMet) {
  BallAndWall scene(at(50, 0, 0.25));
  scene.world.set_pose(scene.world.tree().find("/Wall"), at(0.6, 0, 0.25));
  EXPECT_LT(scene.run(), 0.2);
}

TEST(NearShapes, AStaticShapeThatIsMovedAwayIsMetNoMore) {
  BallAndWall scene(at(0.6, 0, 0.25));
  scene.world.set_pose(scene.world.tree().find("/Wall"), at(50, 0, 0.25));
  EXPECT_GT(scene.run(), 0.8);
}

TEST(NearShapes, AModelThatIsRemovedIsMetNoMore) {
  BallAndWall scene(at(0.6, 0, 0.25));
  scene.world.models().remove(scene.world.tree().find("/Wall"));
  EXPECT_GT(scene.run(), 0.8);
}

TEST(NearShapes, AModelThatIsAddedIsMet) {
  BallAndWall scene(at(50, 0, 0.25));
  scene.world.models().add(still(box("Other", at(0.6, 0, 0.25))));
  EXPECT_LT(scene.run(), 0.2);
}

/// A mill, which never sleeps, whose arm passes a box that sleeps.
SceneDescription mill_and_box() {
  ModelDescription mill = model("Mill", link("base"), at(0, 0, 0.25));
  mill.links.push_back(link("arm", {0.5, 0, 0}));
  mill.links[1].collisions.push_back(shape(Box{{1, 0.1, 0.1}}));
  mill.joints = {joint("fixed", {}, {}, "world", "base"),
                 joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kVelocity)}, {-0.5, 0, 0}, "base", "arm")};
  mill.joints[1].name = "motor";
  mill.joints[1].axes[0].max_force = 100;
  return scene({floor(), mill, box("Box", at(0, 1, 0.25))});
}

TEST(NearShapes, WhatSleepsElsewhereInARestoredStateIsMetThere) {
  World world(mill_and_box(), 0);
  world.advance(3, kStep);
  const std::string near = saved(world);
  const ObjectId box = world.tree().find("/Box");
  world.set_pose(box, at(0, 3, 0.25));
  world.advance(3, kStep);
  restore(near, world);
  World other(mill_and_box(), 0);
  restore(near, other);
  for (World* each : {&world, &other}) {
    each->joints().set_target_velocity(each->tree().find("/motor"), 2);
    each->advance(2, kStep);
    EXPECT_GT((each->pose(box).position - Vector3(0, 1, 0.25)).norm(), 0.1);
  }
  EXPECT_EQ(other.state_hash(), world.state_hash());
}

}  // namespace
}  // namespace bubblesim::test::test_near_shapes
