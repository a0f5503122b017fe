// SPDX-License-Identifier: BSD-3-Clause
// Single Python values as C++ values for the wire. The functions return false if they described the failure, or if
// another Python exception is set. They may run Python code of the value's class.
#pragma once

#include <Python.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include "bubblesim/messages/message_type.hpp"
#include "conversion_failure.hpp"
#include "python_ref.hpp"

namespace bubblesim::bindings {

/// .msg spelling of T, with its range for integers: "int8 (-128 to 127)".
template <class T>
std::string expectation() {
  if constexpr (std::is_same_v<T, bool>) {
    return "bool";
  } else if constexpr (std::is_floating_point_v<T>) {
    return sizeof(T) == 4 ? "float32" : "float64";
  } else {
    return std::string(std::is_signed_v<T> ? "int" : "uint") + std::to_string(8 * sizeof(T)) + " (" +
           std::to_string(std::numeric_limits<T>::min()) + " to " + std::to_string(std::numeric_limits<T>::max()) + ")";
  }
}

/// Converts `from` if `to` can hold it: integers exactly, floats to floats rounded but never to infinity, to integers
/// truncated toward zero.
template <class To, class From>
bool narrow(From from, To& to) {
  if constexpr (std::is_same_v<To, bool>) {
    if (from != From{0} && from != From{1}) return false;
    to = from != From{0};
  } else if constexpr (std::is_floating_point_v<To>) {
    to = static_cast<To>(from);
    if constexpr (std::is_floating_point_v<From>) return !std::isinf(to) || std::isinf(from);
  } else if constexpr (std::is_floating_point_v<From>) {
    // All are exact as doubles: powers of two, or 0.
    constexpr To kHalf = std::numeric_limits<To>::max() / 2 + 1;
    constexpr From kEnd = static_cast<From>(kHalf) * 2;
    constexpr From kFirst = static_cast<From>(std::numeric_limits<To>::min());
    const From whole = std::trunc(from);
    if (!(whole >= kFirst && whole < kEnd)) return false;
    to = static_cast<To>(whole);
  } else if constexpr (std::is_signed_v<From> == std::is_signed_v<To>) {
    if (from < std::numeric_limits<To>::min() || from > std::numeric_limits<To>::max()) return false;
    to = static_cast<To>(from);
  } else if constexpr (std::is_signed_v<From>) {
    if (from < 0 || static_cast<std::make_unsigned_t<From>>(from) > std::numeric_limits<To>::max()) return false;
    to = static_cast<To>(from);
  } else {
    if (from > static_cast<std::make_unsigned_t<To>>(std::numeric_limits<To>::max())) return false;
    to = static_cast<To>(from);
  }
  return true;
}

// For values that are not plain floats or ints.
bool read_double(PyObject* value, std::string_view expected, double& number, ConversionFailure& failure);
bool read_unsigned(PyObject* value, std::string_view expected, std::uint64_t& number, ConversionFailure& failure);
bool read_signed(PyObject* value, std::string_view expected, std::int64_t& number, ConversionFailure& failure);

template <class T>
bool read_number_slowly(PyObject* value, T& number, ConversionFailure& failure) {
  // Python code of the value's class may release the last other reference to it.
  const Ref held = Ref::borrow(value);
  if constexpr (std::is_floating_point_v<T>) {
    double wide = 0;
    if (!read_double(value, expectation<T>(), wide, failure)) return false;
    return narrow(wide, number) || failure.expected(expectation<T>() + " (finite or inf)", value);
  } else if constexpr (std::is_same_v<T, bool>) {
    double wide = 0;  // 0.5 is not a valid bool, but a valid integer
    if (!read_double(value, expectation<T>(), wide, failure)) return false;
    return narrow(wide, number) || failure.expected(expectation<T>(), value);
  } else {
    using Wide = std::conditional_t<std::is_unsigned_v<T> && sizeof(T) == 8, std::uint64_t, std::int64_t>;
    Wide wide = 0;
    bool understood = false;
    if constexpr (std::is_same_v<Wide, std::uint64_t>) {
      understood = read_unsigned(value, expectation<T>(), wide, failure);
    } else {
      understood = read_signed(value, expectation<T>(), wide, failure);
    }
    return understood && (narrow(wide, number) || failure.expected(expectation<T>(), value));
  }
}

/// A bool, an integer or a float.
template <class T>
bool read_number(PyObject* value, T& number, ConversionFailure& failure) {
  if constexpr (std::is_floating_point_v<T>) {
    if (PyFloat_CheckExact(value) && narrow(PyFloat_AS_DOUBLE(value), number)) return true;
  } else if constexpr (!std::is_same_v<T, std::uint64_t>) {
    if (PyLong_CheckExact(value)) {
      int overflow = 0;
      const long long wide = PyLong_AsLongLongAndOverflow(value, &overflow);
      if (overflow == 0 && narrow(static_cast<std::int64_t>(wide), number)) return true;
    } else if (std::is_same_v<T, bool> && PyBool_Check(value)) {
      number = static_cast<T>(value == Py_True);
      return true;
    }
  }
  return read_number_slowly(value, number, failure);
}

/// Wire form of a time (T = std::uint32_t) or a duration (std::int32_t).
template <class T>
struct TimeParts {
  T secs = 0;
  T nsecs = 0;
};

bool read_time(PyObject* value, TimeParts<std::uint32_t>& time, ConversionFailure& failure);
bool read_time(PyObject* value, TimeParts<std::int32_t>& duration, ConversionFailure& failure);

/// The bytes of a string field; `owner` keeps them alive and must be released with Py_XDECREF.
bool read_string(PyObject* value, std::string_view& bytes, PyObject*& owner, ConversionFailure& failure);

}  // namespace bubblesim::bindings
