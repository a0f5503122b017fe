// SPDX-License-Identifier: BSD-3-Clause
// The fields that describe the bytes of a sensor_msgs/PointCloud2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "parts.hpp"

namespace bubblesim::reading_messages {

/// sensor_msgs/PointField.
constexpr std::uint8_t kCloudUint16 = 4;
constexpr std::uint8_t kCloudFloat32 = 7;

struct CloudField {
  std::string_view name;
  std::uint32_t offset;
  std::uint8_t datatype;
};

struct CloudShape {
  std::size_t height;
  std::size_t width;
};

/// All but the header and `is_dense`; `fill` writes height x width points of `point_size` bytes.
template <class Layout>
void put_cloud(Fields& fields, CloudShape shape, const Layout& layout, std::size_t point_size, Fields::Fill fill) {
  const std::size_t row = point_size * shape.width;
  fields.put("height", shape.height);
  fields.put("width", shape.width);
  fields.list("fields", layout, [&](const CloudField& field) {
    fields.put("name", field.name);
    fields.put("offset", field.offset);
    fields.put("datatype", field.datatype);
    fields.put("count", 1);
  });
  fields.put("is_bigendian", false);
  fields.put("point_step", point_size);
  fields.put("row_step", row);
  fields.array("data", messages::FieldKind::kUint8, row * shape.height, std::move(fill));
}

}  // namespace bubblesim::reading_messages
