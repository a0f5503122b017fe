// SPDX-License-Identifier: BSD-3-Clause
// Encodes a dict to wire bytes.
#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

#include "bubblesim/messages/registry.hpp"
#include "bubblesim/nearest_names.hpp"
#include "field_names.hpp"
#include "message_walk.hpp"
#include "numeric_arrays.hpp"
#include "python_values.hpp"

namespace bubblesim::bindings {
namespace {

using messages::ArrayKind;
using messages::Field;
using messages::FieldKind;
using messages::Layout;
using messages::MessageType;

/// The layout is known here, so that the packed one of ROS 1 spends nothing on alignment.
template <Layout layout>
class Encoder {
 public:
  explicit Encoder(messages::WireBuffer& out) : out_(out) { out_.begin(layout); }

  /// All functions return false if `failure` has the reason or a Python exception is set.
  ConversionFailure failure;

  bool message(const MessageType& type, PyObject* value) {
    if (!PyDict_Check(value)) return failure.expected("dict with the fields of " + type.name, value);
    const Ref held = Ref::borrow(value);  // Python code of a value may release it
    if (kIsCdr && type.fields.empty()) out_.put_empty();
    Py_ssize_t used = 0;
    Py_ssize_t position = 0;
    for (const Field& field : type.fields) {
      PyObject* const name = python_name(field);
      if (name == nullptr) return false;
      // Dicts keep insertion order, usually that of the fields: try the next entry before searching.
      Py_ssize_t next = position;
      PyObject* key = nullptr;
      PyObject* item = nullptr;
      if (PyDict_Next(value, &next, &key, &item) != 0 && key == name) {
        position = next;
      } else {
        item = PyDict_GetItemWithError(value, name);
      }
      if (item != nullptr) {
        ++used;
        const std::size_t truncated = failure.truncation_count();
        if (!this->field(field, item)) return failure.inside(field.name);
        if (failure.truncation_count() != truncated) failure.truncated_inside(truncated, field.name);
      } else {
        if (PyErr_Occurred() != nullptr) return false;
        put_default(field, out_);
      }
    }
    return used == PyDict_GET_SIZE(value) || unknown_key(type, value);
  }

 private:
  static constexpr bool kIsCdr = layout == Layout::kCdr;

  bool field(const Field& field, PyObject* value) {
    if (field.array == ArrayKind::kNone) return element(field, value);
    if (is_number(field.kind)) return encode_numbers(field, value, out_, failure);
    if (is_table_of(field, value)) return encode_table(field, value, out_, failure);
    const Ref held = Ref::borrow(value);
    const Ref items = as_items(field, value, failure);
    if (!items) return false;
    const Py_ssize_t count = PySequence_Fast_GET_SIZE(items.get());
    if (!begin_array(field, static_cast<std::size_t>(count), out_, failure)) return false;
    const std::size_t before = failure.truncation_count();
    std::size_t truncated = before;
    for (Py_ssize_t i = 0; i < count; ++i) {
      // Reading an item may run code that changes the list.
      if (i >= PySequence_Fast_GET_SIZE(items.get())) return failure.set("the list was shortened while it was read");
      if (!element(field, PySequence_Fast_GET_ITEM(items.get(), i))) {
        return failure.inside(static_cast<std::size_t>(i));
      }
      if (failure.truncation_count() != truncated) {
        failure.unite_truncations(before);
        truncated = failure.truncation_count();
      }
    }
    return true;
  }

  bool element(const Field& field, PyObject* value) {
    switch (field.kind) {
      case FieldKind::kBool:
        return number<bool>(value);
      case FieldKind::kInt8:
        return number<std::int8_t>(value);
      case FieldKind::kUint8:
        return number<std::uint8_t>(value);
      case FieldKind::kInt16:
        return number<std::int16_t>(value);
      case FieldKind::kUint16:
        return number<std::uint16_t>(value);
      case FieldKind::kInt32:
        return number<std::int32_t>(value);
      case FieldKind::kUint32:
        return number<std::uint32_t>(value);
      case FieldKind::kInt64:
        return number<std::int64_t>(value);
      case FieldKind::kUint64:
        return number<std::uint64_t>(value);
      case FieldKind::kFloat32:
        return number<float>(value);
      case FieldKind::kFloat64:
        return number<double>(value);
      case FieldKind::kString:
        return string(field, value);
      case FieldKind::kTime:
        return kIsCdr ? time<std::int32_t>(value) : time<std::uint32_t>(value);
      case FieldKind::kDuration:
        return time<std::int32_t>(value);
      case FieldKind::kMessage:
        return message(*field.message, value);
    }
    return failure.set("field of an unknown kind");
  }

