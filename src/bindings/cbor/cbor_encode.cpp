// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <cstring>

#include "cbor/cbor_codec.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

constexpr int kDeepest = 100;  // also ends what contains itself

enum Head : unsigned char {
  kPositiveHead = 0x00,
  kNegativeHead = 0x20,
  kBytesHead = 0x40,
  kTextHead = 0x60,
  kArrayHead = 0x80,
  kMapHead = 0xa0,
  kFalseHead = 0xf4,
  kTrueHead = 0xf5,
  kNullHead = 0xf6,
  kDoubleHead = 0xfb,
};

[[noreturn]] void refuse_result(const std::string& why) { throw py::type_error("the result cannot be sent: " + why); }

/// The buffer of an object, if it has one without gaps in the order of C.
class Buffer {
 public:
  explicit Buffer(const py::handle& object) : found_(PyObject_GetBuffer(object.ptr(), &view_, PyBUF_SIMPLE) == 0) {
    if (!found_) PyErr_Clear();
  }
  ~Buffer() {
    if (found_) PyBuffer_Release(&view_);
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  explicit operator bool() const { return found_; }
  std::string_view bytes() const { return {static_cast<const char*>(view_.buf), static_cast<std::size_t>(view_.len)}; }

 private:
  Py_buffer view_{};
  const bool found_;
};

class CborWriter {
 public:
  void value(const py::handle& value, int depth) {
    if (depth > kDeepest) refuse_result("it has more than 100 nested lists and maps");
    PyObject* const object = value.ptr();
    if (PyFloat_Check(object)) return number(PyFloat_AS_DOUBLE(object));
    if (object == Py_None) return head(kNullHead);
    if (PyBool_Check(object)) return head(object == Py_True ? kTrueHead : kFalseHead);
    if (PyLong_Check(object)) return integer(object);
    if (PyUnicode_Check(object)) return text(object);
    if (PyList_Check(object) || PyTuple_Check(object)) return sequence(object, depth);
    if (PyDict_Check(object)) return map(object, depth);
    if (PyBytes_Check(object)) {
      return bytes(kBytesHead, {PyBytes_AS_STRING(object), static_cast<std::size_t>(PyBytes_GET_SIZE(object))});
    }
    other(value, depth);
  }

  py::bytes result() const { return {written_.data(), written_.size()}; }

 private:
  void head(Head of) { written_.push_back(static_cast<char>(of)); }

  void head(Head of, std::uint64_t argument) {
    unsigned size = 0;  // bytes of the argument
    unsigned detail = static_cast<unsigned>(argument);
    if (argument >= 24) {
      const unsigned power = argument <= 0xff ? 0 : argument <= 0xffff ? 1 : argument <= 0xffff'ffff ? 2 : 3;
      size = 1U << power;
      detail = 24 + power;
    }
    written_.push_back(static_cast<char>(of | detail));
    big_endian(argument, size);
  }

  void big_endian(std::uint64_t value, unsigned size) {
    for (unsigned i = size; i-- > 0;) written_.push_back(static_cast<char>(value >> 8U * i & 0xffU));
  }

  void number(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    head(kDoubleHead);
    big_endian(bits, sizeof bits);
  }

  void integer(PyObject* object) {
    int overflow = 0;
    const long long small = PyLong_AsLongLongAndOverflow(object, &overflow);
    if (overflow == 0) {
      return small >= 0 ? head(kPositiveHead, static_cast<std::uint64_t>(small))
                        : head(kNegativeHead, static_cast<std::uint64_t>(-1 - small));
    }
    const auto positive = py::reinterpret_steal<py::object>(overflow < 0 ? PyNumber_Invert(object) : Py_NewRef(object));
    const unsigned long long large = PyLong_AsUnsignedLongLong(positive.ptr());
    if (PyErr_Occurred() != nullptr) {
      PyErr_Clear();
      refuse_result("it contains an integer of more than 64 bits");
    }
    head(overflow < 0 ? kNegativeHead : kPositiveHead, large);
  }

  void text(PyObject* object) {
    Py_ssize_t size = 0;
    const char* const data = PyUnicode_AsUTF8AndSize(object, &size);
    if (data == nullptr) {
      PyErr_Clear();
      refuse_result("it contains a string that has no UTF-8");
    }
    bytes(kTextHead, {data, static_cast<std::size_t>(size)});
  }

  void bytes(Head of, std::string_view data) {
    head(of, data.size());
    written_.append(data);
  }

  void sequence(PyObject* object, int depth) {
    const auto count = static_cast<std::size_t>(PySequence_Fast_GET_SIZE(object));
    head(kArrayHead, count);
    for (std::size_t i = 0; i < count; ++i) {
      value(PySequence_Fast_GET_ITEM(object, static_cast<Py_ssize_t>(i)), depth + 1);
    }
  }

  void map(PyObject* object, int depth) {
    head(kMapHead, static_cast<std::uint64_t>(PyDict_Size(object)));
    PyObject* key = nullptr;
    PyObject* item = nullptr;
    for (Py_ssize_t place = 0; PyDict_Next(object, &place, &key, &item) != 0;) {
      value(key, depth + 1);
      value(item, depth + 1);
    }
  }

  void other(const py::handle& object, int depth) {
    const py::module_ numpy = py::module_::import("numpy");
    if (py::isinstance(object, numpy.attr("generic"))) return value(object.attr("item")(), depth + 1);
    const bool is_array = py::isinstance(object, numpy.attr("ndarray"));
    if (!is_array && !PyMemoryView_Check(object.ptr()) && !PyByteArray_Check(object.ptr())) {
      const py::str type = py::type::handle_of(object).attr("__name__");
      refuse_result("it contains a value of type " + type.cast<std::string>());
    }
    if (const Buffer buffer(object); buffer) return bytes(kBytesHead, buffer.bytes());
    value(object.attr("tobytes")(), depth);
  }

  std::string written_;
};

}  // namespace

py::bytes cbor_encode(const py::handle& value) {
  CborWriter writer;
  writer.value(value, 0);
  return writer.result();
}

}  // namespace bubblesim::bindings
