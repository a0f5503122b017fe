// SPDX-License-Identifier: BSD-3-Clause
// The process-wide state of the codec.
#include "message_walk.hpp"
#include "numeric_arrays.hpp"

namespace bubblesim::bindings {
namespace {

PyObject* message_error_class = nullptr;

}  // namespace

bool prepare_codec() {
  if (message_error_class != nullptr) return true;
  if (!load_numpy()) return false;
  message_error_class = PyErr_NewExceptionWithDoc(
      "bubblesim.MessageError",
      "Conversion error of a message: a dict or bytes that do not fit the message type, with field and cause.",
      PyExc_ValueError, nullptr);
  return message_error_class != nullptr;
}

PyObject* message_error() { return message_error_class; }

}  // namespace bubblesim::bindings
