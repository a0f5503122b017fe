// SPDX-License-Identifier: BSD-3-Clause
// The layout of ROS 2: the expected bytes are those of the specification (OMG DDS-XTypes 1.3, 7.4.1: PLAIN_CDR).
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bubblesim/messages/fields.hpp"
#include "bubblesim/messages/number_fields.hpp"
#include "bubblesim/messages/registry.hpp"

namespace bubblesim::messages::cdr {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const WireBuffer& buffer) { return {buffer.data(), buffer.data() + buffer.size()}; }

class Made final : public FieldReader {
 public:
  explicit Made(std::function<void(Fields&)> put) : put_(std::move(put)) {}
  void read(Fields& fields) const override { put_(fields); }

 private:
  std::function<void(Fields&)> put_;
};

/// A type of ROS 2 with these fields, under a name of its own.
const MessageType& type_with(const std::string& name, std::vector<Field> fields) {
  return add_message({"cdr_msgs/" + name, "hash of " + name, "", false, std::move(fields), {}, RosVersion::kRos2});
}

Field field(const std::string& name, FieldKind kind, ArrayKind array = ArrayKind::kNone, std::uint32_t length = 0,
            const MessageType* message = nullptr) {
  Field field;
  field.name = name;
  field.kind = kind;
  field.array = array;
  field.fixed_length = length;
  field.message = message;
  return field;
}

Bytes encoded(const MessageType& type, std::function<void(Fields&)> put) {
  WireBuffer bytes;
  encode(type, Made(std::move(put)), bytes);
  return bytes_of(bytes);
}

TEST(Cdr, NumbersBeginAtMultiplesOfTheirSize) {
  const MessageType& type = type_with(
      "Numbers", {field("a", FieldKind::kUint8), field("b", FieldKind::kFloat64), field("c", FieldKind::kInt16)});
  const Bytes expected{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f, 2, 0};
  EXPECT_EQ(encoded(type,
                    [](Fields& fields) {
                      fields.put("a", 1);
                      fields.put("b", 1.0);
                      fields.put("c", 2);
                    }),
            expected);
}

TEST(Cdr, StringsEndWithZeroWhichTheirLengthCounts) {
  const MessageType& type = type_with("Strings", {field("a", FieldKind::kString), field("b", FieldKind::kString)});
  EXPECT_EQ(encoded(type, [](Fields& fields) { fields.put("a", "xy"); }),
            (Bytes{3, 0, 0, 0, 'x', 'y', 0, 0, 1, 0, 0, 0, 0}));
}

TEST(Cdr, AnEmptySequenceHasNoPaddingForItsElements) {
  const std::vector<Field> fields{field("a", FieldKind::kFloat64, ArrayKind::kVariable),
                                  field("b", FieldKind::kUint32)};
  const MessageType& type = type_with("Sequence", fields);
  EXPECT_EQ(encoded(type, [](Fields& put) { put.put("b", 7); }), (Bytes{0, 0, 0, 0, 7, 0, 0, 0}));
  const std::vector<double> one{1.0};
  const Bytes expected{1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f, 7, 0, 0, 0};
  EXPECT_EQ(encoded(type,
                    [&](Fields& put) {
                      put.array("a", one);
                      put.put("b", 7);
                    }),
            expected);
}

TEST(Cdr, AMessageWithoutFieldsIsOneByte) {
  const MessageType& empty = type_with("Nothing", {});
  const MessageType& outer =
      type_with("Outer", {field("a", FieldKind::kMessage, ArrayKind::kNone, 0, &empty), field("b", FieldKind::kUint8)});
  EXPECT_EQ(encoded(outer, [](Fields& fields) { fields.put("b", 5); }), (Bytes{0, 5}));
}

TEST(Cdr, DefaultsAreAlignedToo) {
  const MessageType& inner = type_with("Inner", {field("x", FieldKind::kFloat32), field("y", FieldKind::kString)});
  const MessageType& type = type_with("Defaults", {field("a", FieldKind::kUint8), field("t", FieldKind::kTime),
                                                   field("m", FieldKind::kMessage, ArrayKind::kFixed, 2, &inner)});
  WireBuffer bytes;
  bytes.begin(Layout::kCdr);
  put_default(type, bytes);
  Bytes expected(4 + 8, 0);                                                              // a, padding, t
  for (const std::uint8_t byte : {0, 0, 0, 0, 1, 0, 0, 0, 0}) expected.push_back(byte);  // x, y
  for (int i = 0; i < 3; ++i) expected.push_back(0);                                     // padding
  for (const std::uint8_t byte : {0, 0, 0, 0, 1, 0, 0, 0, 0}) expected.push_back(byte);
  EXPECT_EQ(bytes_of(bytes), expected);
}

TEST(Cdr, ReadingSkipsWhatWritingPads) {
  WireBuffer out;
  out.begin(Layout::kCdr);
  out.put(std::uint8_t{3});
  out.put(2.5);
  out.put(std::uint16_t{4});
  out.put(std::uint32_t{5});
  WireView view(out.data(), out.size());
  view.begin(Layout::kCdr);
  EXPECT_EQ(view.get<std::uint8_t>(), 3);
  EXPECT_EQ(view.get<double>(), 2.5);
  EXPECT_EQ(view.get<std::uint16_t>(), 4);
  EXPECT_EQ(view.get<std::uint32_t>(), 5U);
  EXPECT_EQ(view.left(), 0U);
}

TEST(Cdr, ReadingPastTheEndIsAnErrorAlsoInPadding) {
  const Bytes bytes{1, 0, 0};
  WireView view(bytes.data(), bytes.size());
  view.begin(Layout::kCdr);
  view.get<std::uint8_t>();
  EXPECT_THROW(view.get<double>(), WireError);
}

TEST(Cdr, NumbersAreReadWithPaddingAndTolerateThatOfTheEnd) {
  const MessageType& type = type_with(
      "Mixed", {field("a", FieldKind::kUint8), field("b", FieldKind::kFloat64), field("c", FieldKind::kUint8)});
  const NumberFields numbers(type, {"c", "b"});
  Bytes bytes = encoded(type, [](Fields& fields) {
    fields.put("b", 1.5);
    fields.put("c", 9);
  });
  EXPECT_EQ(numbers.read(WireView(bytes.data(), bytes.size())), (std::vector<double>{9, 1.5}));
  bytes.insert(bytes.end(), 3, 0);
  EXPECT_EQ(numbers.read(WireView(bytes.data(), bytes.size())), (std::vector<double>{9, 1.5}));
  EXPECT_THROW(numbers.read(WireView(bytes.data(), bytes.size() - 4)), WireError);
}

TEST(Versions, KeepTypesOfOneNameApart) {
  const MessageType* ros1 = find_message("geometry_msgs/Twist");
  const MessageType& ros2 =
      add_message({"cdr_msgs/Both", "hash 2", "", false, {field("b", FieldKind::kUint8)}, {}, RosVersion::kRos2});
  const MessageType& other = add_message({"cdr_msgs/Both", "hash 1", "", false, {}, {}, RosVersion::kRos1});
  EXPECT_EQ(ros1->version, RosVersion::kRos1);
  EXPECT_NE(&ros2, &other);
  EXPECT_EQ(find_message("cdr_msgs/msg/Both", RosVersion::kRos2), &ros2);
  EXPECT_EQ(find_message("cdr_msgs/msg/Both"), &other);
}

}  // namespace
}  // namespace bubblesim::messages::cdr
