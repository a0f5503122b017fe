// SPDX-License-Identifier: BSD-3-Clause
// The embedded Python interpreter.
#pragma once

#include <pybind11/embed.h>

#include <memory>

namespace bubblesim::scripting {

/// Starts Python as /usr/bin/python3 would start, whatever `python3` comes first on PATH, and lets go of the GIL: take
/// it around each use. Throws std::runtime_error when the `bubblesim` package cannot be found.
class Interpreter {
 public:
  Interpreter();
  ~Interpreter();
  Interpreter(const Interpreter&) = delete;
  Interpreter& operator=(const Interpreter&) = delete;

 private:
  std::unique_ptr<pybind11::gil_scoped_release> released_;
};

/// Has Python run the handler that bubblesim.scripting.host.interruption installed. A signal
/// handler may call it, on the thread that made the interpreter.
void interrupt();

}  // namespace bubblesim::scripting
