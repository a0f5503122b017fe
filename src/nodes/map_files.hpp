// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>

#include <filesystem>

namespace bubblesim {

/// Per cent of occupancy from which a cell is a wall, and up to which it is free, as ROS's map_saver has them.
struct MapThresholds {
  int occupied = 65;
  int free = 25;
};

/// Writes NAME.pgm and NAME.yaml, as ROS's map_server reads them. Folders in the way are made.
/// Returns the path of the yaml file; throws std::runtime_error, which tells what could not be written.
std::filesystem::path write_map(const nav_msgs::OccupancyGrid& map, const std::filesystem::path& name,
                                const MapThresholds& thresholds = {});

}  // namespace bubblesim
