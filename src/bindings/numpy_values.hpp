// SPDX-License-Identifier: BSD-3-Clause
// Vectors, quaternions (x, y, z, w) and numpy arrays.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <string>

#include "bubblesim/error.hpp"
#include "bubblesim/math.hpp"

namespace bubblesim::bindings {

using NumpyArray = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

inline NumpyArray to_numpy(const Vector3& v) {
  const std::array<double, 3> values = {v.x(), v.y(), v.z()};
  return NumpyArray(values.size(), values.data());
}

inline NumpyArray to_numpy(const Quaternion& q) {
  const std::array<double, 4> values = {q.x(), q.y(), q.z(), q.w()};
  return NumpyArray(values.size(), values.data());
}

inline std::array<double, 3> to_list(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// Checks that `values` is a flat array of `size` numbers; `what` names it in the error.
inline const double* checked(const NumpyArray& values, pybind11::ssize_t size, const char* what) {
  if (values.ndim() == 1 && values.shape(0) == size) return values.data();
  std::string shape;
  for (pybind11::ssize_t axis = 0; axis < values.ndim(); ++axis) {
    shape += (axis == 0 ? "" : " x ") + std::to_string(values.shape(axis));
  }
  throw InvalidInput(std::string(what) + ": expected " + std::to_string(size) + " numbers, found " +
                     (values.ndim() == 0 ? "a single value" : shape));
}

inline Vector3 to_vector(const NumpyArray& values, const char* what) {
  const double* v = checked(values, 3, what);
  return {v[0], v[1], v[2]};
}

inline Quaternion to_quaternion(const NumpyArray& values, const char* what) {
  const double* q = checked(values, 4, what);
  return {q[3], q[0], q[1], q[2]};
}

}  // namespace bubblesim::bindings
