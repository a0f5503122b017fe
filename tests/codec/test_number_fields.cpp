// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "bubblesim/messages/number_fields.hpp"
#include "bubblesim/messages/registry.hpp"

namespace bubblesim::messages {
namespace {

NumberFields fields(const std::string& type, const std::vector<std::string>& paths) {
  return {*find_message(type), paths};
}

std::vector<double> read(const NumberFields& numbers, const WireBuffer& bytes) {
  return numbers.read(WireView(bytes.data(), bytes.size()));
}

TEST(NumberFields, AreReadInTheOrderOfTheirPaths) {
  WireBuffer twist;
  for (double number = 1; number <= 6; ++number) twist.put(number);
  const NumberFields numbers = fields("geometry_msgs/Twist", {"angular.z", "linear.x", "linear.y"});
  EXPECT_EQ(read(numbers, twist), (std::vector<double>{6, 1, 2}));
}

TEST(NumberFields, MayBeOfAnyKind) {
  WireBuffer cliff;  // kobuki_msgs/CliffEvent: uint8 sensor, uint8 state, uint16 bottom
  cliff.put(std::uint8_t{2});
  cliff.put(std::uint8_t{1});
  cliff.put(std::uint16_t{50000});
  EXPECT_EQ(read(fields("kobuki_msgs/CliffEvent", {"bottom", "sensor"}), cliff), (std::vector<double>{50000, 2}));
}

TEST(NumberFields, OfMessagesOfAnotherSizeAreRefused) {
  WireBuffer twist;
  for (int i = 0; i < 5; ++i) twist.put(1.0);
  const NumberFields numbers = fields("geometry_msgs/Twist", {"linear.x"});
  EXPECT_THROW(read(numbers, twist), WireError);
  twist.put(1.0);
  EXPECT_NO_THROW(read(numbers, twist));
  twist.put(1.0);
  EXPECT_THROW(read(numbers, twist), WireError);
}

TEST(NumberFields, ThatAreNoNumbersAreRefused) {
  for (const char* path : {"linear", "linear.w", "middle.x", "linear.x.y", ""}) {
    EXPECT_THROW(fields("geometry_msgs/Twist", {path}), std::invalid_argument) << path;
  }
  EXPECT_THROW(fields("sensor_msgs/Imu", {"orientation.x"}), std::invalid_argument) << "its header has a string";
}

}  // namespace
}  // namespace bubblesim::messages
