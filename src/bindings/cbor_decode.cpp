// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "cbor_codec.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

constexpr int kDepth = 32;
constexpr std::uint64_t kItems = 4'000'000;  // a table of points; decoding holds up the simulation

enum Major : unsigned { kUnsigned, kNegative, kBytes, kText, kArray, kMap, kTag, kSimple };

py::object owned(PyObject* made) {
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(made);
}

/// IEEE 754 binary16, as in RFC 8949, appendix D.
double half(std::uint64_t bits) {
  const auto exponent = static_cast<int>(bits >> 10U & 31U);
  const auto mantissa = static_cast<double>(bits & 1023U);
  double value = 0;
  if (exponent == 0) {
    value = std::ldexp(mantissa, -24);
  } else if (exponent != 31) {
    value = std::ldexp(mantissa + 1024, exponent - 25);
  } else {
    value = mantissa == 0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  }
  return (bits & 0x8000U) != 0 ? -value : value;
}

template <class Float, class Bits>
double number_of(std::uint64_t bits) {
  const auto narrow = static_cast<Bits>(bits);
  Float value = 0;
  std::memcpy(&value, &narrow, sizeof value);
  return static_cast<double>(value);
}

/// Reads one item and all in it. Nothing is allocated that the data does not contain.
class CborReader {
 public:
  explicit CborReader(std::string_view data) : data_(data) {}

  py::object item(int depth) {
    if (depth > kDepth) refuse("more than 32 nested lists and tables");
    if (++items_ > kItems) refuse("more than four million values");
    const unsigned head = byte();
    const auto major = static_cast<Major>(head >> 5U);
    const unsigned detail = head & 31U;
    switch (major) {
      case kUnsigned:
        return owned(PyLong_FromUnsignedLongLong(argument(detail)));
      case kNegative:
        return negative(argument(detail));
      case kBytes: {
        const std::string_view bytes = take(argument(detail));
        return owned(PyBytes_FromStringAndSize(bytes.data(), static_cast<Py_ssize_t>(bytes.size())));
      }
      case kText:
        return text(argument(detail));
      case kArray:
        return list(length(detail), depth);
      case kMap:
        return map(length(detail), depth);
      case kTag:
        refuse("tagged values are not supported");
      case kSimple:
        break;
    }
    return simple(detail);
  }

  bool at_end() const { return place_ == data_.size(); }

 private:
  static constexpr unsigned kIndefinite = 31;
  static constexpr unsigned kBreak = 0xff;

  [[noreturn]] static void refuse(const char* why) { throw py::value_error(why); }

  unsigned byte() {
    if (place_ >= data_.size()) refuse("the data ends early");
    return static_cast<unsigned char>(data_[place_++]);
  }

  std::string_view take(std::uint64_t size) {
    if (size > data_.size() - place_) refuse("the data ends early");
    const std::string_view taken = data_.substr(place_, size);
    place_ += size;
    return taken;
  }

  std::uint64_t argument(unsigned detail) {
    if (detail < 24) return detail;
    if (detail == kIndefinite) refuse("texts and bytes of unknown length are not supported");
    if (detail > 27) refuse("a length is malformed");
    std::uint64_t value = 0;
    for (const char each : take(std::uint64_t{1} << (detail - 24)))
      value = value << 8U | static_cast<unsigned char>(each);
    return value;
  }

  /// The number of items; none if a break ends them.
  std::optional<std::uint64_t> length(unsigned detail) {
    if (detail == kIndefinite) return std::nullopt;
    const std::uint64_t count = argument(detail);
    if (count > data_.size() - place_) refuse("the data ends early");  // each item has at least one byte
    return count;
  }

  bool ends(std::optional<std::uint64_t> count, std::uint64_t so_far) {
    if (count) return so_far == *count;
    if (place_ >= data_.size() || static_cast<unsigned char>(data_[place_]) != kBreak) return false;
    ++place_;
    return true;
  }

  static py::object negative(std::uint64_t value) {
    if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
      return owned(PyLong_FromLongLong(-1 - static_cast<std::int64_t>(value)));
    }
    return owned(PyNumber_Invert(owned(PyLong_FromUnsignedLongLong(value)).ptr()));
  }

  py::object text(std::uint64_t size) {
    const std::string_view bytes = take(size);
    PyObject* made = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "strict");
    if (made == nullptr) {
      PyErr_Clear();
      refuse("a text is not valid UTF-8");
    }
    return owned(made);
  }

  py::object list(std::optional<std::uint64_t> count, int depth) {
    py::list values;  // grows: what is announced need not come
    for (std::uint64_t i = 0; !ends(count, i); ++i) values.append(item(depth + 1));
    return values;
  }

  py::object map(std::optional<std::uint64_t> count, int depth) {
    py::dict values;
    for (std::uint64_t i = 0; !ends(count, i); ++i) {
      const py::object key = item(depth + 1);
      if (PyList_Check(key.ptr()) || PyDict_Check(key.ptr())) refuse("a list or a table is the key of a table");
      values[key] = item(depth + 1);
    }
    return values;
  }

  py::object simple(unsigned detail) {
    constexpr unsigned kFalse = 20;
    constexpr unsigned kTrue = 21;
    constexpr unsigned kNull = 22;
    constexpr unsigned kUndefined = 23;
    switch (detail) {
      case kFalse:
        return py::bool_(false);
      case kTrue:
        return py::bool_(true);
      case kNull:
      case kUndefined:
        return py::none();
      case 25:
        return py::float_(half(argument(detail)));
      case 26:
        return py::float_(number_of<float, std::uint32_t>(argument(detail)));
      case 27:
        return py::float_(number_of<double, std::uint64_t>(argument(detail)));
      default:
        refuse("a simple value is none of false, true and null");
    }
  }

  const std::string_view data_;
  std::size_t place_ = 0;
  std::uint64_t items_ = 0;
};

}  // namespace

py::object cbor_decode(const py::bytes& data) {
  CborReader reader{std::string_view(data)};
  py::object value = reader.item(0);
  if (!reader.at_end()) throw py::value_error("data follows the value");
  return value;
}

}  // namespace bubblesim::bindings
