// SPDX-License-Identifier: BSD-3-Clause
// bubblesim._core.World: objects by handle, with plain lists and numbers, for the `sim` functions of child scripts.
#include <pybind11/stl.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <variant>

#include "bindings.hpp"
#include "bubblesim/error.hpp"
#include "bubblesim/simulation.hpp"
#include "bubblesim/world.hpp"
#include "guarded.hpp"
#include "numpy_values.hpp"
#include "world/bind_contacts.hpp"
#include "world/file_places.hpp"
#include "world/world_poses.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

Vector3 to_vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Pose7 pose_in(const World& world, ObjectId object, const Pose& frame) {
  return to_list(frame.inverse() * world.pose(object));
}

/// Functions of World's Python class that are those of a part in C++.
template <class Result, class... Arguments>
auto of_joints(Result (WorldJoints::*function)(Arguments...) const) {
  return [function](const World& w, Arguments... arguments) { return (w.joints().*function)(arguments...); };
}

template <class... Arguments>
auto of_joints(void (WorldJoints::*function)(Arguments...)) {
  return [function](World& w, Arguments... arguments) { (w.joints().*function)(arguments...); };
}

auto of_properties(double (WorldProperties::*function)(ObjectId) const) {
  return [function](const World& w, ObjectId object) { return (w.properties().*function)(object); };
}

auto of_properties(void (WorldProperties::*function)(ObjectId, double)) {
  return [function](World& w, ObjectId object, double value) { (w.properties().*function)(object, value); };
}

std::vector<PluginDescription> plugins(const World& world, ObjectId object) {
  switch (world.tree().at(object).kind) {
    case ObjectKind::kModel:
      return world.models().description(object).plugins;
    case ObjectKind::kSensor:
      return world.models().sensor_description(object).plugins;
    default:
      return {};
  }
}

/// A mass that was set has scaled the inertia of the description.
std::pair<std::array<double, 9>, std::array<double, 3>> inertia(const World& world, ObjectId link) {
  const Object& object = world.tree().at(link);
  if (object.kind != ObjectKind::kLink) {
    throw WrongObject(world.tree().path(link) + " is a " + std::string(kind_name(object.kind)) + ", not a link");
  }
  const LinkDescription& description = world.models().description(link).links[object.index];
  const Matrix3 m = description.inertia() * (world.properties().mass(link) / description.mass);
  const Vector3& centre = description.centre_of_mass;
  return {{m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)},
          {centre.x(), centre.y(), centre.z()}};
}

}  // namespace

