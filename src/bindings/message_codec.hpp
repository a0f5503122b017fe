// SPDX-License-Identifier: BSD-3-Clause
// Translates between Python dicts and ROS wire bytes, for every message type alike. The GIL must be held.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/wire.hpp"

namespace bubblesim::bindings {

/// What decode() makes of a time or a duration. encode() takes all of them.
enum class TimeForm : std::uint8_t {
  kSecsNsecs,   ///< {'secs': int, 'nsecs': int}
  kSecNanosec,  ///< {'sec': int, 'nanosec': int}
  kFloat,       ///< seconds; a double has no room for the nanoseconds of today's date
};

struct CodecOptions {
  TimeForm time = TimeForm::kSecsNsecs;
};

/// Once in the process, before all else here. Throws pybind11::error_already_set when NumPy cannot be imported.
void init_message_codec();

/// The Python class bubblesim.MessageError (a ValueError), which encode() and decode() raise. A borrowed reference.
PyObject* message_error();

/// Appends the bytes of a message to `out`. `message` is a dict of field name -> value; missing fields get their
/// default.
///   bool: bool, 0, 1            integers: int, NumPy integers, floats without fraction; range-checked
///   floats: any real number     string: str (UTF-8, surrogateescape) or bytes
///   time, duration: seconds as a number, {secs, nsecs} or {sec, nanosec}
///   arrays of numbers: buffers (numpy, array, memoryview) and sequences; uint8[] and int8[] also bytes, bytearray and
///   str (Latin-1)               other arrays: sequences
/// Throws pybind11::error_already_set (MessageError) with type, field path, expected and found; `out` then holds a
/// part.
void encode(const messages::MessageType& type, PyObject* message, messages::WireBuffer& out);

/// The dict of a message's bytes: arrays of numbers become numpy arrays that own their data, uint8[] becomes bytes.
/// Throws pybind11::error_already_set (MessageError) when the bytes are too few or too many for the type.
pybind11::object decode(const messages::MessageType& type, messages::WireView bytes, CodecOptions options = {});

/// A dict with all fields at their defaults.
pybind11::object default_message(const messages::MessageType& type, CodecOptions options = {});

}  // namespace bubblesim::bindings
