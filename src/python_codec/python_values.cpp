// SPDX-License-Identifier: BSD-3-Clause
#include "python_values.hpp"

#include <string_view>

namespace bubblesim::bindings {
namespace {

/// The only NumPy number that will not be an index in the future; NumPy 1 and 2 name it differently.
bool is_numpy_bool(PyObject* value) {
  const std::string_view type = Py_TYPE(value)->tp_name;
  return type == "numpy.bool_" || type == "numpy.bool";
}

/// Whether it is a float or a NumPy float, of which only float64 is a float.
bool is_float(PyObject* value) {
  constexpr std::string_view kNumpyFloat = "numpy.float";
  const std::string_view type = Py_TYPE(value)->tp_name;
  return PyFloat_Check(value) || type.substr(0, kNumpyFloat.size()) == kNumpyFloat || type == "numpy.longdouble";
}

/// The value as a Python int: ints, NumPy integers, bools, and finite floats without their fraction.
Ref as_int(PyObject* value, std::string_view expected, ConversionFailure& failure) {
  PyObject* number = nullptr;
  if (is_numpy_bool(value)) {
    number = PyLong_FromLong(PyObject_IsTrue(value));
  } else if (PyIndex_Check(value)) {
    number = PyNumber_Index(value);
  } else if (is_float(value)) {
    const double real = PyFloat_AsDouble(value);
    number = PyLong_FromDouble(real);  // toward zero; an exception for infinity and NaN
    if (number != nullptr && std::abs(real - std::trunc(real)) > kUnnoticedTruncation) failure.truncated(real);
  } else {
    failure.expected(expected, value);
    return {};
  }
  if (number == nullptr && clear_conversion_error()) failure.expected(expected, value);
  return Ref::steal(number);
}

template <class T>
bool read_seconds(PyObject* value, TimeParts<T>& time, ConversionFailure& failure) {
  const std::string expected =
      std::string(std::is_signed_v<T> ? "duration" : "time") + ": seconds, {'secs', 'nsecs'} or {'sec', 'nanosec'}";
  if (PyLong_Check(value)) return read_number(value, time.secs, failure);
  double seconds = 0;
  if (!read_double(value, expected, seconds, failure)) return false;
  const double whole = std::floor(seconds);
  const double nanoseconds = std::nearbyint((seconds - whole) * 1e9);
  const bool carries = nanoseconds >= 1e9;
  if (!narrow(whole + (carries ? 1.0 : 0.0), time.secs)) {
    return failure.expected("seconds as " + expectation<T>(), value);
  }
  time.nsecs = carries ? 0 : static_cast<T>(nanoseconds);
  return true;
}

template <class T>
bool read_time_dict(PyObject* dict, TimeParts<T>& time, ConversionFailure& failure) {
  Py_ssize_t position = 0;
  PyObject* key = nullptr;
  PyObject* item = nullptr;
  while (PyDict_Next(dict, &position, &key, &item) != 0) {
    const auto is = [key](const char* name) {
      return PyUnicode_Check(key) && PyUnicode_CompareWithASCIIString(key, name) == 0;
    };
    const bool secs = is("secs") || is("sec");
    if (!secs && !is("nsecs") && !is("nanosec")) {
      return failure.expected("keys 'secs' and 'nsecs' or 'sec' and 'nanosec'", key);
    }
    const std::size_t truncated = failure.truncation_count();
    if (!read_number(item, secs ? time.secs : time.nsecs, failure)) return failure.inside(secs ? "secs" : "nsecs");
    failure.truncated_inside(truncated, secs ? "secs" : "nsecs");
  }
  return true;
}

template <class T>
bool read_any_time(PyObject* value, TimeParts<T>& time, ConversionFailure& failure) {
  const Ref held = Ref::borrow(value);
  return PyDict_Check(value) ? read_time_dict(value, time, failure) : read_seconds(value, time, failure);
}

}  // namespace

bool read_double(PyObject* value, std::string_view expected, double& number, ConversionFailure& failure) {
  number = PyFloat_AsDouble(value);
  if (number != -1.0 || PyErr_Occurred() == nullptr) return true;
  return clear_conversion_error() && failure.expected(expected, value);
}

bool read_signed(PyObject* value, std::string_view expected, std::int64_t& number, ConversionFailure& failure) {
  const Ref integer = as_int(value, expected, failure);
  if (!integer) return false;
  int overflow = 0;
  number = PyLong_AsLongLongAndOverflow(integer.get(), &overflow);
  return overflow == 0 || failure.expected(expected, value);
}

bool read_unsigned(PyObject* value, std::string_view expected, std::uint64_t& number, ConversionFailure& failure) {
  const Ref integer = as_int(value, expected, failure);
  if (!integer) return false;
  number = PyLong_AsUnsignedLongLong(integer.get());
  if (PyErr_Occurred() == nullptr) return true;
  return clear_conversion_error() && failure.expected(expected, value);
}

bool read_time(PyObject* value, TimeParts<std::uint32_t>& time, ConversionFailure& failure) {
  return read_any_time(value, time, failure);
}

bool read_time(PyObject* value, TimeParts<std::int32_t>& duration, ConversionFailure& failure) {
  return read_any_time(value, duration, failure);
}

bool read_string(PyObject* value, std::string_view& bytes, PyObject*& owner, ConversionFailure& failure) {
  if (PyUnicode_Check(value)) {
    Py_ssize_t size = 0;
    if (const char* text = PyUnicode_AsUTF8AndSize(value, &size)) {
      bytes = {text, static_cast<std::size_t>(size)};  // the str owns its UTF-8 form
      return true;
    }
    if (!clear_conversion_error()) return false;
    // Surrogates: decoded bytes that are not UTF-8 become these bytes again.
    owner = PyUnicode_AsEncodedString(value, "utf-8", "surrogateescape");
    if (owner == nullptr) return clear_conversion_error() && failure.expected("string that UTF-8 can express", value);
    value = owner;
  }
  if (!PyBytes_Check(value)) return failure.expected("string", value);
  bytes = {PyBytes_AS_STRING(value), static_cast<std::size_t>(PyBytes_GET_SIZE(value))};
  return true;
}

}  // namespace bubblesim::bindings
