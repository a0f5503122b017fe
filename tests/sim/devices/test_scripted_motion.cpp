// SPDX-License-Identifier: BSD-3-Clause
// Where scripts have their models, compared with the formulas of the spline.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "bubblesim/error.hpp"
#include "bubblesim/scripted_motion.hpp"
#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_scripted_motion {
namespace {

Pose facing(double x, double y, double yaw) { return {x, y, 0, 0, 0, yaw}; }

MotionScript straight(bool loop, double delay) {
  MotionScript script;
  script.loop = loop;
  script.delay = delay;
  script.trajectories = {{1, {{0, facing(0, 0, 0)}, {2, facing(4, 0, 0)}}}};
  return script;
}

TEST(ScriptedMotion, FollowsCatmullRomsSpline) {
  MotionScript script;
  script.loop = false;
  const std::vector<Vector3> p = {{0, 0, 0}, {1, 2, 0}, {3, 2, 0}, {4, 0, 0}};
  Trajectory trajectory;
  for (std::size_t i = 0; i < p.size(); ++i)
    trajectory.waypoints.push_back({static_cast<double>(i), at(p[i].x(), p[i].y(), 0)});
  script.trajectories = {trajectory};
  // Between the second and the third point, at the half: (-p0 + 9 p1 + 9 p2 - p3) / 16.
  const Vector3 half = (p[1] * 9 + p[2] * 9 - p[0] - p[3]) / 16;
  EXPECT_NEAR((ScriptedMotion::pose_at(script, 1.5).position - half).norm(), 0, 1e-12);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR((ScriptedMotion::pose_at(script, static_cast<double>(i)).position - p[i]).norm(), 0, 1e-12);
  }
}

TEST(ScriptedMotion, WithTensionComesToRestAtTheWaypoints) {
  const MotionScript script = straight(false, 0);
  EXPECT_NEAR(ScriptedMotion::pose_at(script, 0.5).position.x(), 4 * (3 * 0.0625 - 2 * 0.015625), 1e-12);
  EXPECT_NEAR(ScriptedMotion::pose_at(script, 1).position.x(), 2, 1e-12);
}

TEST(ScriptedMotion, OfAClosedPathIsSmoothWhereItBegins) {
  MotionScript script;
  script.trajectories = {
      {0, {{0, at(1, 0, 0)}, {1, at(0, 1, 0)}, {2, at(-1, 0, 0)}, {3, at(0, -1, 0)}, {4, at(1, 0, 0)}}}};
  const double h = 1e-5;
  const Vector3 before = ScriptedMotion::pose_at(script, 4 - h).position;
  const Vector3 after = ScriptedMotion::pose_at(script, h).position;
  EXPECT_NEAR(((after - before) / (2 * h) - Vector3(0, 1, 0)).norm(), 0, 1e-4) << "(p1 - p3) / 2";
}

TEST(ScriptedMotion, TurnsTheShorterWay) {
  MotionScript script;
  script.trajectories = {{0, {{0, facing(0, 0, 3)}, {1, facing(0, 0, -3)}}}};
  const double yaw = to_rpy(ScriptedMotion::pose_at(script, 0.5).orientation).z();
  EXPECT_NEAR(std::abs(yaw), M_PI, 1e-9);
}

TEST(ScriptedMotion, WaitsBeforeEachCycle) {
  const MotionScript script = straight(true, 1);
  EXPECT_EQ(ScriptedMotion::pose_at(script, 0.7).position.x(), 0);
  EXPECT_NEAR(ScriptedMotion::pose_at(script, 2).position.x(), 2, 1e-12);
  EXPECT_EQ(ScriptedMotion::pose_at(script, 3.5).position.x(), 4) << "where it has ended";
  EXPECT_NEAR(ScriptedMotion::pose_at(script, 5).position.x(), 2, 1e-12);
}

TEST(ScriptedMotion, WithoutLoopStaysWhereItEnds) {
  EXPECT_EQ(ScriptedMotion::pose_at(straight(false, 1), 100).position.x(), 4);
}

TEST(ScriptedMotion, RunsItsTrajectoriesOneAfterTheOther) {
  MotionScript script;
  script.loop = false;
  script.trajectories = {{1, {{2, at(1, 0, 0)}}}, {1, {{0, at(1, 0, 0)}, {4, at(1, 8, 0)}}}};
  EXPECT_EQ(ScriptedMotion::pose_at(script, 1).position.x(), 1) << "it is at its first waypoint from the start";
  EXPECT_NEAR(ScriptedMotion::pose_at(script, 4).position.y(), 4, 1e-12);
}

SceneDescription walk() {
  ModelDescription person = still(model("Person", link_with(Capsule{0.25, 1.3})));
  person.script = straight(true, 0);
  ModelDescription box = model("Box", link_with(Box{{0.2, 0.2, 0.2}}), at(20, 0, 0.1));
  return scene({floor(), person, box});
}

TEST(ScriptedMotion, MovesAModelOfASimulation) {
  Simulation simulation(walk(), 0);
  const ObjectId person = simulation.world().tree().find("/Person");
  for (int i = 0; i < 30; ++i) {
    simulation.step();
    const Pose wanted = ScriptedMotion::pose_at(straight(true, 0), simulation.time());
    ASSERT_NEAR((simulation.world().pose(person).position - wanted.position).norm(), 0, 1e-9) << i;
  }
  const std::string saved = simulation.save();
  for (int i = 0; i < 10; ++i) simulation.step();
  const std::uint64_t expected = simulation.state_hash();
  simulation.restore(saved);
  for (int i = 0; i < 10; ++i) simulation.step();
  EXPECT_EQ(simulation.state_hash(), expected);
  simulation.reset();
  EXPECT_EQ(simulation.world().pose(person).position.x(), 0);
}

TEST(ScriptedMotion, IsOfStaticModelsWithAScript) {
  SceneDescription described = walk();
  World world(described, 0);
  EXPECT_THROW(ScriptedMotion(world, world.tree().find("/Box")), WrongObject);
  EXPECT_THROW(ScriptedMotion(world, world.tree().find("/Floor")), WrongObject);
}

}  // namespace
}  // namespace bubblesim::test::test_scripted_motion
