// SPDX-License-Identifier: BSD-3-Clause
// Decodes wire bytes to a dict.
#include <cstring>
#include <string>
#include <utility>

#include "bubblesim/messages/registry.hpp"
#include "field_names.hpp"
#include "message_walk.hpp"
#include "numeric_arrays.hpp"

namespace bubblesim::bindings {
namespace {

using messages::ArrayKind;
using messages::Field;
using messages::FieldKind;
using messages::MessageType;
using messages::WireView;

/// Elements without content (std_msgs/Empty[]) cost the sender four bytes for any number of them.
constexpr std::uint32_t kMostEmptyElements = 1U << 16U;

/// The layout is known here, so that the packed one of ROS 1 spends nothing on alignment.
template <messages::Layout layout>
class Decoder {
 public:
  Decoder(WireView bytes, CodecOptions options) : bytes_(bytes), options_(options) { bytes_.begin(layout); }

  /// All functions return an empty object if `failure` has the reason or a Python exception is set.
  ConversionFailure failure;

  Ref message(const MessageType& type) {
    if (kIsCdr && type.fields.empty()) bytes_.skip_empty();
    Ref dict = Ref::steal(PyDict_New());
    if (!dict) return dict;
    for (const Field& field : type.fields) {
      const Ref value = this->field(field);
      if (!value) {
        failure.inside(field.name);
        return {};
      }
      PyObject* const name = python_name(field);
      if (name == nullptr || PyDict_SetItem(dict.get(), name, value.get()) != 0) return {};
    }
    return dict;
  }

  bool at_end() {
    return bytes_.surplus() == 0 || failure.set(std::to_string(bytes_.left()) + " surplus bytes after the last field");
  }

 private:
  static constexpr bool kIsCdr = layout == messages::Layout::kCdr;

  Ref field(const Field& field) {
    if (field.array == ArrayKind::kNone) return element(field);
    std::uint32_t count = field.fixed_length;
    if (field.array == ArrayKind::kVariable) {
      if (!next(FieldKind::kUint32, sizeof(count))) return {};
      count = get<std::uint32_t>();
    }
    // Before allocating: a wrong count may have any value.
    const std::size_t least_size = minimum_element_size(field);
    if (!next(count == 0 ? FieldKind::kUint8 : field.kind, count * least_size)) return {};
    if (is_number(field.kind)) return Ref::steal(decode_numbers(field.kind, bytes_.take(count * least_size), count));
    if (least_size == 0 && count > kMostEmptyElements) {
      failure.set("an array of " + std::to_string(count) + " empty elements");
      return {};
    }
    return list(field, count);
  }

  Ref list(const Field& field, std::uint32_t count) {
    Ref items = Ref::steal(PyList_New(count));
    for (std::uint32_t i = 0; items && i < count; ++i) {
      Ref item = element(field);
      if (!item) {
        failure.inside(i);
        return {};
      }
      PyList_SET_ITEM(items.get(), i, item.release());
    }
    return items;
  }

