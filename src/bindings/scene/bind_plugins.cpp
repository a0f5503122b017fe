// SPDX-License-Identifier: BSD-3-Clause
// The <plugin> elements of a scene.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "bubblesim/scene.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

/// The position in the scene file.
template <class Described>
void bind_source(py::class_<Described>& described) {
  described.def_property_readonly("file", [](const Described& d) { return d.source.file; })
      .def_property_readonly(
          "line", [](const Described& d) { return d.source.line; }, "0 if unknown.");
}

}  // namespace

void bind_plugins(py::module_& module) {
  py::class_<PluginParameter> parameter(module, "PluginParameter", "One element of a <plugin>.");
  parameter.def_readonly("name", &PluginParameter::name)
      .def_readonly("text", &PluginParameter::text)
      .def_readonly("children", &PluginParameter::children);
  bind_source(parameter);
  py::class_<PluginDescription> plugin(module, "PluginDescription", "A <plugin> of a world, model or sensor.");
  plugin.def_readonly("name", &PluginDescription::name)
      .def_readonly("filename", &PluginDescription::filename, "File name of the library.")
      .def_readonly("parameters", &PluginDescription::parameters);
  bind_source(plugin);
}

}  // namespace bubblesim::bindings
