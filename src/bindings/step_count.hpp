// SPDX-License-Identifier: BSD-3-Clause
// A number of simulation steps as a parameter, whose errors state what to pass instead.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>

namespace bubblesim::bindings {

struct StepCount {
  std::uint64_t value;
};

}  // namespace bubblesim::bindings

namespace pybind11::detail {

template <>
struct type_caster<bubblesim::bindings::StepCount> {
  PYBIND11_TYPE_CASTER(bubblesim::bindings::StepCount, const_name("int"));

  bool load(handle source, bool) {
    if (PyIndex_Check(source.ptr()) == 0) throw type_error(refusal(source));
    const auto number = reinterpret_steal<object>(PyNumber_Index(source.ptr()));
    if (!number) throw error_already_set();
    value.value = PyLong_AsUnsignedLongLong(number.ptr());
    if (PyErr_Occurred() != nullptr) {
      PyErr_Clear();
      throw value_error(refusal(source));
    }
    return true;
  }

  static std::string refusal(handle source) {
    return "steps=" + repr(source).cast<std::string>() +
           " is not a number of simulation steps: pass a whole number, 0 or more; for a time in seconds, "
           "round(seconds / time_step)";
  }
};

}  // namespace pybind11::detail