void bind_world(py::module_& module) {
  py::enum_<MotorMode>(module, "MotorMode", "Mode of the motor of a joint's axis.")
      .value("NONE", MotorMode::kNone, "No motor: the axis moves freely, with friction and damping.")
      .value("VELOCITY", MotorMode::kVelocity)
      .value("POSITION", MotorMode::kPosition)
      .value("EFFORT", MotorMode::kEffort);
  py::class_<World> world(module, "World", "Objects by handle. Poses are [x, y, z, qx, qy, qz, qw], SI units.");
  bind_contacts(world);
  Guarded(world)
      .def(
          "find",
          [](const World& w, const std::string& path, ObjectId from, std::size_t index) {
            return w.tree().find(path, from, index);
          },
          py::arg("path"), py::arg("start") = kNoObject, py::arg("index") = 0)
      .def("name", [](const World& w, ObjectId id) { return w.tree().at(id).name; })
      .def(
          "alias", [](const World& w, ObjectId id) { return w.tree().at(id).alias; },
          "Return the object's name in paths: its <bubblesim:alias>, or its name.")
      .def("kind", [](const World& w, ObjectId id) { return std::string(kind_name(w.tree().at(id).kind)); })
      .def("is_static", [](const World& w, ObjectId id) { return w.models().description(id).is_static; })
      .def("path", [](const World& w, ObjectId id) { return w.tree().path(id); })
      .def("short_path", [](const World& w, ObjectId id) { return w.tree().short_path(id); })
      .def("parent", [](const World& w, ObjectId id) { return w.tree().at(id).parent; })
      .def(
          "model_base_of", [](const World& w, ObjectId id) { return w.tree().model_base_of(id); },
          "Return the nearest base of a model above the object or itself: where ':' in paths leads.")
      .def(
          "is_hidden", [](const World& w, ObjectId id) { return w.tree().at(id).is_hidden; },
          "Return whether an object is a model that is no object of its own, in no path.")
      .def("is_model_base", [](const World& w, ObjectId id) { return w.tree().at(id).is_model_base; })
      .def(
          "subtree", [](const World& w, ObjectId id) { return w.tree().subtree(id); },
          "Return an object and all below it, parents first.")
      .def(
          "carrier", [](const World& w, ObjectId id) { return w.tree().at(id).carrier; }, py::arg("sensor"),
          "Return the link or joint that has a sensor, wherever it is in the tree.")
      .def(
          "parts",
          [](const World& w, ObjectId model, const std::string& kind) {
            for (const ObjectKind each :
                 {ObjectKind::kModel, ObjectKind::kLink, ObjectKind::kJoint, ObjectKind::kSensor, ObjectKind::kFrame}) {
              if (kind == kind_name(each)) return w.tree().parts(model, each);
            }
            throw InvalidInput("the parts of a model are of the kinds model, link, joint, sensor and frame, not '" +
                               kind + "'");
          },
          py::arg("model"), py::arg("kind"),
          "Return the parts of a model, wherever they are in the tree; of the kind 'model' with itself.")
      .def("contains", [](const World& w, ObjectId id) { return w.tree().contains(id); })
      .def(
          "part_of", [](const World& w, ObjectId id) { return w.tree().at(id).model; },
          "Return the innermost model of which an object is a part, -1 for an outermost model and a frame of none.")
      .def(
          "frame_link", [](const World& w, ObjectId id) { return w.frames().link(id); }, py::arg("frame"),
          "Return the link that carries a frame, -1 for the world.")
      .def(
          "frame_kind", [](const World& w, ObjectId id) { return std::string(frame_kind_name(w.frames().kind(id))); },
          py::arg("frame"), "Return 'dummy', 'shape', 'camera', 'light', 'graph', 'script' or 'joint'.")
      .def(
          "add_dummy", [](World& w, const std::string& name) { return w.frames().add_dummy(name); }, py::arg("name"),
          "Add a dummy at the origin; return its handle.")
      .def(
          "add_joint",
          [](World& w, const std::string& name, const std::string& type) { return w.frames().add_joint(name, type); },
          py::arg("name"), py::arg("type"),
          "Add a joint without physics at the origin, which moves what is below it in the tree; return its handle.")
      .def(
          "set_joint_limits",
          [](World& w, ObjectId joint, double lower, double upper) {
            w.frames().set_joint_limits(joint, lower, upper);
          },
          py::arg("joint"), py::arg("lower"), py::arg("upper"),
          "Set the limits of a joint that was added; infinite for none.")
      .def(
          "remove_dummy", [](World& w, ObjectId id) { w.frames().remove_dummy(id); }, py::arg("dummy"),
          "Remove a dummy that was added.")
      .def(
          "set_parent", [](World& w, ObjectId id, ObjectId parent) { w.frames().set_parent(id, parent); },
          py::arg("object"), py::arg("parent"),
          "Make an object the last child of another one, or of the scene (-1); nothing moves.")
      .def(
          "set_alias", [](World& w, ObjectId id, const std::string& alias) { w.frames().set_alias(id, alias); },
          py::arg("object"), py::arg("alias"))
      .def(
          "nearest",
          [](const World& w, const std::vector<ObjectId>& first, const std::vector<ObjectId>& second,
             double limit) -> py::object {
            const std::optional<NearestPoints> found = w.geometry().nearest(first, second, limit);
            if (!found) return py::none();
            return py::make_tuple(found->distance, to_list(found->on_first), to_list(found->on_second), found->first,
                                  found->second);
          },
          py::arg("first"), py::arg("second"), py::arg("limit"),
          "Return distance, the nearest points in the world and their links, for the shapes of two lists of links; "
          "None "
          "if they are farther apart than the limit, or have no shapes.")
      .def(
          "bounds",
          [](const World& w, const std::vector<ObjectId>& links, const Pose7& frame) -> py::object {
            const auto found = w.geometry().bounds(links, to_pose(frame));
            if (!found) return py::none();
            return py::make_tuple(to_list(found->first), to_list(found->second));
          },
          py::arg("links"), py::arg("frame"),
          "Return the corners of the smallest box, along the axes of a pose, with all shapes of some links; None if "
          "they have none, or a plane.")
      .def("model_of", [](const World& w, ObjectId id) { return w.tree().model_of(id); })
      .def("outermost_model_of", [](const World& w, ObjectId id) { return w.tree().outermost_model_of(id); })
      .def_property_readonly("models", [](const World& w) { return w.tree().models(); })
      .def(
          "children", [](const World& w, ObjectId id) { return w.tree().children(id); },
          "Return the children of an object; those of -1 are the objects at the top.")
      .def(
          "sensor_topic",
          [](const World& w, ObjectId id) {
            const SensorDescription& sensor = w.models().sensor_description(id);
            return py::make_tuple(sensor.topic, sensor.frame, sensor.update_rate);
          },
          py::arg("sensor"),
          "Return its <bubblesim:topic> and <bubblesim:frame>, which may be empty, and its rate in Hz.")
      .def(
          "gz_topic",
          [](const World& w, ObjectId id) {
            const SensorDescription& sensor = w.models().sensor_description(id);
            return py::make_tuple(sensor.type, sensor.gz.topic, sensor.gz.info_topic, sensor.gz.frame);
          },
          py::arg("sensor"),
          "Return SDFormat's name of the sensor's type; its <topic>, <camera_info_topic> and frame, which may be "
          "empty.")
      .def(
          "find_signal",
          [](const World& w, const std::string& signal) {
            for (const ObjectId id : w.tree().objects()) {
              if (w.tree().at(id).kind != ObjectKind::kSensor) continue;
              const auto* lidar = w.models().sensor_description(id).kind.get_if<LidarDescription>();
              if (lidar != nullptr && lidar->signal == signal) return id;
            }
            return kNoObject;
          },
          py::arg("signal"),
          "Return the handle of the lidar with this <bubblesim:signal>, or -1; `signal` must not be empty.")
      .def(
          "sonar_limits",
          [](const World& w, ObjectId id) {
            const auto* sonar = w.models().sensor_description(id).kind.get_if<SonarDescription>();
            if (sonar == nullptr) throw WrongObject(w.tree().short_path(id) + " is not a proximity sensor");
            return py::make_tuple(sonar->min_range, sonar->max_range, sonar->half_angle);
          },
          py::arg("sensor"),
          "Return a proximity sensor's minimum and maximum range, m, and half its opening angle, rad.")
      .def("plugins", &plugins, py::arg("handle"), "Return the PluginDescriptions of a model or sensor itself.")
      .def("pose", [](const World& w, ObjectId id) { return to_list(w.pose(id)); })
      .def(
          "pose_in", [](const World& w, ObjectId id, ObjectId frame) { return pose_in(w, id, frame_of(w, frame)); },
          "Return the pose in the frame of another object; relative to a joint, in its moving frame.")
      .def("set_pose", [](World& w, ObjectId id, const Pose7& pose) { w.set_pose(id, to_pose(pose)); })
      .def("set_pose_in", [](World& w, ObjectId id, const Pose7& pose,
                             ObjectId frame) { w.set_pose(id, frame_of(w, frame) * to_pose(pose)); })
      .def(
          "pose_from",
          [](const World& w, const Pose7& pose, ObjectId frame) { return to_list(frame_of(w, frame) * to_pose(pose)); },
          "Return the world pose of a pose in the frame of an object; see `pose_in`.")
      .def(
          "pose_to",
          [](const World& w, const Pose7& pose, ObjectId frame) {
            return to_list(frame_of(w, frame).inverse() * to_pose(pose));
          },
          "Return a world pose in the frame of an object; see `pose_in`.")
      .def(
          "set_state",
          [](World& w, ObjectId id, const Pose7& pose, const std::array<double, 3>& linear,
             const std::array<double, 3>& angular) {
            w.set_state(id, to_pose(pose), {to_vector(linear), to_vector(angular)});
          },
          "Set the pose, linear and angular velocity at once.")
      .def(
          "apply_wrench",
          [](World& w, ObjectId id, const std::array<double, 3>& force, const std::array<double, 3>& torque,
             const std::optional<std::array<double, 3>>& point, bool local) {
            w.wrenches().apply(id, {to_vector(force), to_vector(torque)},
                               point ? std::make_optional(to_vector(*point)) : std::nullopt,
                               local ? WrenchFrame::kObject : WrenchFrame::kWorld);
          },
          py::arg("object"), py::arg("force"), py::arg("torque") = std::array<double, 3>{}, py::kw_only(),
          py::arg("point") = py::none(), py::arg("local") = false,
          "Push a link or model in the next step, N and N m; see Object.apply_wrench.")
      .def(
          "clear_wrench", [](World& w, ObjectId id, bool force, bool torque) { w.wrenches().clear(id, force, torque); },
          py::arg("object"), py::arg("force") = true, py::arg("torque") = true,
          "Remove the forces or torques that were applied for the next step, or both.")
      .def("set_planar_velocity", &World::set_planar_velocity, py::arg("model"), py::arg("x"), py::arg("y"),
           py::arg("turning"),
           "Move a model as a whole, m/s along the world's x and y and rad/s about its z, until the world is reset.")
      .def("velocity",
           [](const World& w, ObjectId id) {
             const Twist v = w.velocity(id);
             return std::make_pair(to_list(v.linear), to_list(v.angular));
           })
      .def(
          "acceleration", [](const World& w, ObjectId id) { return to_list(w.acceleration(id)); },
          "Return the velocity of the object's origin, world axes: the mean over the last step.")
      .def_property_readonly("gravity", [](const World& w) { return to_list(w.properties().gravity()); })
      .def(
          "set_gravity",
          [](World& w, const std::array<double, 3>& gravity) { w.properties().set_gravity(to_vector(gravity)); },
          py::arg("gravity"), "Set the gravity, m/s^2, until the world is reset.")
      .def("mass", of_properties(&WorldProperties::mass), py::arg("object"),
           "Return the mass of a link or of all links of a model, kg.")
      .def("inertia", &inertia, py::arg("link"),
           "Return the inertia of a link about its centre of mass, along its axes, kg m^2: nine numbers, row by row; "
           "and the centre of mass in its frame.")
      .def("set_mass", of_properties(&WorldProperties::set_mass), py::arg("object"), py::arg("mass"),
           "Set the mass, kg, until the world is reset; the inertia is scaled. That of a model is scaled as a whole.")
      .def("friction", of_properties(&WorldProperties::friction), py::arg("object"),
           "Return the friction coefficient of its first collision.")
      .def("set_friction", of_properties(&WorldProperties::set_friction), py::arg("object"), py::arg("mu"),
           "Set the friction coefficient of all collisions of a link or model, until the world is reset.")
      .def(
          "set_belt",
          [](World& w, ObjectId link, const std::array<double, 3>& axis, double speed) {
            w.properties().set_belt(link, to_vector(axis), speed);
          },
          py::arg("link"), py::arg("axis"), py::arg("speed"),
          "Let the surfaces of a link run about an axis in its frame like a belt, m/s, until the world is reset.")
      .def(
          "attach", [](World& w, ObjectId parent, ObjectId child) { return w.attachments().attach(parent, child); },
          py::arg("parent"), py::arg("child"),
          "Hold two links to each other where they are, as by a fixed joint; return the number of the attachment.")
      .def(
          "detach", [](World& w, AttachmentId attachment) { w.attachments().detach(attachment); },
          py::arg("attachment"), "End an attachment; does nothing if it has ended.")
      .def_property_readonly(
          "attachments",
          [](const World& w) {
            std::map<AttachmentId, std::pair<ObjectId, ObjectId>> found;
            for (const Attachment& each : w.attachments().all()) found[each.id] = {each.parent, each.child};
            return found;
          },
          "The parent and child links of the attachments, by their numbers.")
      .def("joint_position", of_joints(&WorldJoints::position), py::arg("joint"), py::arg("axis") = 0)
      .def("joint_velocity", of_joints(&WorldJoints::velocity), py::arg("joint"), py::arg("axis") = 0)
      .def("motor_effort", of_joints(&WorldJoints::motor_effort), py::arg("joint"), py::arg("axis") = 0,
           "Return the effort of the motor on the child, the mean over the last step; 0 without a motor.")
      .def("joint_links", of_joints(&WorldJoints::links), py::arg("joint"),
           "Return the handles of the parent link and the child link; -1 is the world.")
      .def("joint_axes", of_joints(&WorldJoints::axes), py::arg("joint"), "Return the number of axes.")
      .def("target_position", of_joints(&WorldJoints::target_position), py::arg("joint"), py::arg("axis") = 0)
      .def("target_velocity", of_joints(&WorldJoints::target_velocity), py::arg("joint"), py::arg("axis") = 0)
      .def("target_effort", of_joints(&WorldJoints::target_effort), py::arg("joint"), py::arg("axis") = 0)
      .def("max_force", of_joints(&WorldJoints::max_force), py::arg("joint"), py::arg("axis") = 0)
      .def("motor_mode", of_joints(&WorldJoints::motor_mode), py::arg("joint"), py::arg("axis") = 0)
      .def("set_motor_mode", of_joints(&WorldJoints::set_motor_mode), py::arg("joint"), py::arg("mode"),
           py::arg("axis") = 0, "Set the MotorMode, until the world is reset.")
      .def("set_target_position", of_joints(&WorldJoints::set_target_position), py::arg("joint"), py::arg("position"),
           py::arg("axis") = 0)
      .def("set_target_velocity", of_joints(&WorldJoints::set_target_velocity), py::arg("joint"), py::arg("velocity"),
           py::arg("axis") = 0)
      .def("set_target_effort", of_joints(&WorldJoints::set_target_effort), py::arg("joint"), py::arg("effort"),
           py::arg("axis") = 0,
           "Set the force or torque on the child of an effort-controlled joint; its force limit applies.")
      .def("is_kinematic", of_joints(&WorldJoints::is_kinematic), py::arg("joint"),
           "Return whether a joint has no physics: it moves what is below it only when its position is set.")
      .def(
          "is_driven_by_callback",
          [](const World& w, ObjectId joint) {
            const std::vector<AxisDescription>& axes = w.joints().description(joint).axes;
            return !axes.empty() && axes.front().by_callback;
          },
          py::arg("joint"), "Return whether the scene's file lets sysCall_joint of a script drive a joint.")
      .def(
          "max_velocity",
          [](const World& w, ObjectId joint) {
            const std::vector<AxisDescription>& axes = w.joints().description(joint).axes;
            return axes.empty() ? 0.0 : axes.front().max_velocity;
          },
          py::arg("joint"), "Return the limit of a motor's velocity in the scene's file; infinite without a limit.")
      .def("joint_type", [](const World& w, ObjectId joint) { return w.joints().description(joint).type; })
      .def(
          "joint_limits",
          [](const World& w, ObjectId joint) {
            const JointDescription& description = w.joints().description(joint);
            if (description.axes.empty()) return std::make_pair(0.0, 0.0);
            return std::make_pair(description.axes.front().lower, description.axes.front().upper);
          },
          "Return the lower and upper limit of a joint's first axis; infinite without limits.")
      .def("set_joint_position", of_joints(&WorldJoints::set_position), py::arg("joint"), py::arg("position"))
      .def("set_max_force", of_joints(&WorldJoints::set_max_force), py::arg("joint"), py::arg("force"),
           py::arg("axis") = 0);
  bind_file_places(world);
}

}  // namespace bubblesim::bindings
