// SPDX-License-Identifier: BSD-3-Clause
// What the codec keeps for the whole process.
#include "message_codec.hpp"
#include "numeric_arrays.hpp"

namespace bubblesim::bindings {
namespace {

PyObject* message_error_class = nullptr;

}  // namespace

void init_message_codec() {
  if (message_error_class != nullptr) return;
  init_numeric_arrays();
  message_error_class = PyErr_NewExceptionWithDoc(
      "bubblesim.MessageError", "A dict that does not fit its message type, or bytes that do not; says where and why.",
      PyExc_ValueError, nullptr);
  if (message_error_class == nullptr) throw pybind11::error_already_set();
}

PyObject* message_error() { return message_error_class; }

}  // namespace bubblesim::bindings
