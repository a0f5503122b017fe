// SPDX-License-Identifier: BSD-3-Clause
// Which models a logical camera sees, and where.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_logical_camera {
namespace {

/// The field of view is 90 degrees wide and half as high.
constexpr double kWide = M_PI / 2;

std::vector<SeenModel> seen(std::vector<ModelDescription> models, const Pose& camera = {}) {
  Simulation simulation(with_sensor("Camera", LogicalCameraDescription{1, 5, 2, kWide}, std::move(models), camera), 0);
  const ObjectId sensor = simulation.world().tree().find("/Camera");
  return simulation.measure(sensor)->measurement.get<LogicalCameraReading>().models;
}

std::vector<std::string> names_seen(const Vector3& place) {
  std::vector<std::string> names;
  for (const SeenModel& each : seen({model("Ball", link("link"), Pose(place, Quaternion::Identity()))})) {
    names.push_back(each.name);
  }
  return names;
}

TEST(LogicalCamera, SeesWhatIsInThePyramidBetweenNearAndFar) {
  const std::vector<std::string> ball = {"Ball"};
  EXPECT_EQ(names_seen({2, 1.9, 0}), ball);
  EXPECT_EQ(names_seen({2, -1.9, 0.9}), ball);
  EXPECT_TRUE(names_seen({2, 2.1, 0}).empty());
  EXPECT_TRUE(names_seen({2, 0, 1.1}).empty());
  EXPECT_TRUE(names_seen({0.9, 0, 0}).empty());
  EXPECT_TRUE(names_seen({5.1, 0, 0}).empty());
  EXPECT_TRUE(names_seen({-2, 0, 0}).empty());
}

TEST(LogicalCamera, MeasuresPosesInItsOwnFrame) {
  const Pose camera(1, 2, 3, 0, 0, M_PI / 2);
  const auto found = seen({model("Ball", link("link"), Pose(1, 5, 3, 0, 0, M_PI))}, camera);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR((found[0].position - Vector3(3, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(to_rpy(found[0].orientation).z(), M_PI / 2, 1e-12);
}

TEST(LogicalCamera, SeesHiddenModelsButNotItsOwn) {
  const auto found =
      seen({still(model("Wall", link_with(Box{{0.1, 5, 5}}), at(2, 0, 0))), model("Ball", link("link"), at(3, 0, 0))});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "Wall");
  EXPECT_EQ(found[1].name, "Ball");
}

}  // namespace
}  // namespace bubblesim::test::test_logical_camera
