// SPDX-License-Identifier: BSD-3-Clause
#include "map_files.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace bubblesim {

namespace {

// Grey values of the image, from which readers get the state of a cell: white is free.
constexpr char kFree = static_cast<char>(254);
constexpr char kOccupied = 0;
constexpr char kUnknown = static_cast<char>(205);

char shade(std::int8_t cell, const MapThresholds& thresholds) {
  if (cell < 0) return kUnknown;
  if (cell >= thresholds.occupied) return kOccupied;
  return cell <= thresholds.free ? kFree : kUnknown;
}

std::string picture(const nav_msgs::OccupancyGrid& map, const MapThresholds& thresholds) {
  const std::size_t width = map.info.width;
  const std::size_t height = map.info.height;
  std::string text = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  for (std::size_t row = height; row-- > 0;) {  // an image's first row is the top, a map's is the southernmost
    for (std::size_t column = 0; column < width; ++column)
      text.push_back(shade(map.data[row * width + column], thresholds));
  }
  return text;
}

std::string description(const nav_msgs::OccupancyGrid& map, const std::string& image) {
  const auto& origin = map.info.origin;
  const auto& turn = origin.orientation;
  const double heading =
      std::atan2(2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y * turn.y + turn.z * turn.z));
  char numbers[160];
  std::snprintf(numbers, sizeof numbers, "resolution: %.6f\norigin: [%.6f, %.6f, %.6f]\n", map.info.resolution,
                origin.position.x, origin.position.y, heading);
  // The grey value of unknown cells, 205, is between these two.
  return "image: " + image + "\n" + numbers + "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream output(file, std::ios::binary);
  output << text << std::flush;
  if (!output)
    throw std::runtime_error("cannot write " + file.string() + ": " + std::generic_category().message(errno));
}

}  // namespace

std::filesystem::path write_map(const nav_msgs::OccupancyGrid& map, const std::filesystem::path& name,
                                const MapThresholds& thresholds) {
  if (map.data.size() != std::size_t{map.info.width} * map.info.height || map.data.empty())
    throw std::runtime_error("there is no map yet");
  const std::filesystem::path base = std::filesystem::absolute(name);
  if (base.filename().empty()) throw std::runtime_error(base.string() + " is a folder: append a file name");
  std::error_code failed;
  std::filesystem::create_directories(base.parent_path(), failed);  // an error shows when writing
  const std::string image = base.filename().string() + ".pgm";
  std::filesystem::path yaml = base.string() + ".yaml";
  write(base.parent_path() / image, picture(map, thresholds));
  write(yaml, description(map, image));
  return yaml;
}

}  // namespace bubblesim
