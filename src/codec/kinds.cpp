// SPDX-License-Identifier: BSD-3-Clause
// The names of field kinds, the sizes and defaults of fields.
#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/numbers.hpp"

namespace bubblesim::messages {
namespace {

// In the order of FieldKind.
constexpr std::array<std::string_view, 15> kNames{"bool",    "int8",   "uint8", "int16",    "uint16",
                                                  "int32",   "uint32", "int64", "uint64",   "float32",
                                                  "float64", "string", "time",  "duration", "message"};

/// In CDR.
void put_given_default(const Field& field, WireBuffer& out) {
  const std::string_view value = field.default_value;
  const bool is_text = field.kind == FieldKind::kString;
  if (field.array == ArrayKind::kVariable) {
    const std::ptrdiff_t strings = std::count(value.begin(), value.end(), '\0');
    out.put(
        static_cast<std::uint32_t>(is_text ? static_cast<std::size_t>(strings) : value.size() / wire_size(field.kind)));
  }
  if (!is_text) {
    out.align(alignment(field.kind));
    out.put_bytes(value.data(), value.size());
    return;
  }
  for (std::size_t at = 0; at < value.size();) {
    const std::size_t end = value.find('\0', at);
    out.put_string(value.substr(at, end - at));
    at = end == value.npos ? end : end + 1;
  }
}

}  // namespace

std::string_view kind_name(FieldKind kind) { return kNames[static_cast<std::size_t>(kind)]; }

std::string type_text(const Field& field) {
  std::string base = field.message != nullptr ? field.message->name : std::string(kind_name(field.kind));
  if (field.string_bound != 0) base += "<=" + std::to_string(field.string_bound);
  switch (field.array) {
    case ArrayKind::kFixed:
      return base + "[" + std::to_string(field.fixed_length) + "]";
    case ArrayKind::kVariable:
      return base + (field.bound != 0 ? "[<=" + std::to_string(field.bound) + "]" : "[]");
    default:
      return base;
  }
}

FieldKind kind_of(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) throw std::invalid_argument("'" + std::string(name) + "' is not a kind of field");
  return static_cast<FieldKind>(found - kNames.begin());
}

std::size_t minimum_size(const MessageType& type) {
  std::size_t size = 0;
  for (const Field& field : type.fields) size += minimum_size(field);
  return size;
}

std::size_t minimum_element_size(const Field& field) {
  if (field.kind == FieldKind::kMessage) return minimum_size(*field.message);
  if (field.kind == FieldKind::kString) return sizeof(std::uint32_t);
  return wire_size(field.kind);
}

std::size_t minimum_size(const Field& field) {
  if (field.array == ArrayKind::kVariable) return sizeof(std::uint32_t);
  return minimum_element_size(field) * (field.array == ArrayKind::kFixed ? field.fixed_length : 1);
}

void put_default(const MessageType& type, WireBuffer& out) {
  if (type.fields.empty()) out.put_empty();
  for (const Field& field : type.fields) put_default(field, out);
}

void put_default(const Field& field, WireBuffer& out) {
  if (is_number(field.kind) && field.array == ArrayKind::kNone && field.default_value.empty()) {
    // Most fields: their zeros have a size that is known here, which is faster.
    if (wire_size(field.kind) == sizeof(std::uint64_t)) return out.put(std::uint64_t{0});
    if (wire_size(field.kind) == sizeof(std::uint32_t)) return out.put(std::uint32_t{0});
  }
  if (out.layout() == Layout::kPacked) {
    const std::size_t size = minimum_size(field);
    if (size != 0) std::memset(out.extend(size), 0, size);
    return;
  }
  if (!field.default_value.empty()) return put_given_default(field, out);
  if (field.array == ArrayKind::kVariable) {
    out.put(std::uint32_t{0});
    return;
  }
  const std::uint32_t count = field.array == ArrayKind::kFixed ? field.fixed_length : 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (field.kind == FieldKind::kMessage) {
      put_default(*field.message, out);
    } else if (field.kind == FieldKind::kString) {
      out.put_string({});
    } else {
      out.align(alignment(field.kind));
      std::memset(out.extend(wire_size(field.kind)), 0, wire_size(field.kind));
    }
  }
}

}  // namespace bubblesim::messages
