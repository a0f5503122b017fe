// SPDX-License-Identifier: BSD-3-Clause
// bubblesim._core.ObjectFrames: poses of objects in the axes that child scripts and remote clients see.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "bubblesim/world.hpp"
#include "guarded.hpp"
#include "world/object_axes.hpp"
#include "world/world_poses.hpp"

namespace bubblesim::bindings {
namespace {

namespace py = pybind11;

struct ObjectFrames {
  World& world;

  Pose pose(ObjectId object) const { return seen(world.pose(object), object); }
  /// The frame for poses relative to an object.
  Pose reference(ObjectId object) const { return seen(frame_of(world, object), object); }
  void set_pose(ObjectId object, const Pose& pose) {
    world.set_pose(object, {pose.position, pose.orientation * object_axes(world, object).inverse()});
  }

 private:
  Pose seen(const Pose& pose, ObjectId object) const {
    const ObjectKind kind = world.tree().at(object).kind;
    if (kind != ObjectKind::kJoint && kind != ObjectKind::kSensor) return pose;
    return {pose.position, pose.orientation * object_axes(world, object)};
  }
};

AccessLock& lock_of(const ObjectFrames& frames) { return frames.world.access(); }

}  // namespace

void bind_object_frames(py::module_& module) {
  py::class_<ObjectFrames> frames(
      module, "ObjectFrames",
      "Poses of objects, [x, y, z, qx, qy, qz, qw], with the axes of <bubblesim:axis_convention>.");
  frames.def(py::init([](World& world) { return ObjectFrames{world}; }), py::keep_alive<1, 2>());
  Guarded(frames)
      .def("pose", [](const ObjectFrames& f, ObjectId id) { return to_list(f.pose(id)); })
      .def(
          "pose_in",
          [](const ObjectFrames& f, ObjectId id, ObjectId frame) {
            return to_list(f.reference(frame).inverse() * f.pose(id));
          },
          "Return the pose in the frame of another object; relative to a joint, in its moving frame.")
      .def("set_pose", [](ObjectFrames& f, ObjectId id, const Pose7& pose) { f.set_pose(id, to_pose(pose)); })
      .def("set_pose_in", [](ObjectFrames& f, ObjectId id, const Pose7& pose,
                             ObjectId frame) { f.set_pose(id, f.reference(frame) * to_pose(pose)); })
      .def(
          "pose_from",
          [](const ObjectFrames& f, const Pose7& pose, ObjectId frame) {
            return to_list(f.reference(frame) * to_pose(pose));
          },
          "Return the world pose of a pose in the frame of an object; see `pose_in`.")
      .def(
          "pose_to",
          [](const ObjectFrames& f, const Pose7& pose, ObjectId frame) {
            return to_list(f.reference(frame).inverse() * to_pose(pose));
          },
          "Return a world pose in the frame of an object; see `pose_in`.");
}

}  // namespace bubblesim::bindings
