// SPDX-License-Identifier: BSD-3-Clause
// The fields of a message as names with values, and the bytes made of them. A maker of messages names fields, and knows
// neither their order on the wire nor their layout.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <forward_list>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/numbers.hpp"
#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {

/// A point in time.
struct Stamp {
  std::uint32_t sec = 0;
  std::uint32_t nanosec = 0;
};

/// Named values of a message. A type takes those that it has, and its other fields are zero or empty; so a field that
/// has two names in two versions of a type is given under both. Names, strings and arrays that are not marked as kept
/// belong to the caller until the message is encoded.
class Fields {
 public:
  /// Writes an array to memory of any alignment.
  using Fill = std::function<void(std::uint8_t*)>;

  Fields() { nodes_.reserve(kUsualCount); }
  Fields(const Fields&) = delete;
  Fields& operator=(const Fields&) = delete;

  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  void put(std::string_view name, Number value) {
    if constexpr (std::is_floating_point_v<Number>) {
      add(name, double{value});
    } else {
      add(name, static_cast<std::int64_t>(value));
    }
  }
  void put(std::string_view name, std::string_view text) { add(name, text); }
  void put(std::string_view name, const char* text) { add(name, std::string_view(text)); }
  void put(std::string_view name, Stamp stamp) { add(name, stamp); }
  /// A flag that is set by the Fill of a field that comes before it in the type.
  void put(std::string_view name, std::shared_ptr<const bool> flag) {
    flags_.push_back(std::move(flag));
    add(name, Flag{flags_.back().get()});
  }
  void put(std::string_view name, const std::vector<std::string>& strings) { add(name, &strings); }

  /// An array of numbers; also an array of messages that only hold numbers of that kind, such as Point32.
  template <class Number>
  void array(std::string_view name, const Number* values, std::size_t count) {
    add(name, Array{kind_of_number<Number>(), count, reinterpret_cast<const std::uint8_t*>(values)});
  }
  template <class Number>
  void array(std::string_view name, const std::vector<Number>& values) {
    array(name, values.data(), values.size());
  }
  /// The numbers are kept.
  template <std::size_t count>
  void array(std::string_view name, const std::array<double, count>& values) {
    add(name, KeptNumbers{numbers_.size(), count});
    numbers_.insert(numbers_.end(), values.begin(), values.end());
  }
  /// An array that is written to its place in the message.
  void array(std::string_view name, FieldKind kind, std::size_t count, Fill fill) {
    add(name, FilledArray{kind, count, &fills_.emplace_front(std::move(fill))});
  }

  /// A nested message; `put_fields` puts its fields.
  template <class PutFields>
  void message(std::string_view name, PutFields put_fields) {
    const std::size_t at = nodes_.size();
    add(name, Nested{});
    put_fields();
    nodes_[at].end = nodes_.size();
  }
  /// An array of messages; `put_fields` puts the fields of one for an element of `elements`.
  template <class Elements, class PutFields>
  void list(std::string_view name, const Elements& elements, PutFields put_fields) {
    message(name, [&] {
      for (const auto& element : elements) {
        message({}, [&] { put_fields(element); });
      }
    });
  }

  /// Keeps a string until the message is encoded.
  std::string_view keep(std::string text) { return texts_.emplace_front(std::move(text)); }

 private:
  friend class FieldEncoder;

  struct Flag {
    const bool* value;
  };
  struct Array {
    FieldKind kind;
    std::size_t count;
    const std::uint8_t* values;
  };
  struct FilledArray {
    FieldKind kind;
    std::size_t count;
    const Fill* fill;
  };
  struct KeptNumbers {
    std::size_t first;  // in numbers_
    std::size_t count;
  };
  struct Nested {};  // the nodes up to `end`
  using Value = std::variant<std::int64_t, double, std::string_view, Stamp, Flag, const std::vector<std::string>*,
                             Array, FilledArray, KeptNumbers, Nested>;
  struct Node {
    std::string_view name;
    Value value;
    std::size_t end;  // the next node that is not inside this one
  };

  static constexpr std::size_t kUsualCount = 40;

  void add(std::string_view name, const Value& value);

  std::vector<Node> nodes_;  // each before those inside it
  std::vector<double> numbers_;
  std::forward_list<std::string> texts_;
  std::forward_list<Fill> fills_;
  std::vector<std::shared_ptr<const bool>> flags_;
};

/// The source of a message's fields.
class FieldReader {
 public:
  virtual ~FieldReader() = default;
  /// May be called on any thread, and several times.
  virtual void read(Fields& fields) const = 0;
};

/// Appends the wire bytes of a message. Throws std::invalid_argument with the type and the field for a value
/// that the field does not take; `out` then holds a part.
void encode(const MessageType& type, const FieldReader& message, WireBuffer& out);

}  // namespace bubblesim::messages
