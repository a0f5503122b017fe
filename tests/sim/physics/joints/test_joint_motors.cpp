// SPDX-License-Identifier: BSD-3-Clause
// Motors, limits, friction and damping of joints, compared with theory.
#include <gtest/gtest.h>

#include "bubblesim/error.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_joint_motors {
namespace {

constexpr double kStep = 0.005;

/// `arm` on one axis against the world, 1 kg and 1 kg m^2, so that force is acceleration for both kinds of joint.
class Axis {
 public:
  Axis(const char* type, AxisDescription description, const Vector3& gravity = {})
      : world(described(type, std::move(description), gravity), 0) {}

  void run(double duration) { world.advance(duration, kStep); }
  double position() const { return world.joints().position(joint); }
  double velocity() const { return world.joints().velocity(joint); }
  void push(double velocity) {
    const bool slides = world.tree().at(joint).name == "prismatic";
    const Vector3 along = Vector3::UnitZ() * velocity;
    world.set_velocity(world.tree().find("/arm"), slides ? Twist{along, {}} : Twist{{}, along});
  }

  World world;
  ObjectId joint = world.tree().find("/Robot/*", kNoObject, 2);

 private:
  static SceneDescription described(const char* type, AxisDescription description, const Vector3& gravity) {
    JointDescription made = test::joint(type, {std::move(description)}, {}, "world");
    made.name = type;
    SceneDescription scene = jointed(made);
    scene.gravity = gravity;
    return scene;
  }
};

class AnyAxis : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Kinds, AnyAxis, ::testing::Values("revolute", "prismatic"));

TEST_P(AnyAxis, VelocityMotorReachesItsTarget) {
  Axis axis(GetParam(), test::axis(Vector3::UnitZ(), MotorMode::kVelocity));
  axis.world.joints().set_target_velocity(axis.joint, -1.5);
  axis.run(0.5);
  EXPECT_NEAR(axis.velocity(), -1.5, 1e-6);
}

TEST_P(AnyAxis, ForceLimitBoundsTheAcceleration) {
  AxisDescription weak = test::axis(Vector3::UnitZ(), MotorMode::kVelocity);
  weak.max_force = 2;
  Axis axis(GetParam(), weak);
  axis.world.joints().set_target_velocity(axis.joint, 100);
  axis.run(0.5);
  EXPECT_NEAR(axis.velocity(), 2 * 0.5, 1e-6) << "v = F/m t";
}

TEST_P(AnyAxis, ForceLimitCanBeSetWhileRunning) {
  Axis axis(GetParam(), test::axis(Vector3::UnitZ(), MotorMode::kVelocity));
  axis.world.joints().set_max_force(axis.joint, 3);
  axis.world.joints().set_target_velocity(axis.joint, 100);
  axis.run(0.5);
  EXPECT_EQ(axis.world.joints().max_force(axis.joint), 3);
  EXPECT_NEAR(axis.velocity(), 3 * 0.5, 1e-6);
}

TEST_P(AnyAxis, VelocityLimitBoundsTheMotor) {
  AxisDescription slow = test::axis(Vector3::UnitZ(), MotorMode::kVelocity);
  slow.max_velocity = 0.7;
  Axis axis(GetParam(), slow);
  axis.world.joints().set_target_velocity(axis.joint, 100);
  axis.run(0.5);
  EXPECT_NEAR(axis.velocity(), 0.7, 1e-6);
}

TEST_P(AnyAxis, PositionMotorReachesItsTargetAndHoldsIt) {
  AxisDescription servo = test::axis(Vector3::UnitZ(), MotorMode::kPosition);
  servo.lower = -2;
  servo.upper = 2;
  Axis axis(GetParam(), servo, {0, 0, -9.81});
  axis.world.joints().set_target_position(axis.joint, 1.2);
  axis.run(1);
  EXPECT_NEAR(axis.position(), 1.2, 1e-6);
  axis.run(5);
  EXPECT_NEAR(axis.position(), 1.2, 1e-9);
  EXPECT_NEAR(axis.velocity(), 0, 1e-9);
}

