// SPDX-License-Identifier: BSD-3-Clause
#define NPY_NO_DEPRECATED_API NPY_1_7_API_VERSION
#include "numeric_arrays.hpp"

#include <numpy/arrayobject.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "python_values.hpp"

namespace bubblesim::bindings {
namespace {

using messages::ArrayKind;
using messages::Field;
using messages::FieldKind;
using messages::WireBuffer;

struct NumpyKind {
  int type_number;
  char kind;  // of the dtype: 'b' bool, 'i' signed, 'u' unsigned, 'f' float
};

NumpyKind numpy_kind(FieldKind kind) {
  switch (kind) {
    case FieldKind::kBool:
      return {NPY_BOOL, 'b'};
    case FieldKind::kInt8:
      return {NPY_INT8, 'i'};
    case FieldKind::kUint8:
      return {NPY_UINT8, 'u'};
    case FieldKind::kInt16:
      return {NPY_INT16, 'i'};
    case FieldKind::kUint16:
      return {NPY_UINT16, 'u'};
    case FieldKind::kInt32:
      return {NPY_INT32, 'i'};
    case FieldKind::kUint32:
      return {NPY_UINT32, 'u'};
    case FieldKind::kInt64:
      return {NPY_INT64, 'i'};
    case FieldKind::kUint64:
      return {NPY_UINT64, 'u'};
    case FieldKind::kFloat32:
      return {NPY_FLOAT32, 'f'};
    default:
      return {NPY_FLOAT64, 'f'};
  }
}

bool encode_bytes(const Field& field, std::string_view bytes, WireBuffer& out, ConversionFailure& failure) {
  if (!begin_array(field, bytes.size(), out, failure)) return false;
  out.put_bytes(bytes.data(), bytes.size());
  return true;
}

/// Encodes a str as an array of bytes, for scripts that treat uint8[] as strings: one byte per character.
bool encode_text(const Field& field, PyObject* text, WireBuffer& out, ConversionFailure& failure) {
  const Ref bytes = Ref::steal(PyUnicode_AsLatin1String(text));
  if (!bytes) {
    return clear_conversion_error() && failure.expected(type_text(field) + " or str of characters below 256", text);
  }
  const auto size = static_cast<std::size_t>(PyBytes_GET_SIZE(bytes.get()));
  return encode_bytes(field, {PyBytes_AS_STRING(bytes.get()), size}, out, failure);
}

template <class To>
bool encode_items(const Field& field, PyObject* items, WireBuffer& out, ConversionFailure& failure) {
  const Py_ssize_t count = PySequence_Fast_GET_SIZE(items);
  if (!begin_array(field, static_cast<std::size_t>(count), out, failure)) return false;
  std::uint8_t* place = out.extend(static_cast<std::size_t>(count) * sizeof(To));
  for (Py_ssize_t i = 0; i < count; ++i, place += sizeof(To)) {
    // Reading an item may run code that changes the list.
    if (i >= PySequence_Fast_GET_SIZE(items)) return failure.set("the list was shortened while it was read");
    To number{};
    if (!read_number(PySequence_Fast_GET_ITEM(items, i), number, failure)) {
      return failure.inside(static_cast<std::size_t>(i));
    }
    std::memcpy(place, &number, sizeof(To));
  }
  return true;
}

/// Elements of another type than the field's, read as the widest type of their kind.
template <class From, class To>
bool encode_converted(const Field& field, PyArrayObject* array, int wide_type, WireBuffer& out,
                      ConversionFailure& failure) {
  const Ref wide =
      Ref::steal(PyArray_FromArray(array, PyArray_DescrFromType(wide_type), NPY_ARRAY_CARRAY_RO | NPY_ARRAY_FORCECAST));
  if (!wide) return false;
  auto* source = reinterpret_cast<PyArrayObject*>(wide.get());
  const auto count = static_cast<std::size_t>(PyArray_SIZE(source));
  if (!begin_array(field, count, out, failure)) return false;
  const auto* values = static_cast<const From*>(PyArray_DATA(source));
  std::uint8_t* place = out.extend(count * sizeof(To));
  for (std::size_t i = 0; i < count; ++i, place += sizeof(To)) {
    To number{};
    if (!narrow(values[i], number)) {
      failure.set("expected " + expectation<To>() + ", found " + std::to_string(values[i]));
      return failure.inside(i);
    }
    if constexpr (std::is_floating_point_v<From> && std::is_integral_v<To>) {
      if (std::abs(values[i] - static_cast<From>(number)) > kUnnoticedTruncation) failure.truncated(values[i]);
    }
    std::memcpy(place, &number, sizeof(To));
  }
  return true;
}

bool encode_array(const Field& field, PyArrayObject* array, WireBuffer& out, ConversionFailure& failure) {
  PyObject* object = reinterpret_cast<PyObject*>(array);
  if (PyArray_NDIM(array) == 0) return failure.expected(type_text(field), object);
  const PyArray_Descr* dtype = PyArray_DESCR(array);
  const bool same_type = dtype->kind == numpy_kind(field.kind).kind &&
                         PyArray_ITEMSIZE(array) == static_cast<npy_intp>(wire_size(field.kind)) &&
                         PyArray_ISNOTSWAPPED(array);
  if (same_type) {
    const Ref contiguous =
        Ref::steal(reinterpret_cast<PyObject*>(PyArray_GETCONTIGUOUS(array)));  // the array itself if it is contiguous
    if (!contiguous) return false;
    auto* source = reinterpret_cast<PyArrayObject*>(contiguous.get());
    if (!begin_array(field, static_cast<std::size_t>(PyArray_SIZE(source)), out, failure)) return false;
    out.put_bytes(PyArray_DATA(source), static_cast<std::size_t>(PyArray_NBYTES(source)));
    return true;
  }
  return messages::with_number(field.kind, [&](auto element) {
    using To = decltype(element);
    switch (dtype->kind) {
      case 'b':
      case 'i':
        return encode_converted<std::int64_t, To>(field, array, NPY_INT64, out, failure);
      case 'u':
        return encode_converted<std::uint64_t, To>(field, array, NPY_UINT64, out, failure);
      case 'f':
        return encode_converted<double, To>(field, array, NPY_FLOAT64, out, failure);
      case 'O': {
        const Ref items = as_items(field, object, failure);
        return items && encode_items<To>(field, items.get(), out, failure);
      }
      default:
        return failure.set("expected " + type_text(field) + ", found numpy array of dtype kind '" + dtype->kind + "'");
    }
  });
}

}  // namespace

bool load_numpy() {
  // NumPy would refuse, too, but with a page of advice on stderr.
  constexpr int kBuilt = NPY_ABI_VERSION >> 24;  // major version
  const Ref numpy = Ref::steal(PyImport_ImportModule("numpy"));
  if (!numpy) return false;
  const Ref version = Ref::steal(PyObject_GetAttrString(numpy.get(), "__version__"));
  const char* found = version ? PyUnicode_AsUTF8(version.get()) : nullptr;
  if (found == nullptr) return false;
  if (std::atoi(found) > kBuilt) {
    PyErr_Format(PyExc_ImportError, "bubblesim was built for numpy %d.x, this Python has %s: pip install \"numpy<%d\"",
                 kBuilt, found, kBuilt + 1);
    return false;
  }
  return _import_array() >= 0;
}

bool begin_array(const Field& field, std::size_t count, WireBuffer& out, ConversionFailure& failure) {
  if (field.array == ArrayKind::kFixed && count != field.fixed_length) {
    return failure.set("expected " + std::to_string(field.fixed_length) + " elements, found " + std::to_string(count));
  }
  if (field.bound != 0 && count > field.bound) {
    return failure.set("expected at most " + std::to_string(field.bound) + " elements, found " + std::to_string(count));
  }
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    return failure.set("an array of " + std::to_string(count) + " elements does not fit into a message");
  }
  if (field.array == ArrayKind::kVariable) out.put(static_cast<std::uint32_t>(count));
  if (count != 0) out.align(alignment(field.kind));
  return true;
}

