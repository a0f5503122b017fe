// SPDX-License-Identifier: BSD-3-Clause
// Universal joints, screws, gearboxes, springs and mimic joints, compared with theory.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bubblesim/error.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_joint_kinds {
namespace {

constexpr double kStep = 0.005;

AxisDescription motor(const Vector3& direction) { return axis(direction, MotorMode::kVelocity); }

struct Jointed {
  explicit Jointed(JointDescription description) : world(jointed(std::move(description)), 0) {}
  explicit Jointed(const SceneDescription& scene) : world(scene, 0) {}

  World world;
  ObjectId arm = world.tree().find("/arm");
  ObjectId joint = world.tree().find("/joint");
};

class Universal : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Parents, Universal, ::testing::Values("base", "world"));

TEST_P(Universal, EachAxisTurnsTheChildPositively) {
  for (const int driven : {0, 1}) {
    Jointed pair(joint("universal", {motor(Vector3::UnitZ()), motor(Vector3::UnitY())}, {}, GetParam()));
    pair.world.joints().set_target_velocity(pair.joint, 0.5, driven);
    pair.world.advance(2, kStep);
    const Pose from = GetParam() == std::string("world") ? Pose() : pair.world.pose(pair.world.tree().find("/base"));
    const Vector3 direction = driven == 0 ? Vector3::UnitZ() : Vector3::UnitY();
    const double turned = turn_about(direction, from, pair.world.pose(pair.arm));
    EXPECT_NEAR(turned, 1, 0.01);
    EXPECT_NEAR(pair.world.joints().position(pair.joint, driven), turned, 1e-4);
    EXPECT_NEAR(pair.world.joints().velocity(pair.joint, driven), 0.5, 1e-4);
    EXPECT_NEAR(pair.world.joints().position(pair.joint, 1 - driven), 0, 1e-4);
  }
}

TEST_P(Universal, SecondAxisTurnsAlongWithTheFirst) {
  Jointed pair(
      joint("universal", {axis(Vector3::UnitZ(), MotorMode::kPosition), motor(Vector3::UnitY())}, {}, GetParam()));
  pair.world.joints().set_target_position(pair.joint, M_PI / 2, 0);  // the second axis then points along -x
  pair.world.advance(2, kStep);
  pair.world.joints().set_target_velocity(pair.joint, 0.3, 1);
  pair.world.advance(0.5, kStep);
  const ObjectId base = pair.world.tree().find("/base");
  const bool fixed = GetParam() == std::string("world");
  const Vector3 spin =
      pair.world.velocity(pair.arm).angular - (fixed ? Vector3::Zero() : pair.world.velocity(base).angular);
  const Quaternion axes = fixed ? Quaternion() : pair.world.pose(base).orientation;
  EXPECT_NEAR((axes.conjugate() * spin).x(), -0.3, 0.01);
}

TEST_P(Universal, LimitsHold) {
  JointDescription described = joint("universal", {motor(Vector3::UnitZ()), motor(Vector3::UnitY())}, {}, GetParam());
  described.axes[1].lower = -0.2;
  described.axes[1].upper = 0.4;
  Jointed pair(described);
  for (const auto& [speed, end] : {std::pair{1.0, 0.4}, std::pair{-1.0, -0.2}}) {
    pair.world.joints().set_target_velocity(pair.joint, speed, 1);
    pair.world.advance(2, kStep);
    EXPECT_NEAR(pair.world.joints().position(pair.joint, 1), end, 0.01);
  }
}

JointDescription screw(double lead, const std::string& parent = "world") {
  JointDescription described = joint("screw", {motor(Vector3::UnitZ())}, {}, parent);
  described.screw_lead = lead;
  return described;
}

TEST(Screw, MovesByItsLeadForEachTurn) {
  for (const double lead : {0.5, 0.01, -0.1}) {
    for (const char* parent : {"world", "base"}) {
      Jointed pair(screw(lead, parent));
      pair.world.joints().set_target_velocity(pair.joint, 2 * M_PI);  // a turn per second
      pair.world.advance(3, kStep);
      const double turns = pair.world.joints().position(pair.joint) / (2 * M_PI);
      EXPECT_NEAR(turns, 3, 0.1);
      const bool fixed = parent == std::string("world");
      const Pose base = fixed ? Pose() : pair.world.pose(pair.world.tree().find("/base"));
      EXPECT_NEAR((base.inverse() * pair.world.pose(pair.arm)).position.z(), turns * lead, std::abs(lead) * 1e-3)
          << lead;
      EXPECT_NEAR(
          std::remainder(turn_about(Vector3::UnitZ(), base, pair.world.pose(pair.arm)) - turns * 2 * M_PI, 2 * M_PI), 0,
          1e-3)
          << lead;
      EXPECT_NEAR(pair.world.joints().velocity(pair.joint), 2 * M_PI, 1e-3);
    }
  }
}