TEST_P(AnyAxis, PositionMotorStopsAtALimitBeforeItsTarget) {
  AxisDescription servo = test::axis(Vector3::UnitZ(), MotorMode::kPosition);
  servo.lower = -0.5;
  servo.upper = 0.25;
  Axis axis(GetParam(), servo);
  axis.world.joints().set_target_position(axis.joint, 9);
  axis.run(2);
  EXPECT_NEAR(axis.position(), 0.25, 1e-6);
}

TEST(EndlessJoint, PositionMotorTakesTheShortWay) {
  Axis axis("continuous", test::axis(Vector3::UnitZ(), MotorMode::kPosition));
  axis.world.joints().set_target_position(axis.joint, 3);
  axis.run(2);
  EXPECT_NEAR(axis.position(), 3, 1e-6);
  axis.world.joints().set_target_position(axis.joint, -3);
  for (int i = 0; i < 40; ++i) {
    axis.run(0.05);
    ASSERT_GT(std::abs(axis.position()), 2.9) << "it must not turn back through zero";
  }
  EXPECT_NEAR(axis.position(), -3, 1e-6);
}

TEST(EndlessJoint, TargetBeyondATurnMeansTheSameDirection) {
  Axis axis("continuous", test::axis(Vector3::UnitZ(), MotorMode::kPosition));
  axis.world.joints().set_target_position(axis.joint, 2 * M_PI * 3 + 0.5);
  axis.run(2);
  EXPECT_NEAR(axis.position(), 0.5, 1e-6);
}

TEST(WideLimits, PositionMotorReachesATargetBeyondHalfATurn) {
  AxisDescription servo = test::axis(Vector3::UnitZ(), MotorMode::kPosition);
  servo.lower = -6.2;
  servo.upper = 6.2;
  Axis axis("revolute", servo);
  for (const double target : {4.0, -5.5, 6.2, 0.0}) {
    axis.world.joints().set_target_position(axis.joint, target);
    axis.run(3);
    EXPECT_NEAR(axis.position(), target, 1e-6);
    EXPECT_NEAR(axis.velocity(), 0, 1e-6);
  }
}

TEST(WideLimits, HoldBeyondHalfATurn) {
  AxisDescription wide = test::axis(Vector3::UnitZ());
  wide.lower = -0.5;
  wide.upper = 4;
  Axis axis("revolute", wide);
  axis.push(1);
  double furthest = 0;
  for (int i = 0; i < 200; ++i) {
    axis.run(0.05);
    furthest = std::max(furthest, axis.position());
  }
  EXPECT_NEAR(furthest, 4, 0.01);
}

TEST_P(AnyAxis, LimitsStopAMovingLinkWithoutRebound) {
  for (const double side : {-0.7, 1.0, 20.0}) {
    AxisDescription limited = test::axis(Vector3::UnitZ());
    limited.lower = -0.4;
    limited.upper = 0.4;
    Axis axis(GetParam(), limited);
    axis.push(side);
    double furthest = 0;
    double back = 0;
    for (int i = 0; i < 600; ++i) {
      axis.run(kStep);
      furthest = std::max(furthest, std::copysign(axis.position(), axis.position() * side));
      back = std::min(back, std::copysign(1, side) * axis.velocity());
    }
    EXPECT_NEAR(std::abs(axis.position()), 0.4, 1e-6) << side << " m/s: it rests on the limit";
    EXPECT_LT(furthest, 0.4 + 1e-6) << side;
    EXPECT_GT(back, -1e-6) << side << " m/s: it never moves back";
  }
}

