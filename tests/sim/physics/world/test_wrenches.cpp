// SPDX-License-Identifier: BSD-3-Clause
// Forces and torques on links, compared with the motion of a free rigid body.
#include <gtest/gtest.h>

#include <functional>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "near.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_wrenches {
namespace {

constexpr double kStep = 0.005;
constexpr double kPass = 0.05;
constexpr double kMass = 2;
const Vector3 kInertia(0.5, 1, 2);

/// A free body, rotated, with its centre of mass away from its origin.
SceneDescription free_body(const Vector3& gravity = {}) {
  ModelDescription body = model("Body", link("link"), Pose(1, 2, 3, 0.3, -0.2, 0.5));
  body.links[0].mass = kMass;
  body.links[0].inertia_diagonal = kInertia;
  body.links[0].centre_of_mass = {0.1, -0.2, 0.3};
  return scene({body, still(model("Wall", link_with(Box{{1, 1, 1}}), at(0, 0, 50)))}, gravity);
}

class Wrenches : public ::testing::Test {
 protected:
  ObjectId find(const std::string& path) const { return world.tree().find(path); }
  /// Velocity of the centre of mass.
  Vector3 linear() const {
    const Twist twist = world.velocity(body);
    return twist.linear + twist.angular.cross(world.pose(body).orientation * Vector3(0.1, -0.2, 0.3));
  }
  Vector3 centre() const { return world.pose(body) * Vector3(0.1, -0.2, 0.3); }

