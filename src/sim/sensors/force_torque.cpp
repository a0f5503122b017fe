// SPDX-License-Identifier: BSD-3-Clause
// Force-torque sensor: wrench of a joint's child on its parent, or of the parent on the child.
#include "sensors/kinds.hpp"
#include "sensors/noise.hpp"

namespace bubblesim {
namespace {

using Frame = ForceTorqueDescription::Frame;

class ForceTorque final : public Sensor {
 public:
  ForceTorque(const ForceTorqueDescription& description, ObjectId id, ObjectId joint, ObjectId parent, ObjectId child)
      : Sensor(ForceTorqueReading{}),
        description_(description),
        id_(id),
        joint_(joint),
        parent_(parent),
        child_(child) {}

 private:
  void measure(const MeasurementContext& moment, Measurement& measurement) override {
    const World& world = moment.world;
    const Wrench wrench = world.joint_wrench(joint_);
    const Vector3 lever = world.joint_child_pose(joint_).Pos() - world.pose(id_).Pos();
    const double sign = description_.of_child ? 1 : -1;
    const Quaternion turn = axes(world);
    ForceTorqueReading reading;
    reading.force = turn.RotateVectorReverse(wrench.force * sign);
    reading.torque = turn.RotateVectorReverse((wrench.torque + lever.Cross(wrench.force)) * sign);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      distort(reading.force[axis], description_.force_noise[axis], moment, id_, axis);
      distort(reading.torque[axis], description_.torque_noise[axis], moment, id_, 3 + axis);
    }
    measurement = reading;
  }

  Quaternion axes(const World& world) const {
    if (description_.frame == Frame::kSensor) return world.pose(id_).Rot();
    const ObjectId link = description_.frame == Frame::kChild ? child_ : parent_;
    return link == kNoObject ? Quaternion::Identity : world.pose(link).Rot();
  }

  ForceTorqueDescription description_;
  ObjectId id_;
  ObjectId joint_;
  ObjectId parent_;  // kNoObject is the world
  ObjectId child_;
};

}  // namespace

std::unique_ptr<Sensor> make_kind(const ForceTorqueDescription& description, const SensorSite& site) {
  const SceneTree& tree = site.world.tree();
  const Object& joint = tree.at(tree.at(site.id).parent);
  const ModelDescription& model = site.world.description(site.id);
  const JointDescription& described = model.joints[joint.index];
  ObjectId parent = kNoObject;
  ObjectId child = kNoObject;
  for (const ObjectId link : tree.parts(tree.outermost_model_of(site.id), ObjectKind::kLink)) {
    const std::string& name = model.links[tree.at(link).index].name;
    if (name == described.parent) parent = link;
    if (name == described.child) child = link;
  }
  return std::make_unique<ForceTorque>(description, site.id, joint.id, parent, child);
}

}  // namespace bubblesim
