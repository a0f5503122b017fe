// SPDX-License-Identifier: BSD-3-Clause
// Contacts: resting, sticking and sliding.
#include <gtest/gtest.h>

#include "bubblesim/world.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_contacts {
namespace {

constexpr double kStep = 0.005;
constexpr double kLayer = 0.001;  // m, allowed penetration

/// Height of the model's frame after a second over the floor.
double height_after_a_second(ModelDescription dropped, ModelDescription ground = floor()) {
  const std::string name = "/" + dropped.name;
  World world(scene({std::move(ground), std::move(dropped)}), 0);
  world.advance(1, kStep);
  return world.pose(world.tree().find(name)).position.z();
}

TEST(Contact, EveryShapeRestsOnAPlaneAtItsHalfHeight) {
  EXPECT_NEAR(height_after_a_second(model("Box", link_with(Box{{1, 1, 0.4}}), at(0, 0, 0.25))), 0.2, 2 * kLayer);
  EXPECT_NEAR(height_after_a_second(model("Ball", link_with(Sphere{0.3}), at(0, 0, 0.35))), 0.3, 2 * kLayer);
  EXPECT_NEAR(height_after_a_second(model("Can", link_with(Cylinder{0.2, 0.6}), at(0, 0, 0.35))), 0.3, 2 * kLayer);
}

TEST(Contact, EveryShapeRestsOnAStaticBox) {
  const ModelDescription table = still(model("Table", link_with(Box{{4, 4, 1}}), at(0, 0, 0.5)));
  EXPECT_NEAR(height_after_a_second(model("Box", link_with(Box{{1, 1, 0.4}}), at(0, 0, 1.25)), table), 1.2, 2 * kLayer);
  EXPECT_NEAR(height_after_a_second(model("Ball", link_with(Sphere{0.3}), at(0, 0, 1.35)), table), 1.3, 2 * kLayer);
  EXPECT_NEAR(height_after_a_second(model("Can", link_with(Cylinder{0.2, 0.6}), at(0, 0, 1.35)), table), 1.3,
              2 * kLayer);
}

TEST(Contact, HoldsFarFromTheOrigin) {
  const ModelDescription table = still(model("Table", link_with(Box{{4, 4, 1}}), at(5000, -5000, 0.5)));
  EXPECT_NEAR(height_after_a_second(model("Box", link_with(Box{{1, 1, 0.4}}), at(5000, -5000, 1.25)), table), 1.2,
              2 * kLayer);
}

TEST(Contact, ShapesKeepTheirPlaceInALinkWithAnOffsetCentreOfMass) {
  ModelDescription box = model("Box", link_with(Box{{1, 1, 0.4}}), at(0, 0, 0.65));
  box.links[0].centre_of_mass = {0, 0, -0.3};
  box.links[0].collisions[0].pose.position = {0, 0, -0.4};
  EXPECT_NEAR(height_after_a_second(box), 0.6, 2 * kLayer);
}

class Slope : public ::testing::TestWithParam<double> {};

/// The distance that a box slides down a slope in one second; `mu_box` and `mu_slope` are the frictions of the two
/// surfaces.
double slide(double angle, double mu_box, double mu_slope) {
  const Quaternion tilt = from_rpy(0, angle, 0);
  ModelDescription slope = still(model("Slope", link_with(Box{{40, 4, 1}}, mu_slope), Pose(Vector3::Zero(), tilt)));
  ModelDescription box = model("Box", link_with(Box{{0.4, 0.4, 0.2}}, mu_box));
  box.links[0].inertia_diagonal = Vector3(0.0167, 0.0167, 0.0267);
  box.pose = Pose(tilt * Vector3(0, 0, 0.6), tilt);
  World world(scene({slope, box}), 0);
  const ObjectId id = world.tree().find("/Box");
  world.advance(0.5, kStep);  // settles
  world.set_velocity(id, {});
  const Vector3 before = world.pose(id).position;
  world.advance(1, kStep);
  return (world.pose(id).position - before).dot(tilt * Vector3::UnitX());
}

TEST_P(Slope, HoldsBelowTheAngleOfFriction) {
  EXPECT_NEAR(slide(std::atan(GetParam()) - 0.02, GetParam(), GetParam()), 0, 2e-3);
}

TEST_P(Slope, SlidesAboveTheAngleOfFriction) {
  const double angle = std::atan(GetParam()) + 0.1;
  const double acceleration = 9.81 * (std::sin(angle) - GetParam() * std::cos(angle));
  EXPECT_NEAR(slide(angle, GetParam(), GetParam()), acceleration / 2, 0.03 * acceleration / 2);
}

TEST_P(Slope, LowerFrictionOfTheTwoCounts) {
  const double angle = std::atan(GetParam()) + 0.1;
  EXPECT_GT(slide(angle, GetParam(), 5), 0.1);
  EXPECT_GT(slide(angle, 5, GetParam()), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Mu, Slope, ::testing::Values(0.2, 0.5, 0.8));

TEST(Slope, WithoutFrictionNothingHolds) { EXPECT_NEAR(slide(0.1, 0, 1), 9.81 * std::sin(0.1) / 2, 0.02); }

TEST(CollideBitmask, ShapesWithoutACommonBitPassThroughEachOther) {
  EXPECT_NEAR(height_after_a_second(model("Ball", link_with(Sphere{0.3}, 1, 0b0110), at(0, 0, 0.3)), floor(1, 0b0010)),
              0.3, 2 * kLayer);
  EXPECT_LT(height_after_a_second(model("Ball", link_with(Sphere{0.3}, 1, 0b0101), at(0, 0, 0.3)), floor(1, 0b1010)),
            -4);
  EXPECT_LT(height_after_a_second(model("Ball", link_with(Sphere{0.3}, 1, 0), at(0, 0, 0.3))), -4);
}

TEST(Contact, MovingModelsPushEachOther) {
  World world(scene({model("Left", link_with(Sphere{0.5}), at(-2, 0, 0)), model("Right", link_with(Sphere{0.5}))},
                    Vector3::Zero()),
              0);
  world.set_velocity(world.tree().find("/Left"), {{2, 0, 0}, {}});
  world.advance(2, kStep);
  EXPECT_NEAR(world.velocity(world.tree().find("/Left")).linear.x(), 1, 0.06) << "inelastic: they share the momentum";
  EXPECT_NEAR(world.velocity(world.tree().find("/Right")).linear.x(), 1, 0.06);
}

/// Two overlapping balls of one model, and how far apart they move.
double distance_of_overlapping_links(bool self_collide, bool jointed) {
  ModelDescription pair = model("Pair", link_with(Sphere{0.5}));
  LinkDescription other = link_with(Sphere{0.5});
  other.name = "other";
  other.pose.position = {0.8, 0, 0};
  pair.links.push_back(other);
  pair.self_collide = self_collide;
  if (jointed) pair.joints.push_back(joint("prismatic", {axis(Vector3::UnitX())}, {}, "link", "other"));
  World world(scene({pair}, Vector3::Zero()), 0);
  world.advance(3, kStep);
  return (world.pose(world.tree().find("/other")).position - world.pose(world.tree().find("/link")).position).norm();
}

TEST(SelfCollide, LinksOfOneModelTouchOnlyWhenAskedFor) {
  EXPECT_NEAR(distance_of_overlapping_links(false, false), 0.8, 1e-9);
  EXPECT_GT(distance_of_overlapping_links(true, false), 0.95);
}

TEST(SelfCollide, JointedLinksNeverTouch) { EXPECT_NEAR(distance_of_overlapping_links(true, true), 0.8, 1e-9); }

TEST(Contact, ShapesOfOneLinkDoNotTouch) {
  ModelDescription body = model("Body", link_with(Sphere{0.5}));
  body.links[0].collisions.push_back(shape(Box{{1, 1, 1}}));
  body.self_collide = true;
  World world(scene({body}, Vector3::Zero()), 0);
  world.advance(1, kStep);
  EXPECT_EQ(world.pose(world.tree().find("/Body")).position.norm(), 0);
}

TEST(Contact, OverlappingShapesPartSlowly) {
  World world(
      scene({still(model("Rock", link_with(Box{{1, 1, 1}}))), model("Ball", link_with(Sphere{0.5}), at(0.6, 0, 0))},
            Vector3::Zero()),
      0);
  const ObjectId ball = world.tree().find("/Ball");
  for (int i = 0; i < 400; ++i) {
    world.advance(kStep, kStep);
    ASSERT_LT(world.velocity(ball).linear.norm(), 0.11) << "overlapping bodies must not fly apart";
  }
}

}  // namespace
}  // namespace bubblesim::test::test_contacts
