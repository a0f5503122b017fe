// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/observers.hpp"

#include <pybind11/stl.h>

#include <cstdio>
#include <exception>

#include "python_methods.hpp"

namespace bubblesim {

namespace py = pybind11;

Observers::Observers(PythonEngine& engine, const ObserverOptions& options) : PythonSystem(engine, "the observers") {
  with_python([&] {
    PythonEngine::Objects& python = engine.objects();
    methods_->bind(py::module_::import("bubblesim.observers.observers")
                       .attr("Observers")(python.bridge, python.runner, options.record.string(), options.lockstep));
    python.bridge = methods_->self.attr("bridge");
  });
}

Observers::~Observers() {
  try {
    with_python([&] { methods_->self.attr("close")(); });
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
}

}  // namespace bubblesim
