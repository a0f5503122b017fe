// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <cstddef>

namespace bubblesim {

/// The fan of rays of a LaserScan that is made of something else, and what goes into it. Angles in rad, lengths in m.
struct ScanShape {
  double angle_min = -3.141592653589793;
  double angle_max = 3.141592653589793;
  double angle_increment = 3.141592653589793 / 180.0;
  double scan_time = 1.0 / 30.0;  ///< s between scans, as the message tells it
  double range_min = 0.0;
  double range_max = 1.7976931348623157e308;
  bool use_inf = true;       ///< a ray that meets nothing is +inf (REP 117), else range_max + inf_epsilon
  double inf_epsilon = 1.0;  ///< m
};

/// Throws std::invalid_argument, which names the parameter, when no fan of rays is like this.
void check(const ScanShape& shape);

/// A scan whose rays have met nothing yet. Its header is empty.
sensor_msgs::LaserScan empty_scan(const ScanShape& shape);

/// Puts points into the rays of a scan: each ray keeps the nearest.
class ScanFiller {
 public:
  ScanFiller(const ScanShape& shape, sensor_msgs::LaserScan& scan);

  /// A point in the scan's plane, m. It counts for the ray whose angle is nearest, when it lies within the fan and the
  /// ranges; NaN never does.
  void add(double x, double y);

 private:
  ScanShape shape_;
  bool closed_;  // the fan goes all the way round: after the last ray comes the first
  double rays_per_radian_;
  sensor_msgs::LaserScan& scan_;
};

}  // namespace bubblesim
