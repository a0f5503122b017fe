// SPDX-License-Identifier: BSD-3-Clause
#include "parameters/parameter_value.hpp"

#include <charconv>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

namespace bubblesim::ros2 {
namespace {

using messages::WireBuffer;
using messages::WireView;

template <class Number>
std::optional<Number> number_of(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The value if it has this type, else a default one.
template <class Type>
Type value_or_default(const Value& value) {
  const Type* found = std::get_if<Type>(&value);
  return found != nullptr ? *found : Type();
}

template <class Item>
void put_list(const Value& value, WireBuffer& out) {
  const auto items = value_or_default<std::vector<Item>>(value);
  out.put(static_cast<std::uint32_t>(items.size()));
  for (const auto& item : items) {
    if constexpr (std::is_same_v<Item, std::string>) {
      out.put_string(item);
    } else if constexpr (std::is_same_v<Item, bool>) {
      out.put(static_cast<std::uint8_t>(item ? 1 : 0));
    } else {
      out.put(item);
    }
  }
}

template <class Item>
std::vector<Item> get_list(WireView& message) {
  std::vector<Item> items;
  for (auto left = message.get<std::uint32_t>(); left > 0; --left) {  // a wrong count ends at the message's end
    if constexpr (std::is_same_v<Item, std::string>) {
      items.push_back(get_string(message));
    } else if constexpr (std::is_same_v<Item, bool>) {
      items.push_back(message.get<std::uint8_t>() != 0);
    } else {
      items.push_back(message.get<Item>());
    }
  }
  return items;
}

}  // namespace

messages::ParameterValue for_script(const Value& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag;
  if (const double* number = std::get_if<double>(&value)) return *number;
  if (const std::string* text = std::get_if<std::string>(&value)) return *text;
  if (const std::int64_t* integer = std::get_if<std::int64_t>(&value)) {
    const auto narrow = static_cast<std::int32_t>(*integer);
    if (narrow == *integer) return narrow;
    return static_cast<double>(*integer);
  }
  return std::monostate();
}

Value from_script(const messages::ParameterValue& value) {
  return std::visit(
      [](const auto& given) -> Value {
        if constexpr (std::is_same_v<std::decay_t<decltype(given)>, std::int32_t>) {
          return std::int64_t{given};
        } else {
          return given;
        }
      },
      value);
}

Value value_of(const std::string& text) {
  if (text == "true" || text == "True") return true;
  if (text == "false" || text == "False") return false;
  if (const auto integer = number_of<std::int64_t>(text)) return *integer;
  if (const auto real = number_of<double>(text)) return *real;
  return text;
}

void put(const Value& value, WireBuffer& out) {
  out.put(static_cast<std::uint8_t>(value.index()));
  out.put(static_cast<std::uint8_t>(value_or_default<bool>(value) ? 1 : 0));
  out.put(value_or_default<std::int64_t>(value));
  out.put(value_or_default<double>(value));
  out.put_string(value_or_default<std::string>(value));
  put_list<std::uint8_t>(value, out);
  put_list<bool>(value, out);
  put_list<std::int64_t>(value, out);
  put_list<double>(value, out);
  put_list<std::string>(value, out);
}

Value get_value(WireView& message) {
  const auto type = message.get<std::uint8_t>();
  const bool flag = message.get<std::uint8_t>() != 0;
  const auto integer = message.get<std::int64_t>();
  const auto real = message.get<double>();
  std::string text = get_string(message);
  auto bytes = get_list<std::uint8_t>(message);
  auto flags = get_list<bool>(message);
  auto integers = get_list<std::int64_t>(message);
  auto reals = get_list<double>(message);
  auto strings = get_list<std::string>(message);
  switch (type) {
    case 1:
      return flag;
    case 2:
      return integer;
    case 3:
      return real;
    case 4:
      return text;
    case 5:
      return bytes;
    case 6:
      return flags;
    case 7:
      return integers;
    case 8:
      return reals;
    case 9:
      return strings;
    default:
      return std::monostate();
  }
}

std::string get_string(WireView& message) {
  const auto size = message.get<std::uint32_t>();
  const auto* letters = reinterpret_cast<const char*>(message.take(size));
  return std::string(letters, size > 0 && letters[size - 1] == '\0' ? size - 1 : size);
}

}  // namespace bubblesim::ros2