TEST(Screw, FallsAsItsInertiaLetsIt) {
  constexpr double kLead = 2;
  SceneDescription described = jointed(screw(kLead));
  described.models[0].joints[0].axes[0].motor = MotorMode::kNone;
  described.gravity = {0, 0, -9.81};
  Jointed pair(described);
  pair.world.advance(1, kStep);
  // m g = (m + I / p^2) a, with the lead p per radian, here for 1 kg and 1 kg m^2.
  const double slope = kLead / (2 * M_PI);
  const double acceleration = 9.81 / (1 + 1 / (slope * slope));
  EXPECT_NEAR(pair.world.velocity(pair.arm).linear.z(), -acceleration, acceleration * 1e-3);
}

TEST(Screw, LimitsCountWholeTurns) {
  JointDescription described = screw(0.1);
  described.axes[0].upper = 9;
  described.axes[0].lower = -1;
  Jointed pair(described);
  pair.world.joints().set_target_velocity(pair.joint, 5);
  pair.world.advance(4, kStep);
  EXPECT_NEAR(pair.world.joints().position(pair.joint), 9, 0.02);
}

struct Gears {
  const char* reference;
  Vector3 first, second, apart;
};

/// Two wheels on hinges in `base`, or in the world, coupled by a gearbox; the first has a motor.
SceneDescription geared(double ratio, const Gears& gears, Solver solver) {
  const auto& [reference, first, second, apart] = gears;
  ModelDescription box = model("Box", link("base"));
  box.links.push_back(link("in"));
  box.links.push_back(link("out", apart));
  box.joints = {joint("revolute", {motor(first)}, {}, reference, "in"),
                joint("continuous", {axis(second)}, apart, reference, "out"),
                joint("gearbox", {axis(first), axis(second)}, {}, "in", "out")};
  for (int i = 0; i < 3; ++i) box.joints[static_cast<std::size_t>(i)].name = "joint" + std::to_string(i);
  box.joints[2].gearbox_ratio = ratio;
  box.joints[2].gearbox_reference = reference;
  SceneDescription described = scene({box}, Vector3::Zero());
  described.solver = solver;
  return described;
}

class Gearbox : public ::testing::TestWithParam<std::tuple<Gears, Solver>> {};
INSTANTIATE_TEST_SUITE_P(
    Places, Gearbox,
    ::testing::Combine(::testing::Values(Gears{"world", Vector3::UnitZ(), Vector3::UnitZ(), {0.4, 0, 0}},
                                         Gears{"base", Vector3::UnitY(), Vector3::UnitY(), {0.3, 0, 0.1}},
                                         Gears{"base", Vector3::UnitZ(), Vector3::UnitX(), {0.2, 0, 0}},
                                         Gears{
                                             "world", Vector3::UnitX(), Vector3::UnitX(), {0.5, 0, 0}},  // on one line
                                         Gears{"base", Vector3::UnitZ(), Vector3::UnitZ(), {0, 0, 0.1}}),
                       ::testing::Values(Solver::kOde, Solver::kBubblesim)));

TEST_P(Gearbox, ChildTurnsMinusRatioTimesTheParent) {
  const auto& [gears, solver] = GetParam();
  for (const double ratio : {2.0, -0.5, 1.0, -1.0}) {
    World world(geared(ratio, gears, solver), 0);
    const ObjectId in = world.tree().find("/joint0");
    const ObjectId out = world.tree().find("/joint1");
    world.joints().set_target_velocity(in, 3);
    world.advance(4, kStep);
    EXPECT_NEAR(world.joints().velocity(in), 3, 1e-3);
    EXPECT_NEAR(world.joints().velocity(out), -ratio * 3, 5e-3 * std::abs(ratio)) << ratio;
    const ObjectId gearbox = world.tree().find("/joint2");
    EXPECT_NEAR(world.joints().position(gearbox, 0), 12, 0.1) << "whole turns count";
    EXPECT_NEAR(world.joints().position(gearbox, 1), -ratio * world.joints().position(gearbox, 0), 5e-3) << ratio;
  }
}

TEST_P(Gearbox, HasNoMotor) {
  const auto& [gears, solver] = GetParam();
  World world(geared(1, gears, solver), 0);
  const ObjectId gearbox = world.tree().find("/joint2");
  EXPECT_THROW(world.joints().set_motor_mode(gearbox, MotorMode::kEffort), WrongObject);
  EXPECT_THROW(world.joints().set_motor_mode(gearbox, MotorMode::kVelocity, 1), WrongObject);
  EXPECT_NO_THROW(world.joints().set_motor_mode(gearbox, MotorMode::kNone));
  world.advance(0.1, kStep);
  EXPECT_EQ(world.joints().motor_effort(gearbox), 0);
}

