// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/LaserScan.h>

#include <memory>

namespace bubblesim {

/// A pose in the plane: m, m, rad.
struct PlanarPose {
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;
};

/// Pose of a lidar on the base, seen from above.
struct LidarMount {
  PlanarPose pose;           ///< in the base's frame
  bool upside_down = false;  ///< z axis points down: scans run clockwise
};

struct ScanMapperOptions {
  double cell_size = 0.05;       ///< m
  double max_usable_range = 80;  ///< m, a longer range only marks free space up to there
  double linear_update = 0.3;    ///< m to move before a scan is entered into the map
  double angular_update = 0.3;   ///< rad to turn, likewise
};

/// Throws std::invalid_argument that names the invalid option.
void check(const ScanMapperOptions& options);

/// Builds a 2D map from scans and odometry: matches each scan to the known points (ICP) and enters it into an occupancy
/// grid. The map's frame is the base's pose at the first scan. This header needs no header of MRPT, which does the work
/// (https://www.mrpt.org, CMetricMapBuilderICP).
class ScanMapper {
 public:
  explicit ScanMapper(const ScanMapperOptions& options);
  ~ScanMapper();
  ScanMapper(ScanMapper&&) noexcept;
  ScanMapper& operator=(ScanMapper&&) noexcept;

  /// Adds a scan with the odometry pose of the base at its time; returns the base's pose in the map. Stamps must
  /// increase.
  PlanarPose add(const sensor_msgs::LaserScan& scan, const LidarMount& mount, const PlanarPose& odometry);

  /// Returns the map: per cent of occupancy, -1 for unseen cells. The caller sets the header.
  [[nodiscard]] nav_msgs::OccupancyGrid map() const;

 private:
  struct Builder;
  std::unique_ptr<Builder> builder_;
};

}  // namespace bubblesim
