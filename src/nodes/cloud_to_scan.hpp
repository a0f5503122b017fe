// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <tf2/LinearMath/Transform.h>

#include "scan_shape.hpp"

namespace bubblesim {

/// Range of heights in the scan's frame, m, for the points to use.
struct HeightBand {
  double min = -1.7976931348623157e308;
  double max = 1.7976931348623157e308;
};

/// Converts the points of a cloud within a range of heights to a scan. `to_scan` transforms points from the cloud's
/// frame to the scan's frame. The caller sets the header. Throws std::invalid_argument for a cloud without x, y and z
/// as float32, or with inconsistent sizes.
sensor_msgs::LaserScan cloud_to_scan(const sensor_msgs::PointCloud2& cloud, const tf2::Transform& to_scan,
                                     const HeightBand& heights, const ScanShape& shape);

}  // namespace bubblesim
