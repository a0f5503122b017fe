// SPDX-License-Identifier: BSD-3-Clause
// Values from bytes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace bubblesim::fuzz {

/// Takes values off the front of the data, zeros after its end.
class Taken {
 public:
  explicit Taken(std::string_view data) : data_(data) {}

  template <class Value>
  Value value() {
    Value taken{};
    const std::size_t size = std::min(sizeof taken, data_.size());
    if (size > 0) std::memcpy(&taken, data_.data(), size);
    data_.remove_prefix(size);
    return taken;
  }
  template <class Value>
  std::vector<Value> values() {
    std::vector<Value> taken(value<std::uint8_t>());
    for (Value& each : taken) each = value<Value>();
    return taken;
  }

 private:
  std::string_view data_;
};

}  // namespace bubblesim::fuzz
