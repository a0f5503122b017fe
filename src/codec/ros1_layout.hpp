// SPDX-License-Identifier: BSD-3-Clause
// Values in the layout of ROS 1: little-endian, unaligned (http://wiki.ros.org/msg).
#pragma once

#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/wire.hpp"

namespace bubblesim::messages {

class Ros1Layout {
 public:
  explicit Ros1Layout(WireBuffer& out) : out_(out) {}

  template <class Number>
  void number(Number value) {
    out_.put(value);
  }
  void string(std::string_view text) {
    length(text.size());
    out_.put_bytes(text.data(), text.size());
  }
  /// The number of elements of a variable array, before them.
  void length(std::size_t count) {
    if (count > std::numeric_limits<std::uint32_t>::max()) {
      throw std::invalid_argument(std::to_string(count) + " elements do not fit into a message");
    }
    out_.put(static_cast<std::uint32_t>(count));
  }
  /// Space for `count` numbers of `size` bytes each.
  std::uint8_t* numbers(std::size_t count, std::size_t size) { return out_.extend(count * size); }
  void put_default(const Field& field) {
    const std::size_t size = default_size(field);
    if (size != 0) std::memset(out_.extend(size), 0, size);
  }

 private:
  WireBuffer& out_;
};

}  // namespace bubblesim::messages
