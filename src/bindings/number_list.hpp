// SPDX-License-Identifier: BSD-3-Clause
// A number of floats as a parameter: faster than pybind11's std::array, which calls Python for each item.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>

namespace bubblesim::bindings {

template <std::size_t count>
struct NumberList : std::array<double, count> {};

}  // namespace bubblesim::bindings

namespace pybind11::detail {

template <std::size_t count>
struct type_caster<bubblesim::bindings::NumberList<count>> {
  PYBIND11_TYPE_CASTER(bubblesim::bindings::NumberList<count>,
                       const_name("List[float[") + const_name<count>() + const_name("]]"));

  bool load(handle source, bool) {
    if (!PySequence_Check(source.ptr())) return false;
    const auto items = reinterpret_steal<object>(PySequence_Fast(source.ptr(), ""));
    if (!items || PySequence_Fast_GET_SIZE(items.ptr()) != static_cast<Py_ssize_t>(count)) {
      PyErr_Clear();
      return false;
    }
    for (std::size_t i = 0; i < count; ++i) {
      value[i] = PyFloat_AsDouble(PySequence_Fast_GET_ITEM(items.ptr(), static_cast<Py_ssize_t>(i)));
      if (value[i] == -1.0 && PyErr_Occurred() != nullptr) {
        PyErr_Clear();
        return false;
      }
    }
    return true;
  }

  static handle cast(const bubblesim::bindings::NumberList<count>& numbers, return_value_policy, handle) {
    tuple items(count);
    for (std::size_t i = 0; i < count; ++i) items[i] = float_(numbers[i]);
    return items.release();
  }
};

}  // namespace pybind11::detail
