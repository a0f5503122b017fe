// SPDX-License-Identifier: BSD-3-Clause
// revolute and continuous: the child rotates about one axis.
#include <cmath>

#include "physics/joints/define.hpp"

namespace bubblesim {
namespace {

bool beyond_half_a_turn(double limit) { return std::isfinite(limit) && std::abs(limit) > M_PI; }

class Hinge final : public Joint {
 public:
  Hinge(dWorldID world, const JointDescription& description, const JointSite& site)
      : Joint(description.axes), joint_(dJointCreateHinge(world, nullptr)) {
    // Child first: ODE measures the angle of the first body relative to the second.
    dJointAttach(joint_.get(), site.child, site.parent);
    const Vector3 direction = axis_direction(description, 0, site);
    dJointSetHingeAnchor(joint_.get(), site.pose.position.x(), site.pose.position.y(), site.pose.position.z());
    dJointSetHingeAxis(joint_.get(), direction.x(), direction.y(), direction.z());
    const AxisDescription& axis = description.axes[0];
    counts_turns_ = beyond_half_a_turn(axis.lower) || beyond_half_a_turn(axis.upper) || axis.spring_stiffness > 0;
    add_rows(world, Motor(joint_.get(), dJointSetHingeParam, 0), Motion::kTurns, {direction, site.child, site.parent});
  }

  /// From -pi to pi; with limits beyond, or a spring, full turns are counted.
  double position(int) const override {
    const double angle = dJointGetHingeAngle(joint_.get());
    return counts_turns_ ? angle + 2 * M_PI * std::round((followed_ - angle) / (2 * M_PI)) : angle;
  }
  double velocity(int) const override { return dJointGetHingeAngleRate(joint_.get()); }

  void place(const Pose& frame) override {
    const Vector3 direction = frame.orientation * axis(0).direction;
    dJointSetHingeAnchor(joint_.get(), frame.position.x(), frame.position.y(), frame.position.z());
    dJointSetHingeAxis(joint_.get(), direction.x(), direction.y(), direction.z());
    turn_motors(direction);
  }

 private:
  void follow(double) override {
    if (!counts_turns_) return;
    followed_ = position(0);
    // ODE compares angles from -pi to pi with the stops: shift the stops to the current turn.
    shift_limits(0, followed_ - dJointGetHingeAngle(joint_.get()));
  }
  void transfer_own(StateArchive& archive) override {
    if (counts_turns_) archive(followed_);
  }

  ode::JointHandle joint_;
  bool counts_turns_ = false;
  double followed_ = 0;  // rad, position at the last substep
};

}  // namespace

class RevoluteKind final : public JointKind {
 public:
  RevoluteKind() : JointKind("revolute", 1) { is_hinge = swings = true; }

  std::unique_ptr<Joint> make(dxWorld* world, const JointDescription& description,
                              const JointSite& site) const override {
    return std::make_unique<Hinge>(world, description, site);
  }
};

template const JointKind& joint_kind<RevoluteKind>();

class ContinuousKind final : public JointKind {
 public:
  ContinuousKind() : JointKind("continuous", 1) {
    is_hinge = swings = true;
    has_limits = false;
  }

  std::unique_ptr<Joint> make(dxWorld* world, const JointDescription& description,
                              const JointSite& site) const override {
    return std::make_unique<Hinge>(world, description, site);
  }
};

template const JointKind& joint_kind<ContinuousKind>();

}  // namespace bubblesim
