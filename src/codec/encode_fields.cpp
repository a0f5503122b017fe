// SPDX-License-Identifier: BSD-3-Clause
// Writes named values in the order of a type's fields.
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "bubblesim/messages/fields.hpp"

namespace bubblesim::messages {
namespace {

[[noreturn]] void throw_unfit(const MessageType& type, const Field& field, const std::string& given) {
  throw std::invalid_argument(type.name + ": " + field.name + ": expected " + type_text(field) + ", found " + given);
}

/// Numbers of one kind in each element of an array: 1 for numbers, those of a message such as Point32; 0 if it has
/// others.
std::size_t numbers_per_element(const Field& field, FieldKind kind) {
  if (field.kind == kind) return 1;
  if (field.kind != FieldKind::kMessage) return 0;
  for (const Field& column : field.message->fields) {
    if (column.kind != kind || column.array != ArrayKind::kNone) return 0;
  }
  return field.message->fields.size();
}

}  // namespace

void Fields::add(std::string_view name, const Value& value) { nodes_.push_back({name, value, nodes_.size() + 1}); }

class FieldEncoder {
 public:
  FieldEncoder(const Fields& fields, WireBuffer& out) : fields_(fields), out_(out) {}

  void message(const MessageType& type) { message(type, 0, fields_.nodes_.size()); }

 private:
  using Node = Fields::Node;

  const Node& node(std::size_t at) const { return fields_.nodes_[at]; }

  /// Of the nodes from `begin` to `end`, on one level.
  void message(const MessageType& type, std::size_t begin, std::size_t end) {
    if (type.fields.empty()) out_.put_empty();
    std::size_t expected = begin;  // usually they have the order of the type
    for (const Field& field : type.fields) {
      const std::size_t found = find(field.name, expected, begin, end);
      if (found == end) {
        put_default(field, out_);
      } else {
        put(type, field, found);
        expected = node(found).end;
      }
    }
  }

  std::size_t find(std::string_view name, std::size_t expected, std::size_t begin, std::size_t end) const {
    if (expected < end && node(expected).name == name) return expected;
    for (std::size_t at = begin; at < end; at = node(at).end) {
      if (node(at).name == name) return at;
    }
    return end;
  }

  void put(const MessageType& type, const Field& field, std::size_t at) {
    std::visit([&](const auto& value) { put(type, field, at, value); }, node(at).value);
  }

  void put(const MessageType& type, const Field& field, std::size_t, std::int64_t value) {
    if (!is_single_number(field)) throw_unfit(type, field, "a number");
    with_number(field.kind, [&](auto number) {
      using Number = decltype(number);
      if constexpr (std::is_same_v<Number, bool>) {
        out_.put(static_cast<std::uint8_t>(value != 0 ? 1 : 0));
      } else {
        if constexpr (std::is_integral_v<Number>) {
          const bool fits = static_cast<std::int64_t>(static_cast<Number>(value)) == value;
          if (!fits || (std::is_unsigned_v<Number> && value < 0)) throw_unfit(type, field, std::to_string(value));
        }
        out_.put(static_cast<Number>(value));
      }
    });
  }
  void put(const MessageType& type, const Field& field, std::size_t, double value) {
    if (!is_single_number(field)) throw_unfit(type, field, "a number");
    if (field.kind == FieldKind::kFloat64) {
      out_.put(value);
    } else if (field.kind == FieldKind::kFloat32) {
      out_.put(static_cast<float>(value));
    } else {
      throw_unfit(type, field, "a number with a fraction");
    }
  }
  void put(const MessageType& type, const Field& field, std::size_t at, Fields::Flag flag) {
    put(type, field, at, std::int64_t{*flag.value ? 1 : 0});
  }
  void put(const MessageType& type, const Field& field, std::size_t, std::string_view text) {
    if (field.kind != FieldKind::kString || field.array != ArrayKind::kNone) throw_unfit(type, field, "a string");
    out_.put_string(text);
  }
  void put(const MessageType& type, const Field& field, std::size_t, Stamp stamp) {
    if (field.kind != FieldKind::kTime || field.array != ArrayKind::kNone) throw_unfit(type, field, "a time");
    out_.put(stamp.sec);
    out_.put(stamp.nanosec);
  }
  void put(const MessageType& type, const Field& field, std::size_t, const std::vector<std::string>* strings) {
    if (field.kind != FieldKind::kString || field.array == ArrayKind::kNone) throw_unfit(type, field, "strings");
    begin_array(type, field, strings->size());
    for (const std::string& text : *strings) out_.put_string(text);
  }
  void put(const MessageType& type, const Field& field, std::size_t, const Fields::Array& array) {
    std::uint8_t* place = begin_numbers(type, field, array.kind, array.count);
    if (array.count != 0) std::memcpy(place, array.values, array.count * wire_size(array.kind));
  }
  void put(const MessageType& type, const Field& field, std::size_t, const Fields::FilledArray& array) {
    std::uint8_t* place = begin_numbers(type, field, array.kind, array.count);
    if (array.count != 0) (*array.fill)(place);
  }
  void put(const MessageType& type, const Field& field, std::size_t, Fields::KeptNumbers numbers) {
    std::uint8_t* place = begin_numbers(type, field, FieldKind::kFloat64, numbers.count);
    std::memcpy(place, &fields_.numbers_[numbers.first], numbers.count * sizeof(double));
  }
  void put(const MessageType& type, const Field& field, std::size_t at, Fields::Nested) {
    if (field.kind != FieldKind::kMessage) throw_unfit(type, field, "a message");
    const std::size_t end = node(at).end;
    if (field.array == ArrayKind::kNone) {
      message(*field.message, at + 1, end);
      return;
    }
    std::size_t count = 0;
    for (std::size_t element = at + 1; element < end; element = node(element).end) ++count;
    begin_array(type, field, count);
    for (std::size_t element = at + 1; element < end; element = node(element).end) {
      message(*field.message, element + 1, node(element).end);
    }
  }

  static bool is_single_number(const Field& field) { return is_number(field.kind) && field.array == ArrayKind::kNone; }

  std::uint8_t* begin_numbers(const MessageType& type, const Field& field, FieldKind kind, std::size_t count) {
    const std::size_t columns = numbers_per_element(field, kind);
    if (columns == 0 || count % columns != 0) {
      throw_unfit(type, field, "an array of " + std::to_string(count) + " " + std::string(kind_name(kind)));
    }
    begin_array(type, field, count / columns);
    if (count != 0) out_.align(alignment(kind));
    return out_.extend(count * wire_size(kind));
  }

  void begin_array(const MessageType& type, const Field& field, std::size_t count) {
    const bool fits =
        field.array == ArrayKind::kVariable || (field.array == ArrayKind::kFixed && count == field.fixed_length);
    if (!fits) throw_unfit(type, field, std::to_string(count) + " elements");
    if (field.array == ArrayKind::kVariable) length(count);
  }

  /// The number of elements of a variable array, before them.
  void length(std::size_t count) {
    if (count > std::numeric_limits<std::uint32_t>::max()) {
      throw std::invalid_argument(std::to_string(count) + " elements do not fit into a message");
    }
    out_.put(static_cast<std::uint32_t>(count));
  }

  const Fields& fields_;
  WireBuffer& out_;
};

void encode(const MessageType& type, const FieldReader& message, WireBuffer& out) {
  Fields fields;
  message.read(fields);
  out.begin(layout_of(type.version));
  FieldEncoder(fields, out).message(type);
}

}  // namespace bubblesim::messages
