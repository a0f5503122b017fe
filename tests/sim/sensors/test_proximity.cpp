// SPDX-License-Identifier: BSD-3-Clause
// The volumes of proximity sensors, probed with a small ball.
#include <gtest/gtest.h>

#include "bubblesim/simulation.hpp"
#include "scenes.hpp"

namespace bubblesim::test::test_proximity {
namespace {

constexpr double kExact = 1e-4;  // m
constexpr double kHalfAngle = 0.4;
constexpr double kReach = 2;
const double kEndRadius = kReach * std::tan(kHalfAngle);

ProximityReading reading(ProximityVolume volume, const Vector3& ball, double radius = 0.1) {
  ModelDescription eye = still(model("Eye", link("link")));
  SensorDescription sensor;
  sensor.name = "Sensor";
  SonarDescription kind{0.05, kReach, kHalfAngle};
  kind.volume = volume;
  sensor.kind = kind;
  eye.links[0].sensors.push_back(sensor);
  Simulation simulation(scene({eye, still(model("Ball", link_with(Sphere{radius}), Pose(ball, Quaternion())))}));
  return simulation.read_proximity(simulation.world().tree().find("/Sensor"));
}

bool sees(ProximityVolume volume, const Vector3& ball) { return reading(volume, ball).detected; }

/// One metre ahead, off the axis by an angle in a direction about it.
Vector3 aside(double angle, double turn) {
  return {1, std::tan(angle) * std::cos(turn), std::tan(angle) * std::sin(turn)};
}

class AnyVolume : public ::testing::TestWithParam<ProximityVolume> {};

TEST_P(AnyVolume, MeasuresWhatStandsStraightAhead) {
  const ProximityReading seen = reading(GetParam(), {1.5, 0, 0});
  ASSERT_TRUE(seen.detected);
  EXPECT_NEAR(seen.distance, 1.4, kExact);
  EXPECT_LT((seen.point - Vector3(1.4, 0, 0)).norm(), kExact);
  EXPECT_LT((seen.normal - Vector3(-1, 0, 0)).norm(), kExact);
}

TEST_P(AnyVolume, EndsAtItsMaximalRange) {
  EXPECT_TRUE(sees(GetParam(), {kReach + 0.09, 0, 0}));
  EXPECT_FALSE(sees(GetParam(), {kReach + 0.11, 0, 0}));
}

TEST_P(AnyVolume, SeesPastWhatIsNearerThanItsMinimalRange) {
  ModelDescription eye = still(model("Eye", link("link")));
  SensorDescription sensor;
  sensor.name = "Sensor";
  SonarDescription kind{0.05, kReach, kHalfAngle};
  kind.volume = GetParam();
  sensor.kind = kind;
  eye.links[0].sensors.push_back(sensor);
  const auto plate = [](const std::string& name, double x) {
    return still(model(name, link_with(Box{{0.01, 9, 9}}), at(x, 0, 0)));
  };
  Simulation simulation(scene({eye, plate("Close", 0.03), plate("Wall", 1.5)}));
  EXPECT_NEAR(simulation.read_proximity(simulation.world().tree().find("/Sensor")).distance, 1.495, kExact);
}

TEST_P(AnyVolume, LooksAheadOnly) {
  EXPECT_FALSE(sees(GetParam(), {-1, 0, 0}));
  EXPECT_FALSE(sees(GetParam(), {0, 1, 0}));
}

INSTANTIATE_TEST_SUITE_P(All, AnyVolume,
                         ::testing::Values(ProximityVolume::kRay, ProximityVolume::kCone, ProximityVolume::kPyramid,
                                           ProximityVolume::kDisc, ProximityVolume::kCylinder));

TEST(RayVolume, SeesOnlyWhatItsRayMeets) {
  EXPECT_TRUE(sees(ProximityVolume::kRay, {1, 0.09, 0}));
  EXPECT_FALSE(sees(ProximityVolume::kRay, {1, 0.11, 0}));
}

TEST(ConeVolume, IsRound) {
  for (int i = 0; i < 16; ++i) {
    EXPECT_TRUE(sees(ProximityVolume::kCone, aside(kHalfAngle, i * M_PI / 8))) << i;
    EXPECT_FALSE(sees(ProximityVolume::kCone, aside(kHalfAngle + 0.12, i * M_PI / 8))) << i;
  }
}

TEST(PyramidVolume, HasItsCornersToo) {
  const double edge = std::tan(kHalfAngle);
  EXPECT_TRUE(sees(ProximityVolume::kPyramid, {1, edge, edge}));
  EXPECT_TRUE(sees(ProximityVolume::kPyramid, {1, -edge, 0.3 * edge}));
  EXPECT_FALSE(sees(ProximityVolume::kPyramid, {1, edge + 0.12, 0}));
  EXPECT_FALSE(sees(ProximityVolume::kPyramid, {1, 0, -edge - 0.12}));
}

TEST(DiscVolume, IsFlat) {
  EXPECT_TRUE(sees(ProximityVolume::kDisc, aside(kHalfAngle, 0)));
  EXPECT_TRUE(sees(ProximityVolume::kDisc, aside(kHalfAngle, M_PI)));
  EXPECT_FALSE(sees(ProximityVolume::kDisc, aside(kHalfAngle + 0.12, 0)));
  EXPECT_FALSE(sees(ProximityVolume::kDisc, {1, 0.2, 0.11}));
}

TEST(CylinderVolume, IsAsWideAtItsBeginningAsAtItsEnd) {
  EXPECT_TRUE(sees(ProximityVolume::kCylinder, {0.3, kEndRadius, 0}));
  EXPECT_TRUE(sees(ProximityVolume::kCylinder, {1.8, 0, -kEndRadius}));
  EXPECT_FALSE(sees(ProximityVolume::kCylinder, {0.3, kEndRadius + 0.12, 0}));
  EXPECT_FALSE(sees(ProximityVolume::kCone, {0.3, kEndRadius, 0})) << "where a cone is narrow";
}

TEST(CylinderVolume, MeasuresAlongItsAxis) {
  const ProximityReading seen = reading(ProximityVolume::kCylinder, {1, kEndRadius, 0});
  EXPECT_NEAR(seen.distance, 0.9, kExact);
  EXPECT_LT((seen.point - Vector3(0.9, kEndRadius, 0)).norm(), kExact);
}

}  // namespace
}  // namespace bubblesim::test::test_proximity