TEST_P(AnyAxis, LimitHoldsALinkThatFallsOnIt) {
  AxisDescription limited = test::axis(Vector3::UnitZ(), MotorMode::kEffort);
  limited.lower = -0.4;
  limited.upper = 0.4;
  Axis axis(GetParam(), limited);
  axis.world.joints().set_target_effort(axis.joint, 300);
  double back = 0;
  for (int i = 0; i < 100; ++i) {
    axis.run(kStep);
    back = std::min(back, axis.velocity());
    EXPECT_NEAR(axis.world.joints().motor_effort(axis.joint), 300, 1e-6) << "without the stop's impulse";
  }
  EXPECT_NEAR(axis.position(), 0.4, 1e-6);
  EXPECT_GT(back, -1e-6);
}

TEST_P(AnyAxis, LimitHoldsAgainstAMotorOfAnyForce) {
  for (const double force : {1.0, 1e4, kInfinity}) {
    AxisDescription limited = test::axis(Vector3::UnitZ(), MotorMode::kVelocity);
    limited.lower = -0.4;
    limited.upper = 0.4;
    limited.max_force = force;
    Axis axis(GetParam(), limited);
    axis.world.joints().set_target_velocity(axis.joint, 1);
    axis.run(3);
    EXPECT_NEAR(axis.position(), 0.4, 1e-3) << force;
    axis.world.joints().set_target_velocity(axis.joint, -0.1);
    axis.run(1);
    EXPECT_NEAR(axis.velocity(), -0.1, 1e-3) << "leaves the limit at its own pace, " << force;
    EXPECT_NEAR(axis.position(), 0.3, 0.01) << force;
  }
}

TEST_P(AnyAxis, DampedLinkRestsOnItsLimit) {
  AxisDescription damped = test::axis(Vector3::UnitZ());
  damped.lower = -0.4;
  damped.upper = 0.4;
  damped.damping = 5;
  Axis axis(GetParam(), damped);
  axis.push(4);
  axis.run(3);
  EXPECT_NEAR(axis.position(), 0.4, 0.1) << "except for the rebound";
  EXPECT_NEAR(axis.velocity(), 0, 1e-3);
}

TEST(Friction, HoldsBelowItsForceAndYieldsAbove) {
  AxisDescription rough = test::axis(Vector3::UnitZ());
  rough.friction = 10;
  Axis holds("prismatic", rough, {0, 0, -9.81});
  holds.run(1);
  EXPECT_NEAR(holds.position(), 0, 1e-9);
  rough.friction = 9;
  Axis yields("prismatic", rough, {0, 0, -9.81});
  yields.run(1);
  EXPECT_NEAR(yields.velocity(), -0.81, 1e-6) << "a = g - F/m";
}

TEST_P(AnyAxis, FrictionStopsAMovingLinkAfterItsTime) {
  AxisDescription rough = test::axis(Vector3::UnitZ());
  rough.friction = 0.5;
  Axis axis(GetParam(), rough);
  axis.push(1);
  axis.run(1);
  EXPECT_NEAR(axis.velocity(), 0.5, 1e-6);
  axis.run(1.5);
  EXPECT_NEAR(axis.velocity(), 0, 1e-9);
}

TEST_P(AnyAxis, DampingDecaysExponentially) {
  for (const double damping : {0.2, 1.0, 5.0}) {
    AxisDescription damped = test::axis(Vector3::UnitZ());
    damped.damping = damping;
    Axis axis(GetParam(), damped);
    axis.push(1);
    axis.run(0.4);
    const double exact = std::exp(-damping * 0.4);
    // The error of the implicit step is d h / 2m of the exponent.
    EXPECT_NEAR(axis.velocity(), exact, exact * damping * 0.4 * damping * kStep);
  }
}

TEST_P(AnyAxis, StrongDampingStaysStable) {
  AxisDescription damped = test::axis(Vector3::UnitZ());
  damped.damping = 1e6;
  Axis axis(GetParam(), damped);
  axis.push(1);
  axis.run(1);
  EXPECT_NEAR(axis.velocity(), 0, 1e-6);
  EXPECT_LT(std::abs(axis.position()), 1e-3);
}

