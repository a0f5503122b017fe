// SPDX-License-Identifier: BSD-3-Clause
// The Python objects of ChildScripts.
#pragma once

#include <pybind11/pybind11.h>

#include "bubblesim/child_scripts.hpp"
#include "interpreter.hpp"

namespace bubblesim {

struct ChildScripts::Python {
  scripting::Interpreter interpreter;
  pybind11::object host;
  pybind11::object process_input;
  pybind11::object publish;  // None without a bridge
  pybind11::object close;
  pybind11::object actuate;
  pybind11::object sense;
  pybind11::object finish;
  bool finished = false;
};

}  // namespace bubblesim
