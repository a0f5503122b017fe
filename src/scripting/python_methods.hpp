// SPDX-License-Identifier: BSD-3-Clause
// The Python objects of PythonEngine and PythonSystem.
#pragma once

#include <pybind11/pybind11.h>

#include "bubblesim/python_system.hpp"
#include "interpreter.hpp"
#include "python_call.hpp"

namespace bubblesim {

struct PythonEngine::Objects {
  scripting::Interpreter interpreter;
  pybind11::object runner;
  pybind11::object bridge;  // as scripts and plugins use it; None without ROS
};

/// The object, and its bound methods, looked up once because they are called in every step.
struct PythonSystem::Methods {
  pybind11::object self;
  pybind11::object process_input;
  pybind11::object actuate;
  pybind11::object sense;
  pybind11::object publish;
  pybind11::object stop;
  pybind11::object start;
  pybind11::object reset;
  pybind11::object model_added;
  pybind11::object model_removing;
  pybind11::object save_state;
  pybind11::object restore_state;

  /// Call it with the GIL.
  void bind(pybind11::object object);
};

template <class Action>
void PythonSystem::with_python(Action action) {
  scripting::with_python(engine_.simulation(), name_.c_str(), [&] {
    action();
    after_call();
  });
}

}  // namespace bubblesim