Ref as_items(const Field& field, PyObject* value, ConversionFailure& failure) {
  const bool is_text = PyUnicode_Check(value) || PyBytes_Check(value) || PyByteArray_Check(value);
  const bool is_empty_table = PyDict_Check(value) && PyDict_GET_SIZE(value) == 0;  // from Lua, without lists
  if (is_text || (!PySequence_Check(value) && !is_empty_table)) {
    failure.expected(type_text(field) + " as a sequence", value);
    return {};
  }
  PyObject* items = PySequence_Fast(value, "not iterable");
  if (items == nullptr && clear_conversion_error()) failure.expected(type_text(field) + " as a sequence", value);
  return Ref::steal(items);
}

bool encode_numbers(const Field& field, PyObject* value, WireBuffer& out, ConversionFailure& failure) {
  const bool has_bytes = field.kind == FieldKind::kUint8 || field.kind == FieldKind::kInt8;
  if (PyArray_Check(value)) return encode_array(field, reinterpret_cast<PyArrayObject*>(value), out, failure);
  if (has_bytes && PyBytes_Check(value)) {
    return encode_bytes(field, {PyBytes_AS_STRING(value), static_cast<std::size_t>(Py_SIZE(value))}, out, failure);
  }
  if (has_bytes && PyByteArray_Check(value)) {
    return encode_bytes(field, {PyByteArray_AS_STRING(value), static_cast<std::size_t>(Py_SIZE(value))}, out, failure);
  }
  if (has_bytes && PyUnicode_Check(value)) return encode_text(field, value, out, failure);
  const bool is_text = PyUnicode_Check(value) || PyBytes_Check(value) || PyByteArray_Check(value);
  if (!is_text && PyObject_CheckBuffer(value)) {
    const Ref array = Ref::steal(PyArray_FROM_O(value));
    if (!array) return clear_conversion_error() && failure.expected(type_text(field), value);
    return encode_array(field, reinterpret_cast<PyArrayObject*>(array.get()), out, failure);
  }
  const Ref items = as_items(field, value, failure);
  return items && messages::with_number(field.kind, [&](auto element) {
           return encode_items<decltype(element)>(field, items.get(), out, failure);
         });
}

