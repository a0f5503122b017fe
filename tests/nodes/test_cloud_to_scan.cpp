// SPDX-License-Identifier: BSD-3-Clause
// A cloud seen from above, beside the same written as plainly as can be, and the scan's own rules.
#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "cloud_to_scan.hpp"

namespace bubblesim {
namespace {

using Point = std::array<float, 3>;

constexpr double kPi = 3.141592653589793;
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

sensor_msgs::PointCloud2 cloud_of(const std::vector<Point>& points) {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> place(cloud, "x");
  for (const Point& point : points) {
    std::copy(point.begin(), point.end(), &place[0]);
    ++place;
  }
  return cloud;
}

ScanShape degrees(double from, double to, double step) {
  ScanShape shape;
  shape.angle_min = from * kPi / 180.0;
  shape.angle_max = to * kPi / 180.0;
  shape.angle_increment = step * kPi / 180.0;
  return shape;
}

std::vector<float> ranges(const std::vector<Point>& points, const ScanShape& shape, const HeightBand& heights = {}) {
  return cloud_to_scan(cloud_of(points), tf2::Transform::getIdentity(), heights, shape).ranges;
}

/// For each ray, all points: the nearest of those that lie within half a ray of it.
std::vector<float> reference(const std::vector<Point>& points, const tf2::Transform& place, const HeightBand& heights,
                             const ScanShape& shape, std::size_t count) {
  std::vector<float> nearest(count, kInf);
  for (std::size_t ray = 0; ray < count; ++ray) {
    const double direction = shape.angle_min + static_cast<double>(ray) * shape.angle_increment;
    for (const auto& [x, y, z] : points) {
      const tf2::Vector3 seen = place * tf2::Vector3(x, y, z);
      const double range = std::hypot(seen.x(), seen.y());
      const double off = std::remainder(std::atan2(seen.y(), seen.x()) - direction, 2.0 * kPi);
      if (std::abs(off) <= shape.angle_increment / 2.0 && range >= shape.range_min && range <= shape.range_max &&
          seen.z() >= heights.min && seen.z() <= heights.max)
        nearest[ray] = std::min(nearest[ray], static_cast<float>(range));
    }
  }
  return nearest;
}

TEST(CloudToScan, EqualsThePlainReferenceForAnyCloudAndPlace) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> metres(-6.0F, 6.0F);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  for (int round = 0; round < 20; ++round) {
    std::vector<Point> points(500);
    for (Point& point : points) point = {metres(random), metres(random), metres(random)};
    tf2::Quaternion turn;
    turn.setRPY(0.2 * angle(random), 0.2 * angle(random), angle(random));
    const tf2::Transform place(turn, tf2::Vector3(0.3, -0.2, 0.5));
    ScanShape shape = degrees(-180.0, 180.0, 2.0);
    shape.range_min = 0.5;
    shape.range_max = 5.0;
    const HeightBand heights{-1.0, 2.0};
    const auto scan = cloud_to_scan(cloud_of(points), place, heights, shape);
    ASSERT_EQ(scan.ranges.size(), 180U);
    const auto expected = reference(points, place, heights, shape, scan.ranges.size());
    for (std::size_t ray = 0; ray < expected.size(); ++ray) EXPECT_EQ(scan.ranges[ray], expected[ray]) << ray;
  }
}

TEST(CloudToScan, CountsAPointForTheRayThatIsNearest) {
  const ScanShape quarter = degrees(0.0, 90.0, 30.0);  // rays at 0, 30 and 60 degrees
  const auto at = [](double angle) {
    return Point{static_cast<float>(2.0 * std::cos(angle * kPi / 180.0)),
                 static_cast<float>(2.0 * std::sin(angle * kPi / 180.0)), 0.0F};
  };
  EXPECT_EQ(ranges({at(14.0)}, quarter), (std::vector<float>{2.0F, kInf, kInf}));
  EXPECT_EQ(ranges({at(16.0)}, quarter), (std::vector<float>{kInf, 2.0F, kInf}));
  EXPECT_EQ(ranges({at(74.0)}, quarter), (std::vector<float>{kInf, kInf, 2.0F}));
  EXPECT_EQ(ranges({at(80.0)}, quarter), (std::vector<float>{kInf, kInf, kInf}));
}

TEST(CloudToScan, AFullTurnHasNoSeam) {
  const auto scan = ranges({{-3.0F, 0.01F, 0.0F}}, degrees(-180.0, 180.0, 1.0));
  EXPECT_NEAR(scan.front(), 3.0F, 1e-4);
  EXPECT_EQ(scan.back(), kInf);
}

TEST(CloudToScan, AFanMayStartAtZeroAndGoAllTheWayRound) {
  const auto scan = ranges({{0.0F, -2.0F, 0.0F}}, degrees(0.0, 360.0, 90.0));
  EXPECT_EQ(scan, (std::vector<float>{kInf, kInf, kInf, 2.0F}));
}

TEST(CloudToScan, KeepsTheNearestOfARay) {
  EXPECT_EQ(ranges({{3.0F, 0, 0}, {1.0F, 0, 0}, {2.0F, 0, 0}}, degrees(0, 10, 20)).front(), 1.0F);
}

TEST(CloudToScan, LeavesOutWhatIsNoPoint) {
  EXPECT_EQ(ranges({{kNan, 0, 0}, {1, kNan, 0}, {1, 0, kNan}, {kInf, 0, 0}, {1, -kInf, 0}}, degrees(0, 10, 20)),
            std::vector<float>{kInf});
}

TEST(CloudToScan, MeasuresTheFarEndInsteadOfInfinityWhenAsked) {
  ScanShape shape = degrees(0, 10, 20);
  shape.range_max = 8.0;
  shape.use_inf = false;
  shape.inf_epsilon = 0.5;
  EXPECT_EQ(ranges({}, shape), std::vector<float>{8.5F});
}

TEST(CloudToScan, TheMessageHasItsShape) {
  ScanShape shape = degrees(-90, 90, 1);
  shape.scan_time = 0.1;
  shape.range_min = 0.2;
  const auto scan = cloud_to_scan(cloud_of({}), tf2::Transform::getIdentity(), {}, shape);
  EXPECT_FLOAT_EQ(scan.angle_min, -kPi / 2);
  EXPECT_FLOAT_EQ(scan.angle_max, kPi / 2);
  EXPECT_FLOAT_EQ(scan.angle_increment, kPi / 180);
  EXPECT_FLOAT_EQ(scan.scan_time, 0.1F);
  EXPECT_FLOAT_EQ(scan.range_min, 0.2F);
  EXPECT_TRUE(std::isfinite(scan.range_max));
  EXPECT_EQ(scan.ranges.size(), 180U);
}

TEST(CloudToScan, ReadsPointsWithMoreFieldsAndPaddedRows) {
  auto cloud = cloud_of({{1, 0, 0}, {4, 0, 0}, {2, 0, 0}, {4, 0, 0}});
  cloud.width = 1;  // the second point of each row is padding
  cloud.height = 2;
  cloud.row_step = 2 * cloud.point_step;
  const auto scan = cloud_to_scan(cloud, tf2::Transform::getIdentity(), {}, degrees(0, 10, 20));
  EXPECT_EQ(scan.ranges.front(), 1.0F);
}

TEST(CloudToScan, RefusesCloudsThatItCannotRead) {
  const auto refused = [](const sensor_msgs::PointCloud2& cloud) {
    EXPECT_THROW(cloud_to_scan(cloud, tf2::Transform::getIdentity(), {}, {}), std::invalid_argument);
  };
  const auto good = cloud_of({{1, 0, 0}});
  auto cloud = good;
  cloud.fields.pop_back();
  refused(cloud);
  cloud = good;
  cloud.fields[0].datatype = sensor_msgs::PointField::FLOAT64;
  refused(cloud);
  cloud = good;
  cloud.fields[2].offset = cloud.point_step;
  refused(cloud);
  cloud = good;
  cloud.width = 1000;
  refused(cloud);
  cloud = good;
  cloud.height = 4'000'000'000U;
  refused(cloud);
  cloud = good;
  cloud.is_bigendian = 1;
  refused(cloud);
}

TEST(ScanShape, StatesWhatNoFanCanBe) {
  const auto refused = [](auto change) {
    ScanShape shape;
    change(shape);
    EXPECT_THROW(check(shape), std::invalid_argument);
  };
  check(ScanShape{});
  refused([](ScanShape& shape) { shape.angle_increment = 0.0; });
  refused([](ScanShape& shape) { shape.angle_increment = 1e-9; });
  refused([](ScanShape& shape) { shape.angle_max = shape.angle_min; });
  refused([](ScanShape& shape) { shape.angle_max = 10.0; });
  refused([](ScanShape& shape) { shape.angle_min = std::nan(""); });
  refused([](ScanShape& shape) { shape.range_min = -1.0; });
  refused([](ScanShape& shape) { shape.range_max = shape.range_min; });
  refused([](ScanShape& shape) { shape.scan_time = -1.0; });
  refused([](ScanShape& shape) { shape.inf_epsilon = -1.0; });
}

}  // namespace
}  // namespace bubblesim
