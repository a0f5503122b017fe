// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/remote_api_server.hpp"

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <utility>

#include "python_methods.hpp"

namespace bubblesim {

namespace py = pybind11;

RemoteApiServer::RemoteApiServer(PythonEngine& engine, const RemoteApiOptions& options)
    : PythonSystem(engine, "the remote API server") {
  with_python([&] {
    const py::object server = py::module_::import("bubblesim.remote.server").attr("RemoteServer");
    const py::cpp_function note_clients([this](bool any) { has_clients_ = any; });
    try {
      methods_->bind(server(options.address, options.port, note_clients, py::arg("socket") = options.socket.string(),
                            py::arg("token") = options.token.string(), py::arg("trusted") = options.trusted,
                            py::arg("fixed_scene") = options.fixed_scene));
    } catch (const py::error_already_set& error) {
      if (!error.matches(PyExc_RuntimeError)) throw;
      throw std::runtime_error(py::str(error.value()));  // such as a port in use: the user's, not the code's
    }
  });
}

RemoteApiServer::~RemoteApiServer() {
  try {
    close();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
  }
}

void RemoteApiServer::publish(const World& world, double time) {
  if (has_clients_) PythonSystem::publish(world, time);
}

void RemoteApiServer::attach(const ChildScripts& scripts, const std::string& failure) {
  with_python([&] { methods_->self.attr("attach")(scripts.methods_->self, failure); });
}

void RemoteApiServer::detach() {
  with_python([&] { methods_->self.attr("detach")(); });
}

std::shared_ptr<const Scene> RemoteApiServer::take_next_scene() {
  std::shared_ptr<const Scene> next;
  with_python([&] { next = methods_->self.attr("take_next_scene")().cast<std::shared_ptr<Scene>>(); });
  return next;
}

void RemoteApiServer::close() {
  if (std::exchange(closed_, true)) return;
  with_python([&] { methods_->self.attr("close")(); });
}

}  // namespace bubblesim
