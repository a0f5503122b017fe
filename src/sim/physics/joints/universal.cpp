// SPDX-License-Identifier: BSD-3-Clause
// universal: two axes at right angles. The first is fixed in the parent, the second in the child.
#include <cmath>

#include "physics/joints/define.hpp"
#include "scene/describe.hpp"
#include "validation/checker.hpp"
#include "validation/limits.hpp"

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

class UniversalKind final : public JointKind {
 public:
  UniversalKind() : JointKind("universal", 2) { swings = true; }

  /// Old models omit one or both axes: these are at right angles to the others.
  void read(const SdfElement&, const std::string&, LoadContext&, JointDescription& joint) const override {
    if (joint.axes.empty()) joint.axes.emplace_back().direction = Vector3::UnitX();
    if (joint.axes.size() > 1) return;
    const Vector3 first = joint.axes.front().direction;
    const Vector3 beside = std::abs(first.y()) < 0.9 ? Vector3::UnitY() : Vector3::UnitZ();
    joint.axes.emplace_back().direction = (beside - first * first.dot(beside)).normalized();
  }

  void check(Checker& checker, const ModelDescription&, const JointDescription& joint) const override {
    checker.require(within(joint.axes[0].direction.dot(joint.axes[1].direction), 1e-2), "the second axis",
                    text(joint.axes[1].direction), "at right angles to the first");
  }

  std::unique_ptr<Joint> make(dxWorld* world, const JointDescription& description,
                              const JointSite& site) const override {
    return std::make_unique<Universal>(world, description, site);
  }
};

template const JointKind& joint_kind<UniversalKind>();

}  // namespace bubblesim
