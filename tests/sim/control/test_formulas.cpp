// SPDX-License-Identifier: BSD-3-Clause
// Splines, limits, odometry and PID against their formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "bubblesim/control/joint_spline.hpp"
#include "bubblesim/control/pid.hpp"
#include "bubblesim/control/speed_limiter.hpp"
#include "bubblesim/control/wheel_odometry.hpp"

namespace bubblesim::test::test_control_formulas {
namespace {

using control::JointKnot;
using control::JointSegment;
using control::JointState;
using control::Pid;
using control::SpeedLimits;
using control::WheelOdometry;

constexpr double kPi = 3.14159265358979323846;

TEST(JointSegment, WithoutVelocitiesIsALine) {
  const JointSegment segment({1, 2}, {3, 6});
  EXPECT_DOUBLE_EQ(segment.at(1.5).position, 3);
  EXPECT_DOUBLE_EQ(segment.at(1.5).velocity, 2);
  EXPECT_DOUBLE_EQ(segment.at(1.5).acceleration, 0);
}

TEST(JointSegment, WithVelocitiesIsTheCubicThroughThem) {
  // x = t^3 - 2 t^2 + t has x(0) = 0, x'(0) = 1, x(2) = 2, x'(2) = 5.
  const JointSegment segment({0, 0, 1.0}, {2, 2, 5.0});
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    EXPECT_NEAR(segment.at(t).position, t * t * t - 2 * t * t + t, 1e-12);
    EXPECT_NEAR(segment.at(t).velocity, 3 * t * t - 4 * t + 1, 1e-12);
    EXPECT_NEAR(segment.at(t).acceleration, 6 * t - 4, 1e-12);
  }
}

TEST(JointSegment, WithAccelerationsIsTheQuinticThroughThem) {
  // x = t^5 - t^3 has x(1) = 0, x'(1) = 2, x''(1) = 14 and x(2) = 24, x'(2) = 68, x''(2) = 148.
  const JointSegment segment({1, 0, 2.0, 14.0}, {2, 24, 68.0, 148.0});
  for (const double t : {1.0, 1.25, 1.5, 1.9, 2.0}) {
    EXPECT_NEAR(segment.at(t).position, std::pow(t, 5) - std::pow(t, 3), 1e-9);
    EXPECT_NEAR(segment.at(t).velocity, 5 * std::pow(t, 4) - 3 * t * t, 1e-9);
    EXPECT_NEAR(segment.at(t).acceleration, 20 * std::pow(t, 3) - 6 * t, 1e-8);
  }
}

TEST(JointSegment, RestsOutsideItsTime) {
  const JointSegment segment({1, 2, 0.0}, {3, 6, 1.0});
  EXPECT_DOUBLE_EQ(segment.at(0).position, 2);
  EXPECT_DOUBLE_EQ(segment.at(0).velocity, 0);
  EXPECT_DOUBLE_EQ(segment.at(9).position, 6);
  EXPECT_DOUBLE_EQ(segment.at(9).velocity, 0);
}

TEST(JointSegment, OfNoDurationIsItsEnd) {
  const JointSegment segment({1, 2}, {1, 6});
  EXPECT_DOUBLE_EQ(segment.at(1).position, 6);
  EXPECT_DOUBLE_EQ(segment.at(1).velocity, 0);
}

TEST(SpeedLimits, WithoutLimitsPassOn) { EXPECT_DOUBLE_EQ((SpeedLimits{}.limit(-7, 1, 2, 0.1)), -7); }

TEST(SpeedLimits, LimitTheVelocity) {
  SpeedLimits limits;
  limits.velocity = {-0.5, 1};
  EXPECT_DOUBLE_EQ(limits.limit(3, 0, 0, 0.1), 1);
  EXPECT_DOUBLE_EQ(limits.limit(-3, 0, 0, 0.1), -0.5);
}

TEST(SpeedLimits, LimitTheChangeOfTheVelocity) {
  SpeedLimits limits;
  limits.acceleration = {-4, 2};
  EXPECT_DOUBLE_EQ(limits.limit(3, 1, 1, 0.1), 1.2);
  EXPECT_DOUBLE_EQ(limits.limit(-3, 1, 1, 0.1), 0.6);
  EXPECT_DOUBLE_EQ(limits.limit(1.1, 1, 1, 0.1), 1.1);
}

TEST(SpeedLimits, LimitTheChangeOfTheAcceleration) {
  SpeedLimits limits;
  limits.jerk = {-5, 5};
  // The last change was 0.1; it may change by 2 * 5 * 0.1^2 = 0.1.
  EXPECT_DOUBLE_EQ(limits.limit(3, 1, 0.9, 0.1), 1.2);
  EXPECT_DOUBLE_EQ(limits.limit(-3, 1, 0.9, 0.1), 1.0);
}

TEST(WheelOdometry, FollowsALine) {
  WheelOdometry odometry(10);
  odometry.move({0.5, 0, 0}, 0.25);
  EXPECT_DOUBLE_EQ(odometry.x(), 0.5);
  EXPECT_DOUBLE_EQ(odometry.y(), 0);
  EXPECT_DOUBLE_EQ(odometry.velocity().forward, 2);
}

TEST(WheelOdometry, FollowsAnArcExactly) {
  WheelOdometry odometry(10);
  for (int i = 0; i < 4; ++i) odometry.move({3 * kPi / 8, 0, kPi / 8}, 0.1);  // a quarter of a circle of 3 m
  EXPECT_NEAR(odometry.x(), 3, 1e-12);
  EXPECT_NEAR(odometry.y(), 3, 1e-12);
  EXPECT_NEAR(odometry.heading(), kPi / 2, 1e-12);
}

TEST(WheelOdometry, FollowsAnArcSidewaysExactly) {
  WheelOdometry odometry(10);
  for (int i = 0; i < 4; ++i) odometry.move({0, 3 * kPi / 8, kPi / 8}, 0.1);  // its left side leads along the arc
  EXPECT_NEAR(odometry.x(), -3, 1e-12);
  EXPECT_NEAR(odometry.y(), 3, 1e-12);
  EXPECT_NEAR(odometry.heading(), kPi / 2, 1e-12);
}

TEST(WheelOdometry, AveragesVelocitiesOverItsWindow) {
  WheelOdometry odometry(2);
  odometry.move({1, 0, 0}, 0.1);
  odometry.move({0.1, 0.2, 0.01}, 0.1);
  odometry.move({0.3, 0.4, 0.03}, 0.1);
  EXPECT_NEAR(odometry.velocity().forward, 2, 1e-12);
  EXPECT_NEAR(odometry.velocity().left, 3, 1e-12);
  EXPECT_NEAR(odometry.velocity().turn, 0.2, 1e-12);
}

TEST(Pid, SumsItsThreeParts) {
  Pid pid({2, 3, 5, 100, -100, false});
  EXPECT_DOUBLE_EQ(pid.command(0.5, 0.25, 0.1), 2 * 0.5 + 3 * 0.05 + 5 * 0.25);
  EXPECT_DOUBLE_EQ(pid.command(1, 0, 0.1), 2 * 1 + 3 * 0.15);
}

TEST(Pid, LimitsThePartOfTheIntegral) {
  Pid pid({0, 1, 0, 0.2, -0.1, false});
  EXPECT_DOUBLE_EQ(pid.command(5, 0, 0.1), 0.2);
  EXPECT_DOUBLE_EQ(pid.command(-6, 0, 0.1), -0.1) << "the integral itself has gone on: 0.5 - 0.6";
  Pid limited({0, 1, 0, 0.2, -0.1, true});
  EXPECT_DOUBLE_EQ(limited.command(5, 0, 0.1), 0.2);
  EXPECT_DOUBLE_EQ(limited.command(-1, 0, 0.1), 0.1) << "the integral was limited: 0.2 - 0.1";
}

TEST(Pid, DerivesTheErrorItself) {
  Pid pid({0, 0, 2, 0, 0, false});
  EXPECT_DOUBLE_EQ(pid.command(0.5, 0.1), 10);
  EXPECT_DOUBLE_EQ(pid.command(0.7, 0.1), 4);
}

TEST(Pid, IgnoresWhatIsNoNumber) {
  Pid pid({2, 1, 1, 1, -1, false});
  EXPECT_EQ(pid.command(std::nan(""), 0, 0.1), 0);
  EXPECT_EQ(pid.command(1, 0, 0), 0);
  EXPECT_DOUBLE_EQ(pid.command(0, 0, 0.1), 0) << "the integral was not changed";
}

}  // namespace
}  // namespace bubblesim::test::test_control_formulas
