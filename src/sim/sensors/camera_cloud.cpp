// SPDX-License-Identifier: BSD-3-Clause
// Point clouds of cameras, in one pass over depths and colours.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "bubblesim/sensor_kinds.hpp"
#include "scene/simd.hpp"
#include "sensors/worker_pool.hpp"

namespace bubblesim {
namespace {

constexpr std::size_t kPointRows = 16;  // of a large image, on one thread

/// The offset of each of `count` pixels from the image's centre, at a depth of 1 m, rightwards or downwards.
std::vector<float> offsets(int count, double pixel) {
  std::vector<float> found;
  for (int i = 0; i < count; ++i) found.push_back(static_cast<float>((i - (count - 1) / 2.0) * pixel));
  return found;
}

struct Row {
  const float* depths;
  const std::uint8_t* rgb;  // null: none
  const float* across;
  float down;
  std::size_t width;
};

constexpr std::size_t kBlock = 16;  // pixels at a time

/// Returns the number of points that are NaN.
BUBBLESIM_SIMD std::size_t fill_row(const Row& row, float least, float most, bool optical, std::uint8_t* points) {
  constexpr std::size_t kPoint = kCloudFloats * sizeof(float);
  std::size_t missing = 0;
  for (std::size_t first = 0; first < row.width; first += kBlock) {
    const std::size_t count = std::min(kBlock, row.width - first);
    // x, y, z and the colour. Each point is written field by field: a vector read from fields that were just written
    // one by one would wait for them.
    alignas(64) float fields[4][kBlock];
    for (std::size_t i = 0; i < count; ++i) {
      const float measured = row.depths[first + i];
      const bool inside = (measured > least) & (measured < most);
      const float depth = inside ? measured : std::numeric_limits<float>::quiet_NaN();
      missing += inside ? 0 : 1;
      const float right = depth * row.across[first + i];
      const float down = depth * row.down;
      fields[0][i] = optical ? right : depth;
      fields[1][i] = optical ? down : -right;
      fields[2][i] = optical ? depth : -down;
    }
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t color = 0;
      if (row.rgb != nullptr) {
        const std::uint8_t* rgb = row.rgb + 3 * (first + i);
        color = static_cast<std::uint32_t>(rgb[0]) << 16U | static_cast<std::uint32_t>(rgb[1]) << 8U | rgb[2];
      }
      std::uint8_t* point = points + kPoint * (first + i);
      constexpr std::uint64_t kNone = 0;
      std::memcpy(point, &fields[0][i], sizeof(float));
      std::memcpy(point + 4, &fields[1][i], sizeof(float));
      std::uint64_t last = 0;
      std::memcpy(&last, &fields[2][i], sizeof(float));
      std::memcpy(point + 8, &last, sizeof last);
      last = color;  // the lowest byte first, as on all machines that run ROS
      std::memcpy(point + 16, &last, sizeof last);
      std::memcpy(point + 24, &kNone, sizeof kNone);
    }
  }
  return missing;
}

}  // namespace

bool to_point_cloud(const CameraImage& image, double least, double most, CloudAxes axes, std::uint8_t* points) {
  const double pixel = std::tan(image.horizontal_fov / 2) * 2 / image.width;
  const std::vector<float> across = offsets(image.width, pixel);
  const std::vector<float> down = offsets(image.height, pixel);
  const std::size_t width = across.size();
  const std::size_t rows = down.size();
  std::atomic<std::size_t> missing{0};
  const std::size_t length = rows * width < kRaysWorthThreads ? rows : kPointRows;
  WorkerPool::shared().run((rows + length - 1) / length, [&](std::size_t part) {
    std::size_t found = 0;
    for (std::size_t row = part * length; row < std::min(rows, (part + 1) * length); ++row) {
      const std::size_t first = row * width;
      const Row pixels{&image.depth[first], image.rgb.empty() ? nullptr : &image.rgb[3 * first], across.data(),
                       down[row], width};
      found += fill_row(pixels, static_cast<float>(least), static_cast<float>(most), axes == CloudAxes::kOptical,
                        points + kCloudFloats * sizeof(float) * first);
    }
    missing += found;
  });
  return missing == 0;
}

}  // namespace bubblesim
