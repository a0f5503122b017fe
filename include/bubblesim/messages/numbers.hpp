// SPDX-License-Identifier: BSD-3-Clause
// The C++ types of bools and numbers in messages.
#pragma once

#include <cstdint>
#include <type_traits>

#include "bubblesim/messages/message_type.hpp"

namespace bubblesim::messages {

inline bool is_number(FieldKind kind) { return kind <= FieldKind::kFloat64; }

/// The kind of a C++ type.
template <class Number>
constexpr FieldKind kind_of_number() {
  if constexpr (std::is_same_v<Number, bool>) return FieldKind::kBool;
  if constexpr (std::is_floating_point_v<Number>) {
    return sizeof(Number) == 4 ? FieldKind::kFloat32 : FieldKind::kFloat64;
  }
  switch (sizeof(Number)) {
    case 1:
      return std::is_signed_v<Number> ? FieldKind::kInt8 : FieldKind::kUint8;
    case 2:
      return std::is_signed_v<Number> ? FieldKind::kInt16 : FieldKind::kUint16;
    case 4:
      return std::is_signed_v<Number> ? FieldKind::kInt32 : FieldKind::kUint32;
    default:
      return std::is_signed_v<Number> ? FieldKind::kInt64 : FieldKind::kUint64;
  }
}

/// Calls `action` with a zero of the C++ type of a kind of numbers.
template <class Action>
auto with_number(FieldKind kind, Action action) {
  switch (kind) {
    case FieldKind::kBool:
      return action(bool{});
    case FieldKind::kInt8:
      return action(std::int8_t{});
    case FieldKind::kUint8:
      return action(std::uint8_t{});
    case FieldKind::kInt16:
      return action(std::int16_t{});
    case FieldKind::kUint16:
      return action(std::uint16_t{});
    case FieldKind::kInt32:
      return action(std::int32_t{});
    case FieldKind::kUint32:
      return action(std::uint32_t{});
    case FieldKind::kInt64:
      return action(std::int64_t{});
    case FieldKind::kUint64:
      return action(std::uint64_t{});
    case FieldKind::kFloat32:
      return action(float{});
    default:
      return action(double{});
  }
}

}  // namespace bubblesim::messages
