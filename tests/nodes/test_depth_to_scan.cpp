// SPDX-License-Identifier: BSD-3-Clause
// Depth images of simple things, whose ranges follow from geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "depth_to_scan.hpp"

namespace bubblesim {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr double kFocalLength = 50.0;
constexpr double kMiddle = 31.5;

sensor_msgs::CameraInfo camera() {
  sensor_msgs::CameraInfo info;
  info.width = kWidth;
  info.height = kHeight;
  info.K = {kFocalLength, 0, kMiddle, 0, kFocalLength, 23.5, 0, 0, 1};
  return info;
}

template <typename Pixel>
sensor_msgs::Image image_of(const char* encoding, Pixel value) {
  sensor_msgs::Image image;
  image.width = kWidth;
  image.height = kHeight;
  image.step = kWidth * sizeof(Pixel);
  image.encoding = encoding;
  image.data.resize(std::size_t{image.step} * image.height);
  for (std::size_t place = 0; place < image.data.size(); place += sizeof(Pixel))
    std::memcpy(&image.data[place], &value, sizeof value);
  return image;
}

void set(sensor_msgs::Image& image, int column, int row, float value) {
  std::memcpy(&image.data[row * image.step + column * sizeof value], &value, sizeof value);
}

TEST(DepthToScan, AWallAheadIsAStraightLine) {
  for (const auto& image : {image_of<float>("32FC1", 2.0F), image_of<std::uint16_t>("16UC1", 2000)}) {
    const auto scan = depth_to_scan(image, camera(), {});
    ASSERT_EQ(scan.ranges.size(), static_cast<std::size_t>(kWidth));
    int seen = 0;
    for (std::size_t ray = 0; ray < scan.ranges.size(); ++ray) {
      if (std::isnan(scan.ranges[ray])) continue;  // rays lie closer in the middle than columns do
      ++seen;
      const double angle = scan.angle_min + static_cast<double>(ray) * scan.angle_increment;
      EXPECT_NEAR(scan.ranges[ray] * std::cos(angle), 2.0, 0.02) << ray;
    }
    EXPECT_GT(seen, kWidth / 2);
  }
}

TEST(DepthToScan, TheFanIsTheCamerasView) {
  const auto scan = depth_to_scan(image_of<float>("32FC1", 2.0F), camera(), {});
  EXPECT_FLOAT_EQ(scan.angle_max, std::atan(kMiddle / kFocalLength));
  EXPECT_FLOAT_EQ(scan.angle_min, -std::atan((kWidth - 1 - kMiddle) / kFocalLength));
  EXPECT_FALSE(std::isnan(scan.ranges.front()));
  EXPECT_FALSE(std::isnan(scan.ranges.back()));
}

TEST(DepthToScan, TheImagesLeftIsTheScansLeft) {
  auto image = image_of<float>("32FC1", std::numeric_limits<float>::quiet_NaN());
  set(image, 0, 23, 2.0F);  // the leftmost column: the largest angle, REP 103
  const auto scan = depth_to_scan(image, camera(), {});
  EXPECT_FLOAT_EQ(scan.ranges.back(), 2.0 * std::hypot(1.0, kMiddle / kFocalLength));
  EXPECT_TRUE(std::isnan(scan.ranges.front()));
}

TEST(DepthToScan, KeepsTheNearestRowOfTheBandOnly) {
  auto image = image_of<float>("32FC1", 3.0F);
  const int column = 31;
  set(image, column, 20, 1.0F);
  set(image, column, 26, 2.0F);
  const auto nearest = [&](int rows) {
    DepthBand band;
    band.scan_height = rows;
    const auto scan = depth_to_scan(image, camera(), band);
    float found = std::numeric_limits<float>::infinity();
    for (const float range : scan.ranges) found = std::fmin(found, range);
    return found;
  };
  EXPECT_NEAR(nearest(1), 3.0, 0.01);
  EXPECT_NEAR(nearest(8), 1.0, 0.01);  // rows 19 to 26
  EXPECT_NEAR(nearest(kHeight), 1.0, 0.01);
}

TEST(DepthToScan, TooFarIsInfiniteAndTooNearIsNothing) {
  EXPECT_TRUE(std::isinf(depth_to_scan(image_of<float>("32FC1", 20.0F), camera(), {}).ranges.back()));
  EXPECT_TRUE(std::isinf(depth_to_scan(image_of<float>("32FC1", INFINITY), camera(), {}).ranges.back()));
  EXPECT_TRUE(std::isnan(depth_to_scan(image_of<float>("32FC1", 0.1F), camera(), {}).ranges.back()));
  EXPECT_TRUE(std::isnan(depth_to_scan(image_of<std::uint16_t>("16UC1", 0), camera(), {}).ranges.back()));
}

TEST(DepthToScan, RefusesWhatItCannotRead) {
  const auto refused = [](const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info, DepthBand band) {
    EXPECT_THROW(depth_to_scan(image, info, band), std::invalid_argument);
  };
  const auto good = image_of<float>("32FC1", 2.0F);
  auto image = good;
  image.encoding = "rgb8";
  refused(image, camera(), {});
  image = good;
  image.data.resize(100);
  refused(image, camera(), {});
  image = good;
  image.step = 8;
  refused(image, camera(), {});
  DepthBand band;
  band.scan_height = kHeight + 1;
  refused(good, camera(), band);
  refused(good, sensor_msgs::CameraInfo(), {});
}

TEST(DepthBand, StatesWhatNoBandCanBe) {
  check(DepthBand{});
  for (const DepthBand& band : {DepthBand{0, 0.1, 0.4, 10.0}, DepthBand{1, -1.0, 0.4, 10.0},
                                DepthBand{1, 0.1, -0.4, 10.0}, DepthBand{1, 0.1, 4.0, 4.0}})
    EXPECT_THROW(check(band), std::invalid_argument);
}

}  // namespace
}  // namespace bubblesim
