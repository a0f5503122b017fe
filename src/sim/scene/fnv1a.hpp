// SPDX-License-Identifier: BSD-3-Clause
// The FNV-1a hash over the bits of numbers (http://www.isthe.com/chongo/tech/comp/fnv/).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace bubblesim {

class Fnv1a {
 public:
  void add(std::uint64_t bits) {
    for (int byte = 0; byte < 8; ++byte) {
      value_ = (value_ ^ ((bits >> (8 * byte)) & 0xff)) * 0x100000001b3ULL;
    }
  }
  void add(const double* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &values[i], sizeof bits);
      add(bits);
    }
  }
  /// Eight bytes at a time; the last ones are filled up with zeros.
  void add(std::string_view bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += 8) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, bytes.data() + at, bytes.size() - at < 8 ? bytes.size() - at : 8);
      add(bits);
    }
    add(static_cast<std::uint64_t>(bytes.size()));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace bubblesim
