// SPDX-License-Identifier: BSD-3-Clause
// What the codec keeps for the whole process.
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
      "bubblesim.MessageError", "A dict that does not fit its message type, or bytes that do not; says where and why.",
      PyExc_ValueError, nullptr);
  return message_error_class != nullptr;
}

PyObject* message_error() { return message_error_class; }

}  // namespace bubblesim::bindings
