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

inline std::string text(const Vector3& v) { return "(" + text(v.X()) + ", " + text(v.Y()) + ", " + text(v.Z()) + ")"; }

/// x, y, z, w
inline std::string text(const Quaternion& q) {
  return "(" + text(q.X()) + ", " + text(q.Y()) + ", " + text(q.Z()) + ", " + text(q.W()) + ")";
}

}  // namespace bubblesim
