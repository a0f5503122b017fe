// SPDX-License-Identifier: BSD-3-Clause
// The two files of a map, byte by byte, as ROS's map_server documents them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "map_files.hpp"

namespace bubblesim {
namespace {

namespace fs = std::filesystem;

class MapFiles : public testing::Test {
 protected:
  MapFiles() {
    std::string name = (fs::temp_directory_path() / "bubblesim-maps-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for the test");
    folder_ = name;
    map_.info.resolution = 0.05F;
    map_.info.width = 3;
    map_.info.height = 2;
    map_.info.origin.position.x = -1.25;
    map_.info.origin.position.y = 0.5;
    map_.info.origin.orientation.z = std::sin(0.25);
    map_.info.origin.orientation.w = std::cos(0.25);
    map_.data = {-1, 0, 100, 25, 26, 65};
  }
  ~MapFiles() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ifstream input(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(input), {}};
  }

  fs::path folder_;
  nav_msgs::OccupancyGrid map_;
};

TEST_F(MapFiles, ThePictureStartsAtTheTopWithWhiteForFree) {
  write_map(map_, folder_ / "room");
  EXPECT_EQ(content(folder_ / "room.pgm"),
            std::string("P5\n3 2\n255\n") + "\xfe\xcd" + std::string(1, '\0') + "\xcd\xfe" + std::string(1, '\0'));
}

TEST_F(MapFiles, TheDescriptionHasWhatMapServerWants) {
  EXPECT_EQ(write_map(map_, folder_ / "room"), folder_ / "room.yaml");
  EXPECT_EQ(content(folder_ / "room.yaml"),
            "image: room.pgm\nresolution: 0.050000\norigin: [-1.250000, 0.500000, 0.500000]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST_F(MapFiles, ThresholdsSeparateWallsFromFloor) {
  write_map(map_, folder_ / "room", {100, 0});
  EXPECT_EQ(content(folder_ / "room.pgm").substr(11), std::string("\xcd\xcd\xcd\xcd\xfe", 5) + std::string(1, '\0'));
}

TEST_F(MapFiles, FoldersInTheWayAreMade) {
  write_map(map_, folder_ / "maps" / "of" / "today");
  EXPECT_TRUE(fs::exists(folder_ / "maps" / "of" / "today.yaml"));
}

TEST_F(MapFiles, WhatCannotBeWrittenIsReported) {
  std::ofstream(folder_ / "file") << "no folder";
  EXPECT_THROW(write_map(map_, folder_ / "file" / "map"), std::runtime_error);
  EXPECT_THROW(write_map(map_, folder_ / ""), std::runtime_error);
  EXPECT_THROW(write_map(nav_msgs::OccupancyGrid(), folder_ / "map"), std::runtime_error);
}

}  // namespace
}  // namespace bubblesim
