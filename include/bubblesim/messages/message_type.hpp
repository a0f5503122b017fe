// SPDX-License-Identifier: BSD-3-Clause
// Description of a ROS message type: written by the generator, used by the codec, announced by the bridge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {

/// The version of ROS whose names, fields and bytes a type has. Most types exist in both, some with other fields.
enum class RosVersion : std::uint8_t { kRos1 = 1, kRos2 = 2 };

constexpr Layout layout_of(RosVersion version) { return version == RosVersion::kRos2 ? Layout::kCdr : Layout::kPacked; }

/// Wire format of one value of a field (http://wiki.ros.org/msg, "Field Types").
enum class FieldKind : std::uint8_t {
  kBool,
  kInt8,
  kUint8,  ///< also `char`
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
  kString,    ///< uint32 length, then bytes; in CDR the last byte is 0
  kTime,      ///< uint32 secs, uint32 nsecs; in ROS 2 like kDuration
  kDuration,  ///< int32 secs, int32 nsecs
  kMessage,   ///< the fields of another type, in order
};

enum class ArrayKind : std::uint8_t {
  kNone,
  kFixed,     ///< `T[n]`: n values, no length on the wire
  kVariable,  ///< `T[]`: uint32 count, then the values
};

struct MessageType;

struct Field {
  std::string name;
  FieldKind kind = FieldKind::kBool;
  ArrayKind array = ArrayKind::kNone;
  std::uint32_t fixed_length = 0;        ///< of a kFixed array
  std::uint32_t bound = 0;               ///< in ROS 2, the most values of a kVariable array; 0: any number
  std::uint32_t string_bound = 0;        ///< in ROS 2, the most bytes of a string; 0: any number
  const MessageType* message = nullptr;  ///< of a kMessage field; owned by the registry
  /// Index of `name` among all field names known to the process (see field_key()). Adapters keep their own form of the
  /// name, such as an interned Python string, in a table under this index.
  std::uint32_t key = 0;
  /// In ROS 2 a definition may give a default: the bytes of its numbers, or strings that end with 0 each. Empty: 0, "".
  std::string default_value{};
};

struct Constant {
  std::string name;
  std::variant<bool, std::int64_t, std::uint64_t, double, std::string> value;
};

/// A message, or the request or response of a service. Once returned by the registry, it lives as long as the process.
struct MessageType {
  std::string name;       ///< `geometry_msgs/Twist`; of a service: `std_srvs/SetBoolRequest` (ROS 2: `SetBool_Request`)
  std::string type_hash;  ///< the MD5 of ROS 1, or `RIHS01_...` of ROS 2; peers compare it
  std::string definition;   ///< full text with nested types, as bags store it
  bool has_header = false;  ///< first field is std_msgs/Header: roscpp writes its sequence number
  std::vector<Field> fields;
  std::vector<Constant> constants;
  RosVersion version = RosVersion::kRos1;
};

struct ServiceType {
  std::string name;  ///< `std_srvs/SetBool`
  std::string type_hash;
  const MessageType* request = nullptr;
  const MessageType* response = nullptr;
};

/// Bytes of one value of a kind; 0 when the size depends on the value (strings, messages).
constexpr std::uint32_t wire_size(FieldKind kind) {
  constexpr std::uint8_t kSizes[] = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 0, 8, 8, 0};  // in the order of FieldKind
  return kSizes[static_cast<std::size_t>(kind)];
}

/// The multiple at which a value of a kind begins in CDR; 1 for messages, whose first value has its own.
constexpr std::uint32_t alignment(FieldKind kind) {
  if (kind <= FieldKind::kFloat64) return wire_size(kind);
  return kind == FieldKind::kMessage ? 1 : sizeof(std::uint32_t);  // lengths, seconds
}

/// Least bytes of a message, a field or one element of an array field, without those for alignment. In the layout of
/// ROS 1 these are the bytes of the default value.
std::size_t minimum_size(const MessageType& type);
std::size_t minimum_size(const Field& field);
std::size_t minimum_element_size(const Field& field);

/// Appends the default value of a message or a field: that of its definition, or 0, false, "", time 0, no elements.
void put_default(const MessageType& type, WireBuffer& out);
void put_default(const Field& field, WireBuffer& out);

/// The .msg spelling of a kind: "float32"; "message" for kMessage.
std::string_view kind_name(FieldKind kind);

/// The .msg spelling of a field's type: "geometry_msgs/Point", "float64[36]", "string[]"; in ROS 2 also
/// "float64[<=3]", "string<=5".
std::string type_text(const Field& field);

/// The kind with that spelling; std::invalid_argument for an unknown spelling.
FieldKind kind_of(std::string_view name);

}  // namespace bubblesim::messages
