// SPDX-License-Identifier: BSD-3-Clause
// Links that are attached to each other: two models move as the one rigid body that they make.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/world.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_attachments {
namespace {

constexpr double kStep = 0.001;
constexpr double kForce = 2;  // N

/// Two models of 1 and 3 kg, each with inertia 1 kg m^2, 2 m apart along x.
SceneDescription pair_of_bodies(Solver solver, const Vector3& gravity = Vector3::Zero()) {
  ModelDescription heavy = model("B", link("link"), at(2, 0, 0));
  heavy.links[0].mass = 3;
  SceneDescription described = scene({model("A", link("link")), heavy}, gravity);
  described.solver = solver;
  return described;
}

class Attached : public testing::TestWithParam<Solver> {
 protected:
  static ObjectId link_of(const World& world, const std::string& name) {
    return world.tree().find("/" + name + "/link");
  }
};

TEST_P(Attached, MoveAsOneRigidBody) {
  World world(pair_of_bodies(GetParam()), 0);
  const ObjectId a = link_of(world, "A");
  const ObjectId b = link_of(world, "B");
  world.attachments().attach(a, b);
  for (int i = 0; i < 500; ++i) {
    world.wrenches().apply(a, {{0, kForce, 0}, {}});
    world.advance(kStep, kStep);
  }
  const double time = 0.5;
  const double inertia = 1 + 1 + 1 * 1.5 * 1.5 + 3 * 0.5 * 0.5;  // about the centre of mass at x = 1.5
  const Twist of_a = world.velocity(a);
  const Twist of_b = world.velocity(b);
  EXPECT_NEAR((of_a.linear * 1 + of_b.linear * 3).y(), kForce * time, 1e-6) << "momentum";
  const double turned = 0.5 * 1.5 * kForce / inertia * time * time;
  EXPECT_NEAR(of_a.angular.z(), -1.5 * kForce / inertia * time, 2e-2 * turned) << "the force turns little with it";
  EXPECT_NEAR((of_a.angular - of_b.angular).norm(), 0, 1e-6);
  const Pose apart = world.pose(a).inverse() * world.pose(b);
  EXPECT_NEAR((apart.position - Vector3(2, 0, 0)).norm(), 0, 1e-4);
  EXPECT_NEAR(to_rpy(apart.orientation).norm(), 0, 1e-5);
}

TEST_P(Attached, HoldWhatHangsOnAStaticLinkUntilItIsDetached) {
  SceneDescription described =
      scene({still(model("Hook", link("link"), at(0, 0, 3))), model("A", link("link"), at(1, 0, 2))});
  described.solver = GetParam();
  World world(described, 0);
  const ObjectId a = link_of(world, "A");
  const AttachmentId held = world.attachments().attach(link_of(world, "Hook"), a);
  world.advance(1, kStep);
  EXPECT_NEAR((world.pose(a).position - Vector3(1, 0, 2)).norm(), 0, 1e-6);
  ASSERT_TRUE(world.attachments().contains(held));
  world.attachments().detach(held);
  world.advance(0.5, kStep);
  EXPECT_NEAR(world.velocity(a).linear.z(), -9.81 * 0.5, 1e-6);
  world.attachments().detach(held);  // does nothing
}

TEST_P(Attached, CarryTheLoadOfARobotWithJoints) {
  // An arm that a strong motor holds level; the load of 3 kg hangs at its end.
  ModelDescription arm = model("A", link("link"));
  arm.joints.push_back(joint("prismatic", {axis(Vector3::UnitZ(), MotorMode::kPosition)}, {}, "world", "link"));
  ModelDescription load = model("B", link("link"), at(0.5, 0, 0));
  load.links[0].mass = 3;
  SceneDescription described = scene({arm, load});
  described.solver = GetParam();
  World world(described, 0);
  const ObjectId lift = world.tree().find("/A/joint");
  world.attachments().attach(link_of(world, "A"), link_of(world, "B"));
  world.joints().set_target_position(lift, 0.2);
  world.advance(2, kStep);
  EXPECT_NEAR(world.pose(link_of(world, "B")).position.z(), 0.2, 2e-3);
  world.advance(0.1, kStep);
  EXPECT_NEAR(world.joints().motor_effort(lift), 4 * 9.81, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Attached, testing::Values(Solver::kBubblesim, Solver::kOde));

struct Attachments : testing::Test {
  ObjectId a() const { return world.tree().find("/A/link"); }
  ObjectId b() const { return world.tree().find("/B/link"); }
  World world{pair_of_bodies(Solver::kBubblesim), 0};
};

TEST_F(Attachments, EndWithTheirModelsAndWithAReset) {
  world.attachments().attach(a(), b());
  ASSERT_EQ(world.attachments().all().size(), 1U);
  world.reset();
  EXPECT_TRUE(world.attachments().all().empty());
  const AttachmentId again = world.attachments().attach(b(), a());
  EXPECT_EQ(world.attachments().all()[0].parent, b());
  world.models().remove(world.tree().find("/B"));
  EXPECT_FALSE(world.attachments().contains(again));
  world.advance(0.1, kStep);
}

TEST_F(Attachments, HoldALinkWhereItWasPut) {
  world.attachments().attach(a(), b());
  world.set_pose(world.tree().find("/B"), at(5, 1, 0));
  world.set_velocity(a(), {{1, 0, 0}, {}});
  world.set_velocity(b(), {{1, 0, 0}, {}});
  world.advance(1, kStep);
  EXPECT_NEAR((world.pose(a()).position - Vector3(1, 0, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((world.pose(b()).position - Vector3(6, 1, 0)).norm(), 0, 1e-6);
}

TEST_F(Attachments, ChangeTheHashOfTheState) {
  const std::uint64_t before = world.state_hash();
  const AttachmentId made = world.attachments().attach(a(), b());
  EXPECT_NE(world.state_hash(), before);
  world.attachments().detach(made);
  EXPECT_EQ(world.state_hash(), before);
}

TEST_F(Attachments, LinksThatAreHeldDoNotCollide) {
  World boxes(
      scene({model("A", link_with(Box{{1, 1, 1}}), at(0, 0, 5)), model("B", link_with(Box{{1, 1, 1}}), at(0.5, 0, 5))},
            Vector3::Zero()),
      0);
  boxes.attachments().attach(boxes.tree().find("/A/link"), boxes.tree().find("/B/link"));
  boxes.advance(1, kStep);
  EXPECT_TRUE(boxes.measurements().contact_points().empty());
  EXPECT_NEAR(boxes.velocity(boxes.tree().find("/A")).linear.norm(), 0, 1e-9);
}

TEST_F(Attachments, AreOfTwoLinksOfWhichOneMayMove) {
  EXPECT_THROW(world.attachments().attach(a(), a()), WrongObject);
  EXPECT_THROW(world.attachments().attach(world.tree().find("/A"), b()), WrongObject);
  EXPECT_THROW(world.attachments().attach(a(), kNoObject), NoSuchObject);
  World fixed(scene({still(model("A", link("link"))), still(model("B", link("link")))}), 0);
  EXPECT_THROW(fixed.attachments().attach(fixed.tree().find("/A/link"), fixed.tree().find("/B/link")), WrongObject);
}

TEST(AttachedProps, SleepAndWakeTogether) {
  World world(scene({floor(), model("A", link_with(Box{{1, 1, 1}}), at(0, 0, 0.5)),
                     model("B", link_with(Box{{1, 1, 1}}), at(1.2, 0, 0.5))}),
              0);
  const ObjectId a = world.tree().find("/A/link");
  const ObjectId b = world.tree().find("/B/link");
  world.attachments().attach(a, b);
  world.advance(3, 0.005);
  const Vector3 rest = world.pose(b).position;
  world.wrenches().apply(a, {{200, 0, 0}, {}});
  world.advance(0.1, 0.005);
  EXPECT_GT(world.pose(b).position.x(), rest.x() + 0.01);
  EXPECT_NEAR((world.pose(a).inverse() * world.pose(b)).position.x(), 1.2, 1e-3);
}

}  // namespace
}  // namespace bubblesim::test::test_attachments