  World world{free_body(), 0};
  ObjectId body = world.tree().find("/Body/link");
};

TEST_F(Wrenches, MomentumIsForceTimesTime) {
  const Vector3 force(3, -1, 0.5);
  for (int i = 0; i < 20; ++i) {
    world.wrenches().apply(body, {force, {}});
    world.advance(kPass, kStep);
  }
  expect_near(linear() * kMass, force * 20 * kPass, 1e-9);
  expect_near(world.velocity(body).angular, {}, 1e-9);
}

TEST_F(Wrenches, ActDuringOneStep) {
  world.wrenches().apply(body, {{1, 0, 0}, {}});
  world.advance(kPass, kStep);
  const Vector3 after_one = linear();
  world.advance(kPass, kStep);
  expect_near(after_one, {kPass / kMass, 0, 0}, 1e-12);
  expect_near(linear(), after_one, 1e-12);
}

TEST_F(Wrenches, AddUp) {
  world.wrenches().apply(body, {{1, 0, 0}, {}});
  world.wrenches().apply(body, {{2, 4, 0}, {}});
  world.advance(kPass, kStep);
  expect_near(linear() * kMass, Vector3(3, 4, 0) * kPass, 1e-12);
}

TEST_F(Wrenches, TorqueAboutAPrincipalAxisTurnsAboutIt) {
  for (int axis = 0; axis < 3; ++axis) {
    world.reset();
    Vector3 torque;
    torque[axis] = 0.4;
    const Vector3 in_world = world.pose(body).orientation * torque;
    for (int i = 0; i < 10; ++i) {
      world.wrenches().apply(body, {{}, torque}, {}, WrenchFrame::kObject);
      world.advance(kPass, kStep);
    }
    expect_near(world.velocity(body).angular, in_world * 0.5 / kInertia[axis], 1e-9);
    expect_near(linear(), {}, 1e-9);
  }
}

TEST_F(Wrenches, AForceBesideTheCentreAlsoTurns) {
  const Vector3 force(0, 3, 0);
  const Vector3 lever(0.2, 0, 0.1);
  world.wrenches().apply(body, {force, {}}, centre() + lever);
  world.advance(kStep, kStep);
  const Quaternion turned = free_body().models[0].pose.orientation;
  const Vector3 torque = turned.conjugate() * lever.cross(force);
  const Vector3 angular = turned * torque.cwiseQuotient(kInertia) * kStep;
  expect_near(linear(), force * kStep / kMass, 1e-12);
  expect_near(world.velocity(body).angular, angular, 1e-9);
}

TEST_F(Wrenches, TheFrameOfTheObjectIsThatOfAllVectors) {
  const Pose before = world.pose(body);
  World other(free_body(), 0);
  const Wrench wrench{{1, -2, 3}, {0.1, 0.2, -0.3}};
  const Vector3 point(0.4, 0.1, -0.2);
  world.wrenches().apply(body, wrench, point, WrenchFrame::kObject);
  other.wrenches().apply(body, {before.orientation * wrench.force, before.orientation * wrench.torque}, before * point);
  world.advance(kPass, kStep);
  other.advance(kPass, kStep);
  expect_near(world.velocity(body).linear, other.velocity(body).linear, 1e-12);
  expect_near(world.velocity(body).angular, other.velocity(body).angular, 1e-12);
}

TEST_F(Wrenches, OnAModelActOnItsCanonicalLink) {
  World other(free_body(), 0);
  world.wrenches().apply(find("/Body"), {{1, 2, 3}, {4, 5, 6}});
  other.wrenches().apply(body, {{1, 2, 3}, {4, 5, 6}});
  world.advance(kPass, kStep);
  other.advance(kPass, kStep);
  EXPECT_EQ(world.state_hash(), other.state_hash());
}

TEST_F(Wrenches, OnTwoJoinedLinksMoveBoth) {
  World pair(jointed(joint("fixed", {})), 0);
  const ObjectId base = pair.tree().find("/Robot/base");
  pair.wrenches().apply(base, {{1, 0, 0}, {}});
  pair.advance(kPass, kStep);
  EXPECT_NEAR(pair.velocity(base).linear.x(), kPass / 2, 1e-6) << "1 N moves two links of 1 kg";
}

TEST_F(Wrenches, CanBeCleared) {
  world.wrenches().apply(body, {{1, 0, 0}, {0, 1, 0}});
  world.wrenches().clear(body, true, false);
  world.advance(kPass, kStep);
  expect_near(linear(), {}, 1e-12);
  EXPECT_GT(world.velocity(body).angular.norm(), 0.01);
  world.reset();
  world.wrenches().apply(body, {{1, 0, 0}, {0, 1, 0}});
  world.wrenches().clear(body);
  EXPECT_EQ(world.state_hash(), World(free_body(), 0).state_hash());
}

TEST_F(Wrenches, AreForgottenByAReset) {
  const std::uint64_t before = world.state_hash();
  world.wrenches().apply(body, {{1, 0, 0}, {}});
  EXPECT_NE(world.state_hash(), before);
  world.reset();
  EXPECT_EQ(world.state_hash(), before);
}

TEST_F(Wrenches, OfARemovedModelAreForgotten) {
  world.wrenches().apply(body, {{1, 0, 0}, {}});
  world.models().remove(find("/Body"));
  EXPECT_NO_THROW(world.advance(kPass, kStep));
}

TEST_F(Wrenches, WakeASleepingBody) {
  ModelDescription box = model("Box", link_with(Box{{0.2, 0.2, 0.2}}, 0), at(0, 0, 0.1));
  World ground(scene({floor(0), box}), 0);
  const ObjectId link = ground.tree().find("/Box/link");
  ground.advance(3, kStep);  // it sleeps after half a second at rest
  const double before = ground.pose(link).position.x();
  ground.advance(1, kStep);
  ASSERT_EQ(ground.pose(link).position.x(), before);
  ground.wrenches().apply(link, {{2, 0, 0}, {}});
  ground.advance(kPass, kStep);
  EXPECT_NEAR(ground.velocity(link).linear.x(), 2 * kPass, 1e-6);
}

TEST_F(Wrenches, SmallOnesAct) {
  world.wrenches().apply(body, {{1e-6, 0, 0}, {0, 1e-7, 0}});
  world.advance(kPass, kStep);
  EXPECT_NEAR(linear().x(), 1e-6 * kPass / kMass, 1e-15);
  EXPECT_GT(world.velocity(body).angular.norm(), 1e-9);
}

TEST_F(Wrenches, WithoutForceOrTorqueDoNotWakeIt) {
  const std::uint64_t before = world.state_hash();
  world.wrenches().apply(body, {});
  EXPECT_EQ(world.state_hash(), before);
}

TEST_F(Wrenches, TooLargeForTheWorldAreADivergence) {
  world.wrenches().apply(body, {{1e9, 0, 0}, {}});
  EXPECT_THROW(world.advance(kPass, kStep), Diverged);
  world.reset();
  EXPECT_NO_THROW(world.advance(kPass, kStep));
}

TEST_F(Wrenches, InvalidOnesAreRefused) {
  const std::uint64_t before = world.state_hash();
  EXPECT_THROW(world.wrenches().apply(body, {{kNaN, 0, 0}, {}}), InvalidInput);
  EXPECT_THROW(world.wrenches().apply(body, {{}, {0, kInfinity, 0}}), InvalidInput);
  EXPECT_THROW(world.wrenches().apply(body, {{1e10, 0, 0}, {}}), InvalidInput);
  EXPECT_THROW(world.wrenches().apply(body, {{1, 0, 0}, {}}, Vector3(kNaN, 0, 0)), InvalidInput);
  EXPECT_THROW(world.wrenches().apply(find("/Wall/link"), {{1, 0, 0}, {}}), WrongObject);
  EXPECT_THROW(world.wrenches().apply(find("/Wall"), {{1, 0, 0}, {}}), WrongObject);
  EXPECT_THROW(world.wrenches().apply(12345, {{1, 0, 0}, {}}), NoSuchObject);
  World pair(jointed(joint("revolute", {axis(Vector3::UnitZ())})), 0);
  EXPECT_THROW(pair.wrenches().apply(pair.tree().find("/joint"), {{1, 0, 0}, {}}), WrongObject);
  EXPECT_EQ(world.state_hash(), before);
}

}  // namespace
}  // namespace bubblesim::test::test_wrenches
