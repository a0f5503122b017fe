// SPDX-License-Identifier: BSD-3-Clause
// A model that moves in the plane at a velocity along its own axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bubblesim/error.hpp"
#include "bubblesim/planar_drive.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_planar_drive {
namespace {

constexpr double kStep = 0.005;

class Planar : public ::testing::Test {
 protected:
  World world{scene({model("Robot", link("link"), Pose(1, 2, 0, 0, 0, M_PI / 2))}, Vector3::Zero()), 0};
  ObjectId robot = world.tree().find("/Robot");
  std::shared_ptr<PlanarDrive> drive = [this] {
    auto added = std::make_shared<PlanarDrive>(robot);
    world.devices().add(added, robot);
    return added;
  }();
};

TEST_F(Planar, MovesAlongTheAxesOfTheModel) {
  drive->set_velocity(0.5, 0.2, 0);
  world.advance(0.1, kStep);  // its force is limited
  const Vector3 before = world.pose(robot).position;
  world.advance(2, kStep);
  EXPECT_NEAR(world.pose(robot).position.x(), before.x() - 0.4, 1e-6);
  EXPECT_NEAR(world.pose(robot).position.y(), before.y() + 1, 1e-6);
}

TEST_F(Planar, ConstantVelocityIsACircle) {
  drive->set_velocity(0.5, 0, 1);
  world.advance(0.2, kStep);
  const Pose before = world.pose(robot);
  const Vector3 centre = before * Vector3(0, 0.5, 0);  // to the left, v / w away
  double farthest = 0;
  for (int i = 0; i < 120; ++i) {
    world.advance(0.05, kStep);
    farthest = std::max(farthest, std::abs((world.pose(robot).position - centre).norm() - 0.5));
  }
  EXPECT_LT(farthest, 1e-4);
  EXPECT_NEAR(std::remainder(to_rpy(world.pose(robot).orientation).z() - to_rpy(before.orientation).z() - 6, 2 * M_PI),
              0, 1e-4);
}

TEST_F(Planar, DoesNothingWithoutACommand) {
  world.set_velocity(robot, {{1, 0, 0}, {}});
  world.advance(1, kStep);
  EXPECT_NEAR(world.velocity(robot).linear.x(), 1, 1e-9);
}

TEST_F(Planar, StandsStillAfterAReset) {
  drive->set_velocity(0.5, 0, 1);
  world.advance(1, kStep);
  world.reset();
  world.advance(1, kStep);
  EXPECT_NEAR((world.pose(robot).position - Vector3(1, 2, 0)).norm(), 0, 1e-9);
}

TEST_F(Planar, InvalidVelocitiesAreRefused) {
  EXPECT_THROW(drive->set_velocity(kNaN, 0, 0), InvalidInput);
  EXPECT_THROW(drive->set_velocity(0, kInfinity, 0), InvalidInput);
  EXPECT_THROW(drive->set_velocity(0, 0, 1e7), InvalidInput);
  EXPECT_THROW(drive->set_velocity(1e6, 1e6, 0), InvalidInput);
}

}  // namespace
}  // namespace bubblesim::test::test_planar_drive
