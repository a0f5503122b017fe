// SPDX-License-Identifier: BSD-3-Clause
// Single numbers of a message, read without the rest of it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {

/// Numbers at the same places in all messages of a type, such as those of a Twist.
class NumberFields {
 public:
  /// `paths`: "linear.x". Throws std::invalid_argument for a path that is not a number, and for one behind strings or
  /// variable arrays.
  NumberFields(const MessageType& type, const std::vector<std::string>& paths);

  /// Throws WireError if the message has another size than its type.
  std::vector<double> read(WireView message) const;

 private:
  struct Place {
    std::size_t offset;
    FieldKind kind;
  };

  std::vector<Place> places_;
  std::size_t size_;
  bool is_fixed_;
};

}  // namespace bubblesim::messages
