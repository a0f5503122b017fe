// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>

namespace bubblesim {

/// What of a depth image becomes a scan.
struct DepthBand {
  int scan_height = 1;       ///< rows around the one that looks straight ahead; each column gives its nearest
  double scan_time = 0.033;  ///< s
  double range_min = 0.45;   ///< m
  double range_max = 10.0;   ///< m
};

/// Throws std::invalid_argument, which names the parameter, when there is no such band.
void check(const DepthBand& band);

/// The rows in the middle of a depth image (16UC1 in mm or 32FC1 in m, REP 118), looked at from above, in a frame that
/// looks along x. One ray for each column; a ray is NaN where nothing was measured and +inf where it was too far to be.
/// The header is left to the caller.
/// Throws std::invalid_argument for other encodings, a camera without focal length, a band higher than the image.
sensor_msgs::LaserScan depth_to_scan(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& camera,
                                     const DepthBand& band);

}  // namespace bubblesim
