// SPDX-License-Identifier: BSD-3-Clause
// universal: two axes at right angles. The first is fixed in the parent, the second in the child.
#include "physics/joints/kinds.hpp"

namespace bubblesim {
namespace {

class Universal final : public Joint {
 public:
  Universal(dWorldID world, const JointDescription& description, const JointSite& site)
      : Joint(description.axes), joint_(dJointCreateUniversal(world, nullptr)) {
    // Child first, so that the parent may be the world: ODE's first axis is then our second.
    dJointAttach(joint_.get(), site.child, site.parent);
    dJointSetUniversalAnchor(joint_.get(), site.pose.position.x(), site.pose.position.y(), site.pose.position.z());
    const Vector3 of_parent = axis_direction(description, 0, site);
    const Vector3 of_child = axis_direction(description, 1, site);
    dJointSetUniversalAxis1(joint_.get(), of_child.x(), of_child.y(), of_child.z());
    dJointSetUniversalAxis2(joint_.get(), of_parent.x(), of_parent.y(), of_parent.z());
    add_rows(world, Motor(joint_.get(), dJointSetUniversalParam, 1), Motion::kTurns,
             {of_parent, site.child, site.parent, 2});
    add_rows(world, Motor(joint_.get(), dJointSetUniversalParam, 0), Motion::kTurns,
             {of_child, site.child, site.parent, 1});
  }

  double position(int axis) const override {
    return axis == 0 ? dJointGetUniversalAngle2(joint_.get()) : dJointGetUniversalAngle1(joint_.get());
  }
  double velocity(int axis) const override {
    return axis == 0 ? dJointGetUniversalAngle2Rate(joint_.get()) : dJointGetUniversalAngle1Rate(joint_.get());
  }

 private:
  ode::JointHandle joint_;
};

}  // namespace

std::unique_ptr<Joint> make_universal(dWorldID world, const JointDescription& description, const JointSite& site) {
  return std::make_unique<Universal>(world, description, site);
}

}  // namespace bubblesim
