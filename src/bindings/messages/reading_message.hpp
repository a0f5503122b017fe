// SPDX-License-Identifier: BSD-3-Clause
// Messages that are made of readings, beside those that are dicts.
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "bubblesim/messages/fields.hpp"
#include "message_codec.hpp"

namespace bubblesim::bindings {

/// The fields of a ReadingMessage; nullptr for a dict.
inline const messages::FieldReader* reading_message(const pybind11::object& message) {
  if (PyDict_Check(message.ptr()) || !pybind11::isinstance<messages::FieldReader>(message)) return nullptr;
  return message.cast<const messages::FieldReader*>();
}

/// Appends the bytes of a dict or a ReadingMessage; see encode() of the dicts. Throws std::invalid_argument for a
/// ReadingMessage of another type.
inline std::vector<Truncation> encode_any(const messages::MessageType& type, const pybind11::object& message,
                                          messages::WireBuffer& out) {
  const messages::FieldReader* reading = reading_message(message);
  if (reading == nullptr) return encode(type, message.ptr(), out);
  messages::encode(type, *reading, out);
  return {};
}

}  // namespace bubblesim::bindings
