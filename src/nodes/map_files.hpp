// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>

#include <filesystem>

namespace bubblesim {

/// Occupancy in per cent: lower limit of occupied cells and upper limit of free cells, as in ROS's map_saver.
struct MapThresholds {
  int occupied = 65;
  int free = 25;
};

/// Writes NAME.pgm and NAME.yaml, in the format of ROS's map_server. Makes missing folders.
/// Returns the path of the yaml file; throws std::runtime_error that names the file that could not be written.
std::filesystem::path write_map(const nav_msgs::OccupancyGrid& map, const std::filesystem::path& name,
                                const MapThresholds& thresholds = {});

}  // namespace bubblesim