TEST_P(Gearbox, CarriesTorqueByItsRatio) {
  const auto& [gears, solver] = GetParam();
  constexpr double kRatio = 2;
  SceneDescription described = geared(kRatio, {"world", gears.first, gears.second, gears.apart}, solver);
  described.models[0].joints[0].axes[0].max_force = 1;
  World world(described, 0);
  const ObjectId in = world.tree().find("/joint0");
  world.joints().set_target_velocity(in, 100);
  world.advance(1, kStep);
  // 1 N m accelerates the inertias 1 and 1 ratio^2 kg m^2.
  EXPECT_NEAR(world.joints().velocity(in), 1 / (1 + kRatio * kRatio), 0.01);
}

TEST_P(Gearbox, GoesWithAModelThatIsPutElsewhere) {
  const auto& [gears, solver] = GetParam();
  World world(geared(2, {"base", gears.first, gears.second, gears.apart}, solver), 0);
  const ObjectId in = world.tree().find("/joint0");
  world.joints().set_target_velocity(in, 1);
  world.advance(1, kStep);
  world.set_pose(world.tree().find("/Box"), Pose(100, -50, 3, 0.4, 1, -2));
  world.advance(1, kStep);
  EXPECT_NEAR(world.joints().velocity(world.tree().find("/joint1")), -2, 0.02);
  EXPECT_LT((world.pose(world.tree().find("/Box")).position - Vector3(100, -50, 3)).norm(), 0.05);
}

/// `arm` on one axis against the world, 1 kg and 1 kg m^2.
Jointed sprung(const char* type, double stiffness, double damping, double reference) {
  JointDescription described = joint(type, {axis(Vector3::UnitZ())}, {}, "world");
  described.axes[0].spring_stiffness = stiffness;
  described.axes[0].damping = damping;
  described.axes[0].spring_reference = reference;
  return Jointed(described);
}

class Spring : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Kinds, Spring, ::testing::Values("revolute", "prismatic"));

TEST_P(Spring, SwingsWithThePeriodOfTheory) {
  constexpr double kFineStep = 0.0005;
  Jointed pair = sprung(GetParam(), 40, 0, 0.3);
  std::vector<double> passages;  // upwards through the rest position, by interpolation
  double before = -0.3;
  for (int i = 1; passages.size() < 6 && i < 20000; ++i) {
    pair.world.advance(kFineStep, kFineStep);
    const double now = pair.world.joints().position(pair.joint) - 0.3;
    if (before < 0 && now >= 0) passages.push_back((i - now / (now - before)) * kFineStep);
    before = now;
  }
  ASSERT_EQ(passages.size(), 6u);
  const double theory = 2 * M_PI / std::sqrt(40.0);
  EXPECT_NEAR((passages.back() - passages.front()) / 5, theory, theory * 1e-3);
}

TEST_P(Spring, OfAnyStiffnessStaysStable) {
  for (const double stiffness : {1.0, 1e3, 1e6, 1e9}) {
    Jointed pair = sprung(GetParam(), stiffness, 2 * std::sqrt(stiffness), 0.3);  // critically damped
    pair.world.advance(12, kStep);
    EXPECT_NEAR(pair.world.joints().position(pair.joint), 0.3, 1e-3) << stiffness;
    EXPECT_NEAR(pair.world.joints().velocity(pair.joint), 0, 1e-3) << stiffness;
  }
}

TEST_P(Spring, HoldsAWeightWhereTheForcesBalance) {
  SceneDescription described = jointed(joint("prismatic", {axis(Vector3::UnitZ())}, {}, "world"));
  described.gravity = {0, 0, -9.81};
  described.models[0].joints[0].axes[0].spring_stiffness = 200;
  described.models[0].joints[0].axes[0].damping = 20;
  Jointed pair(described);
  pair.world.advance(5, kStep);
  EXPECT_NEAR(pair.world.joints().position(pair.joint), -9.81 / 200, 1e-5);
}

TEST(TorsionSpring, RemembersWholeTurns) {
  Jointed pair = sprung("continuous", 1, 2, 15);
  pair.world.advance(20, kStep);
  EXPECT_NEAR(pair.world.joints().position(pair.joint), 15, 1e-3);
}

class Motorised : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Kinds, Motorised, ::testing::Values("revolute", "prismatic"));

