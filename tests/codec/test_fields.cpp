// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bubblesim/messages/fields.hpp"
#include "bubblesim/messages/registry.hpp"

namespace bubblesim::messages {
namespace {

class Made final : public FieldReader {
 public:
  explicit Made(std::function<void(Fields&)> put) : put_(std::move(put)) {}
  void read(Fields& fields) const override { put_(fields); }

 private:
  std::function<void(Fields&)> put_;
};

/// The bytes of a message, to be read from the front.
class Encoded {
 public:
  Encoded(const std::string& type, std::function<void(Fields&)> put) : view_(nullptr, 0) {
    encode(*find_message(type), Made(std::move(put)), bytes_);
    view_ = WireView(bytes_.data(), bytes_.size());
  }

  template <class T>
  T next() {
    return view_.get<T>();
  }
  std::string next_string() {
    const auto size = next<std::uint32_t>();
    return {reinterpret_cast<const char*>(view_.take(size)), size};
  }
  std::size_t left() const { return view_.left(); }

 private:
  WireBuffer bytes_;
  WireView view_;
};

void put_vector(Fields& fields, double x, double y, double z) {
  fields.put("x", x);
  fields.put("y", y);
  fields.put("z", z);
}

TEST(Fields, AreWrittenInTheOrderOfTheType) {
  Encoded twist("geometry_msgs/Twist", [](Fields& fields) {
    fields.message("angular", [&] {
      fields.put("z", 6.0);
      fields.put("y", 5.0);
      fields.put("x", 4.0);
    });
    fields.message("linear", [&] { put_vector(fields, 1, 2, 3); });
  });
  for (double expected = 1; expected <= 6; ++expected) EXPECT_EQ(twist.next<double>(), expected);
  EXPECT_EQ(twist.left(), 0U);
}

TEST(Fields, ThatAreMissingHaveTheirDefault) {
  Encoded scan("sensor_msgs/LaserScan", [](Fields& fields) { fields.put("angle_max", 1.5); });
  EXPECT_EQ(scan.next<std::uint32_t>(), 0U);  // header: seq
  EXPECT_EQ(scan.next<std::uint64_t>(), 0U);
  EXPECT_EQ(scan.next_string(), "");
  EXPECT_EQ(scan.next<float>(), 0.0F);
  EXPECT_EQ(scan.next<float>(), 1.5F);
  EXPECT_EQ(scan.left(), 5 * sizeof(float) + 2 * sizeof(std::uint32_t));
}

TEST(Fields, OfAnotherVersionOfTheTypeAreIgnored) {
  Encoded number("std_msgs/Float64", [](Fields& fields) {
    fields.put("variance", 1.0);
    fields.put("data", 2.5);
    fields.message("more", [&] { fields.put("data", 3.5); });
  });
  EXPECT_EQ(number.next<double>(), 2.5);
  EXPECT_EQ(number.left(), 0U);
}

TEST(Fields, TakeTimesStringsAndArrays) {
  const std::vector<std::string> names{"left", "right"};
  const std::vector<double> positions{1, 2};
  Encoded state("sensor_msgs/JointState", [&](Fields& fields) {
    fields.message("header", [&] {
      fields.put("stamp", Stamp{7, 8});
      fields.put("frame_id", fields.keep(std::string(40, 'f')));
    });
    fields.put("name", names);
    fields.array("position", positions);
    fields.array("velocity", std::array{3.0});
  });
  EXPECT_EQ(state.next<std::uint32_t>(), 0U);
  EXPECT_EQ(state.next<std::uint32_t>(), 7U);
  EXPECT_EQ(state.next<std::uint32_t>(), 8U);
  EXPECT_EQ(state.next_string(), std::string(40, 'f'));
  EXPECT_EQ(state.next<std::uint32_t>(), 2U);
  EXPECT_EQ(state.next_string(), "left");
  EXPECT_EQ(state.next_string(), "right");
  EXPECT_EQ(state.next<std::uint32_t>(), 2U);
  EXPECT_EQ(state.next<double>(), 1.0);
  EXPECT_EQ(state.next<double>(), 2.0);
  EXPECT_EQ(state.next<std::uint32_t>(), 1U);
  EXPECT_EQ(state.next<double>(), 3.0);
  EXPECT_EQ(state.next<std::uint32_t>(), 0U);  // effort
  EXPECT_EQ(state.left(), 0U);
}

TEST(Fields, TakeListsOfMessagesAndTablesOfNumbers) {
  const std::vector<float> corners{1, 2, 3, 4, 5, 6};
  Encoded polygon("geometry_msgs/Polygon", [&](Fields& fields) { fields.array("points", corners); });
  EXPECT_EQ(polygon.next<std::uint32_t>(), 2U);
  for (const float corner : corners) EXPECT_EQ(polygon.next<float>(), corner);
  EXPECT_EQ(polygon.left(), 0U);

  Encoded same("geometry_msgs/Polygon", [](Fields& fields) {
    fields.list("points", std::array{1.0, 4.0}, [&](double x) { put_vector(fields, x, x + 1, x + 2); });
  });
  EXPECT_EQ(same.next<std::uint32_t>(), 2U);
  for (const float corner : corners) EXPECT_EQ(same.next<float>(), corner);
  EXPECT_EQ(same.left(), 0U);
}

TEST(Fields, MayBeFilledInPlaceBeforeALaterFlag) {
  Encoded cloud("sensor_msgs/PointCloud2", [](Fields& fields) {
    const auto dense = std::make_shared<bool>(false);
    fields.put("is_dense", std::shared_ptr<const bool>(dense));
    fields.array("data", FieldKind::kUint8, 3, [dense](std::uint8_t* place) {
      for (std::uint8_t i = 0; i < 3; ++i) place[i] = i;
      *dense = true;
    });
  });
  while (cloud.left() > 4) cloud.next<std::uint8_t>();
  for (std::uint8_t i = 0; i < 3; ++i) EXPECT_EQ(cloud.next<std::uint8_t>(), i);
  EXPECT_EQ(cloud.next<std::uint8_t>(), 1);
}

std::string refusal(const std::string& type, const std::function<void(Fields&)>& put) {
  WireBuffer bytes;
  try {
    encode(*find_message(type), Made(put), bytes);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(Fields, ThatDoNotFitAreRefusedWithTheirName) {
  EXPECT_EQ(refusal("std_msgs/UInt8", [](Fields& fields) { fields.put("data", 256); }),
            "std_msgs/UInt8: data: expected uint8, found 256");
  EXPECT_EQ(refusal("std_msgs/UInt64", [](Fields& fields) { fields.put("data", -1); }),
            "std_msgs/UInt64: data: expected uint64, found -1");
  EXPECT_EQ(refusal("std_msgs/Int32", [](Fields& fields) { fields.put("data", 1.5); }),
            "std_msgs/Int32: data: expected int32, found a number with a fraction");
  EXPECT_EQ(refusal("std_msgs/String", [](Fields& fields) { fields.put("data", 1); }),
            "std_msgs/String: data: expected string, found a number");
  EXPECT_EQ(refusal("sensor_msgs/Imu",
                    [](Fields& fields) {
                      fields.array("orientation_covariance", std::array{1.0, 2.0});
                    }),
            "sensor_msgs/Imu: orientation_covariance: expected float64[9], found 2 elements");
  EXPECT_EQ(refusal("sensor_msgs/Image",
                    [](Fields& fields) {
                      fields.array("data", std::array{1.0, 2.0});
                    }),
            "sensor_msgs/Image: data: expected uint8[], found an array of 2 float64");
}

TEST(Fields, OfTheSmallestAndLargestIntegersFit) {
  Encoded least("std_msgs/Int8", [](Fields& fields) { fields.put("data", -128); });
  EXPECT_EQ(least.next<std::int8_t>(), -128);
  Encoded most("std_msgs/UInt32", [](Fields& fields) { fields.put("data", 4294967295U); });
  EXPECT_EQ(most.next<std::uint32_t>(), 4294967295U);
}

}  // namespace
}  // namespace bubblesim::messages
