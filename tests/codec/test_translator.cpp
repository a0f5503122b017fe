// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS 1 as those of ROS 2 and back. The bytes are written by hand, by the specifications of both layouts.
#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "bubblesim/messages/registry.hpp"
#include "bubblesim/messages/translator.hpp"

namespace bubblesim::messages {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes translated(const MessageType& from, const MessageType& to, const Bytes& bytes) {
  const WireBuffer result = Translator(from, to).translate(WireView(bytes.data(), bytes.size()));
  return {result.data(), result.data() + result.size()};
}

Field field(const std::string& name, FieldKind kind, ArrayKind array = ArrayKind::kNone,
            const MessageType* message = nullptr) {
  Field made;
  made.name = name;
  made.kind = kind;
  made.array = array;
  made.message = message;
  return made;
}

MessageType type(RosVersion version, std::vector<Field> fields) {
  MessageType made;
  made.name = "a_msgs/A";
  made.version = version;
  made.fields = std::move(fields);
  return made;
}

TEST(Translator, AlignsNumbersAndEndsStringsForRos2) {
  const std::vector<Field> fields{field("small", FieldKind::kUint8), field("name", FieldKind::kString),
                                  field("value", FieldKind::kFloat64)};
  const MessageType one = type(RosVersion::kRos1, fields);
  const MessageType two = type(RosVersion::kRos2, fields);
  const Bytes packed{7, 2, 0, 0, 0, 'h', 'i', 0, 0, 0, 0, 0, 0, 0xF0, 0x3F};
  const Bytes cdr{7,   0,   0, 0, 3, 0, 0,    0,      // the length begins at 4
                  'h', 'i', 0, 0, 0, 0, 0,    0,      // the string ends at 11
                  0,   0,   0, 0, 0, 0, 0xF0, 0x3F};  // the number begins at 16
  EXPECT_EQ(translated(one, two, packed), cdr);
  EXPECT_EQ(translated(two, one, cdr), packed);
}

TEST(Translator, LeavesOutAndFillsInWhatOneSideHas) {
  const MessageType one = type(RosVersion::kRos1, {field("seq", FieldKind::kUint32), field("D", FieldKind::kUint8)});
  const MessageType two =
      type(RosVersion::kRos2, {field("d", FieldKind::kUint8), field("variance", FieldKind::kFloat32)});
  EXPECT_EQ(translated(one, two, {1, 2, 3, 4, 5}), (Bytes{5, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(translated(two, one, {5, 0, 0, 0, 0, 0, 0x80, 0x3F}), (Bytes{0, 0, 0, 0, 5}));
}

TEST(Translator, TranslatesArraysOfMessages) {
  const MessageType point1 = type(RosVersion::kRos1, {field("x", FieldKind::kInt16), field("t", FieldKind::kTime)});
  const MessageType point2 = type(RosVersion::kRos2, {field("x", FieldKind::kInt16), field("t", FieldKind::kTime)});
  const MessageType one =
      type(RosVersion::kRos1, {field("points", FieldKind::kMessage, ArrayKind::kVariable, &point1)});
  const MessageType two =
      type(RosVersion::kRos2, {field("points", FieldKind::kMessage, ArrayKind::kVariable, &point2)});
  const Bytes packed{2, 0, 0, 0, 1, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4, 0, 5, 0, 0, 0, 6, 0, 0, 0};
  const Bytes cdr{2, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0, 5, 0, 0, 0, 6, 0, 0, 0};
  EXPECT_EQ(translated(one, two, packed), cdr);
  EXPECT_EQ(translated(two, one, cdr), packed);
}

TEST(Translator, RefusesWrongBytes) {
  const std::vector<Field> fields{field("values", FieldKind::kFloat64, ArrayKind::kVariable)};
  const MessageType one = type(RosVersion::kRos1, fields);
  const MessageType two = type(RosVersion::kRos2, fields);
  EXPECT_THROW(translated(one, two, {1, 0, 0}), WireError);
  EXPECT_THROW(translated(one, two, {255, 255, 255, 255}), WireError);
  EXPECT_THROW(translated(one, two, {0, 0, 0, 0, 9}), WireError);
  EXPECT_THROW(translated(two, one, {255, 255, 255, 255, 0}), WireError);
}

TEST(Translator, RefusesTypesWhoseFieldsDoNotFit) {
  const MessageType one = type(RosVersion::kRos1, {field("value", FieldKind::kInt32)});
  const MessageType two = type(RosVersion::kRos2, {field("value", FieldKind::kString)});
  EXPECT_THROW(Translator(one, two), std::invalid_argument);
}

TEST(Translator, KnowsAllListedTypesOfBothSides) {
  for (const std::string& name : message_names(RosVersion::kRos2)) {
    const MessageType* one = find_message(name, RosVersion::kRos1);
    if (one == nullptr) continue;
    const MessageType& two = *find_message(name, RosVersion::kRos2);
    WireBuffer empty;
    empty.begin(Layout::kPacked);
    put_default(*one, empty);
    const WireBuffer there = Translator(*one, two).translate(WireView(empty.data(), empty.size()));
    const WireBuffer back = Translator(two, *one).translate(WireView(there.data(), there.size()));
    EXPECT_EQ(back.size(), empty.size()) << name;
  }
}

}  // namespace
}  // namespace bubblesim::messages
