// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/messages/number_fields.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "bubblesim/messages/numbers.hpp"

namespace bubblesim::messages {

NumberFields::NumberFields(const MessageType& type, const std::vector<std::string>& paths)
    : layout_(layout_of(type.version)), count_(paths.size()) {
  add(type, "", paths);
  std::set<std::size_t> found;
  for (const Number& number : numbers_) found.insert(number.place);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (found.count(i) == 0) throw std::invalid_argument(type.name + ": '" + paths[i] + "' is not a number");
  }
}

void NumberFields::add(const MessageType& type, const std::string& prefix, const std::vector<std::string>& paths) {
  if (type.fields.empty() && layout_ == Layout::kCdr) numbers_.push_back({FieldKind::kUint8, kSkipped});
  for (const Field& field : type.fields) {
    const std::string path = prefix + field.name;
    if (field.array == ArrayKind::kNone && is_number(field.kind)) {
      const auto wanted = std::find(paths.begin(), paths.end(), path);
      numbers_.push_back(
          {field.kind, wanted == paths.end() ? kSkipped : static_cast<std::size_t>(wanted - paths.begin())});
    } else if (field.array == ArrayKind::kNone && field.kind == FieldKind::kMessage) {
      add(*field.message, path + ".", paths);
    } else {
      throw std::invalid_argument(type.name + ": '" + field.name + "' is a " + type_text(field) + ", not a number");
    }
  }
}

std::vector<double> NumberFields::read(WireView message) const {
  std::vector<double> found(count_);
  message.begin(layout_);
  for (const auto& [kind, place] : numbers_) {
    const double value = with_number(kind, [&](auto number) {
      using Type = std::conditional_t<std::is_same_v<decltype(number), bool>, std::uint8_t, decltype(number)>;
      return static_cast<double>(message.get<Type>());
    });
    if (place != kSkipped) found[place] = value;
  }
  if (message.surplus() != 0) throw WireError(std::to_string(message.left()) + " surplus bytes after the last field");
  return found;
}

}  // namespace bubblesim::messages
