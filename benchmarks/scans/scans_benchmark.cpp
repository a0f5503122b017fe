// SPDX-License-Identifier: BSD-3-Clause
// Measures the conversion of a cloud of 11,520 points (16 rings of 720) to a scan of 720 rays, with a transform. Prints
// the median and the 99th percentile in microseconds.
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "cloud_to_scan.hpp"

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRounds = 2000;
constexpr int kRings = 16;
constexpr int kRays = 720;
constexpr double kTurn = 2.0 * 3.141592653589793;

/// The cloud of a lidar with several rings in the centre of a cylinder.
sensor_msgs::PointCloud2 make_cloud() {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(kRings * kRays);
  sensor_msgs::PointCloud2Iterator<float> place(cloud, "x");
  for (int ring = 0; ring < kRings; ++ring) {
    for (int ray = 0; ray < kRays; ++ray, ++place) {
      const double angle = kTurn * ray / kRays;
      place[0] = static_cast<float>(4.0 * std::cos(angle));
      place[1] = static_cast<float>(4.0 * std::sin(angle));
      place[2] = static_cast<float>(4.0 * std::tan(0.03 * (ring - 8)));
    }
  }
  return cloud;
}

}  // namespace

int main() {
  const sensor_msgs::PointCloud2 cloud = make_cloud();
  const tf2::Transform place(tf2::Quaternion(tf2::Vector3(0, 0, 1), 0.3), tf2::Vector3(0.1, 0.0, 0.4));
  bubblesim::ScanShape shape;
  shape.angle_increment = kTurn / kRays;
  std::vector<double> times;
  float sum = 0.0F;  // use the result, so that the compiler does not remove the computation
  for (int round = 0; round < kRounds; ++round) {
    const auto begin = Clock::now();
    const auto scan = bubblesim::cloud_to_scan(cloud, place, {-1.0, 1.0}, shape);
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    sum += scan.ranges[round % kRays];
  }
  std::sort(times.begin(), times.end());
  std::printf("%d points: median %.0f us, 99th percentile %.0f us (sum %g)\n", kRings * kRays, times[kRounds / 2],
              times[kRounds * 99 / 100], sum);
}
