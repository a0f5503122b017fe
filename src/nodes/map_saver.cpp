// SPDX-License-Identifier: BSD-3-Clause
// The node map_saver: writes the next received map to two files and exits.
#include <ros/ros.h>

#include <cstdio>
#include <exception>
#include <string>

#include "map_files.hpp"
#include "run_node.hpp"

namespace {

constexpr char kUsage[] =
    "usage: map_saver [--occ PER_CENT] [--free PER_CENT] [-f NAME]\n\n"
    "Writes the map on topic map to NAME.pgm and NAME.yaml (default NAME: map).\n\n"
    "  --occ   occupancy in per cent from which a cell is occupied (default 65)\n"
    "  --free  occupancy in per cent up to which a cell is free (default 25)\n";

struct Options {
  std::string name = "map";
  bubblesim::MapThresholds thresholds;
};

int per_cent(const std::string& text) {
  const int value = std::stoi(text);
  if (value < 0 || value > 100) throw std::out_of_range(text);
  return value;
}

/// Throws for invalid arguments.
Options read(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string flag = argv[i];
    if (i + 1 == argc) throw std::invalid_argument(flag);
    const std::string value = argv[i + 1];
    if (flag == "-f")
      options.name = value;
    else if (flag == "--occ")
      options.thresholds.occupied = per_cent(value);
    else if (flag == "--free")
      options.thresholds.free = per_cent(value);
    else
      throw std::invalid_argument(flag);
  }
  if (options.thresholds.free >= options.thresholds.occupied) throw std::invalid_argument("--free");
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  bubblesim::stay_on_this_machine(argc, argv);
  ros::init(argc, argv, "map_saver", ros::init_options::AnonymousName);
  if (argc == 2 && (std::string(argv[1]) == "--help" || std::string(argv[1]) == "-h")) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  Options options;
  try {
    options = read(argc, argv);
  } catch (const std::exception&) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  ros::NodeHandle node = bubblesim::start_node();
  int code = 1;
  const auto save = [&](const nav_msgs::OccupancyGrid::ConstPtr& map) {
    try {
      std::printf("%s\n", bubblesim::write_map(*map, options.name, options.thresholds).c_str());
      code = 0;
    } catch (const std::runtime_error& error) {
      std::fprintf(stderr, "error: %s\n", error.what());
    }
    ros::requestShutdown();
  };
  std::fprintf(stderr, "waiting for a map on %s\n", node.resolveName("map").c_str());
  const ros::Subscriber maps = node.subscribe<nav_msgs::OccupancyGrid>("map", 1, save);
  ros::spin();
  return code;
}
