// SPDX-License-Identifier: BSD-3-Clause
// Messages of cameras. The images must live until the fields are encoded.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "bubblesim/sensor_kinds.hpp"
#include "parts.hpp"

namespace bubblesim::reading_messages {

/// Depths in metres, both excluded.
struct DepthLimits {
  double least = 0;
  double most = 0;
};

/// sensor_msgs/Image of the colours, rgb8.
void color_image(Fields& fields, const Header& header, const CameraImage& image);

/// sensor_msgs/Image of the depths in metres, 32FC1; those outside the limits are NaN.
void depth_image(Fields& fields, const Header& header, const CameraImage& image,
                 const std::optional<DepthLimits>& limits);

/// sensor_msgs/PointCloud2: x, y, z and the colour in PCL's form; points outside the limits are NaN.
void camera_cloud(Fields& fields, const Header& header, const CameraImage& image, const DepthLimits& limits,
                  CloudAxes axes);

/// A pinhole camera; pixels and metres.
struct Pinhole {
  int width = 0;
  int height = 0;
  double focal_length = 0;
  double center_x = 0;
  double center_y = 0;
  double baseline = 0;                 ///< of the right camera of a stereo pair
  std::array<double, 5> distortion{};  ///< k1, k2, t1, t2, k3 of the model plumb_bob
};

/// sensor_msgs/CameraInfo.
void camera_info(Fields& fields, const Header& header, const Pinhole& camera);

/// sensor_msgs/CompressedImage; `data` must live until the fields are encoded.
void compressed_image(Fields& fields, const Header& header, std::string_view format, std::string_view data);

}  // namespace bubblesim::reading_messages
