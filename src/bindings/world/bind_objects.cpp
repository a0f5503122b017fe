// SPDX-License-Identifier: BSD-3-Clause
// bubblesim.Object: one object of a running scene, with its properties.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>

#include "bindings.hpp"
#include "bubblesim/urdf.hpp"
#include "guarded.hpp"
#include "numpy_values.hpp"
#include "object_view.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

std::optional<ObjectView> parent(const ObjectView& view) {
  const ObjectId id = view.object().parent;
  return id == kNoObject ? std::nullopt : std::make_optional<ObjectView>(view.owner(), id);
}

void set_position(const ObjectView& view, const NumpyArray& position) {
  view.world().set_pose(view.id(), {to_vector(position, "position"), view.world().pose(view.id()).orientation});
}

void set_orientation(const ObjectView& view, const NumpyArray& orientation) {
  view.world().set_pose(view.id(), {view.world().pose(view.id()).position, to_quaternion(orientation, "orientation")});
}

void set_linear_velocity(const ObjectView& view, const NumpyArray& velocity) {
  view.world().set_velocity(view.id(),
                            {to_vector(velocity, "linear_velocity"), view.world().velocity(view.id()).angular});
}

void set_angular_velocity(const ObjectView& view, const NumpyArray& velocity) {
  view.world().set_velocity(view.id(),
                            {view.world().velocity(view.id()).linear, to_vector(velocity, "angular_velocity")});
}

void apply_wrench(const ObjectView& view, const NumpyArray& force, const NumpyArray& torque,
                  const std::optional<NumpyArray>& point, bool local) {
  view.world().wrenches().apply(view.id(), {to_vector(force, "force"), to_vector(torque, "torque")},
                                point ? std::make_optional(to_vector(*point, "point")) : std::nullopt,
                                local ? WrenchFrame::kObject : WrenchFrame::kWorld);
}

}  // namespace

