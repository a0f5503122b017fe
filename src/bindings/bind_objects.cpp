// SPDX-License-Identifier: BSD-3-Clause
// bubblesim.Object: one object of a running scene, with what can be read and set on it.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "bubblesim/simulation.hpp"
#include "numpy_values.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

/// Python keeps the simulation alive as long as one of its objects is held.
struct ObjectView {
  Simulation& simulation;
  ObjectId id;

  World& world() const { return simulation.world(); }
  const SceneTree& tree() const { return simulation.world().tree(); }
};

std::vector<ObjectView> all_objects(Simulation& simulation) {
  std::vector<ObjectView> views;
  for (const Object& object : simulation.world().tree().objects()) views.push_back({simulation, object.id});
  return views;
}

py::object optional_view(const py::object& self, ObjectId id) {
  if (id == kNoObject) return py::none();
  return py::cast(ObjectView{self.cast<ObjectView&>().simulation, id}, py::return_value_policy::move, self);
}

void bind_reading(py::module_& module) {
  py::class_<ProximityReading>(module, "ProximityReading",
                               "What a proximity sensor saw, in its own frame: it looks along x.")
      .def_readonly("detected", &ProximityReading::detected)
      .def_readonly("distance", &ProximityReading::distance, "Metres; 0 when nothing was detected.")
      .def_property_readonly("point", [](const ProximityReading& r) { return to_numpy(r.point); })
      .def_property_readonly("normal", [](const ProximityReading& r) { return to_numpy(r.normal); })
      .def_readonly("handle", &ProximityReading::object, "Handle of the link seen, or -1.");
}

}  // namespace

void bind_objects(py::module_& module) {
  bind_reading(module);

  py::class_<ObjectView>(
      module, "Object",
      "A model, link, joint or sensor of a simulation. SI units, world frame, quaternions x, y, z, w.")
      .def_readonly("handle", &ObjectView::id)
      .def_property_readonly("name", [](const ObjectView& o) { return o.tree().at(o.id).name; })
      .def_property_readonly(
          "kind", [](const ObjectView& o) { return std::string(kind_name(o.tree().at(o.id).kind)); },
          "'model', 'link', 'joint' or 'sensor'.")
      .def_property_readonly("path", [](const ObjectView& o) { return o.tree().path(o.id); })
      .def_property_readonly("parent",
                             [](const py::object& self) {
                               const auto& o = self.cast<ObjectView&>();
                               return optional_view(self, o.tree().at(o.id).parent);
                             })
      .def_property(
          "position", [](const ObjectView& o) { return to_numpy(o.world().pose(o.id).Pos()); },
          [](const ObjectView& o, const NumpyArray& position) {
            o.world().set_pose(o.id, {to_vector(position, "position"), o.world().pose(o.id).Rot()});
          },
          "Metres, numpy array of 3.")
      .def_property(
          "orientation", [](const ObjectView& o) { return to_numpy(o.world().pose(o.id).Rot()); },
          [](const ObjectView& o, const NumpyArray& orientation) {
            o.world().set_pose(o.id, {o.world().pose(o.id).Pos(), to_quaternion(orientation, "orientation")});
          },
          "Quaternion x, y, z, w, numpy array of 4.")
      .def_property(
          "linear_velocity", [](const ObjectView& o) { return to_numpy(o.world().velocity(o.id).linear); },
          [](const ObjectView& o, const NumpyArray& velocity) {
            o.world().set_velocity(o.id, {to_vector(velocity, "linear_velocity"), o.world().velocity(o.id).angular});
          },
          "m/s of the object's origin, numpy array of 3.")
      .def_property(
          "angular_velocity", [](const ObjectView& o) { return to_numpy(o.world().velocity(o.id).angular); },
          [](const ObjectView& o, const NumpyArray& velocity) {
            o.world().set_velocity(o.id, {o.world().velocity(o.id).linear, to_vector(velocity, "angular_velocity")});
          },
          "rad/s, numpy array of 3.")
      .def_property_readonly(
          "joint_position", [](const ObjectView& o) { return o.world().joint_position(o.id); }, "Radians or metres.")
      .def_property_readonly(
          "joint_velocity", [](const ObjectView& o) { return o.world().joint_velocity(o.id); }, "rad/s or m/s.")
      .def_property(
          "target_position", [](const ObjectView& o) { return o.world().target_position(o.id); },
          [](const ObjectView& o, double target) { o.world().set_target_position(o.id, target); },
          "Of a position-controlled joint, radians or metres.")
      .def_property(
          "target_velocity", [](const ObjectView& o) { return o.world().target_velocity(o.id); },
          [](const ObjectView& o, double target) { o.world().set_target_velocity(o.id, target); },
          "Of a velocity-controlled joint, rad/s or m/s.")
      .def_property(
          "max_force", [](const ObjectView& o) { return o.world().max_force(o.id); },
          [](const ObjectView& o, double force) { o.world().set_max_force(o.id, force); },
          "Of the joint's motor, N m or N.")
      .def_property_readonly(
          "reading", [](const ObjectView& o) { return o.simulation.read_proximity(o.id); },
          "What a proximity sensor measured last.")
      .def("__repr__", [](const ObjectView& o) {
        return "<bubblesim.Object " + o.tree().path(o.id) + " (" + std::string(kind_name(o.tree().at(o.id).kind)) +
               ")>";
      });

  // Simulation was bound before, but its objects could only be bound now.
  const auto simulation = py::class_<Simulation>(module.attr("Simulation"));
  const auto add = [&simulation](const char* name, const py::object& member) { py::setattr(simulation, name, member); };
  add("object", py::cpp_function(
                    [](Simulation& s, const std::string& path) {
                      return ObjectView{s, s.world().tree().find(path)};
                    },
                    py::name("object"), py::is_method(simulation), py::arg("path"), py::keep_alive<0, 1>(),
                    "The object at a path such as /Tricycle/FrontMotor, or /FrontMotor when that is the only one.\n\n"
                    ":raises NoSuchObject: naming similar objects."));
  add("objects", py::module_::import("builtins")
                     .attr("property")(py::cpp_function([](py::object self) {
                                         py::list list;
                                         for (const ObjectView& view : all_objects(self.cast<Simulation&>())) {
                                           list.append(py::cast(view, py::return_value_policy::move, self));
                                         }
                                         return list;
                                       }),
                                       py::none(), py::none(), "All objects of the scene."));
}

}  // namespace bubblesim::bindings
