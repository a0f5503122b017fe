// SPDX-License-Identifier: BSD-3-Clause
// Messages of lidars and other range sensors. The readings must live until the fields are encoded.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "bubblesim/sensor_kinds.hpp"
#include "parts.hpp"

namespace bubblesim::reading_messages {

/// sensor_msgs/LaserScan, of one ring, or of all one after the other as in Gazebo.
void laser_scan(Fields& fields, const Header& header, const LidarScan& scan, std::optional<int> ring = {});

/// Which returns a lidar's cloud has: those between two ranges in metres, both excluded. An organized cloud has rings x
/// samples points, and NaN for the others.
struct CloudOptions {
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
  bool organized = false;
};

/// sensor_msgs/PointCloud2 of the returns: x, y, z, intensity, ring and time, as in velodyne_pointcloud.
void lidar_cloud(Fields& fields, const Header& header, const LidarScan& scan, const CloudOptions& options);

/// sensor_msgs/PointCloud with intensities; rays without a return end at the maximum range, as in Gazebo.
void lidar_points(Fields& fields, const Header& header, const LidarScan& scan);

/// The nearest range of a scan, m; infinite without a return.
float nearest_range(const LidarScan& scan);

/// sensor_msgs/Range.
struct RangeReading {
  std::uint8_t radiation = 0;  ///< 0: ultrasound, 1: infrared
  double field_of_view = 0;    ///< rad
  double min_range = 0;        ///< m
  double max_range = 0;        ///< m
  double range = 0;            ///< m
};
void range(Fields& fields, const Header& header, const RangeReading& reading);

}  // namespace bubblesim::reading_messages
