// SPDX-License-Identifier: BSD-3-Clause
// The numbers of one world in a batch.
#pragma once

#include <cstddef>

#include "bubblesim/math.hpp"

namespace bubblesim {

enum class NumberType { kFloat32, kFloat64 };

/// A row of numbers of either type.
class Row {
 public:
  Row(void* data, NumberType type) : data_(data), type_(type) {}

  void put(double value) {
    if (type_ == NumberType::kFloat32) {
      static_cast<float*>(data_)[at_++] = static_cast<float>(value);
    } else {
      static_cast<double*>(data_)[at_++] = value;
    }
  }
  void put(const Vector3& v) {
    for (const double value : {v.x(), v.y(), v.z()}) put(value);
  }
  /// x, y, z, w
  void put(const Quaternion& q) {
    for (const double value : {q.x(), q.y(), q.z(), q.w()}) put(value);
  }
  double take() {
    return type_ == NumberType::kFloat32 ? static_cast<const float*>(data_)[at_++]
                                         : static_cast<const double*>(data_)[at_++];
  }

 private:
  void* data_;
  NumberType type_;
  std::size_t at_ = 0;
};

}  // namespace bubblesim
