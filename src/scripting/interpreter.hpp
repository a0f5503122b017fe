// SPDX-License-Identifier: BSD-3-Clause
// The embedded Python interpreter.
#pragma once

#include <pybind11/embed.h>

#include <memory>

namespace bubblesim::scripting {

/// Starts Python as /usr/bin/python3 starts, whatever `python3` is first on PATH, and releases the GIL: acquire it for
/// each use. Throws std::runtime_error if the `bubblesim` package cannot be found.
class Interpreter {
 public:
  Interpreter();
  ~Interpreter();
  Interpreter(const Interpreter&) = delete;
  Interpreter& operator=(const Interpreter&) = delete;

 private:
  std::unique_ptr<pybind11::gil_scoped_release> released_;
};

/// Makes Python run the handler installed by bubblesim.scripting.host.interruption. A signal handler may call it, on
/// the thread that made the interpreter.
void interrupt();

}  // namespace bubblesim::scripting
