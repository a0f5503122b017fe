// SPDX-License-Identifier: BSD-3-Clause
// Translates between Python dicts and ROS wire bytes, for every message type. The GIL must be held.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "message_walk.hpp"

namespace bubblesim::bindings {

/// Call it once, before everything else here. Throws pybind11::import_error if NumPy cannot be imported.
inline void init_message_codec() {
  if (prepare_codec()) return;
  const pybind11::error_already_set error;
  throw pybind11::import_error(pybind11::str(error.value()));  // the module's import fails with the same words
}

/// Appends the bytes of a message to `out`. `message` is a dict of field name -> value; missing fields get their
/// default.
///   bool: bool, 0, 1            integers: int, NumPy integers, finite floats truncated toward zero; range-checked
///   floats: any real number     string: str (UTF-8, surrogateescape) or bytes
///   time, duration: seconds as a number, {secs, nsecs} or {sec, nanosec}
///   arrays of numbers: buffers (numpy, array, memoryview) and sequences; uint8[] and int8[] also bytes, bytearray and
///   str (Latin-1)               other arrays: sequences
/// Throws pybind11::error_already_set (MessageError) with type, field path, expected and found value; `out` then holds
/// a part. Returns the fields where a float lost more than kUnnoticedTruncation.
inline std::vector<Truncation> encode(const messages::MessageType& type, PyObject* message, messages::WireBuffer& out) {
  std::vector<Truncation> truncations;
  if (!encode_message(type, message, out, &truncations)) throw pybind11::error_already_set();
  return truncations;
}

/// For scripts: None, or a list of (field, value before it was truncated).
inline pybind11::object to_python(const std::vector<Truncation>& truncations) {
  if (truncations.empty()) return pybind11::none();
  pybind11::list list;
  for (const Truncation& truncation : truncations) {
    list.append(pybind11::make_tuple(truncation.field, truncation.value));
  }
  return list;
}

/// Decodes a message to a dict: arrays of numbers become numpy arrays that own their data, uint8[] becomes bytes.
/// Throws pybind11::error_already_set (MessageError) if there are too few or too many bytes for the type.
inline pybind11::object decode(const messages::MessageType& type, messages::WireView bytes, CodecOptions options = {}) {
  PyObject* message = decode_message(type, bytes, options);
  if (message == nullptr) throw pybind11::error_already_set();
  return pybind11::reinterpret_steal<pybind11::object>(message);
}

/// A dict with all fields at their defaults.
inline pybind11::object default_message(const messages::MessageType& type, CodecOptions options = {}) {
  messages::WireBuffer bytes;
  bytes.begin(layout_of(type.version));
  bytes.extend(0);  // so that data() is never null
  put_default(type, bytes);
  return decode(type, messages::WireView(bytes.data(), bytes.size()), options);
}

}  // namespace bubblesim::bindings