TEST_P(Motorised, FrictionTakesItsShareOfTheForce) {
  JointDescription described = joint(GetParam(), {motor(Vector3::UnitZ())}, {}, "world");
  described.axes[0].max_force = 3;
  described.axes[0].friction = 1;
  Jointed pair(described);
  pair.world.joints().set_target_velocity(pair.joint, 100);
  pair.world.advance(0.5, kStep);
  EXPECT_NEAR(pair.world.joints().velocity(pair.joint), (3 - 1) * 0.5, 1e-6);
}

TEST_P(Motorised, FrictionHoldsAWeakMotor) {
  JointDescription described = joint(GetParam(), {motor(Vector3::UnitZ())}, {}, "world");
  described.axes[0].max_force = 1;
  described.axes[0].friction = 2;
  Jointed pair(described);
  pair.world.joints().set_target_velocity(pair.joint, 5);
  pair.world.advance(1, kStep);
  EXPECT_NEAR(pair.world.joints().velocity(pair.joint), 0, 1e-9);
}

TEST_P(Motorised, DampingSetsTheSpeedOfAWeakMotor) {
  JointDescription described = joint(GetParam(), {motor(Vector3::UnitZ())}, {}, "world");
  described.axes[0].max_force = 3;
  described.axes[0].damping = 2;
  Jointed pair(described);
  pair.world.joints().set_target_velocity(pair.joint, 100);
  pair.world.advance(10, kStep);
  EXPECT_NEAR(pair.world.joints().velocity(pair.joint), 3.0 / 2, 1e-6);
}

/// A leader and a follower, each on a hinge.
SceneDescription mimicking(MimicDescription mimic) {
  ModelDescription hand = model("Hand", link("left"));
  hand.links.push_back(link("right", {1, 0, 0}));
  hand.joints = {joint("revolute", {motor(Vector3::UnitZ())}, {}, "world", "left"),
                 joint("revolute", {axis(Vector3::UnitZ())}, {1, 0, 0}, "world", "right")};
  hand.joints[0].name = "leader";
  hand.joints[1].name = "follower";
  for (JointDescription& finger : hand.joints) {
    finger.axes[0].lower = -2;
    finger.axes[0].upper = 2;
  }
  mimic.joint = "leader";
  hand.joints[1].axes[0].mimic = mimic;
  return scene({hand}, Vector3::Zero());
}

TEST(Mimic, FollowsByMultiplierAndOffset) {
  World world(mimicking({"", 0, -0.5, 0.25, 0.1}), 0);
  const ObjectId leader = world.tree().find("/leader");
  const ObjectId follower = world.tree().find("/follower");
  world.joints().set_target_velocity(leader, 0.6);
  world.advance(2, kStep);
  EXPECT_NEAR(world.joints().position(follower), -0.5 * (world.joints().position(leader) - 0.1) + 0.25, 1e-3);
  EXPECT_NEAR(world.joints().velocity(follower), -0.3, 1e-3);
}

TEST(Mimic, FollowsBeyondHalfATurn) {
  for (const double multiplier : {1.0, -1.0, 0.5, 3.0}) {
    SceneDescription described = mimicking({"", 0, multiplier, 0, 0});
    for (JointDescription& finger : described.models[0].joints) {
      finger.axes[0].lower = -std::numeric_limits<double>::infinity();
      finger.axes[0].upper = std::numeric_limits<double>::infinity();
    }
    World world(described, 0);
    const ObjectId leader = world.tree().find("/leader");
    const ObjectId follower = world.tree().find("/follower");
    world.joints().set_target_velocity(leader, 4);
    double turned = 0;  // of the leader, with full turns
    for (int i = 0; i < 600; ++i) {
      world.advance(kStep, kStep);
      turned += std::remainder(world.joints().position(leader) - turned, 2 * M_PI);
      if (i < 60) continue;  // it catches up by a fifth in each substep
      EXPECT_NEAR(world.joints().velocity(follower), 4 * multiplier, 1e-3 * std::abs(4 * multiplier))
          << "at " << i * kStep << " s";
      EXPECT_NEAR(std::remainder(world.joints().position(follower) - multiplier * turned, 2 * M_PI), 0, 1e-3);
    }
    EXPECT_NEAR(turned, 12, 0.1);
  }
}

TEST(Mimic, StopsAtItsOwnLimit) {
  World world(mimicking({"", 0, 3, 0, 0}), 0);
  const ObjectId leader = world.tree().find("/leader");
  world.joints().set_target_velocity(leader, 1);
  world.advance(1.5, kStep);
  EXPECT_NEAR(world.joints().position(world.tree().find("/follower")), 2, 0.02);
}

TEST(Mimic, OfAJointThatDoesNotExistIsAnError) {
  SceneDescription described = mimicking({});
  described.models[0].joints[1].axes[0].mimic->joint = "leder";
  try {
    World world(described, 0);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean leader"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace bubblesim::test::test_joint_kinds
