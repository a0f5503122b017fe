// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/node_services.hpp"

#include "python_methods.hpp"

namespace bubblesim {

namespace py = pybind11;

NodeServices::NodeServices(PythonEngine& engine, const ChildScripts& scripts, bool gazebo_names,
                           const std::string& node_name)
    : PythonSystem(engine, "the node's services") {
  with_python([&] {
    methods_->bind(py::module_::import("bubblesim.services.offered")
                       .attr("NodeServices")(scripts.methods_->self, py::arg("gazebo_compat") = gazebo_names,
                                             py::arg("node_name") = node_name));
  });
}

}  // namespace bubblesim
