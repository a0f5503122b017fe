// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <tf2/LinearMath/Transform.h>

#include "scan_shape.hpp"

namespace bubblesim {

/// Heights in the scan's frame, m, between which points count.
struct HeightBand {
  double min = -1.7976931348623157e308;
  double max = 1.7976931348623157e308;
};

/// The points of a cloud within a band of heights, looked at from above. `to_scan` takes points from the cloud's frame
/// to the scan's. The header is left to the caller.
/// Throws std::invalid_argument for a cloud without x, y and z as float32, or whose sizes do not fit together.
sensor_msgs::LaserScan cloud_to_scan(const sensor_msgs::PointCloud2& cloud, const tf2::Transform& to_scan,
                                     const HeightBand& heights, const ScanShape& shape);

}  // namespace bubblesim
