// SPDX-License-Identifier: BSD-3-Clause
// Formats numbers: for error messages, and exactly.
#pragma once

#include <array>
#include <charconv>
#include <string>

#include "bubblesim/math.hpp"

namespace bubblesim {

/// Six digits, as a stream writes it.
inline std::string text(double value) {
  std::array<char, 32> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 6).ptr;
  return {buffer.data(), end};
}

/// The shortest string that is read back as the same number.
inline std::string exact(double value) {
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

inline std::string text(const Vector3& v) { return "(" + text(v.x()) + ", " + text(v.y()) + ", " + text(v.z()) + ")"; }

/// x, y, z, w
inline std::string text(const Quaternion& q) {
  return "(" + text(q.x()) + ", " + text(q.y()) + ", " + text(q.z()) + ", " + text(q.w()) + ")";
}

}  // namespace bubblesim
