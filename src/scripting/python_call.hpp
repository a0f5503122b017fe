// SPDX-License-Identifier: BSD-3-Clause
// Calls from C++ to the simulator's Python code.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <stdexcept>
#include <string>

#include "bubblesim/simulation.hpp"

namespace bubblesim::scripting {

/// Acquires the GIL and calls. Other Python threads may use the simulation, which may be null, whenever the call
/// releases the GIL. Converts a Python exception, which must not outlive the interpreter, to a std::runtime_error.
template <class Action>
auto with_python(Simulation* simulation, const char* whose, Action action) {
  std::optional<AccessLock::Pause> others_may_use_it;
  if (simulation != nullptr) others_may_use_it.emplace(simulation->world().access());
  const pybind11::gil_scoped_acquire gil;
  try {
    return action();
  } catch (const pybind11::error_already_set& error) {
    throw std::runtime_error(std::string(whose) + " failed: " + error.what());
  }
}

}  // namespace bubblesim::scripting
