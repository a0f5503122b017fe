// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_to_scan.hpp"

#include <sensor_msgs/PointField.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <string>

namespace bubblesim {

namespace {

std::size_t offset_of(const sensor_msgs::PointCloud2& cloud, const std::string& name) {
  for (const sensor_msgs::PointField& field : cloud.fields) {
    if (field.name != name) continue;
    if (field.datatype != sensor_msgs::PointField::FLOAT32)
      throw std::invalid_argument("the cloud's field " + name + " is not FLOAT32");
    if (field.offset + sizeof(float) > cloud.point_step)
      throw std::invalid_argument("the cloud's field " + name + " exceeds point_step");
    return field.offset;
  }
  throw std::invalid_argument("the cloud has no field " + name);
}

void check_sizes(const sensor_msgs::PointCloud2& cloud) {
  if (cloud.is_bigendian) throw std::invalid_argument("the cloud is big-endian, which is not supported");
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.height > 1 && cloud.row_step < row)
    throw std::invalid_argument("the cloud's rows are longer than row_step");
  if (cloud.height == 0 || cloud.width == 0) return;
  if (cloud.data.size() < std::uint64_t{cloud.height - 1} * cloud.row_step + row)
    throw std::invalid_argument("the cloud has less data than height, row_step and width require");
}

float float_at(const std::uint8_t* bytes) {
  float value = 0.0F;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

}  // namespace

sensor_msgs::LaserScan cloud_to_scan(const sensor_msgs::PointCloud2& cloud, const tf2::Transform& to_scan,
                                     const HeightBand& heights, const ScanShape& shape) {
  const std::array<std::size_t, 3> offsets{offset_of(cloud, "x"), offset_of(cloud, "y"), offset_of(cloud, "z")};
  check_sizes(cloud);
  sensor_msgs::LaserScan scan = empty_scan(shape);
  ScanFiller filler(shape, scan);
  for (std::size_t row = 0; row < cloud.height; ++row) {
    const std::uint8_t* point = cloud.data.data() + row * cloud.row_step;
    for (std::size_t column = 0; column < cloud.width; ++column, point += cloud.point_step) {
      const tf2::Vector3 seen = to_scan * tf2::Vector3(float_at(point + offsets[0]), float_at(point + offsets[1]),
                                                       float_at(point + offsets[2]));
      if (seen.z() >= heights.min && seen.z() <= heights.max) filler.add(seen.x(), seen.y());
    }
  }
  return scan;
}

}  // namespace bubblesim
