// SPDX-License-Identifier: BSD-3-Clause
// Why and where inside a message a value could not be converted.
#pragma once

#include <Python.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace bubblesim::bindings {

/// Filled from the inside out while a failed conversion returns through the fields that it was in: nothing is spent on
/// paths as long as all goes well. Its functions return false, so that they can be returned.
class ConversionFailure {
 public:
  bool set(std::string reason);
  /// "expected <expected>, found <found>".
  bool expected(std::string_view expected, PyObject* found);
  bool inside(std::string_view field);
  bool inside(std::size_t index);

  /// Sets MessageError, unless a Python exception of another origin (KeyboardInterrupt, MemoryError) is set.
  void raise(std::string_view type_name) const;

 private:
  std::string path_;
  std::string reason_;
};

/// A value as error texts show it: "str 'abc'", "list of 3", "float 1.5".
std::string describe(PyObject* value);

/// Clears a Python exception that only says "wrong type or value", for which there will be a better text. Returns false
/// and keeps it when it says anything else.
bool clear_conversion_error();

}  // namespace bubblesim::bindings