  template <class T>
  void put(T number) {
    if constexpr (kIsCdr) out_.align(sizeof(T));
    std::memcpy(out_.extend(sizeof(T)), &number, sizeof(T));
  }

  template <class T>
  bool number(PyObject* value) {
    T number{};
    if (!read_number(value, number, failure)) return false;
    put(number);
    return true;
  }

  bool string(const Field& field, PyObject* value) {
    std::string_view bytes;
    PyObject* owner = nullptr;
    if (!read_string(value, bytes, owner, failure)) return false;
    const std::size_t most =
        field.string_bound != 0 ? field.string_bound : std::numeric_limits<std::uint32_t>::max() - 1;
    const bool fits = bytes.size() <= most;
    if (fits) {
      put(static_cast<std::uint32_t>(bytes.size() + (kIsCdr ? 1 : 0)));
      out_.put_bytes(bytes.data(), bytes.size());
      if (kIsCdr) put('\0');
    }
    Py_XDECREF(owner);
    return fits ||
           failure.set("expected at most " + std::to_string(most) + " bytes, found " + std::to_string(bytes.size()));
  }

  template <class T>
  bool time(PyObject* value) {
    TimeParts<T> parts;
    if (!read_time(value, parts, failure)) return false;
    put(parts.secs);
    put(parts.nsecs);
    return true;
  }

  bool unknown_key(const MessageType& type, PyObject* dict) {
    std::vector<std::string> names;
    for (const Field& field : type.fields) names.push_back(field.name);
    Py_ssize_t position = 0;
    PyObject* key = nullptr;
    while (PyDict_Next(dict, &position, &key, nullptr) != 0) {
      const char* letters = PyUnicode_Check(key) ? PyUnicode_AsUTF8(key) : nullptr;
      if (letters == nullptr) {
        PyErr_Clear();
        return failure.expected("field names of " + type.name + " as keys", key);
      }
      if (std::find(names.begin(), names.end(), letters) != names.end()) continue;
      std::string valid;
      for (const std::string& name : names) valid += (valid.empty() ? "" : ", ") + name;
      return failure.set(type.name + " has no field '" + letters + "'" + did_you_mean(letters, names) +
                         (did_you_mean(letters, names).empty() ? ";" : "") +
                         " its fields: " + (valid.empty() ? "none" : valid) + of_other_version(type, letters));
    }
    return true;  // Python code of a value changed the dict: all current entries are known fields
  }

  /// A hint for scripts that were written for the other version of ROS.
  static std::string of_other_version(const MessageType& type, std::string_view name) {
    const bool is_ros2 = type.version == messages::RosVersion::kRos2;
    const MessageType* other =
        messages::find_message(type.name, is_ros2 ? messages::RosVersion::kRos1 : messages::RosVersion::kRos2);
    const auto has = [name](const Field& field) { return field.name == name; };
    if (other == nullptr || std::none_of(other->fields.begin(), other->fields.end(), has)) return {};
    return std::string("; in ROS ") + (is_ros2 ? "1" : "2") + " it has '" + std::string(name) + "'";
  }

  messages::WireBuffer& out_;
};

template <Layout layout>
bool encode_as(const MessageType& type, PyObject* message, messages::WireBuffer& out,
               std::vector<Truncation>* truncations) {
  Encoder<layout> encoder(out);
  if (encoder.message(type, message)) {
    if (truncations != nullptr) *truncations = encoder.failure.take_truncations();
    return true;
  }
  encoder.failure.raise(type.name);
  return false;
}

}  // namespace

bool encode_message(const MessageType& type, PyObject* message, messages::WireBuffer& out,
                    std::vector<Truncation>* truncations) {
  return layout_of(type.version) == Layout::kCdr ? encode_as<Layout::kCdr>(type, message, out, truncations)
                                                 : encode_as<Layout::kPacked>(type, message, out, truncations);
}

}  // namespace bubblesim::bindings
