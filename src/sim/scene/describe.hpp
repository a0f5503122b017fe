// SPDX-License-Identifier: BSD-3-Clause
// Formats numbers for error messages.
#pragma once

#include <sstream>
#include <string>

#include "bubblesim/math.hpp"

namespace bubblesim {

inline std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

inline std::string text(const Vector3& v) { return "(" + text(v.x()) + ", " + text(v.y()) + ", " + text(v.z()) + ")"; }

/// x, y, z, w
inline std::string text(const Quaternion& q) {
  return "(" + text(q.x()) + ", " + text(q.y()) + ", " + text(q.z()) + ", " + text(q.w()) + ")";
}

}  // namespace bubblesim
