// SPDX-License-Identifier: BSD-3-Clause
// Advancing a world: free motion, divergence, independence of worlds.
#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_world {
namespace {

constexpr double kStep = 0.005;

TEST(FreeFall, FollowsTheSemiImplicitEulerExactly) {
  World world(scene({model("Ball", link("link"), at(1, 2, 100))}), 0);
  const ObjectId ball = world.tree().find("/Ball");
  constexpr int kSteps = 200;
  world.advance(kSteps * kStep, kStep);
  // v_n = -g h n; z_n = z_0 - g h^2 n (n + 1) / 2
  EXPECT_NEAR(world.velocity(ball).linear.z(), -9.81 * kStep * kSteps, 1e-9);
  EXPECT_NEAR(world.pose(ball).position.z(), 100 - 9.81 * kStep * kStep * kSteps * (kSteps + 1) / 2, 1e-9);
  EXPECT_EQ(world.pose(ball).position.x(), 1);
  EXPECT_EQ(world.pose(ball).position.y(), 2);
}

TEST(FreeFlight, KeepsVelocityAndSpinWithoutGravity) {
  World world(scene({model("Ball", link("link"))}, Vector3::Zero()), 0);
  const ObjectId ball = world.tree().find("/Ball");
  world.set_velocity(ball, {{1, -2, 3}, {0, 0, 0.5}});
  world.advance(2, kStep);
  EXPECT_LT((world.pose(ball).position - Vector3(2, -4, 6)).norm(), 1e-9);
  EXPECT_NEAR(to_rpy(world.pose(ball).orientation).z(), 1, 1e-4);
}

TEST(FreeFlight, GravityPullsInAnyDirection) {
  World world(scene({model("Ball", link("link"))}, {1, 2, 3}), 0);
  world.advance(1, kStep);
  EXPECT_LT((world.velocity(world.tree().find("/Ball")).linear - Vector3(1, 2, 3)).norm(), 1e-9);
}

TEST(StaticModel, DoesNotFall) {
  World world(scene({still(model("Rock", link_with(Box{{1, 1, 1}}), at(0, 0, 5)))}), 0);
  const ObjectId rock = world.tree().find("/Rock");
  world.advance(1, kStep);
  EXPECT_EQ(world.pose(rock).position.z(), 5);
  EXPECT_EQ(world.velocity(rock).linear.norm(), 0);
}

TEST(Advance, RefusesStepsThatAreNoStepsAndChangesNothing) {
  World world(scene({model("Ball", link("link"))}), 0);
  const std::uint64_t before = world.state_hash();
  for (const double step : {0.0, -0.1, kNaN, kInfinity, 1e-300, 1e300}) {
    EXPECT_THROW(world.advance(0.1, step), InvalidInput) << step;
  }
  for (const double duration : {kNaN, kInfinity, -1.0, 1e300}) {
    EXPECT_THROW(world.advance(duration, kStep), InvalidInput) << duration;
  }
  EXPECT_EQ(world.state_hash(), before);
  world.advance(0, kStep);
  EXPECT_EQ(world.state_hash(), before);
}

/// A ball that leaves the finite world soon.
SceneDescription leaving() { return scene({model("Ball", link("link"), at(999999, 0, 0))}, Vector3::Zero()); }

TEST(DivergingWorld, NamesTheLinkAndWhatToDo) {
  World world(leaving(), 0);
  world.set_velocity(world.tree().find("/Ball"), {{1000, 0, 0}, {}});
  try {
    world.advance(1, kStep);
    FAIL() << "it left the finite world";
  } catch (const Diverged& error) {
    EXPECT_NE(std::string(error.what()).find("/Ball/link"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("smaller physics substep"), std::string::npos) << error.what();
  }
}

TEST(DivergingWorld, StaysDiverged) {
  World world(leaving(), 0);
  world.set_velocity(world.tree().find("/Ball"), {{1000, 0, 0}, {}});
  EXPECT_THROW(world.advance(1, kStep), Diverged);
  EXPECT_THROW(world.advance(kStep, kStep), Diverged);
  world.set_pose(world.tree().find("/Ball"), at(0, 0, 0));
  EXPECT_THROW(world.advance(kStep, kStep), Diverged) << "the state can no longer be trusted";
}

TEST(DivergingWorld, StrongGravityEndsInAnErrorToo) {
  World world(scene({model("Ball", link("link"))}, {0, 0, -1e4}), 0);
  EXPECT_THROW(world.advance(200, 1), Diverged);
}

TEST(DivergingWorld, DoesNotDisturbTheNextOne) {
  for (int i = 0; i < 50; ++i) {
    auto world = std::make_unique<World>(leaving(), 0);
    world->set_velocity(world->tree().find("/Ball"), {{1000, 0, 0}, {}});
    EXPECT_THROW(world->advance(1, kStep), Diverged);
    world.reset();
    World next(scene({floor(), model("Ball", link_with(Sphere{0.5}), at(0, 0, 1))}), 0);
    next.advance(1, kStep);
    EXPECT_NEAR(next.pose(next.tree().find("/Ball")).position.z(), 0.5, 0.01);
  }
}

/// Boxes that fall into a pile: chaotic, so every external influence would show.
SceneDescription heap(int boxes) {
  std::vector<ModelDescription> models{floor()};
  for (int i = 0; i < boxes; ++i) {
    ModelDescription box = model("Box" + std::to_string(i), link_with(Box{{0.5, 0.4, 0.3}}, 0.6));
    box.pose = Pose(0.1 * i, 0.07 * (i % 3), 0.5 + 0.6 * i, 0.3 * i, 0.2, 0.1 * i);
    box.links[0].inertia_diagonal = {0.02, 0.03, 0.04};
    models.push_back(box);
  }
  return scene(models);
}

std::uint64_t hash_after(int boxes, std::uint64_t seed) {
  World world(heap(boxes), seed);
  world.advance(1.5, kStep);
  return world.state_hash();
}

TEST(StateHash, IsEqualForEqualHistories) {
  EXPECT_EQ(hash_after(5, 3), hash_after(5, 3));
  EXPECT_NE(hash_after(5, 3), hash_after(5, 4)) << "the hash includes the seed";
  EXPECT_NE(hash_after(5, 3), hash_after(4, 3));
}

TEST(StateHash, SeesTargetsOfJoints) {
  World world(jointed(joint("revolute", {axis(Vector3::UnitZ(), MotorMode::kVelocity)})), 0);
  const std::uint64_t before = world.state_hash();
  world.joints().set_target_velocity(world.tree().find("/joint"), 1e-9);
  EXPECT_NE(world.state_hash(), before);
}

TEST(TwoWorlds, RunOnTwoThreadsAsIfEachWereAlone) {
  constexpr int kRounds = 8;
  const std::uint64_t alone[] = {hash_after(4, 1), hash_after(6, 2)};
  std::uint64_t together[2][kRounds] = {};
  const auto run = [&together](int index, int boxes, std::uint64_t seed) {
    for (std::uint64_t& hash : together[index]) hash = hash_after(boxes, seed);
  };
  std::thread first(run, 0, 4, 1);
  std::thread second(run, 1, 6, 2);
  first.join();
  second.join();
  for (int index : {0, 1}) {
    for (const std::uint64_t hash : together[index]) EXPECT_EQ(hash, alone[index]);
  }
}

TEST(World, MayBeMadeOnOneThreadAndRunOnAnother) {
  auto world = std::make_unique<World>(heap(3), 0);
  std::thread([&world] { world->advance(0.5, kStep); }).join();
  std::thread([&world] { world.reset(); }).join();
}

}  // namespace
}  // namespace bubblesim::test::test_world
