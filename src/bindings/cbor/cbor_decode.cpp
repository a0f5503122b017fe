// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <cstdint>
#include <limits>

#include "cbor/cbor_codec.hpp"
#include "cbor/cbor_reader.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;
using Kind = CborItem::Kind;

py::object owned(PyObject* made) {
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(made);
}

py::object negative(std::uint64_t value) {
  if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    return owned(PyLong_FromLongLong(-1 - static_cast<std::int64_t>(value)));
  }
  return owned(PyNumber_Invert(owned(PyLong_FromUnsignedLongLong(value)).ptr()));
}

py::object text(std::string_view bytes) {
  PyObject* made = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "strict");
  if (made == nullptr) {
    PyErr_Clear();
    throw CborError("a string is not valid UTF-8");
  }
  return owned(made);
}

/// Makes Python's values of data that check_cbor has accepted.
class CborDecoder {
 public:
  explicit CborDecoder(std::string_view data) : reader_(data) {}

  py::object value() { return value(reader_.next()); }

 private:
  py::object value(const CborItem& item) {
    switch (item.kind) {
      case Kind::kUnsigned:
        return owned(PyLong_FromUnsignedLongLong(item.argument));
      case Kind::kNegative:
        return negative(item.argument);
      case Kind::kReal:
        return py::float_(item.real);
      case Kind::kBytes:
        return owned(PyBytes_FromStringAndSize(item.bytes.data(), static_cast<Py_ssize_t>(item.bytes.size())));
      case Kind::kText:
        return text(item.bytes);
      case Kind::kList:
        return list(item.argument);
      case Kind::kMap:
        return map(item.argument);
      case Kind::kFalse:
        return py::bool_(false);
      case Kind::kTrue:
        return py::bool_(true);
      case Kind::kNull:
      case Kind::kBreak:
        break;
    }
    return py::none();
  }

  py::object list(std::uint64_t count) {
    if (count == CborItem::kUntilBreak) return list_until_break();
    py::list values(static_cast<std::size_t>(count));
    for (std::uint64_t i = 0; i < count; ++i) {
      PyList_SET_ITEM(values.ptr(), static_cast<Py_ssize_t>(i), value().release().ptr());
    }
    return values;
  }

  py::object list_until_break() {
    py::list values;
    for (CborItem item = reader_.next(); item.kind != Kind::kBreak; item = reader_.next()) values.append(value(item));
    return values;
  }

  py::object map(std::uint64_t count) {
    py::dict values;
    for (std::uint64_t i = 0; i < count; ++i) {
      const CborItem item = reader_.next();
      if (item.kind == Kind::kBreak) break;
      const py::object key = value(item);
      values[key] = value();
    }
    return values;
  }

  CborReader reader_;
};

}  // namespace

py::object cbor_decode(const py::bytes& data) {
  const std::string_view bytes(data);
  check_cbor(bytes);  // first, so that nothing is made of data that are refused
  return CborDecoder(bytes).value();
}

}  // namespace bubblesim::bindings
