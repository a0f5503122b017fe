// SPDX-License-Identifier: BSD-3-Clause
// An owned reference to a Python object. Replaces pybind11's object, whose header alone takes more time and memory to
// compile than the whole codec.
#pragma once

#include <Python.h>

#include <utility>

namespace bubblesim::bindings {

class Ref {
 public:
  Ref() = default;
  Ref(Ref&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Ref& operator=(Ref&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  Ref(const Ref&) = delete;
  Ref& operator=(const Ref&) = delete;
  ~Ref() { Py_XDECREF(object_); }

  /// Takes ownership of a new reference; nullptr gives an empty one.
  static Ref steal(PyObject* object) { return Ref(object); }
  /// Keeps another owner's object alive.
  static Ref borrow(PyObject* object) {
    Py_XINCREF(object);
    return Ref(object);
  }

  explicit operator bool() const { return object_ != nullptr; }
  PyObject* get() const { return object_; }
  PyObject* release() { return std::exchange(object_, nullptr); }

 private:
  explicit Ref(PyObject* object) : object_(object) {}

  PyObject* object_ = nullptr;
};

}  // namespace bubblesim::bindings
