// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <cstddef>

namespace bubblesim {

/// The rays of a LaserScan made from other data, and its limits. Angles in rad, lengths in m.
struct ScanShape {
  double angle_min = -3.141592653589793;
  double angle_max = 3.141592653589793;
  double angle_increment = 3.141592653589793 / 180.0;
  double scan_time = 1.0 / 30.0;  ///< s between scans, as in the message
  double range_min = 0.0;
  double range_max = 1.7976931348623157e308;
  bool use_inf = true;       ///< a ray without a hit is +inf (REP 117), otherwise range_max + inf_epsilon
  double inf_epsilon = 1.0;  ///< m
};

/// Throws std::invalid_argument that names the invalid parameter.
void check(const ScanShape& shape);

/// Returns a scan with rays without hits. Its header is empty.
sensor_msgs::LaserScan empty_scan(const ScanShape& shape);

/// Puts points into the rays of a scan: each ray keeps the nearest.
class ScanFiller {
 public:
  ScanFiller(const ScanShape& shape, sensor_msgs::LaserScan& scan);

  /// Adds a point in the scan's plane, m, to the ray with the nearest angle, if it is within the angles and ranges.
  /// Ignores NaN.
  void add(double x, double y);

 private:
  ScanShape shape_;
  bool closed_;  // the scan is a full turn: the first ray follows the last
  double rays_per_radian_;
  sensor_msgs::LaserScan& scan_;
};

}  // namespace bubblesim
