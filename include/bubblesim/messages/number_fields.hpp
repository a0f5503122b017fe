// SPDX-License-Identifier: BSD-3-Clause
// Single numbers of messages, read without their names.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {

/// Numbers of messages that only hold numbers, such as those of a Twist.
class NumberFields {
 public:
  /// `paths`: "linear.x". Throws std::invalid_argument for a path that is not a number, and for types with strings and
  /// variable arrays.
  NumberFields(const MessageType& type, const std::vector<std::string>& paths);

  /// In the order of the paths. Throws WireError if the message has another size than its type.
  std::vector<double> read(WireView message) const;

 private:
  struct Number {
    FieldKind kind;
    std::size_t place;  // in the result, or kSkipped
  };
  static constexpr std::size_t kSkipped = static_cast<std::size_t>(-1);

  void add(const MessageType& type, const std::string& prefix, const std::vector<std::string>& paths);

  Layout layout_;
  std::vector<Number> numbers_;  // all of a message, in its order
  std::size_t count_;
};

}  // namespace bubblesim::messages
