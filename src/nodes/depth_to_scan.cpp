// SPDX-License-Identifier: BSD-3-Clause
#include "depth_to_scan.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace bubblesim {

namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr float kFar = std::numeric_limits<float>::infinity();

/// Depth of one pixel in m, NaN without a measurement.
float metres(const std::uint8_t* pixel, float) {
  float value = 0.0F;
  std::memcpy(&value, pixel, sizeof value);
  return value;
}

float metres(const std::uint8_t* pixel, std::uint16_t) {
  std::uint16_t value = 0;
  std::memcpy(&value, pixel, sizeof value);
  return value == 0 ? kNothing : 0.001f * static_cast<float>(value);
}

template <typename Pixel>
void fill(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& camera, const DepthBand& band,
          sensor_msgs::LaserScan& scan) {
  if (image.step < image.width * sizeof(Pixel) || image.data.size() < std::size_t{image.step} * image.height)
    throw std::invalid_argument("the image has less data than its width, height and step require");
  const double focal_length = camera.K[0];
  const int rows = static_cast<int>(image.height);
  const int middle = static_cast<int>(camera.K[5]);
  const int first = std::min(std::max(middle - band.scan_height / 2, 0), rows - band.scan_height);
  for (std::uint32_t column = 0; column < image.width; ++column) {
    const double sideways = (column - camera.K[2]) / focal_length;  // to the right, at depth 1
    const float stretch = static_cast<float>(std::hypot(1.0, sideways));
    const double place = (-std::atan(sideways) - scan.angle_min) / scan.angle_increment;
    const auto last = static_cast<double>(scan.ranges.size() - 1);
    float& ray = scan.ranges[static_cast<std::size_t>(std::fmin(std::fmax(place + 0.5, 0.0), last))];
    for (int row = first; row < first + band.scan_height; ++row) {
      const std::uint8_t* pixel = image.data.data() + static_cast<std::size_t>(row) * image.step;
      float range = stretch * metres(pixel + column * sizeof(Pixel), Pixel{});
      if (std::isnan(range) || range < scan.range_min) continue;
      if (range > scan.range_max) range = kFar;
      if (!(ray <= range)) ray = range;
    }
  }
}

}  // namespace

void check(const DepthBand& band) {
  if (band.scan_height < 1) throw std::invalid_argument("scan_height must be at least 1");
  if (!(band.scan_time >= 0.0)) throw std::invalid_argument("scan_time must not be negative");
  if (!(band.range_min >= 0.0)) throw std::invalid_argument("range_min must not be negative");
  if (!(band.range_max > band.range_min)) throw std::invalid_argument("range_max must be above range_min");
}

sensor_msgs::LaserScan depth_to_scan(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& camera,
                                     const DepthBand& band) {
  const double focal_length = camera.K[0];
  if (!(focal_length > 0.0)) throw std::invalid_argument("the camera_info has no focal length: K[0] must be above 0");
  if (image.width < 2) throw std::invalid_argument("the image must be at least two pixels wide");
  if (static_cast<std::uint32_t>(band.scan_height) > image.height)
    throw std::invalid_argument("scan_height exceeds the image's " + std::to_string(image.height) + " rows");
  sensor_msgs::LaserScan scan;
  scan.angle_max = static_cast<float>(std::atan(camera.K[2] / focal_length));
  scan.angle_min = static_cast<float>(-std::atan((image.width - 1 - camera.K[2]) / focal_length));
  scan.angle_increment = (scan.angle_max - scan.angle_min) / static_cast<float>(image.width - 1);
  scan.scan_time = static_cast<float>(band.scan_time);
  scan.range_min = static_cast<float>(band.range_min);
  scan.range_max = static_cast<float>(band.range_max);
  scan.ranges.assign(image.width, kNothing);
  if (image.encoding == "32FC1")
    fill<float>(image, camera, band, scan);
  else if (image.encoding == "16UC1")
    fill<std::uint16_t>(image, camera, band, scan);
  else
    throw std::invalid_argument("expected an image with encoding 32FC1 or 16UC1, found " + image.encoding);
  return scan;
}

}  // namespace bubblesim
