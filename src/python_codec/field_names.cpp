// SPDX-License-Identifier: BSD-3-Clause
#include "field_names.hpp"

namespace bubblesim::bindings {

std::vector<PyObject*> interned_names;

PyObject* intern_name(std::uint32_t key, std::string_view name) {
  PyObject* text = PyUnicode_FromStringAndSize(name.data(), static_cast<Py_ssize_t>(name.size()));
  if (text == nullptr) return nullptr;
  PyUnicode_InternInPlace(&text);
  if (key >= interned_names.size()) interned_names.resize(key + 1);
  interned_names[key] = text;
  return text;
}

}  // namespace bubblesim::bindings
