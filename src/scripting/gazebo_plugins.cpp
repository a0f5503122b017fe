// SPDX-License-Identifier: BSD-3-Clause
#include "bubblesim/gazebo_plugins.hpp"

#include "python_methods.hpp"

namespace bubblesim {

GazeboPlugins::GazeboPlugins(PythonEngine& engine, bool follows_rates) : PythonSystem(engine, "Gazebo plugins") {
  with_python([&] {
    const auto& [interpreter, runner, bridge] = engine.objects();
    const pybind11::module_ plugins = pybind11::module_::import("bubblesim.gazebo_plugins.robots");
    methods_->bind(plugins.attr("GazeboPlugins")(runner.attr("simulation"), bridge,
                                                 pybind11::arg("follows_rates") = follows_rates));
  });
}

}  // namespace bubblesim
