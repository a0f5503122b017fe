// SPDX-License-Identifier: BSD-3-Clause
// Array fields of bools and numbers, copied as whole buffers where possible.
#pragma once

#include <Python.h>

#include <cstddef>

#include "bubblesim/messages/message_type.hpp"
#include "bubblesim/messages/numbers.hpp"
#include "bubblesim/messages/wire.hpp"
#include "conversion_failure.hpp"
#include "python_ref.hpp"

namespace bubblesim::bindings {

/// Loads NumPy's C interface. False: an exception is set.
bool load_numpy();

/// Writes the count of a variable array or checks that of a fixed one. False: `failure` has the reason.
bool begin_array(const messages::Field& field, std::size_t count, messages::WireBuffer& out,
                 ConversionFailure& failure);

/// The items of a sequence other than str: a list or tuple, the value itself if it is one. Empty: `failure` has the
/// reason.
Ref as_items(const messages::Field& field, PyObject* value, ConversionFailure& failure);

/// False: `failure` has the reason, or a Python exception is set.
bool encode_numbers(const messages::Field& field, PyObject* value, messages::WireBuffer& out,
                    ConversionFailure& failure);

/// Whether `value` is a numpy array of n x k, for an array of messages with k numbers of one kind, such as Point32.
bool is_table_of(const messages::Field& field, PyObject* value);
/// Writes its rows as n messages. False: `failure` has the reason, or a Python exception is set.
bool encode_table(const messages::Field& field, PyObject* value, messages::WireBuffer& out, ConversionFailure& failure);

/// `count` elements at `bytes` as a new bytes (uint8) or numpy array. nullptr: out of memory.
PyObject* decode_numbers(messages::FieldKind kind, const std::uint8_t* bytes, std::size_t count);

}  // namespace bubblesim::bindings