TEST_P(AnyAxis, FrictionAndDampingAddUp) {
  AxisDescription both = test::axis(Vector3::UnitZ());
  both.friction = 0.5;
  both.damping = 0.4;
  Axis axis(GetParam(), both);
  axis.push(2);
  axis.run(0.5);
  // m v' = -f - d v
  const double exact = (2 + 0.5 / 0.4) * std::exp(-0.4 * 0.5) - 0.5 / 0.4;
  EXPECT_NEAR(axis.velocity(), exact, 0.005);
  axis.run(5);
  EXPECT_NEAR(axis.velocity(), 0, 1e-9) << "friction stops it";
}

TEST_P(AnyAxis, EffortIsAcceleration) {
  Axis axis(GetParam(), test::axis(Vector3::UnitZ(), MotorMode::kEffort));
  axis.world.joints().set_target_effort(axis.joint, -1.5);
  axis.run(0.5);
  EXPECT_NEAR(axis.velocity(), -1.5 * 0.5, 1e-9) << "v = F/m t";
  EXPECT_NEAR(axis.world.joints().motor_effort(axis.joint), -1.5, 1e-9);
  axis.world.joints().set_target_effort(axis.joint, 0);
  axis.run(0.5);
  EXPECT_NEAR(axis.velocity(), -1.5 * 0.5, 1e-9) << "without effort it moves freely";
  EXPECT_EQ(axis.world.joints().motor_effort(axis.joint), 0);
}

TEST_P(AnyAxis, EffortKeepsToTheForceLimitAndNotToTheVelocityLimit) {
  AxisDescription weak = test::axis(Vector3::UnitZ(), MotorMode::kEffort);
  weak.max_force = 2;
  weak.max_velocity = 0.1;
  Axis axis(GetParam(), weak);
  axis.world.joints().set_target_effort(axis.joint, 50);
  axis.run(0.5);
  EXPECT_NEAR(axis.velocity(), 2 * 0.5, 1e-9);
  EXPECT_NEAR(axis.world.joints().motor_effort(axis.joint), 2, 1e-9);
}

TEST_P(AnyAxis, EffortPushesAgainstAStop) {
  AxisDescription stopped = test::axis(Vector3::UnitZ(), MotorMode::kEffort);
  stopped.lower = -0.2;
  stopped.upper = 0.1;
  Axis axis(GetParam(), stopped);
  axis.world.joints().set_target_effort(axis.joint, 3);
  axis.run(3);
  EXPECT_NEAR(axis.position(), 0.1, 0.01);
  EXPECT_NEAR(axis.world.joints().motor_effort(axis.joint), 3, 1e-9) << "the stop holds it, not the motor";
}

TEST_P(AnyAxis, EffortActsBesideFrictionAndDamping) {
  AxisDescription both = test::axis(Vector3::UnitZ(), MotorMode::kEffort);
  both.friction = 0.5;
  both.damping = 0.4;
  Axis axis(GetParam(), both);
  axis.world.joints().set_target_effort(axis.joint, 2.5);
  axis.run(60);
  EXPECT_NEAR(axis.velocity(), (2.5 - 0.5) / 0.4, 1e-6) << "terminal velocity";
}

TEST_P(AnyAxis, ModesCanBeChangedWhileRunning) {
  Axis axis(GetParam(), test::axis(Vector3::UnitZ(), MotorMode::kVelocity));
  axis.world.joints().set_target_velocity(axis.joint, 1);
  axis.world.joints().set_target_effort(axis.joint, 2);
  axis.run(0.1);
  EXPECT_NEAR(axis.velocity(), 1, 1e-6);
  axis.world.joints().set_motor_mode(axis.joint, MotorMode::kEffort);
  axis.run(0.5);
  EXPECT_NEAR(axis.velocity(), 2, 1e-6);
  axis.world.joints().set_motor_mode(axis.joint, MotorMode::kVelocity);
  axis.run(0.1);
  EXPECT_NEAR(axis.velocity(), 1, 1e-6) << "the targets are kept";
}

