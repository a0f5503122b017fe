// SPDX-License-Identifier: BSD-3-Clause
// The codec with Python's C interface: a failure sets a Python exception. message_codec.hpp is the same for callers
// that use pybind11, and documents the accepted values.
#pragma once

#include <Python.h>

#include <cstdint>
#include <vector>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/wire.hpp"
#include "conversion_failure.hpp"

namespace bubblesim::bindings {

/// Form of times and durations from decode(). encode() accepts all of them.
enum class TimeForm : std::uint8_t {
  kSecsNsecs,   ///< {'secs': int, 'nsecs': int}
  kSecNanosec,  ///< {'sec': int, 'nanosec': int}
  kFloat,       ///< seconds; a double cannot hold today's date in nanoseconds
};

struct CodecOptions {
  TimeForm time = TimeForm::kSecsNsecs;
};

/// The Python class bubblesim.MessageError (a ValueError). A borrowed reference; nullptr before prepare_codec().
PyObject* message_error();

/// Call it once, before everything else here. False: an exception is set.
bool prepare_codec();

/// Appends to `out`. False: an exception is set, and `out` holds a part of the message. `truncations`, if given, gets
/// the integer fields that got a float with a noticeable fraction.
bool encode_message(const messages::MessageType& type, PyObject* message, messages::WireBuffer& out,
                    std::vector<Truncation>* truncations = nullptr);

/// A new reference. nullptr: an exception is set.
PyObject* decode_message(const messages::MessageType& type, messages::WireView bytes, CodecOptions options);

}  // namespace bubblesim::bindings
