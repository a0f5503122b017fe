// SPDX-License-Identifier: BSD-3-Clause
// Mapping a room where every range follows from geometry: how far poses and walls are from the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "scan_mapper.hpp"

namespace bubblesim {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kInf = std::numeric_limits<double>::infinity();

/// An upright rectangle: the room, or a thing in it.
struct Rectangle {
  double left, bottom, right, top;

  /// m from a point to the nearest side, along a direction.
  [[nodiscard]] double along(double x, double y, double dx, double dy) const {
    double nearest = kInf;
    const auto meet = [&](double distance, double across, double from, double to) {
      if (distance > 0.0 && across >= from && across <= to) nearest = std::min(nearest, distance);
    };
    for (const double side : {left, right}) {
      const double distance = (side - x) / dx;
      meet(distance, y + distance * dy, bottom, top);
    }
    for (const double side : {bottom, top}) {
      const double distance = (side - y) / dy;
      meet(distance, x + distance * dx, left, right);
    }
    return nearest;
  }

  /// m from a point to the nearest side.
  [[nodiscard]] double off(double x, double y) const {
    const double dx = std::max({left - x, x - right, 0.0});
    const double dy = std::max({bottom - y, y - top, 0.0});
    const double within = std::min({x - left, right - x, y - bottom, top - y});
    return within > 0.0 ? within : std::hypot(dx, dy);
  }
};

const std::array<Rectangle, 4> kRoom{{{-1.5, -3, 6.5, 3}, {1, -1.4, 3, -0.5}, {4.5, 1.5, 6.5, 3}, {-1.5, 2, -0.5, 3}}};

PlanarPose ahead(const PlanarPose& pose, double distance, double turn) {
  const double middle = pose.heading + turn / 2;
  return {pose.x + distance * std::cos(middle), pose.y + distance * std::sin(middle), pose.heading + turn};
}

/// What a lidar sees that sits on the base in a pose: `mount` in the base's frame.
sensor_msgs::LaserScan look(const PlanarPose& base, const LidarMount& mount, double stamp, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 0.01);
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(stamp);
  scan.angle_min = -2.0;  // not symmetric: as lidars may be
  scan.angle_increment = static_cast<float>(kPi / 180.0);
  scan.range_min = 0.1;
  scan.range_max = 5.0;
  const double cosine = std::cos(base.heading);
  const double sine = std::sin(base.heading);
  const double x = base.x + cosine * mount.pose.x - sine * mount.pose.y;
  const double y = base.y + sine * mount.pose.x + cosine * mount.pose.y;
  for (int ray = 0; ray < 300; ++ray) {
    const double turn = scan.angle_min + ray * scan.angle_increment;
    const double angle = base.heading + mount.pose.heading + (mount.upside_down ? -turn : turn);
    double range = kInf;
    for (const Rectangle& thing : kRoom) range = std::min(range, thing.along(x, y, std::cos(angle), std::sin(angle)));
    range += noise(random);
    scan.ranges.push_back(static_cast<float>(range < scan.range_max ? range : kInf));
  }
  scan.angle_max = scan.angle_min + 299 * scan.angle_increment;
  return scan;
}

struct Outcome {
  std::vector<double> errors;  // m, of the pose at each scan
  nav_msgs::OccupancyGrid map;
};

/// Drives round the table in the room, twice, with odometry that is 5 % off in distance and in angle.
Outcome drive(const LidarMount& mount) {
  std::mt19937 random(7);
  std::normal_distribution<double> slip(0.0, 0.05);
  ScanMapper mapper(ScanMapperOptions{});
  Outcome outcome;
  PlanarPose truth;
  PlanarPose odometry;
  double stamp = 1.0;
  const auto move = [&](double distance, double turn) {
    stamp += 0.1;
    truth = ahead(truth, distance, turn);
    odometry = ahead(odometry, distance * (1.05 + slip(random)), turn * (1.05 + slip(random)));
    const PlanarPose pose = mapper.add(look(truth, mount, stamp, random), mount, odometry);
    outcome.errors.push_back(std::hypot(pose.x - truth.x, pose.y - truth.y));
  };
  mapper.add(look(truth, mount, stamp, random), mount, odometry);
  for (int side = 0; side < 8; ++side) {
    const int steps = side % 2 == 0 ? 100 : 48;
    for (int step = 0; step < steps; ++step) move(0.04, 0.0);
    for (int step = 0; step < 20; ++step) move(0.0, -kPi / 40);
  }
  EXPECT_LT(std::hypot(truth.x, truth.y), 0.01);  // it is back where it began
  outcome.map = mapper.map();
  return outcome;
}

double mean_distance_of_walls(const nav_msgs::OccupancyGrid& map) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t cell = 0; cell < map.data.size(); ++cell) {
    if (map.data[cell] < 65) continue;
    const double x = map.info.origin.position.x + (cell % map.info.width + 0.5) * map.info.resolution;
    const double y = map.info.origin.position.y + (cell / map.info.width + 0.5) * map.info.resolution;
    double nearest = kInf;
    for (const Rectangle& thing : kRoom) nearest = std::min(nearest, thing.off(x, y));
    sum += nearest;
    ++count;
  }
  EXPECT_GT(count, 400);  // 28 m of outer walls alone have more than 560
  return sum / count;
}

class Mounts : public testing::TestWithParam<LidarMount> {};

TEST_P(Mounts, PosesAndWallsAreWhereTheyAre) {
  const Outcome outcome = drive(GetParam());
  double sum = 0.0;
  for (const double error : outcome.errors) sum += error;
  const double worst = *std::max_element(outcome.errors.begin(), outcome.errors.end());
  const double mean = sum / static_cast<double>(outcome.errors.size());
  const double walls = mean_distance_of_walls(outcome.map);
  RecordProperty("figures", std::to_string(mean) + " " + std::to_string(worst) + " " + std::to_string(walls));
  std::printf("pose: mean %.4f m, worst %.4f m; walls %.4f m\n", mean, worst, walls);
  EXPECT_LE(mean, 0.03);
  EXPECT_LE(worst, 0.1);
  EXPECT_LE(walls, 0.05);
}

INSTANTIATE_TEST_SUITE_P(ScanMapper, Mounts,
                         testing::Values(LidarMount{}, LidarMount{{0.2, 0.1, 0.5}, false},
                                         LidarMount{{0.2, 0.0, -0.3}, true}));

}  // namespace
}  // namespace bubblesim
