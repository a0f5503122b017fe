// SPDX-License-Identifier: BSD-3-Clause
// Description of a ROS message type: written by the generator, used by the codec, announced by the bridge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace bubblesim::messages {

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
  kString,    ///< uint32 length, then bytes
  kTime,      ///< uint32 secs, uint32 nsecs
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
  const MessageType* message = nullptr;  ///< of a kMessage field; owned by the registry
  /// Index of `name` among all field names known to the process (see field_key()). Adapters keep their own form of the
  /// name, such as an interned Python string, in a table under this index.
  std::uint32_t key = 0;
};

struct Constant {
  std::string name;
  std::variant<bool, std::int64_t, std::uint64_t, double, std::string> value;
};

/// A message, or the request or response of a service. Once returned by the registry, it lives as long as the process.
struct MessageType {
  std::string name;         ///< `geometry_msgs/Twist`; of a service: `std_srvs/SetBoolRequest`
  std::string md5;          ///< as genmsg computes it; peers compare it when they connect
  std::string definition;   ///< full text with nested types, as rosbag stores it
  bool has_header = false;  ///< first field is std_msgs/Header: roscpp writes its sequence number
  std::vector<Field> fields;
  std::vector<Constant> constants;
};

struct ServiceType {
  std::string name;  ///< `std_srvs/SetBool`
  std::string md5;
  const MessageType* request = nullptr;
  const MessageType* response = nullptr;
};

/// Bytes of one value of a kind; 0 when the size depends on the value (strings, messages).
std::uint32_t wire_size(FieldKind kind);

/// Bytes of a message, a field or one element of an array field with its default value. This is the minimum size. The
/// defaults are all zero bytes: 0, false, "", time 0, no elements.
std::size_t default_size(const MessageType& type);
std::size_t default_size(const Field& field);
std::size_t default_element_size(const Field& field);

/// The .msg spelling of a kind: "float32"; "message" for kMessage.
std::string_view kind_name(FieldKind kind);

/// The .msg spelling of a field's type: "geometry_msgs/Point", "float64[36]", "string[]".
std::string type_text(const Field& field);

/// The kind with that spelling; std::invalid_argument for an unknown spelling.
FieldKind kind_of(std::string_view name);

}  // namespace bubblesim::messages
