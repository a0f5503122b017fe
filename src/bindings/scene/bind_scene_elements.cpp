// SPDX-License-Identifier: BSD-3-Clause
// The elements of scene files.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "bubblesim/scene_elements.hpp"

namespace bubblesim::bindings {

namespace py = pybind11;

void bind_scene_elements(py::module_& module) {
  py::class_<SceneElement>(module, "SceneElement", "A line of the table of elements.")
      .def_readonly("path", &SceneElement::path,
                    "From the root, such as world/model/link; of an attribute: world/@name.")
      .def_readonly("type", &SceneElement::type,
                    "None, any, text, flag, integer, number, vector2, vector3, color, pose.")
      .def_readonly("default_text", &SceneElement::default_text, "The default, or an empty string.")
      .def_readonly("effect", &SceneElement::effect, "read, none or left out.")
      .def_readonly("reason", &SceneElement::reason, "Why it is not read.");
  module.def("scene_elements", &scene_elements, "Return all elements that may be in a scene file.");
}

}  // namespace bubblesim::bindings