bool is_table_of(const Field& field, PyObject* value) {
  if (field.kind != FieldKind::kMessage || !PyArray_Check(value)) return false;
  auto* array = reinterpret_cast<PyArrayObject*>(value);
  const std::vector<Field>& columns = field.message->fields;
  const auto fits = [&columns](const Field& column) {
    return column.kind == columns[0].kind && column.array == ArrayKind::kNone && is_number(column.kind);
  };
  return PyArray_NDIM(array) == 2 && !columns.empty() &&
         static_cast<std::size_t>(PyArray_DIM(array, 1)) == columns.size() &&
         std::all_of(columns.begin(), columns.end(), fits);
}

bool encode_table(const Field& field, PyObject* value, WireBuffer& out, ConversionFailure& failure) {
  auto* array = reinterpret_cast<PyArrayObject*>(value);
  if (!begin_array(field, static_cast<std::size_t>(PyArray_DIM(array, 0)), out, failure)) return false;
  Field numbers;  // of known length, so the length is not written
  numbers.kind = field.message->fields[0].kind;
  numbers.array = ArrayKind::kFixed;
  numbers.fixed_length = static_cast<std::uint32_t>(PyArray_SIZE(array));
  return encode_array(numbers, array, out, failure);
}

PyObject* decode_numbers(FieldKind kind, const std::uint8_t* bytes, std::size_t count) {
  if (kind == FieldKind::kUint8) {
    return PyBytes_FromStringAndSize(reinterpret_cast<const char*>(bytes), static_cast<Py_ssize_t>(count));
  }
  npy_intp shape = static_cast<npy_intp>(count);
  PyObject* array = PyArray_SimpleNew(1, &shape, numpy_kind(kind).type_number);
  if (array == nullptr) return nullptr;
  auto* values = static_cast<std::uint8_t*>(PyArray_DATA(reinterpret_cast<PyArrayObject*>(array)));
  if (kind == FieldKind::kBool) {
    // NumPy relies on 0 and 1; the wire may have any byte.
    for (std::size_t i = 0; i < count; ++i) values[i] = bytes[i] != 0 ? 1 : 0;
  } else if (count != 0) {
    std::memcpy(values, bytes, count * wire_size(kind));
  }
  return array;
}

}  // namespace bubblesim::bindings
