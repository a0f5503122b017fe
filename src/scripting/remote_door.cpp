// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/remote_door.hpp"

#include <cstdio>
#include <exception>

#include "python_methods.hpp"

namespace bubblesim {

namespace py = pybind11;

RemoteDoor::RemoteDoor(PythonEngine& engine, const ChildScripts& scripts, const std::string& address, int port)
    : PythonSystem(engine, "the door for remote clients") {
  with_python([&] {
    methods_->bind(
        py::module_::import("bubblesim.remote.server").attr("RemoteServer")(scripts.methods_->self, address, port));
  });
}

RemoteDoor::~RemoteDoor() {
  try {
    close();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
}

void RemoteDoor::close() {
  with_python([&] { methods_->self.attr("close")(); });
}

}  // namespace bubblesim
