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

/// Where a lidar sits on the base, seen from above.
struct LidarMount {
  PlanarPose pose;           ///< in the base's frame
  bool upside_down = false;  ///< its z axis points to the ground: its scans run clockwise
};

struct ScanMapperOptions {
  double cell_size = 0.05;       ///< m
  double max_usable_range = 80;  ///< m, beyond which a range only tells free space up to there
  double linear_update = 0.3;    ///< m to move before a scan is entered into the map
  double angular_update = 0.3;   ///< rad to turn, likewise
};

/// Throws std::invalid_argument, which says what no mapper can have.
void check(const ScanMapperOptions& options);

/// Builds a map of the plane from scans and odometry: each scan is matched to the points that are known already (ICP),
/// and entered into a grid of occupancies. The map's frame is where the base was at the first scan.
/// The files that use it need no header of MRPT, which does the work (https://www.mrpt.org, CMetricMapBuilderICP).
class ScanMapper {
 public:
  explicit ScanMapper(const ScanMapperOptions& options);
  ~ScanMapper();
  ScanMapper(ScanMapper&&) noexcept;
  ScanMapper& operator=(ScanMapper&&) noexcept;

  /// Takes a scan and the base's pose at its time by odometry; returns the base's pose in the map. Stamps must rise.
  PlanarPose add(const sensor_msgs::LaserScan& scan, const LidarMount& mount, const PlanarPose& odometry);

  /// What is known so far: per cent of occupancy, -1 where nothing was seen. The header is left to the caller.
  [[nodiscard]] nav_msgs::OccupancyGrid map() const;

 private:
  struct Builder;
  std::unique_ptr<Builder> builder_;
};

}  // namespace bubblesim
