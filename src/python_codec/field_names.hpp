// SPDX-License-Identifier: BSD-3-Clause
// Field names as interned Python strings: most dict look-ups then compare pointers only.
#pragma once

#include <Python.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "bubblesim/messages/message_type.hpp"

namespace bubblesim::bindings {

/// Indexed by Field::key; nullptr for a name not used yet.
extern std::vector<PyObject*> interned_names;

/// Makes the missing entry. Returns nullptr with a Python exception if out of memory.
PyObject* intern_name(std::uint32_t key, std::string_view name);

/// A borrowed reference that stays valid as long as the interpreter.
inline PyObject* python_name(const messages::Field& field) {
  if (field.key < interned_names.size() && interned_names[field.key] != nullptr) return interned_names[field.key];
  return intern_name(field.key, field.name);
}

}  // namespace bubblesim::bindings
