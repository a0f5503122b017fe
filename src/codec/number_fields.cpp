// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/messages/number_fields.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "bubblesim/messages/numbers.hpp"

namespace bubblesim::messages {
namespace {

bool has_fixed_size(const MessageType& type);

bool has_fixed_size(const Field& field) {
  if (field.array == ArrayKind::kVariable || field.kind == FieldKind::kString) return false;
  return field.kind != FieldKind::kMessage || has_fixed_size(*field.message);
}

bool has_fixed_size(const MessageType& type) {
  return std::all_of(type.fields.begin(), type.fields.end(), [](const Field& field) { return has_fixed_size(field); });
}

/// The field at a path, and where it begins.
std::pair<const Field*, std::size_t> find(const MessageType& type, const std::string& path) {
  const std::string name = path.substr(0, path.find('.'));
  std::size_t offset = 0;
  for (const Field& field : type.fields) {
    if (field.name == name) {
      if (name == path) return {&field, offset};
      if (field.kind != FieldKind::kMessage || field.array != ArrayKind::kNone) break;
      const auto [found, inside] = find(*field.message, path.substr(name.size() + 1));
      return {found, offset + inside};
    }
    if (!has_fixed_size(field)) break;
    offset += default_size(field);
  }
  return {nullptr, 0};
}

}  // namespace

NumberFields::NumberFields(const MessageType& type, const std::vector<std::string>& paths)
    : size_(default_size(type)), is_fixed_(has_fixed_size(type)) {
  for (const std::string& path : paths) {
    const auto [field, offset] = find(type, path);
    if (field == nullptr || !is_number(field->kind) || field->array != ArrayKind::kNone) {
      throw std::invalid_argument(type.name + ": " + path + " is not a number at a fixed place");
    }
    places_.push_back({offset, field->kind});
  }
}

std::vector<double> NumberFields::read(WireView message) const {
  const std::size_t left = message.left();
  if (left < size_ || (is_fixed_ && left != size_)) {
    throw WireError("the message has " + std::to_string(left) + " bytes, its type " + std::to_string(size_));
  }
  const std::uint8_t* bytes = message.take(left);
  std::vector<double> numbers;
  numbers.reserve(places_.size());
  for (const Place& place : places_) {
    with_number(place.kind, [&](auto number) {
      std::memcpy(&number, bytes + place.offset, sizeof number);
      numbers.push_back(static_cast<double>(number));
    });
  }
  return numbers;
}

}  // namespace bubblesim::messages
