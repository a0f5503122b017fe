// SPDX-License-Identifier: BSD-3-Clause
// revolute2: a steered wheel in one joint. The first axis is fixed in the parent, the second in the child.
#include <cmath>

#include "physics/joints/define.hpp"
#include "scene/describe.hpp"
#include "validation/checker.hpp"

namespace bubblesim {
namespace {

class Hinge2 final : public Joint {
 public:
  Hinge2(dWorldID world, const JointDescription& description, const JointSite& site)
      : Joint(description.axes), joint_(dJointCreateHinge2(world, nullptr)) {
    // Hinge2 needs two bodies, the one with the first axis (the parent) first. It measures the rotation of the first
    // body relative to the second; about the negative axes this equals that of the child about the positive axes.
    dJointAttach(joint_.get(), site.parent, site.child);
    dJointSetHinge2Anchor(joint_.get(), site.pose.position.x(), site.pose.position.y(), site.pose.position.z());
    const Vector3 steering = -axis_direction(description, 0, site);
    const Vector3 rolling = -axis_direction(description, 1, site);
    const dVector3 axis1 = {steering.x(), steering.y(), steering.z()};
    const dVector3 axis2 = {rolling.x(), rolling.y(), rolling.z()};
    dJointSetHinge2Axes(joint_.get(), axis1, axis2);
    add_rows(world, Motor(joint_.get(), dJointSetHinge2Param, 0), Motion::kTurns,
             {steering, site.parent, site.child, 1});
    add_rows(world, Motor(joint_.get(), dJointSetHinge2Param, 1), Motion::kTurns,
             {rolling, site.parent, site.child, 2});
  }

  double position(int axis) const override {
    return axis == 0 ? dJointGetHinge2Angle1(joint_.get())
                     : -dJointGetHinge2Angle2(joint_.get());  // sign opposite to that of its rate
  }
  double velocity(int axis) const override {
    return axis == 0 ? dJointGetHinge2Angle1Rate(joint_.get()) : dJointGetHinge2Angle2Rate(joint_.get());
  }

 private:
  ode::JointHandle joint_;
};

}  // namespace

class Revolute2Kind final : public JointKind {
 public:
  Revolute2Kind() : JointKind("revolute2", 2) {}

  void check(Checker& checker, const ModelDescription&, const JointDescription& joint) const override {
    if (joint.parent == "world") checker.report("a revolute2 joint needs a link as its parent, not the world");
    if (std::isfinite(joint.axes[1].lower) || std::isfinite(joint.axes[1].upper)) {
      checker.report("the second axis of a revolute2 joint turns freely: it cannot have limits");
    }
    checker.require(joint.axes[0].direction.cross(joint.axes[1].direction).norm() > 1e-3, "the second axis",
                    text(joint.axes[1].direction), "not parallel to the first");
  }

  std::unique_ptr<Joint> make(dxWorld* world, const JointDescription& description,
                              const JointSite& site) const override {
    return std::make_unique<Hinge2>(world, description, site);
  }
};

template const JointKind& joint_kind<Revolute2Kind>();

}  // namespace bubblesim
