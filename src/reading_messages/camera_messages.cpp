// SPDX-License-Identifier: BSD-3-Clause
#include "camera_messages.hpp"

#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "cloud_fields.hpp"

namespace bubblesim::reading_messages {
namespace {

// As PCL's PointXYZRGB.
constexpr std::array<CloudField, 4> kPixelFields{
    {{"x", 0, kCloudFloat32}, {"y", 4, kCloudFloat32}, {"z", 8, kCloudFloat32}, {"rgb", 16, kCloudFloat32}}};
constexpr std::size_t kPixelSize = kCloudFloats * sizeof(float);

/// All but the data.
void put_image(Fields& fields, const Header& header, const CameraImage& image, std::string_view encoding,
               std::size_t pixel_size) {
  put(fields, header);
  fields.put("height", image.height);
  fields.put("width", image.width);
  fields.put("encoding", encoding);
  fields.put("is_bigendian", 0);
  fields.put("step", static_cast<std::size_t>(image.width) * pixel_size);
}

void write_depths(const std::vector<float>& depths, const DepthLimits& limits, std::uint8_t* place) {
  const auto least = static_cast<float>(limits.least);
  const auto most = static_cast<float>(limits.most);
  for (const float measured : depths) {
    const bool inside = (measured > least) & (measured < most);
    const float depth = inside ? measured : std::numeric_limits<float>::quiet_NaN();
    std::memcpy(place, &depth, sizeof depth);
    place += sizeof depth;
  }
}

/// Some fields have other names in ROS 2.
template <std::size_t size>
void put_matrix(Fields& fields, std::string_view name, std::string_view new_name,
                const std::array<double, size>& matrix) {
  fields.array(name, matrix);
  fields.array(new_name, matrix);
}

}  // namespace

void color_image(Fields& fields, const Header& header, const CameraImage& image) {
  put_image(fields, header, image, "rgb8", 3);
  fields.array("data", image.rgb);
}

void depth_image(Fields& fields, const Header& header, const CameraImage& image,
                 const std::optional<DepthLimits>& limits) {
  put_image(fields, header, image, "32FC1", sizeof(float));
  const std::size_t size = image.depth.size() * sizeof(float);
  if (limits) {
    fields.array("data", messages::FieldKind::kUint8, size,
                 [&image, limits = *limits](std::uint8_t* place) { write_depths(image.depth, limits, place); });
  } else {
    fields.array("data", reinterpret_cast<const std::uint8_t*>(image.depth.data()), size);
  }
}

void camera_cloud(Fields& fields, const Header& header, const CameraImage& image, const DepthLimits& limits,
                  CloudAxes axes) {
  const auto dense = std::make_shared<bool>();
  put(fields, header);
  put_cloud(fields, {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width)}, kPixelFields,
            kPixelSize, [&image, limits, axes, dense](std::uint8_t* place) {
              *dense = to_point_cloud(image, limits.least, limits.most, axes, place);
            });
  fields.put("is_dense", std::shared_ptr<const bool>(dense));
}

void camera_info(Fields& fields, const Header& header, const Pinhole& camera) {
  const auto& [width, height, f, x, y, baseline, distortion] = camera;
  put(fields, header);
  fields.put("height", height);
  fields.put("width", width);
  fields.put("distortion_model", "plumb_bob");
  put_matrix(fields, "D", "d", distortion);
  put_matrix<9>(fields, "K", "k", {f, 0, x, 0, f, y, 0, 0, 1});
  put_matrix<9>(fields, "R", "r", {1, 0, 0, 0, 1, 0, 0, 0, 1});
  put_matrix<12>(fields, "P", "p", {f, 0, x, -f * baseline, 0, f, y, 0, 0, 0, 1, 0});
}

void compressed_image(Fields& fields, const Header& header, std::string_view format, std::string_view data) {
  put(fields, header);
  fields.put("format", format);
  fields.array("data", reinterpret_cast<const std::uint8_t*>(data.data()), data.size());
}

}  // namespace bubblesim::reading_messages