TEST_P(AnyAxis, TargetEffortIsStateAndEndsWithAReset) {
  Axis axis(GetParam(), test::axis(Vector3::UnitZ(), MotorMode::kEffort));
  const std::uint64_t before = axis.world.state_hash();
  axis.world.joints().set_target_effort(axis.joint, 2);
  EXPECT_EQ(axis.world.joints().target_effort(axis.joint), 2);
  EXPECT_NE(axis.world.state_hash(), before);
  axis.world.reset();
  EXPECT_EQ(axis.world.joints().target_effort(axis.joint), 0);
  EXPECT_EQ(axis.world.state_hash(), before);
  EXPECT_THROW(axis.world.joints().set_target_effort(axis.joint, kNaN), InvalidInput);
  EXPECT_THROW(axis.world.joints().set_target_effort(axis.joint, kInfinity), InvalidInput);
  EXPECT_EQ(axis.world.state_hash(), before);
}

TEST_P(AnyAxis, MotorEffortIsKnownInTheFirstStep) {
  Axis axis(GetParam(), test::axis(Vector3::UnitZ(), MotorMode::kVelocity));
  EXPECT_EQ(axis.world.joints().motor_effort(axis.joint), 0) << "before the first step";
  axis.world.joints().set_target_velocity(axis.joint, 0.5);
  axis.run(0.05);
  EXPECT_NEAR(axis.world.joints().motor_effort(axis.joint), 0.5 / 0.05, 1e-5) << "the momentum divided by the time";
}

TEST_P(AnyAxis, MotorEffortOfAMotorWithoutForceIsZero) {
  AxisDescription limited = test::axis(Vector3::UnitZ(), MotorMode::kVelocity);
  limited.lower = -10;  // a motor joint of its own
  Axis axis(GetParam(), limited);
  axis.world.joints().set_target_velocity(axis.joint, 0.5);
  axis.run(0.05);
  EXPECT_GT(axis.world.joints().motor_effort(axis.joint), 1);
  axis.world.joints().set_max_force(axis.joint, 0);
  axis.run(0.05);
  EXPECT_EQ(axis.world.joints().motor_effort(axis.joint), 0) << "not what it exerted last";
}

TEST(Pendulum, SwingsWithThePeriodOfTheory) {
  constexpr double kLength = 0.5;
  constexpr double kFineStep = 0.001;
  ModelDescription pendulum = model("Pendulum", link("arm", {kLength, 0, 0}));
  pendulum.links[0].inertia_diagonal = Vector3(0.01, 0.01, 0.01);
  pendulum.joints.push_back(joint("revolute", {axis(Vector3::UnitY())}, {}, "world"));
  SceneDescription described = scene({pendulum}, Vector3(9.81, 0, 0));  // gravity along the arm
  World world(described, 0);
  const ObjectId id = world.tree().find("/joint");
  world.set_velocity(world.tree().find("/arm"), {{0, 0, -0.05 * kLength}, {0, 0.05, 0}});
  // Upward zero crossings, interpolated between steps.
  std::vector<double> passages;
  double before = 0;
  for (int i = 1; passages.size() < 11 && i < 40000; ++i) {
    world.advance(kFineStep, kFineStep);
    const double now = world.joints().position(id);
    if (before < 0 && now >= 0) passages.push_back((i - now / (now - before)) * kFineStep);
    before = now;
  }
  ASSERT_EQ(passages.size(), 11u);
  const double theory = 2 * M_PI * std::sqrt((0.01 + kLength * kLength) / (9.81 * kLength));
  EXPECT_NEAR((passages.back() - passages.front()) / 10, theory, theory * 1e-3);
}

}  // namespace
}  // namespace bubblesim::test::test_joint_motors
