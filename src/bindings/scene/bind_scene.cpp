// SPDX-License-Identifier: BSD-3-Clause
// bubblesim.Scene: a file that is read once, for any number of simulations.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "bindings.hpp"
#include "scene/loaded_scene.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

std::vector<std::string> warnings_of(const Scene& scene) {
  std::vector<std::string> strings;
  for (const Problem& warning : scene.warnings()) strings.push_back(warning.text());
  return strings;
}

}  // namespace

std::shared_ptr<const Scene> loaded_scene(const std::string& name_or_path, const NamedArguments& named) {
  XacroArguments arguments;
  for (const auto& [name, value] : named) arguments.push_back(name + ":=" + value);
  return load_scene(name_or_path, arguments);
}

void bind_scene(py::module_& module) {
  py::class_<Scene, std::shared_ptr<Scene>>(module, "Scene", R"(A scene that is read, checked and prepared once.

It does not change: any number of simulations share it, also in several threads.

:param scene: scene name ("tricycle") or path of an .sdf file.
:param arguments: xacro arguments by name, for a .xacro file.
:raises SceneError: lists all problems of the file, each with file:line and object.)")
      .def(py::init([](const std::string& scene, const NamedArguments& arguments) {
             const py::gil_scoped_release others_may_run;
             return std::const_pointer_cast<Scene>(loaded_scene(scene, arguments));  // pybind11 holds no const
           }),
           py::arg("scene"), py::kw_only(), py::arg("arguments") = NamedArguments())
      .def_static(
          "empty", [] { return std::const_pointer_cast<Scene>(empty_scene()); }, "A ground plane and a light.")
      .def_property_readonly("warnings", &warnings_of,
                             "Values that were replaced and elements that have no effect: 'FILE:LINE: OBJECT: TEXT'.")
      .def_property_readonly("name", [](const Scene& s) { return s.description().name; })
      .def_property_readonly("file", [](const Scene& s) { return s.description().file; })
      .def("__repr__", [](const Scene& s) { return "<bubblesim.Scene " + s.description().file.string() + ">"; });
}

}  // namespace bubblesim::bindings
