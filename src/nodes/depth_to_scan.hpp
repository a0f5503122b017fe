// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>

namespace bubblesim {

/// The part of a depth image to convert to a scan.
struct DepthBand {
  int scan_height = 1;       ///< rows around the optical centre; each column gives its nearest pixel
  double scan_time = 0.033;  ///< s
  double range_min = 0.45;   ///< m
  double range_max = 10.0;   ///< m
};

/// Throws std::invalid_argument that names the invalid parameter.
void check(const DepthBand& band);

/// Converts the middle rows of a depth image (16UC1 in mm or 32FC1 in m, REP 118) to a scan, in a frame with x forward.
/// One ray per column; a ray is NaN without a measurement and +inf beyond the range. The caller sets the header.
/// Throws std::invalid_argument for other encodings, a camera without focal length, a band higher than the image.
sensor_msgs::LaserScan depth_to_scan(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& camera,
                                     const DepthBand& band);

}  // namespace bubblesim
