// SPDX-License-Identifier: BSD-3-Clause
// Rotations and poses, against the definitions of REP 103 and SDFormat.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bubblesim/math.hpp"
#include "near.hpp"

namespace bubblesim::test::test_math {
namespace {

constexpr double kExact = 1e-14;

Matrix3 about(int axis, double angle) { return Eigen::AngleAxisd(angle, Vector3::Unit(axis)).toRotationMatrix(); }

TEST(Math, ValuesStartAsZeroAndIdentity) {
  const Pose pose;
  EXPECT_EQ(pose.position, Vector3(0, 0, 0));
  EXPECT_EQ(pose.orientation.coeffs(), Eigen::Vector4d(0, 0, 0, 1));
  EXPECT_EQ(Twist{}.linear, Vector3(0, 0, 0));
}

TEST(Math, AnglesTurnAboutFixedAxesInTheOrderRollPitchYaw) {
  const Quaternion turn = from_rpy(0.3, -0.7, 2.1);
  EXPECT_TRUE(turn.toRotationMatrix().isApprox(about(2, 2.1) * about(1, -0.7) * about(0, 0.3), kExact));
  expect_near(from_rpy(M_PI / 2, 0, 0) * Vector3::UnitY(), Vector3::UnitZ(), kExact);
  expect_near(from_rpy(0, M_PI / 2, 0) * Vector3::UnitZ(), Vector3::UnitX(), kExact);
  expect_near(from_rpy(0, 0, M_PI / 2) * Vector3::UnitX(), Vector3::UnitY(), kExact);
  // y, to z by the roll, then to x by the pitch, then to y by the yaw.
  expect_near(from_rpy(M_PI / 2, M_PI / 2, M_PI / 2) * Vector3::UnitY(), Vector3::UnitY(), kExact);
}

TEST(Math, AnglesAreFoundAgain) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 rpy(angle(random), angle(random) / 2, angle(random));
    const Quaternion turn = from_rpy(rpy.x(), rpy.y(), rpy.z());
    const Quaternion same(-turn.w(), -turn.x(), -turn.y(), -turn.z());
    const double tolerance = 1e-15 / std::cos(rpy.y()) + kExact;
    expect_near(to_rpy(turn), rpy, tolerance);
    expect_near(to_rpy(same), rpy, tolerance);
  }
}

TEST(Math, AnglesAboutOneAxisLeaveTheOthersZero) {
  for (const double angle : {-3.0, -1.5, -1e-9, 1e-9, 0.4, 1.5, 3.0}) {
    const Vector3 roll = to_rpy(from_rpy(angle, 0, 0));
    EXPECT_DOUBLE_EQ(roll.x(), angle);
    EXPECT_EQ(roll.y(), 0);
    EXPECT_EQ(roll.z(), 0);
    const Vector3 yaw = to_rpy(from_rpy(0, 0, angle));
    EXPECT_EQ(yaw.x(), 0);
    EXPECT_EQ(yaw.y(), 0);
    EXPECT_DOUBLE_EQ(yaw.z(), angle);
  }
}

TEST(Math, RollIsZeroAtThePoles) {
  for (const double roll : {-2.0, 0.0, 0.5, 3.0}) {
    for (const double yaw : {-2.5, 0.0, 1.0, 3.1}) {
      expect_near(to_rpy(from_rpy(roll, M_PI / 2, yaw)), {0, M_PI / 2, std::remainder(yaw - roll, 2 * M_PI)}, kExact);
      expect_near(to_rpy(from_rpy(roll, -M_PI / 2, yaw)), {0, -M_PI / 2, std::remainder(yaw + roll, 2 * M_PI)}, kExact);
    }
  }
}

TEST(Math, AnglesNearThePolesGiveTheSameRotation) {
  for (double distance = 1; distance > 1e-18; distance /= 10) {
    for (const double pitch : {M_PI / 2 - distance, distance - M_PI / 2}) {
      const Quaternion turn = from_rpy(0.7, pitch, -1.9);
      const Vector3 rpy = to_rpy(turn);
      expect_near(from_rpy(rpy.x(), rpy.y(), rpy.z()), turn, 1e-11);
      EXPECT_NEAR(rpy.y(), pitch, kExact);
    }
  }
}

TEST(Math, TheShortestTurnFromZ) {
  expect_near(turn_from_z({0, 0, 3}), {}, kExact);
  expect_near(turn_from_z({2, 0, 0}), from_rpy(0, M_PI / 2, 0), kExact);
  expect_near(turn_from_z({0, 0, -1}), from_rpy(M_PI, 0, 0), kExact);
  for (const double tilt : {3.0, 3.14, M_PI - 1e-5, M_PI - 1e-7}) {
    const Vector3 direction(std::sin(tilt), 0, std::cos(tilt));
    const Quaternion turn = turn_from_z(direction);
    EXPECT_NEAR(turn.norm(), 1, kExact);
    expect_near(turn * Vector3::UnitZ(), direction, 1e-6);
  }
}

TEST(Math, PosesComposeFromTheOuterFrameToTheInner) {
  const Pose a(1, 2, 3, 0.1, -0.4, 2);
  const Pose b(-2, 0.5, 1, 1, 0.2, -3);
  const Vector3 point(0.3, -0.2, 0.9);
  expect_near((a * b) * point, a * (b * point), kExact);
  expect_near(Pose(1, 0, 0, 0, 0, M_PI / 2) * Vector3(1, 0, 0), {1, 1, 0}, kExact);
  const Pose turned = Pose(1, 0, 0, 0, 0, M_PI / 2) * Pose(1, 0, 0, 0, 0, M_PI / 2);
  expect_near(turned.position, {1, 1, 0}, kExact);
  expect_near(to_rpy(turned.orientation), {0, 0, M_PI}, kExact);
}

TEST(Math, InversesUndoPoses) {
  const Pose pose(1, -2, 3, 0.1, -0.4, 2);
  const Vector3 point(0.3, -0.2, 0.9);
  expect_near(pose.inverse() * (pose * point), point, kExact);
  expect_near((pose * pose.inverse()).position, {}, kExact);
  expect_near((pose * pose.inverse()).orientation, {}, kExact);
  const Pose other(0, 1, 0, 0.3, 0, 1);
  expect_near((pose * other).inverse() * point, other.inverse() * (pose.inverse() * point), kExact);
}

}  // namespace
}  // namespace bubblesim::test::test_math