void bind_objects(py::module_& module) {
  using View = ObjectView;
  py::class_<View> object(
      module, "Object",
      "A model, link, joint or sensor of a simulation. SI units, world frame, quaternions x, y, z, w.");
  Guarded(object)
      .def_property_readonly("handle", &View::id)
      .def_property_readonly("name", [](const View& v) { return v.object().name; })
      .def_property_readonly(
          "kind", [](const View& v) { return std::string(kind_name(v.object().kind)); },
          "'model', 'link', 'joint' or 'sensor'.")
      .def_property_readonly("path", [](const View& v) { return v.tree().path(v.id()); })
      .def_property_readonly("parent", &parent, "The parent object, None at the top.")
      .def_property(
          "position", [](const View& v) { return to_numpy(v.world().pose(v.id()).position); }, &set_position,
          "Metres, array of 3.")
      .def_property(
          "orientation", [](const View& v) { return to_numpy(v.world().pose(v.id()).orientation); }, &set_orientation,
          "Quaternion x, y, z, w, array of 4.")
      .def_property(
          "linear_velocity", [](const View& v) { return to_numpy(v.world().velocity(v.id()).linear); },
          &set_linear_velocity, "Velocity of the object's origin, m/s, array of 3.")
      .def_property(
          "angular_velocity", [](const View& v) { return to_numpy(v.world().velocity(v.id()).angular); },
          &set_angular_velocity, "rad/s, array of 3.")
      .def_property_readonly(
          "joint_position", [](const View& v) { return v.world().joints().position(v.id()); }, "Radians or metres.")
      .def_property_readonly(
          "joint_velocity", [](const View& v) { return v.world().joints().velocity(v.id()); }, "rad/s or m/s.")
      .def_property(
          "target_position", [](const View& v) { return v.world().joints().target_position(v.id()); },
          [](const View& v, double target) { v.world().joints().set_target_position(v.id(), target); },
          "Target of a position-controlled joint, radians or metres.")
      .def_property(
          "target_velocity", [](const View& v) { return v.world().joints().target_velocity(v.id()); },
          [](const View& v, double target) { v.world().joints().set_target_velocity(v.id(), target); },
          "Target of a velocity-controlled joint, rad/s or m/s.")
      .def_property(
          "target_effort", [](const View& v) { return v.world().joints().target_effort(v.id()); },
          [](const View& v, double target) { v.world().joints().set_target_effort(v.id(), target); },
          "Target of an effort-controlled joint, N m or N, positive in the joint's direction.")
      .def_property(
          "motor_mode", [](const View& v) { return v.world().joints().motor_mode(v.id()); },
          [](const View& v, MotorMode mode) { v.world().joints().set_motor_mode(v.id(), mode); },
          "bubblesim.MotorMode of the joint's motor, until the world is reset.")
      .def_property_readonly(
          "motor_effort", [](const View& v) { return v.world().joints().motor_effort(v.id()); },
          "Measured effort of the joint's motor on the child link, N m or N: the mean over the last step.")
      .def("apply_wrench", &apply_wrench, py::arg("force") = py::make_tuple(0, 0, 0),
           py::arg("torque") = py::make_tuple(0, 0, 0), py::kw_only(), py::arg("point") = py::none(),
           py::arg("local") = false,
           R"(Push a link, or the canonical link of a model, during the next step. Wrenches add up.

:param force: N, array of 3, constant during the step.
:param torque: N m, array of 3.
:param point: m, array of 3, where the force acts; by default the link's centre of mass.
:param local: the three vectors are in the object's frame instead of the world's.)")
      .def_property(
          "max_force", [](const View& v) { return v.world().joints().max_force(v.id()); },
          [](const View& v, double force) { v.world().joints().set_max_force(v.id(), force); },
          "Largest effort of the joint's motor, N m or N.")
      .def_property(
          "mass", [](const View& v) { return v.world().properties().mass(v.id()); },
          [](const View& v, double mass) { v.world().properties().set_mass(v.id(), mass); },
          "Mass of a link, or of all links of a model, kg. Setting it scales the inertia too, and all links of a "
          "model\n"
          "by one factor; the centres of mass stay. Until the simulation is reset.")
      .def_property(
          "friction", [](const View& v) { return v.world().properties().friction(v.id()); },
          [](const View& v, double mu) { v.world().properties().set_friction(v.id(), mu); },
          "Coulomb friction coefficient of a link's or model's first collision. Setting it sets those of all its\n"
          "collisions, in all directions, until the simulation is reset. A contact has the lower one of two "
          "collisions.")
      .def_property(
          "motor_gain", [](const View& v) { return v.world().joints().motor_gain(v.id()); },
          [](const View& v, double gain) { v.world().joints().set_motor_gain(v.id(), gain); },
          "Factor between the target of a joint's motor and what it does, until the simulation is reset.")
      .def_property(
          "noise_scale", [](const View& v) { return v.simulation().noise_scale(v.id()); },
          [](const View& v, double scale) { v.simulation().set_noise_scale(v.id(), scale); },
          "Factor of the standard deviations of a sensor's noise, until the simulation is reset.")
      .def_property_readonly(
          "reading", [](const View& v) { return last_reading(v.simulation(), v.id()); },
          "A sensor's last reading, an object of the class of its kind: a LidarScan, CameraImage, ImuReading, ...")
      .def_property_readonly(
          "urdf", [](const View& v) { return to_urdf(v.world().models().description(v.id())); },
          "Return the URDF of the object's model, for robot_state_publisher and RViz; each sensor is a separate link.\n"
          "Raise ValueError for models that URDF cannot describe.")
      .def("__repr__", [](const View& v) {
        if (!v.tree().contains(v.id())) {
          return "<bubblesim.Object " + std::to_string(v.id()) + " (removed)>";
        }
        return "<bubblesim.Object " + v.tree().path(v.id()) + " (" + std::string(kind_name(v.object().kind)) + ")>";
      });
}

}  // namespace bubblesim::bindings