  Ref element(const Field& field) {
    if (field.kind == FieldKind::kMessage) return message(*field.message);
    if (field.kind == FieldKind::kString) return string();
    if (!next(field.kind, wire_size(field.kind))) return {};
    switch (field.kind) {
      case FieldKind::kBool:
        return Ref::steal(PyBool_FromLong(get<std::uint8_t>() != 0 ? 1 : 0));
      case FieldKind::kInt8:
        return Ref::steal(PyLong_FromLong(get<std::int8_t>()));
      case FieldKind::kUint8:
        return Ref::steal(PyLong_FromLong(get<std::uint8_t>()));
      case FieldKind::kInt16:
        return Ref::steal(PyLong_FromLong(get<std::int16_t>()));
      case FieldKind::kUint16:
        return Ref::steal(PyLong_FromLong(get<std::uint16_t>()));
      case FieldKind::kInt32:
        return Ref::steal(PyLong_FromLong(get<std::int32_t>()));
      case FieldKind::kUint32:
        return Ref::steal(PyLong_FromUnsignedLong(get<std::uint32_t>()));
      case FieldKind::kInt64:
        return Ref::steal(PyLong_FromLongLong(get<std::int64_t>()));
      case FieldKind::kUint64:
        return Ref::steal(PyLong_FromUnsignedLongLong(get<std::uint64_t>()));
      case FieldKind::kFloat32:
        return Ref::steal(PyFloat_FromDouble(get<float>()));
      case FieldKind::kFloat64:
        return Ref::steal(PyFloat_FromDouble(get<double>()));
      case FieldKind::kTime:
        return kIsCdr ? time<std::int32_t>() : time<std::uint32_t>();
      case FieldKind::kDuration:
        return time<std::int32_t>();
      default:
        failure.set("field of an unknown kind");
        return {};
    }
  }

  Ref string() {
    if (!next(FieldKind::kUint32, sizeof(std::uint32_t))) return {};
    auto size = get<std::uint32_t>();
    if (!has(size)) return {};
    // Surrogates stand for bytes that are not UTF-8; encoding converts them back.
    const auto* letters = reinterpret_cast<const char*>(bytes_.take(size));
    if (kIsCdr && size > 0 && letters[size - 1] == '\0') --size;
    return Ref::steal(PyUnicode_DecodeUTF8(letters, size, "surrogateescape"));
  }

  template <class T>
  Ref time() {
    const auto secs = get<T>();
    const auto nsecs = get<T>();
    if (options_.time == TimeForm::kFloat) return Ref::steal(PyFloat_FromDouble(secs + 1e-9 * nsecs));
    static const Field kNames[2][2] = {{part("secs"), part("nsecs")}, {part("sec"), part("nanosec")}};
    const Field* parts = kNames[options_.time == TimeForm::kSecNanosec ? 1 : 0];
    Ref dict = Ref::steal(PyDict_New());
    const Ref whole = Ref::steal(PyLong_FromLongLong(secs));
    const Ref rest = Ref::steal(PyLong_FromLongLong(nsecs));
    const bool made = dict && whole && rest && PyDict_SetItem(dict.get(), python_name(parts[0]), whole.get()) == 0 &&
                      PyDict_SetItem(dict.get(), python_name(parts[1]), rest.get()) == 0;
    return made ? std::move(dict) : Ref();
  }

  static Field part(const char* name) {
    Field field;
    field.name = name;
    field.key = messages::field_key(name);
    return field;
  }

  /// Goes on to where a value of this kind begins, and checks that `size` bytes follow.
  bool next([[maybe_unused]] FieldKind kind, std::size_t size) {
    if constexpr (kIsCdr) bytes_.align(alignment(kind));
    return has(size);
  }

  /// After next(), so it is aligned.
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, bytes_.take(sizeof(T)), sizeof(T));
    return value;
  }

  bool has(std::size_t size) {
    return size <= bytes_.left() || failure.set("the message is truncated: expected " + std::to_string(size) +
                                                " more bytes, found " + std::to_string(bytes_.left()));
  }

  WireView bytes_;
  CodecOptions options_;
};

template <messages::Layout layout>
PyObject* decode_as(const MessageType& type, WireView bytes, CodecOptions options) {
  Decoder<layout> decoder(bytes, options);
  Ref message = decoder.message(type);
  if (message && decoder.at_end()) return message.release();
  decoder.failure.raise(type.name);
  return nullptr;
}

}  // namespace

PyObject* decode_message(const MessageType& type, WireView bytes, CodecOptions options) {
  using messages::Layout;
  return layout_of(type.version) == Layout::kCdr ? decode_as<Layout::kCdr>(type, bytes, options)
                                                 : decode_as<Layout::kPacked>(type, bytes, options);
}

}  // namespace bubblesim::bindings
